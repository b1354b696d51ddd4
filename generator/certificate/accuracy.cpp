// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/accuracy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>

#include "common/as_index.hpp"
#include "generator/certificate/random_point.hpp"
#include "generator/derivation/chain.hpp"

namespace catena {
namespace {

using GiNaC::ex;
using GiNaC::numeric;
using Values = std::vector<double>;

constexpr double kGrowth = 10;  // most growth of the entries of N in elimination that is measured

constexpr int kDigitsOfAccuracy = 50;
constexpr double kRounding = std::numeric_limits<double>::epsilon();

// value - exact, rounded once
double difference(double value, const numeric& exact) {
  return (exact - numeric(value)).to_double();
}

double largest(const Values& values) {
  double size = 0;
  for (const double value : values)
    size = std::isnan(value) ? value : std::max(size, std::abs(value));
  return size;
}

class Measurement {
 public:
  Measurement(const Description& description, int links, const catena_model& table)
      : table_(table), chain_(description, links) {
    inertial_ = std::make_unique<Differential>(
        chain_.definitions(), [](const std::string& family) { return family + "_exact_inertial"; });
    for (const ex& a : chain_.accelerations()) {
      inertial_->set(a, chain_.definitions().input("exact_unit_" + full_name_of(a)));
    }
    for (const ex& r : chain_.residual()) mass_.push_back(inertial_->of(r));
    for (const EnergyItem& item : chain_.energies()) {
      if (item.kind != EnergyItem::kStored) continue;
      for (const ex& part : item.parts) stored_rate_.push_back(chain_.rate(part));
    }
  }

  void add_point(std::mt19937_64& generator) {
    point_ = random_point(table_, generator);
    direction_ = random_direction(table_, generator);
    const numeric step = GiNaC::pow(numeric(10), numeric(-18));
    here_ = std::make_unique<ExactEvaluation>(chain_.definitions(), exact_inputs(table_, point_));
    step_ = step;
    ahead_ = std::make_unique<ExactEvaluation>(chain_.definitions(),
                                               exact_inputs(table_, point_, direction_, step));
    behind_ = std::make_unique<ExactEvaluation>(chain_.definitions(),
                                                exact_inputs(table_, point_, direction_, -step));
    residual();
    adjoint();
    mass_and_acceleration();
    newton(generator);
    states();
    positions();
    energy();
    internal_forces();
    reactions();
    if (table_.events > 0) events();
    if (table_.observes) sensor();
  }

  const std::vector<FunctionAccuracy>& result() const { return result_; }

 private:
  std::string full_name_of(const ex& symbol) {
    return GiNaC::ex_to<GiNaC::symbol>(symbol).get_name();
  }

  void note(const std::string& function, double error, double size) {
    const double units = error == 0 ? 0 : std::abs(error) / (kRounding * size);
    for (FunctionAccuracy& known : result_) {
      if (known.function != function) continue;
      known.worst = std::isnan(known.worst) || std::isnan(units) ? std::nan("")
                                                                 : std::max(known.worst, units);
      return;
    }
    result_.push_back({function, units});
  }

  numeric slope(const ex& expression) {
    return (ahead_->of(expression) - behind_->of(expression)) / (2 * step_);
  }

  // Of a value that a small change of its inputs changes by more than itself: the square of a difference that is nearly
  // zero, the angle of two links that nearly fold back on each other.
  static double size_with_slope(double size, const numeric& change) {
    return size + std::abs(change.to_double());
  }

  // The largest sum of the sizes of r's terms, over its rows
  double size_of_terms(const catena_point& point) const {
    Values sum(as_index(table_.coordinates)), term(as_index(table_.coordinates));
    for (int k = 0; k < table_.terms; ++k) {
      table_.residual_term(table_.context, &point, k, term.data());
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += std::abs(term[i]);
    }
    return largest(sum);
  }

