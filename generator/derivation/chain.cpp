// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/chain.hpp"

#include <algorithm>
#include <stdexcept>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "description/effect_checks.hpp"
#include "description/expression_syntax.hpp"

namespace catena {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

const ex kHalf = numeric(1, 2);

// In space the length of q has this many times (I + m l^2/4) (d|q|^2/dt)^2 of kinetic energy, which moves
// nothing else. Moments of turned links push along q where factors of the Newton matrix are old: with 1/8
// Newton's iteration fails in one of eight steps of 1000 links. With 8 it fails in none of them, but twice as often
// in chains of 3 links (docs/performance.md).
const ex kInertiaOfLength = 2;

std::string rate_family(const std::string& family) {
  if (family.ends_with("_momentum")) return family + "_rate";
  const std::string velocity = "_velocity";
  if (family.ends_with(velocity)) {
    return family.substr(0, family.size() - velocity.size()) + "_acceleration";
  }
  if (family == "joint_angle") return "joint_rate";
  return family + velocity;
}

bool is_joint_position(const std::string& family) {
  return family == "joint_side" || family == "joint_down" || family == "joint_across";
}

// The family of the generalised force of a variable, by its name in mechanics.
std::string force_family(const std::string& family) {
  if (is_joint_position(family)) return "cut_force" + family.substr(std::string("joint").size());
  if (family == "joint_angle") return "joint_moment";
  return family + "_force";
}

// A cut force is counted by the link below the cut.
int force_index(const Symbol& variable) {
  return is_joint_position(variable.family) ? variable.index + 1 : variable.index;
}

}  // namespace

Chain::Chain(const Description& description, int links, const std::string& only_term,
             EffectForces effect_forces)
    : description_(description),
      links_(links),
      only_term_(only_term),
      time_(definitions_, rate_family),
      forces_(effect_forces) {
  if (const std::string conflict = conflict_in(description_); !in_plane() && !conflict.empty())
    throw std::invalid_argument(conflict);
  check_held();
  make_inputs();
  make_kinematics();
  if (std::any_of(description_.effects.begin(), description_.effects.end(),
                  [](const Effect& effect) { return names_in(effect).contains(kSteadyTension); }))
    add_steady_tensions();
  add_chain_terms();
  hold();
  for (const Effect& effect : description_.effects) {
    if (forces_ == EffectForces::kApart) apart_ = effect.id;
    add_effect_terms(effect);
  }
  apart_.clear();
  pull_back();
  add_power_of_ends();
  add_sensors();
  add_events();
}

std::string ending(Axis axis) {
  return axis == kSide ? "_side" : axis == kDown ? "_down" : "_across";
}

std::vector<std::string> Chain::term_names(const Description& description) {
  std::vector<std::string> names{"kinetic", "gravity", "elastic", "friction"};
  if (description.space == Space::kPlane) names.emplace_back("torque");
  for (const Effect& effect : description.effects) {
    if (!effect.forces.empty() || !effect.scalars.empty() || effect.held_end.holds())
      names.push_back(effect.id);
  }
  return names;
}

void Chain::add_coordinate(const ex& q, const ex& v, const ex& a) {
  coordinates_.push_back(q);
  rates_.push_back(v);
  accelerations_.push_back(a);
  variables_.insert(definitions_.number_of(q));
  variable_of_rate_[definitions_.number_of(v)] = definitions_.number_of(q);
  time_.set(q, v);
  time_.set(v, a);
}

ex Chain::define_variable(const std::string& family, int index, const ex& value) {
  const ex variable = definitions_.define_always(family, index, value);
  const int number = definitions_.number_of(variable);
  variables_.insert(number);
  ex rate = time_.of(value);
  if (!rate.is_zero()) {
    rate = definitions_.define_always(rate_family(family), index, rate);
    variable_of_rate_[definitions_.number_of(rate)] = number;
    const ex value_of_rate = definitions_[definitions_.number_of(rate)].value;
    const std::string second = rate_family(rate_family(family));
    time_.set(rate, definitions_.define_always(second, index, time_.of(value_of_rate)));
  }
  time_.set(variable, rate);
  return variable;
}

// A variable of the load. Functions in its value have names; these are variables, too.
ex Chain::define_shape(const std::string& family, const ex& value) {
  ex variable = define_variable(family, kNoIndex, value);
  differentiate_names_in(definitions_[definitions_.number_of(variable)].value);
  return variable;
}

