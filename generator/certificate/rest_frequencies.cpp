// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/rest_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <set>
#include <string_view>
#include <vector>

#include "common/as_index.hpp"
#include "generator/certificate/random_point.hpp"
#include "generator/certificate/twin.hpp"
#include "generator/derivation/chain.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using GiNaC::ex;
using GiNaC::numeric;
using Eigenvalues = std::vector<std::complex<double>>;

constexpr int kDigitsOfFrequencies = 70;
// The differences take about 8 n^2 evaluations in 70 digits: ten seconds for so many coordinates.
constexpr int kMostCoordinates = 24;

std::vector<double> parameters(const Description& description, const catena_model& table,
                               unsigned seed) {
  std::set<std::string, std::less<>> moving;  // effects that move the support
  for (const Effect& effect : description.effects) {
    if (effect.support.moves() || effect.support.turns()) moving.insert(effect.id);
  }
  std::mt19937_64 generator(seed);
  std::vector<double> p = cable_parameters(table);
  for (int i = 0; i < table.parameters; ++i) {
    const catena_parameter& parameter = table.parameter[i];
    const std::string_view name = parameter.name;
    const auto dot = name.find('.');
    if (dot == std::string_view::npos || moving.count(name.substr(0, dot))) continue;
    const double usual = parameter.default_value;
    const double seeded = random_parameter(parameter, generator);
    if (std::isfinite(usual) && usual != 0 && usual != parameter.neutral) {
      p[as_index(i)] = usual;
    } else {
      const double scale = std::isinf(parameter.neutral) ? 1e3 : 1;
      p[as_index(i)] = std::clamp(scale * seeded, parameter.lower, parameter.upper);
    }
  }
  return p;
}

RandomPoint still(const catena_model& table) {
  RandomPoint point;
  for (auto* list : {&point.q, &point.v, &point.a}) list->assign(as_index(table.coordinates), 0.0);
  point.z.assign(as_index(table.states), 0.0);
  point.u.assign(as_index(3 * table.signals), 0.0);
  point.p.assign(as_index(table.parameters), 0.0);
  return point;
}

// dr/dq by the emitted code
MatrixXd emitted_stiffness(const catena_model& table, const RandomPoint& point) {
  MatrixXd stiffness(table.coordinates, table.coordinates);
  const catena_point here = point.at();
  RandomPoint along = still(table);
  for (int j = 0; j < table.coordinates; ++j) {
    along.q[as_index(j)] = 1;
    const catena_point direction = along.at();
    table.residual_tangent(table.context, &here, &direction, stiffness.col(j).data());
    along.q[as_index(j)] = 0;
  }
  return stiffness;
}

// Moves the point to the equilibrium; false if none is reached.
bool come_to_rest(const catena_model& table, RandomPoint& point) {
  constexpr int kMostSteps = 200;
  constexpr double kLongestStep = 0.3, kShortestStep = 1e-12;
  for (int step = 0; step < kMostSteps; ++step) {
    VectorXd r(table.coordinates);
    const catena_point here = point.at();
    table.residual(table.context, &here, r.data());
    const VectorXd change = solve_square(emitted_stiffness(table, point), r);
    const double length = change.lpNorm<Eigen::Infinity>();
    if (!std::isfinite(length)) return false;
    const double part = std::min(1.0, kLongestStep / std::max(length, kShortestStep));
    for (int i = 0; i < table.coordinates; ++i) point.q[as_index(i)] -= part * change[i];
    if (length < kShortestStep) return true;
  }
  return false;
}

class FromEnergies {
 public:
  FromEnergies(Chain& chain, const catena_model& table, const RandomPoint& rest)
      : chain_(chain), table_(table), rest_(rest), step_(GiNaC::pow(numeric(10), numeric(-18))) {}