  void residual() {
    const catena_point here = point_.at(), along = direction_.at();
    const double size = size_of_terms(here);
    Values r(as_index(table_.coordinates)), total(r), term(r), tangent(r);
    table_.residual(table_.context, &here, r.data());
    for (int k = 0; k < table_.terms; ++k) {
      table_.residual_term(table_.context, &here, k, term.data());
      for (std::size_t i = 0; i < r.size(); ++i) total[i] += term[i];
    }
    table_.residual_tangent(table_.context, &here, &along, tangent.data());
    for (std::size_t i = 0; i < r.size(); ++i) {
      const numeric exact = here_->of(chain_.residual()[i]);
      note("residual", difference(r[i], exact), size);
      note("residual_term", difference(total[i], exact), size);
      const numeric change = slope(chain_.residual()[i]);
      note("residual_tangent", difference(tangent[i], change), size_with_slope(size, change));
    }
  }

  // The product of the gradient with a direction is the derivative along this direction.
  void adjoint() {
    const catena_point here = point_.at();
    RandomPoint along = direction_;
    along.t = 0;
    for (auto* list : {&along.a, &along.u}) std::fill(list->begin(), list->end(), 0.0);
    const Values weights = direction_.a, rate_weights = direction_.z;
    Values dq(along.q.size()), dv(along.v.size()), dz(along.z.size()), dp(along.p.size());
    table_.residual_adjoint(table_.context, &here, weights.data(), rate_weights.data(), dq.data(),
                            dv.data(), dz.data(), dp.data());
    ExactEvaluation ahead(chain_.definitions(), exact_inputs(table_, point_, along, step_));
    ExactEvaluation behind(chain_.definitions(), exact_inputs(table_, point_, along, -step_));
    numeric error = 0;
    double size = size_of_terms(here);
    const auto subtract = [&](const Values& gradient, const Values& direction) {
      for (std::size_t i = 0; i < gradient.size(); ++i) {
        error = error - numeric(gradient[i]) * numeric(direction[i]);
        size += std::abs(gradient[i] * direction[i]);
      }
    };
    subtract(dq, along.q), subtract(dv, along.v), subtract(dz, along.z), subtract(dp, along.p);
    const auto add = [&](const std::vector<ex>& values, const Values& factors) {
      for (std::size_t i = 0; i < values.size(); ++i) {
        error = error +
                numeric(factors[i]) * (ahead.of(values[i]) - behind.of(values[i])) / (2 * step_);
      }
    };
    add(chain_.residual(), weights), add(chain_.state_rates(), rate_weights);
    note("residual_adjoint", error.to_double(), size);
  }

  void mass_and_acceleration() {
    const int n = table_.coordinates;
    const catena_point here = point_.at();
    Values mass(as_index(n * n));
    table_.mass_matrix(table_.context, &here, mass.data());
    const double size = largest(mass);
    // M x for one x depends on every entry. The product of the doubles is exact.
    const auto inputs = exact_inputs(table_, point_);
    std::map<std::string, numeric> x;
    for (int j = 0; j < n; ++j) {
      x["exact_unit_" + full_name_of(chain_.accelerations()[as_index(j)])] =
          numeric(direction_.a[as_index(j)]);
    }
    ExactEvaluation product(chain_.definitions(), [&](const std::string& name) -> ex {
      const auto found = x.find(name);
      return found == x.end() ? inputs(name) : ex(found->second);
    });
    for (int i = 0; i < n; ++i) {
      numeric row = 0;
      for (int j = 0; j < n; ++j) {
        row = row + numeric(mass[as_index(i * n + j)]) * numeric(direction_.a[as_index(j)]);
      }
      note("mass_matrix", (product.of(mass_[as_index(i)]) - row).to_double(), size);
    }
    RandomPoint still = point_;
    std::fill(still.a.begin(), still.a.end(), 0.0);
    const catena_point at_rest = still.at();
    Values h(as_index(n));
    table_.bias(table_.context, &here, h.data());
    ExactEvaluation exact_bias(chain_.definitions(), exact_inputs(table_, still));
    const double bias_size = size_of_terms(at_rest);
    for (int i = 0; i < n; ++i) {
      note("bias", difference(h[as_index(i)], exact_bias.of(chain_.residual()[as_index(i)])),
           bias_size);
    }
    RandomPoint moving = point_;
    if (table_.acceleration(table_.context, &here, moving.a.data()) != 0) {
      note("acceleration", std::nan(""), 1);
      return;
    }
    const catena_point solved = moving.at();
    ExactEvaluation back(chain_.definitions(), exact_inputs(table_, moving));
    const double solved_size = size_of_terms(solved) + size * largest(moving.a);
    for (int i = 0; i < n; ++i) {
      note("acceleration", back.of(chain_.residual()[as_index(i)]).to_double(), solved_size);
    }
  }