void Chain::differentiate_names_in(const ex& value) {
  for (const int number : definitions_.symbols_of(value)) {
    const Symbol symbol = definitions_[number];
    if (symbol.is_input || symbol.family == "sine" || symbol.family == "cosine" ||
        variable_of_rate_.contains(number) || quasi_velocities_.contains(number) ||
        variables_.contains(number) || time_.of(symbol.symbol).is_zero())
      continue;
    variables_.insert(number);
    differentiate_names_in(symbol.value);
  }
}

// The coefficients of the rates and quasi-velocities in an expression that is linear in them, by their
// numbers. None, if it is a function of the shape; nothing, if it is not linear.
std::optional<std::map<int, ex>> Chain::coefficients_of_rates(const ex& velocity) const {
  const auto is_rate = [&](int number) {
    return variable_of_rate_.contains(number) || quasi_velocities_.contains(number);
  };
  std::map<int, ex> coefficients;
  ex rest = velocity;
  for (const int number : definitions_.symbols_of(velocity)) {
    if (!is_rate(number)) continue;
    const ex symbol = definitions_[number].symbol;
    const ex coefficient = velocity.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
    const std::vector<int> inside = definitions_.symbols_of(coefficient);
    if (std::any_of(inside.begin(), inside.end(), is_rate)) return {};
    coefficients[number] = coefficient;
    rest -= coefficient * symbol;
  }
  if (!coefficients.empty() && !rest.expand().is_zero()) return {};
  return coefficients;
}

void Chain::add_generalised_force(const ex& variable, const ex& force) {
  add_generalised_force(definitions_.number_of(variable), force);
}

void Chain::add_generalised_force(int variable, const ex& force) {
  ex& sum = apart_.empty() ? generalised_force_[variable] : force_of_effect_[variable][apart_];
  sum += force;
}

// The force of a variable, those of effects under names of their own.
ex Chain::generalised_force_of(int variable) {
  ex force = generalised_force_[variable];
  const Symbol symbol = definitions_[variable];
  for (const auto& [effect, part] : force_of_effect_[variable]) {
    const ex named =
        definitions_.define(effect + "_" + force_family(symbol.family), force_index(symbol), part);
    if (GiNaC::is_a<GiNaC::symbol>(named)) effect_forces_.insert(definitions_.number_of(named));
    force += named;
  }
  return force;
}

void Chain::add_energy(const std::string& item, EnergyItem::Kind kind, const ex& part) {
  for (EnergyItem& energy : energies_) {
    if (energy.name == item && energy.kind == kind) {
      energy.parts.push_back(part);
      return;
    }
  }
  energies_.push_back({item, kind, {part}});
}

void Chain::add_kinetic(const std::string& item, const ex& energy) {
  energy_functions_.kinetic.push_back(energy);
  add_energy(item, EnergyItem::kStored, energy);
  add_momenta(energy);
}

// d/dt(dT/dydot) - dT/dy
void Chain::add_momenta(const ex& energy) {
  for (const int number : definitions_.symbols_of(energy)) {
    const Symbol symbol = definitions_[number];
    const ex derivative = energy.diff(GiNaC::ex_to<GiNaC::symbol>(symbol.symbol));
    const auto rate = variable_of_rate_.find(number);
    if (rate != variable_of_rate_.end()) add_generalised_force(rate->second, time_.of(derivative));
    if (variables_.count(number)) add_generalised_force(number, -derivative);
    if (symbol.family == "sine") {
      add_generalised_force(theta_[symbol.index], -derivative * cosine_[symbol.index]);
    } else if (symbol.family == "cosine") {
      add_generalised_force(theta_[symbol.index], derivative * sine_[symbol.index]);
    } else if (quasi_velocities_.count(number)) {
      add_momentum(number, derivative);
    }
  }
}

// d/dt(p dw/dydot) - p dw/dy
void Chain::add_momentum(int rate, const ex& momentum) {
  const Symbol symbol = definitions_[rate];
  const ex p = definitions_.define(symbol.family + "_momentum", symbol.index, momentum);
  for (const int number : definitions_.symbols_of(symbol.value)) {
    const ex partial = symbol.value.diff(GiNaC::ex_to<GiNaC::symbol>(definitions_[number].symbol));
    const auto of = variable_of_rate_.find(number);
    if (of != variable_of_rate_.end()) add_generalised_force(of->second, time_.of(p * partial));
    if (variables_.count(number)) add_generalised_force(number, -p * partial);
    if (quasi_velocities_.count(number)) add_momentum(number, p * partial);
    if (of == variable_of_rate_.end() && definitions_[number].family == "sine")
      add_generalised_force(theta_[definitions_[number].index],
                            -p * partial * cosine_[definitions_[number].index]);
    if (of == variable_of_rate_.end() && definitions_[number].family == "cosine")
      add_generalised_force(theta_[definitions_[number].index],
                            p * partial * sine_[definitions_[number].index]);
  }
}