  MatrixXd mass() {
    const int n = table_.coordinates;
    std::vector<numeric> alone;
    for (int i = 0; i < n; ++i) alone.push_back(energy(velocity({i})));
    const numeric potential = energy(velocity({}));
    MatrixXd m(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j <= i; ++j) {
        const numeric both = energy(velocity({i, j}));
        m(i, j) = m(j, i) =
            (both - alone[as_index(i)] - alone[as_index(j)] + potential).to_double();
      }
    }
    return m;
  }

  MatrixXd stiffness() {
    const int n = table_.coordinates;
    MatrixXd k(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        k(i, j) = j > i ? 0 : mixed(&FromEnergies::energy, &RandomPoint::q, i, j);
      }
    }
    k.triangularView<Eigen::Upper>() = k.transpose();
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) k(i, j) += mixed(&FromEnergies::power, &RandomPoint::v, i, j);
    }
    return k;
  }

 private:
  using Quantity = numeric (FromEnergies::*)(const ExactEvaluation::Inputs&);

  ExactEvaluation::Inputs velocity(const std::vector<int>& ones) const {
    RandomPoint direction = still(table_);
    for (const int i : ones) direction.v[as_index(i)] += 1;
    return exact_inputs(table_, rest_, direction, 1);
  }

  numeric energy(const ExactEvaluation::Inputs& inputs) {
    ExactEvaluation evaluation(chain_.definitions(), inputs);
    numeric sum = 0;
    for (const EnergyItem& item : chain_.energies()) {
      if (item.kind != EnergyItem::kStored) continue;
      for (const ex& part : item.parts) sum = sum + evaluation.of(part);
    }
    return sum;
  }

  // The power that leaves the chain. The force of a fixed support does no work.
  numeric power(const ExactEvaluation::Inputs& inputs) {
    ExactEvaluation evaluation(chain_.definitions(), inputs);
    numeric sum = 0;
    for (const EnergyItem& item : chain_.energies()) {
      if (item.kind == EnergyItem::kStored || item.name == "support") continue;
      for (const ex& part : item.parts) {
        const numeric value = evaluation.of(part);
        sum = item.kind == EnergyItem::kDissipated ? sum + value : sum - value;
      }
    }
    return sum;
  }

  // d2/dx_i dq_j, x the coordinates or the rates
  double mixed(Quantity quantity, std::vector<double> RandomPoint::*x, int i, int j) {
    const auto at_corner = [&](int si, int sj) {
      RandomPoint direction = still(table_);
      (direction.*x)[as_index(i)] += si;
      direction.q[as_index(j)] += sj;
      return (this->*quantity)(exact_inputs(table_, rest_, direction, step_));
    };
    const numeric sum = at_corner(1, 1) - at_corner(1, -1) - at_corner(-1, 1) + at_corner(-1, -1);
    return (sum / (4 * step_ * step_)).to_double();
  }

  Chain& chain_;
  const catena_model& table_;
  const RandomPoint& rest_;
  numeric step_;
};

Eigenvalues sorted_eigenvalues(const MatrixXd& mass, const MatrixXd& stiffness) {
  Eigenvalues values = eigenvalues(solve_positive_definite(mass, stiffness));
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return std::abs(a) < std::abs(b); });
  return values;
}

}  // namespace

RestFrequencies rest_frequencies(const Description& description, int links,
                                 const catena_model& table, unsigned seed) {
  RestFrequencies result;
  if (table.coordinates > kMostCoordinates) {
    result.why_not = "the differences would take too long with more than " +
                     std::to_string(kMostCoordinates) + " coordinates";
    return result;
  }
  if (description.space != Space::kPlane) {
    result.why_not = "in space this is not written yet";
    return result;
  }
  RandomPoint rest = still(table);
  rest.p = parameters(description, table, seed);
  if (!come_to_rest(table, rest)) {
    result.why_not = "no equilibrium was found from the straight chain";
    return result;
  }
  MatrixXd mass(table.coordinates, table.coordinates);
  const catena_point here = rest.at();
  table.mass_matrix(table.context, &here, mass.data());
  const Eigenvalues emitted = sorted_eigenvalues(mass, emitted_stiffness(table, rest));

  const long digits_before = GiNaC::Digits;
  GiNaC::Digits = kDigitsOfFrequencies;
  Chain chain(description, links);
  FromEnergies from_energies(chain, table, rest);
  Eigenvalues other = sorted_eigenvalues(from_energies.mass(), from_energies.stiffness());
  GiNaC::Digits = digits_before;

  result.lowest = std::sqrt(std::abs(emitted.front()));
  result.highest = std::sqrt(std::abs(emitted.back()));
  for (const auto& value : emitted) {
    const auto nearest = std::min_element(other.begin(), other.end(), [&](auto a, auto b) {
      return std::abs(a - value) < std::abs(b - value);
    });
    result.largest_difference =
        std::max(result.largest_difference, std::abs(*nearest - value) / std::abs(value));
    other.erase(nearest);
  }
  return result;
}

}  // namespace catena