  void newton(std::mt19937_64& generator) {
    if (!table_.structured) return;
    const int n = table_.coordinates;
    double cv = 0.5 + static_cast<double>(generator() % 64);
    Values matrix = newton_matrix(cv);
    // An integrator shortens its step where the pivots of N are small. With cv = 0 N is M, which no step
    // makes better: what holds an end lets its entries grow.
    const double growth_of_mass = elimination_growth(newton_matrix(0));
    for (; elimination_growth(matrix) > kGrowth * growth_of_mass; matrix = newton_matrix(cv))
      cv /= 2;
    const double ca = 1.0, cq = cv * cv, size_of_matrix = growth_of_mass * largest(matrix);
    Values work(as_index(table_.newton_work)), x(as_index(n));
    const catena_point here = point_.at();
    if (table_.newton_factor(table_.context, &here, ca, cv, cq, work.data()) != 0) {
      note("newton_solve", std::nan(""), 1);
      return;
    }
    const Values right = direction_.q;
    x = right;
    table_.newton_solve(table_.context, work.data(), x.data());
    // N x from the derivation: the slope of r along (q, v, a) = (cq, cv, ca) x
    RandomPoint along = direction_;
    along.t = 0;
    for (auto* list : {&along.z, &along.u, &along.p}) std::fill(list->begin(), list->end(), 0.0);
    double size_of_x = largest(x);
    const auto scaled = [&](Values& list, double factor) {
      for (int i = 0; i < n; ++i) list[as_index(i)] = factor * x[as_index(i)] / size_of_x;
    };
    scaled(along.q, cq), scaled(along.v, cv), scaled(along.a, ca);
    eliminate_states(along, cv);
    ExactEvaluation ahead(chain_.definitions(), exact_inputs(table_, point_, along, step_));
    ExactEvaluation behind(chain_.definitions(), exact_inputs(table_, point_, along, -step_));
    // y of N'y = left has y.(N x) = left.x.
    const Values left = direction_.v;
    Values y = left;
    table_.newton_solve_transposed(table_.context, work.data(), y.data());
    numeric transposed = 0;
    for (int i = 0; i < n; ++i) {
      const ex& r = chain_.residual()[as_index(i)];
      const numeric product = (ahead.of(r) - behind.of(r)) / (2 * step_) * numeric(size_of_x);
      note("newton_solve", difference(right[as_index(i)], product), size_of_matrix * size_of_x);
      transposed = transposed + numeric(y[as_index(i)]) * product -
                   numeric(left[as_index(i)]) * numeric(x[as_index(i)]);
    }
    note("newton_solve_transposed", transposed.to_double(),
         size_of_matrix * size_of_x * largest(y));
  }

  // N with ca = 1 and cq = cv^2, column by column
  Values newton_matrix(double cv) {
    const int n = table_.coordinates;
    Values matrix(as_index(n * n));
    const catena_point here = point_.at();
    for (int j = 0; j < n; ++j) {
      RandomPoint unit = direction_;
      unit.t = 0;
      for (auto* list : {&unit.q, &unit.v, &unit.a, &unit.z, &unit.u, &unit.p})
        std::fill(list->begin(), list->end(), 0.0);
      unit.q[as_index(j)] = cv * cv, unit.v[as_index(j)] = cv, unit.a[as_index(j)] = 1;
      eliminate_states(unit, cv);
      const catena_point along_unit = unit.at();
      table_.residual_tangent(table_.context, &here, &along_unit, matrix.data() + j * n);
    }
    return matrix;
  }