// dV/dy
void Chain::add_potential(const std::string& item, const ex& energy) {
  energy_functions_.potential.push_back(energy);
  add_energy(item, EnergyItem::kStored, energy);
  for (const int number : definitions_.symbols_of(energy)) {
    const Symbol symbol = definitions_[number];
    const ex derivative = energy.diff(GiNaC::ex_to<GiNaC::symbol>(symbol.symbol));
    if (variables_.count(number)) add_generalised_force(number, derivative);
    if (symbol.family == "sine") {
      add_generalised_force(theta_[symbol.index], derivative * cosine_[symbol.index]);
    } else if (symbol.family == "cosine") {
      add_generalised_force(theta_[symbol.index], -derivative * sine_[symbol.index]);
    }
  }
}

// dD/dydot; the power that leaves is sum ydot dD/dydot
void Chain::add_dissipation(const std::string& item, const ex& function) {
  energy_functions_.dissipation.push_back(function);
  ex power = 0;
  for (const int number : definitions_.symbols_of(function)) {
    const ex symbol = definitions_[number].symbol;
    const ex derivative = function.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
    const auto rate = variable_of_rate_.find(number);
    const bool quasi_velocity = quasi_velocities_.contains(number);
    if (rate == variable_of_rate_.end() && !quasi_velocity) continue;
    add_generalised_force(quasi_velocity ? number : rate->second, derivative);
    power += symbol * derivative;
  }
  add_energy(item, EnergyItem::kDissipated, power);
}

// Virtual work: forces times the variations of their variables. The powers of all components are
// one part of the energy: with one part per link, sums over links become loops.
void Chain::add_force(const std::string& item, const std::vector<Component>& components) {
  ex power = 0;
  for (const auto& [variable, force] : components) {
    if (force.is_zero()) continue;
    add_generalised_force(variable, -force);
    power += force * time_.of(variable);
  }
  if (!power.is_zero()) add_energy(item, EnergyItem::kSupplied, power);
}

ex Chain::speed_squared(const std::vector<ex>& position) {
  ex sum = 0;
  for (const ex& component : position) {
    const ex velocity = time_.of(component);
    sum += velocity * velocity;
  }
  return sum;
}

ex Chain::squared_rate(Link i) {
  if (in_plane()) return theta_dot_[i] * theta_dot_[i];
  std::vector<ex> direction;
  for (const Axis axis : axes()) direction.push_back(direction_[axis][i]);
  return speed_squared(direction);
}

void Chain::add_chain_terms() {
  const auto at = [&](const Points& points, Link k) {
    std::vector<ex> position;
    for (const Axis axis : axes()) position.push_back(points[axis][k]);
    return position;
  };
  hanging_depth_.resize(1);
  joint_cosine_.resize(1);
  link_turning_.resize(axes().size());
  joint_turning_ = joint_cross_ = Points(axes().size(), std::vector<ex>(1));
  rest_bend_.resize(1);
  for (Link k = 1; k <= links_; ++k) {
    if (wanted("kinetic")) {
      ex energy =
          kHalf * mass_[k] * speed_squared(at(centre_, k)) + kHalf * inertia_[k] * squared_rate(k);
      if (!in_plane()) {
        const ex rate = time_.of(direction_square_[k]);
        energy +=
            kInertiaOfLength * (inertia_[k] + mass_[k] * length_[k] * length_[k] / 4) * rate * rate;
      }
      // One part of the energy a link: sums over links become loops.
      add_kinetic("kinetic", energy);
    }
    hanging_depth_.push_back(
        definitions_.define("hanging_depth", k, hanging_depth_[k - 1] + length_[k]));
    if (wanted("gravity")) {
      const ex height = hanging_depth_[k - 1] + length_[k] * kHalf -
                        (cos_tilt_ * centre_[kDown][k] + sin_tilt_ * centre_[kSide][k]);
      add_potential("gravity", mass_[k] * gravity_ * height);
    }
    add_joint_terms(k);
    if (in_plane() && wanted("torque")) add_force("torque", {{theta_[k], torque_[k]}});
  }
  if (wanted("kinetic")) {
    add_kinetic("kinetic", kHalf * load_mass_ * speed_squared(load_) +
                               kHalf * load_inertia_ * squared_rate(links_));
  }
  if (wanted("gravity")) {
    const ex height =
        hanging_depth_[links_] - (cos_tilt_ * load_[kDown] + sin_tilt_ * load_[kSide]);
    add_potential("gravity", load_mass_ * gravity_ * height);
  }
}