  // Growth of the entries when rows are eliminated as the emitted code does, without exchanges: the last link
  // first, in space its components in their order, and what belongs to no link after the chain.
  double elimination_growth(const Values& given) const {
    const double before = largest(given);
    const int n = table_.coordinates, components = table_.positions_across != nullptr ? 3 : 1;
    // The first one is eliminated last. A table has all links of a component one after the other.
    std::vector<int> order;
    for (int k = components * table_.links; k < n; ++k) order.push_back(k);
    for (int i = 0; i < table_.links; ++i)
      for (int a = components - 1; a >= 0; --a) order.push_back(a * table_.links + i);
    Values matrix(given);
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < n; ++i)
        matrix[as_index(k * n + i)] = given[as_index(order[as_index(k)] * n + order[as_index(i)])];
    double met = before;
    for (int j = n - 1; j > 0; --j) {
      for (int k = 0; k < j; ++k) {
        const double factor = matrix[as_index(k * n + j)] / matrix[as_index(j * n + j)];
        for (int i = 0; i < j; ++i) {
          double& entry = matrix[as_index(k * n + i)];
          entry -= factor * matrix[as_index(j * n + i)];
          met = std::max(met, std::abs(entry));
        }
      }
    }
    return met / before;
  }

  // along.z that follows from the rest of `along` in N: cv (1 - cv df/dz)^-1 (df/dv dv + df/dq dq)
  void eliminate_states(RandomPoint& along, double cv) {
    if (table_.states == 0) return;
    const catena_point here = point_.at();
    Values moved(as_index(table_.states)), own(moved);
    std::fill(along.z.begin(), along.z.end(), 0.0);
    const catena_point held = along.at();
    table_.state_rate_tangent(table_.context, &here, &held, moved.data());
    RandomPoint unit = along;
    for (auto* list : {&unit.q, &unit.v, &unit.a}) std::fill(list->begin(), list->end(), 0.0);
    std::fill(unit.z.begin(), unit.z.end(), 1.0);
    const catena_point states_alone = unit.at();
    table_.state_rate_tangent(table_.context, &here, &states_alone, own.data());
    for (std::size_t k = 0; k < own.size(); ++k) along.z[k] = cv * moved[k] / (1 - cv * own[k]);
  }

  void states() {
    if (table_.states == 0) return;
    const catena_point here = point_.at(), along = direction_.at();
    Values rate(as_index(table_.states)), tangent(rate);
    table_.state_rate(table_.context, &here, rate.data());
    table_.state_rate_tangent(table_.context, &here, &along, tangent.data());
    // A motion that time prescribes has a phase, whose rounding is one of time.
    RandomPoint later = direction_;
    for (auto* list : {&later.q, &later.v, &later.a, &later.z, &later.u, &later.p})
      std::fill(list->begin(), list->end(), 0.0);
    later.t = here.t;
    ExactEvaluation ahead(chain_.definitions(), exact_inputs(table_, point_, later, step_));
    ExactEvaluation behind(chain_.definitions(), exact_inputs(table_, point_, later, -step_));
    Values by_time;
    for (const ex& exact : chain_.state_rates())
      by_time.push_back(((ahead.of(exact) - behind.of(exact)) / (2 * step_)).to_double());
    const double size = largest(rate) + largest(by_time) + 1,
                 tangent_size = largest(tangent) + size;
    for (std::size_t i = 0; i < rate.size(); ++i) {
      note("state_rate", difference(rate[i], here_->of(chain_.state_rates()[i])), size);
      note("state_rate_tangent", difference(tangent[i], slope(chain_.state_rates()[i])),
           tangent_size);
    }
  }