// Bending and damping of joint k. In space the section is isotropic: the moment is about the normal of
// the plane of the two links, and the angular velocity of a link is e x edot.
void Chain::add_joint_terms(Link k) {
  ex squared, rate_squared = 0;
  if (in_plane()) {
    const ex rate = time_.of(joint_angle_[k]);
    squared = joint_angle_[k] * joint_angle_[k];
    rate_squared = rate * rate;
  } else {
    ex cosine = 0;
    for (const Axis axis : axes()) cosine += direction_[axis][k - 1] * direction_[axis][k];
    joint_cosine_.push_back(define_variable("joint_cosine", k, cosine));
    squared = squared_angle(joint_cosine_[k]);
    for (const auto& axes_of_plane :
         {std::pair{kSide, kDown}, {kDown, kAcross}, {kAcross, kSide}}) {
      const Axis b = axes_of_plane.first, c = axes_of_plane.second;
      const Axis about = Axis(3 - b - c);
      const auto cross = [&](Link i, const ex& x_b, const ex& x_c) {
        return direction_[b][i] * x_c - direction_[c][i] * x_b;
      };
      const auto turning = [&](Link i) {
        return define_quasi_velocity(
            "turning" + ending(about), i,
            cross(i, time_.of(direction_[b][i]), time_.of(direction_[c][i])));
      };
      if (k == 1) link_turning_[about].push_back(turning(0));
      link_turning_[about].push_back(turning(k));
      // Under a name of its own at joint 1 too: its force is the moment of the joint.
      const ex rate =
          definitions_.define_always("joint_turning" + ending(about), k,
                                     link_turning_[about][k] - link_turning_[about][k - 1]);
      quasi_velocities_.insert(definitions_.number_of(rate));
      joint_turning_[about].push_back(rate);
      joint_cross_[about].push_back(cross(k - 1, direction_[b][k], direction_[c][k]));
      rate_squared += rate * rate;
    }
    rest_bend_.push_back(rest_bend(k));
    if (k <= links_)
      curvatures_.push_back(definitions_.named(GiNaC::sqrt(squared) / spacing(k), "curvature", k));
  }
  if (!in_plane() && !rest_bend_[k].empty()) {
    // |bend - rest|^2, with the bend vector (angle over sine) x (cross product).
    ex along = 0;
    for (const Axis axis : axes()) {
      along += rest_bend_[k][axis] * joint_cross_[axis][k];
      squared += rest_bend_[k][axis] * rest_bend_[k][axis];
    }
    squared -= 2 * angle_over_sine(joint_cosine_[k]) * along;
  }
  if (wanted("elastic")) add_potential("joint_elastic", kHalf * stiffness_[k] * squared);
  if (wanted("friction")) add_dissipation("joint_damping", kHalf * damping_[k] * rate_squared);
}

// Linear in the rates of variables, with coefficients that are functions of variables.
ex Chain::define_quasi_velocity(const std::string& family, int index, const ex& value) {
  ex rate = definitions_.define(family, index, value);
  if (!GiNaC::is_a<GiNaC::symbol>(rate)) return rate;
  const int number = definitions_.number_of(rate);
  if (!variable_of_rate_.contains(number)) quasi_velocities_.insert(number);
  return rate;
}

// The length of cable that bends in joint i.
ex Chain::spacing(Link i) const {
  if (i == 1) return length_[1] / 2;
  return (i > links_ ? length_[links_] : length_[i - 1] + length_[i]) / 2;
}

void Chain::pull_back() {
  std::vector<ex> moment(static_cast<size_t>(links_) + 2);
  Points cut(joint_.size(), moment);
  const auto keep = [&](std::vector<ex>& where, const ex& variable, int index) {
    const auto found = generalised_force_.find(definitions_.number_of(variable));
    where[static_cast<size_t>(index)] = found == generalised_force_.end() ? ex(0) : found->second;
  };
  // Later variables are functions of earlier ones, so the last one comes first. Quasi-velocities are
  // later than the variables whose rates they are made of.
  std::set<int> pulled = variables_;
  pulled.insert(quasi_velocities_.begin(), quasi_velocities_.end());
  for (auto variable = pulled.rbegin(); variable != pulled.rend(); ++variable) {
    const int number = *variable;
    if (definitions_[number].is_input ||
        (!generalised_force_.contains(number) && !force_of_effect_.contains(number)))
      continue;
    const Symbol symbol = definitions_[number];
    const ex force = definitions_.define(force_family(symbol.family), force_index(symbol),
                                         generalised_force_of(number));
    generalised_force_[number] = force;
    if (const auto carried = of_carried_axis_.find(number); carried != of_carried_axis_.end()) {
      const auto& [link, component] = carried->second;
      if (link == 0) continue;  // nothing but time moves it
      const CarriedAxis& of = bend_axes_[static_cast<std::size_t>(link)];
      add_generalised_force(of.roll_rate, force * of.crossing[component]);
      for (const Axis axis : axes())
        add_generalised_force(direction_[axis][link],
                              -force * direction_[component][link] * of.axis[axis]);
      continue;
    }
    for (const int argument : definitions_.symbols_of(symbol.value)) {
      const Symbol below = definitions_[argument];
      const ex partial = symbol.value.diff(GiNaC::ex_to<GiNaC::symbol>(below.symbol));
      if (quasi_velocities_.contains(number)) {
        const auto rate = variable_of_rate_.find(argument);
        if (rate != variable_of_rate_.end())
          generalised_force_[rate->second] += force * partial;
        else if (quasi_velocities_.contains(argument))
          generalised_force_[argument] += force * partial;
      } else if (variables_.count(argument)) {
        generalised_force_[argument] += force * partial;
      } else if (below.family == "sine") {
        add_generalised_force(theta_[below.index], force * partial * cosine_[below.index]);
      } else if (below.family == "cosine") {
        add_generalised_force(theta_[below.index], -force * partial * sine_[below.index]);
      }
    }
  }
  for (const ex& q : coordinates_) {
    const Symbol symbol = definitions_[definitions_.number_of(q)];
    residual_.push_back(definitions_.named(generalised_force_of(definitions_.number_of(q)),
                                           "residual_" + symbol.family, symbol.index));
  }
  if (!in_plane()) {
    direction_force_ = Points(direction_.size(), moment);
    for (const Axis axis : axes())
      for (Link i = 0; i < static_cast<Link>(direction_[axis].size()); ++i)
        if (GiNaC::is_a<GiNaC::symbol>(direction_[axis][i]))
          keep(direction_force_[axis], direction_[axis][i], i);
  }
  for (const auto& [id, chord] : chords_)
    for (const ex& component : chord.vector)
      if (const ex force = generalised_force_[definitions_.number_of(component)]; !force.is_zero())
        chord_forces_.push_back(force);
  for (Link i = 1; i <= links_; ++i) {
    ex tension = 0;
    for (const Axis axis : axes()) {
      keep(cut[axis], joint_[axis][i - 1], i);
      tension += (cut[axis][i] + force_of_chords(axis, i)) * direction_[axis][i];
    }
    tensions_.push_back(definitions_.named(-tension, "tension", i));
    if (!in_plane()) {
      ex squared = 0;
      for (const ex& component : moment_of_joint(i)) squared += component * component;
      moments_.push_back(definitions_.named(GiNaC::sqrt(squared), "moment", i));
      continue;
    }
    keep(moment, joint_angle_[i], i);
    const ex above = i == 1 ? ex(0) : theta_[i - 1];
    curvatures_.push_back(definitions_.named((theta_[i] - above) / spacing(i), "curvature", i));
    moments_.push_back(definitions_.named(-moment[i], "moment", i));
  }
  Reaction support;
  for (const Axis axis : axes()) support.force.push_back(cut[axis][1]);
  if (in_plane()) {
    support.moment = {moments_[0]};
  } else {
    for (const ex& moment : moment_of_joint(1)) support.moment.push_back(-moment);
  }
  reactions_.push_back(support);
  for (const Held& held : held_) {
    Reaction reaction;
    for (const ex& mu : held.mu) reaction.force.push_back(-time_.of(time_.of(mu)));
    reaction.moment = held.effect->held_end.turns() ? moment_of_joint(links_ + 1)
                                                    : std::vector<ex>(held.mu.size());
    reactions_.push_back(reaction);
  }
}

}  // namespace catena