  void positions() {
    const catena_point here = point_.at(), along = direction_.at();
    const std::size_t points = as_index(table_.links + 2);
    std::vector<Values> place(chain_.axes().size(), Values(points)), change(place), velocity(place);
    const void* context = table_.context;
    table_.positions(context, &here, place[kSide].data(), place[kDown].data());
    table_.positions_tangent(context, &here, &along, change[kSide].data(), change[kDown].data());
    table_.velocities(context, &here, velocity[kSide].data(), velocity[kDown].data());
    if (place.size() > kAcross) {
      table_.positions_across(context, &here, place[kAcross].data());
      table_.positions_across_tangent(context, &here, &along, change[kAcross].data());
      table_.velocities_across(context, &here, velocity[kAcross].data());
    }
    const auto size_of = [&](const std::vector<Values>& lists) {
      double size = 0;
      for (const Values& list : lists) {
        size += std::abs(list[0]);
        for (std::size_t i = 1; i < points; ++i) size += std::abs(list[i] - list[i - 1]);
      }
      return size;
    };
    const double size = size_of(place), size_of_change = size_of(change), speed = size_of(velocity);
    for (const Axis axis : chain_.axes()) {
      for (std::size_t i = 0; i < points; ++i) {
        const ex& position = chain_.position(axis)[i];
        note("positions", difference(place[axis][i], here_->of(position)), size);
        note("positions_tangent", difference(change[axis][i], slope(position)),
             size_of_change + size);
        note("velocities", difference(velocity[axis][i], here_->of(chain_.rate(position))), speed);
      }
    }
    if (table_.gap != nullptr) gap(size, speed);
  }

  // The sizes are those of positions.
  void gap(double size, double speed) {
    const catena_point here = point_.at();
    const std::vector<ex>& gaps = chain_.gap();
    Values apart(gaps.size()), rate(gaps.size());
    table_.gap(table_.context, &here, apart.data(), rate.data());
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      note("gap", difference(apart[k], here_->of(gaps[k])), size + std::abs(apart[k]));
      note("gap", difference(rate[k], here_->of(chain_.rate(gaps[k]))), speed + std::abs(rate[k]));
    }
  }

  void events() {
    const catena_point here = point_.at();
    Values values(as_index(table_.events));
    table_.event_values(table_.context, &here, values.data());
    auto emitted = values.begin();
    for (const Chain::Event& event : chain_.events())
      for (const ex& expression : event.values) {
        const numeric exact = here_->of(expression);
        note("event_values", difference(*emitted++, exact),
             size_with_slope(std::abs(exact.to_double()), slope(expression)));
      }
  }

  void energy() {
    const catena_point here = point_.at();
    Values energy(as_index(table_.energies));
    table_.energy(table_.context, &here, energy.data());
    std::vector<numeric> exact;
    numeric balance = 0;
    double powers = 0;  // the sum of the sizes of all
    for (std::size_t k = 0; k < energy.size(); ++k) {
      const EnergyItem& item = chain_.energies()[k];
      numeric sum = 0, change = 0;
      double size = 0;
      for (const ex& part : item.parts) {
        const numeric value = here_->of(part);
        sum = sum + value;
        change = change + slope(part);
        size += std::abs(value.to_double());
      }
      exact.push_back(sum);
      if (item.kind == EnergyItem::kStored) {
        note("energy", difference(energy[k], sum), size_with_slope(size, change));
      } else {
        balance = item.kind == EnergyItem::kDissipated ? balance + sum : balance - sum;
        powers += size;
      }
    }
    for (const ex& part : stored_rate_) {
      const numeric value = here_->of(part);
      balance = balance + value;
      powers += std::abs(value.to_double());
    }
    for (std::size_t i = 0; i < chain_.residual().size(); ++i) {
      const numeric value = here_->of(chain_.rates()[i]) * here_->of(chain_.residual()[i]);
      balance = balance - value;
      powers += std::abs(value.to_double());
    }
    for (std::size_t k = 0; k < energy.size(); ++k) {
      if (chain_.energies()[k].kind != EnergyItem::kStored) {
        note("power", difference(energy[k], exact[k]), powers);
      }
    }
    note("power_balance", balance.to_double(), powers);
  }

  void internal_forces() {
    const catena_point here = point_.at();
    const std::size_t n = as_index(table_.links);
    Values moment(n), tension(n), curvature(n);
    table_.internal_forces(table_.context, &here, moment.data(), tension.data(), curvature.data());
    const auto compare = [&](const Values& values, const std::vector<ex>& exact, double size) {
      for (std::size_t i = 0; i < n; ++i)
        note("internal_forces", difference(values[i], here_->of(exact[i])),
             size_with_slope(size, slope(exact[i])));
    };
    compare(moment, chain_.moments(), largest(moment));
    compare(tension, chain_.tensions(), largest(tension) + size_of_terms(here));
    compare(curvature, chain_.curvatures(), largest(curvature));
  }

  void reactions() {
    if (table_.reactions == nullptr) return;
    const catena_point here = point_.at();
    std::vector<const ex*> forces, moments;
    for (const Chain::Reaction& reaction : chain_.reactions()) {
      for (const ex& component : reaction.force) forces.push_back(&component);
      for (const ex& component : reaction.moment) moments.push_back(&component);
    }
    Values force(forces.size()), moment(moments.size());
    table_.reactions(table_.context, &here, force.data(), moment.data());
    const auto compare = [&](const Values& values, const std::vector<const ex*>& exact) {
      const double size = largest(values) + size_of_terms(here);
      for (std::size_t i = 0; i < values.size(); ++i)
        note("reactions", difference(values[i], here_->of(*exact[i])), size);
    };
    compare(force, forces);
    compare(moment, moments);
  }

  void sensor() {
    const catena_point here = point_.at(), along = direction_.at();
    const Chain::Sensor& sensor = chain_.sensor();
    const double in[3] = {0.3, 0.7, 0.4}, din[3] = {0.5, -0.6, 0.8};
    double out[3], dout[3];
    table_.observe(table_.context, here.t, here.p, in, out);
    table_.observe_tangent(table_.context, here.t, here.p, along.p, in, din, dout);
    const auto inputs = [&](const numeric& step) {
      auto others = exact_inputs(table_, point_, without_time(direction_), step);
      return [=, &sensor](const std::string& name) -> ex {
        for (std::size_t k = 0; k < sensor.seen.size(); ++k) {
          if (name == sensor.seen[k]) return numeric(in[k]) + step * numeric(din[k]);
        }
        return others(name);
      };
    };
    ExactEvaluation now(chain_.definitions(), inputs(0));
    ExactEvaluation ahead(chain_.definitions(), inputs(step_));
    ExactEvaluation behind(chain_.definitions(), inputs(-step_));
    for (std::size_t k = 0; k < sensor.reported.size(); ++k) {
      const ex& reported = sensor.reported[k];
      note("observe", difference(out[k], now.of(reported)), 1);
      const numeric change = (ahead.of(reported) - behind.of(reported)) / (2 * step_);
      note("observe_tangent", difference(dout[k], change), 1);
    }
    const double clock = table_.clock(table_.context, here.t, here.p);
    const double clock_change = table_.clock_tangent(table_.context, here.t, here.p, along.p);
    note("clock", difference(clock, now.of(sensor.clock)), 1 + std::abs(clock));
    note("clock_tangent",
         difference(clock_change, (ahead.of(sensor.clock) - behind.of(sensor.clock)) / (2 * step_)),
         1 + std::abs(clock_change));
  }

  static RandomPoint without_time(RandomPoint direction) {
    direction.t = 0;
    return direction;
  }

  const catena_model& table_;
  Chain chain_;
  std::unique_ptr<Differential> inertial_;
  std::vector<ex> mass_, stored_rate_;
  RandomPoint point_, direction_;
  numeric step_;
  std::unique_ptr<ExactEvaluation> here_, ahead_, behind_;
  std::vector<FunctionAccuracy> result_;
};

}  // namespace

std::vector<FunctionAccuracy> measure_accuracy(const Description& description, int links,
                                               const catena_model& table, int points,
                                               unsigned seed) {
  const long digits_before = GiNaC::Digits;
  GiNaC::Digits = kDigitsOfAccuracy + 20;  // differences with a step of 1e-18 lose digits
  Measurement measurement(description, links, table);
  std::mt19937_64 generator(seed);
  for (int k = 0; k < points; ++k) measurement.add_point(generator);
  GiNaC::Digits = digits_before;
  return measurement.result();
}

}  // namespace catena
