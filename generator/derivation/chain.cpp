// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/chain.hpp"

#include <stdexcept>

namespace catena {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

const ex kHalf = numeric(1, 2);

std::string rate_family(const std::string& family) {
  const std::string velocity = "_velocity";
  if (family.ends_with(velocity)) {
    return family.substr(0, family.size() - velocity.size()) + "_acceleration";
  }
  if (family == "joint_angle") return "joint_rate";
  return family + velocity;
}

// The family of the generalised force of a variable, by its name in mechanics.
std::string force_family(const std::string& family) {
  if (family == "joint_side") return "cut_force_side";
  if (family == "joint_down") return "cut_force_down";
  if (family == "joint_angle") return "joint_moment";
  return family + "_force";
}

// A cut force is counted by the link below the cut.
int force_index(const Symbol& variable) {
  const bool joint = variable.family == "joint_side" || variable.family == "joint_down";
  return joint ? variable.index + 1 : variable.index;
}

}  // namespace

Chain::Chain(const Description& description, int links, const std::string& only_term,
             EffectForces effect_forces)
    : description_(description),
      links_(links),
      only_term_(only_term),
      time_(definitions_, rate_family),
      forces_(effect_forces) {
  make_inputs();
  make_kinematics();
  add_chain_terms();
  for (const Effect& effect : description_.effects) {
    if (forces_ == EffectForces::kApart) apart_ = effect.id;
    add_effect_terms(effect);
  }
  apart_.clear();
  pull_back();
  add_support_power();
  add_sensors();
}

std::vector<std::string> Chain::term_names(const Description& description) {
  std::vector<std::string> names{"kinetic", "gravity", "elastic", "friction", "torque"};
  for (const Effect& effect : description.effects) {
    if (!effect.forces.empty() || !effect.scalars.empty()) names.push_back(effect.id);
  }
  return names;
}

void Chain::make_inputs() {
  const auto per_link = [&](const char* family) {
    std::vector<ex> symbols(1);
    for (Link i = 1; i <= links_; ++i) symbols.push_back(definitions_.input(family, i));
    return symbols;
  };
  const auto add_coordinate = [&](const ex& q, const ex& v, const ex& a) {
    coordinates_.push_back(q);
    rates_.push_back(v);
    accelerations_.push_back(a);
    variables_.insert(definitions_.number_of(q));
    variable_of_rate_[definitions_.number_of(v)] = definitions_.number_of(q);
    time_.set(q, v);
    time_.set(v, a);
  };
  length_ = per_link("length");
  mass_ = per_link("mass");
  inertia_ = per_link("inertia");
  stiffness_ = per_link("stiffness");
  damping_ = per_link("damping");
  torque_ = per_link("torque");
  load_mass_ = definitions_.input("load_mass");
  gravity_ = definitions_.input("gravity");
  time_symbol_ = definitions_.input("time");
  time_.set(time_symbol_, 1);

  theta_ = per_link("theta");
  theta_dot_ = per_link("theta_dot");
  theta_ddot_ = per_link("theta_ddot");
  sine_.resize(1);
  cosine_.resize(1);
  for (Link i = 1; i <= links_; ++i) {
    add_coordinate(theta_[i], theta_dot_[i], theta_ddot_[i]);
    sine_.push_back(definitions_.define("sine", i, GiNaC::sin(theta_[i])));
    cosine_.push_back(definitions_.define("cosine", i, GiNaC::cos(theta_[i])));
    time_.set(sine_[i], cosine_[i] * theta_dot_[i]);
    time_.set(cosine_[i], -sine_[i] * theta_dot_[i]);
  }
  for (const Effect& effect : description_.effects) {
    for (const Coordinate& coordinate : effect.coordinates) {
      const std::string name = effect.id + "_" + coordinate.name;
      auto& symbols = effect_symbols_[effect.id + "." + coordinate.name];
      symbols.resize(1);
      for (Link i = 1; i <= links_; ++i) {
        symbols.push_back(definitions_.input(name, i));
        add_coordinate(symbols[i], definitions_.input(name + "_dot", i),
                       definitions_.input(name + "_ddot", i));
      }
    }
    for (const ExtraState& state : effect.states) {
      auto& symbols = effect_symbols_[effect.id + "." + state.name];
      symbols.resize(1);
      const Link last = state.at == Place::kPivot ? 1 : links_;
      for (Link i = 1; i <= last; ++i) {
        symbols.push_back(definitions_.input(effect.id + "_" + state.name, i));
      }
    }
    for (const SignalChannel& signal : effect.signals) {
      const std::string name = effect.id + "_" + signal.name;
      const ex value = definitions_.input(name);
      const ex rate = definitions_.input(name + "_rate");
      time_.set(value, rate);
      time_.set(rate, definitions_.input(name + "_acceleration"));
    }
  }
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

// (2.24)-(2.27), with the changes that effects make
void Chain::make_kinematics() {
  ex support_side = 0, support_down = 0;
  for (const Effect& effect : description_.effects) {
    support_side += evaluate(effect, effect.support.side, kShape, Place::kLoad, 0, "m");
    support_down += evaluate(effect, effect.support.down, kShape, Place::kLoad, 0, "m");
  }
  joint_side_.push_back(define_variable("joint_side", 0, support_side));
  joint_down_.push_back(define_variable("joint_down", 0, support_down));
  const auto vector = [&] { return std::vector<ex>(1); };
  reach_ = centre_side_ = centre_down_ = middle_side_ = middle_down_ = joint_angle_ = vector();
  arc_ = hanging_depth_ = {ex(0)};

  for (Link i = 1; i <= links_; ++i) {
    const ex extension = kinematic(&Kinematics::extension, "m", Place::kLink, i);
    reach_.push_back(extension.is_zero()
                         ? length_[i]
                         : define_variable("stretched_length", i, length_[i] + extension));
    const ex offset = kinematic(&Kinematics::centre_offset, "m", Place::kLink, i);
    arc_.push_back(definitions_.define("arc", i, arc_[i - 1] + length_[i]));
    // from the upper to the lower end of the link
    const ex span_side = define_variable("span_side", i, reach_[i] * sine_[i]);
    const ex span_down = define_variable("span_down", i, reach_[i] * cosine_[i]);
    middle_side_.push_back(
        define_variable("centre_side", i, joint_side_[i - 1] + kHalf * span_side));
    middle_down_.push_back(
        define_variable("centre_down", i, joint_down_[i - 1] + kHalf * span_down));
    const auto shifted = [&](const char* family, const ex& middle, const ex& direction) {
      return offset.is_zero() ? middle : define_variable(family, i, middle + offset * direction);
    };
    centre_side_.push_back(shifted("mass_centre_side", middle_side_[i], sine_[i]));
    centre_down_.push_back(shifted("mass_centre_down", middle_down_[i], cosine_[i]));
    joint_side_.push_back(define_variable("joint_side", i, joint_side_[i - 1] + span_side));
    joint_down_.push_back(define_variable("joint_down", i, joint_down_[i - 1] + span_down));
    ex rest = kinematic(&Kinematics::rest_angle, "rad", Place::kJoint, i);
    if (i == 1) rest += kinematic(&Kinematics::pivot_rest_angle, "rad", Place::kPivot, i);
    const ex above = i == 1 ? ex(0) : theta_[i - 1];
    joint_angle_.push_back(define_variable("joint_angle", i, theta_[i] - above - rest));
  }
  const ex load_offset = kinematic(&Kinematics::load_offset, "m", Place::kLoad, 0);
  load_side_ = joint_side_[links_];
  load_down_ = joint_down_[links_];
  if (!load_offset.is_zero()) {
    load_side_ = define_variable("load_side", kNoIndex, load_side_ + load_offset * sine_[links_]);
    load_down_ = define_variable("load_down", kNoIndex, load_down_ + load_offset * cosine_[links_]);
  }
  load_mass_ += kinematic(&Kinematics::load_mass, "kg", Place::kLoad, 0);
  load_inertia_ = kinematic(&Kinematics::load_inertia, "kg m^2", Place::kLoad, 0);
  const ex tilt = kinematic(&Kinematics::gravity_tilt, "rad", Place::kLoad, 0);
  cos_tilt_ =
      tilt.is_zero() ? ex(1) : definitions_.define("tilt_cosine", kNoIndex, GiNaC::cos(tilt));
  sin_tilt_ = tilt.is_zero() ? ex(0) : definitions_.define("tilt_sine", kNoIndex, GiNaC::sin(tilt));

  for (Link i = 0; i <= links_; ++i) {
    point_side_.push_back(joint_side_[i]);
    point_down_.push_back(joint_down_[i]);
  }
  point_side_.push_back(load_side_);
  point_down_.push_back(load_down_);
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

// d/dt(dT/dydot) - dT/dy
void Chain::add_kinetic(const std::string& item, const ex& energy) {
  energy_functions_.kinetic.push_back(energy);
  add_energy(item, EnergyItem::kStored, energy);
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
    }
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
    const auto rate = variable_of_rate_.find(number);
    if (rate == variable_of_rate_.end()) continue;
    const ex symbol = definitions_[number].symbol;
    const ex derivative = function.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
    add_generalised_force(rate->second, derivative);
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

void Chain::add_chain_terms() {
  hanging_depth_.resize(1);
  for (Link k = 1; k <= links_; ++k) {
    if (wanted("kinetic")) {
      const ex v_side = time_.of(centre_side_[k]), v_down = time_.of(centre_down_[k]);
      add_kinetic("kinetic", kHalf * mass_[k] * (v_side * v_side + v_down * v_down) +
                                 kHalf * inertia_[k] * theta_dot_[k] * theta_dot_[k]);
    }
    hanging_depth_.push_back(
        definitions_.define("hanging_depth", k, hanging_depth_[k - 1] + length_[k]));
    if (wanted("gravity")) {
      const ex height = hanging_depth_[k - 1] + length_[k] * kHalf -
                        (cos_tilt_ * centre_down_[k] + sin_tilt_ * centre_side_[k]);
      add_potential("gravity", mass_[k] * gravity_ * height);
    }
    if (wanted("elastic")) {
      add_potential("joint_elastic", kHalf * stiffness_[k] * joint_angle_[k] * joint_angle_[k]);
    }
    if (wanted("friction")) {
      const ex rate = time_.of(joint_angle_[k]);
      add_dissipation("joint_damping", kHalf * damping_[k] * rate * rate);
    }
    if (wanted("torque")) add_force("torque", {{theta_[k], torque_[k]}});
  }
  if (wanted("kinetic")) {
    const ex v_side = time_.of(load_side_), v_down = time_.of(load_down_);
    const ex turning = theta_dot_[links_];
    add_kinetic("kinetic", kHalf * load_mass_ * (v_side * v_side + v_down * v_down) +
                               kHalf * load_inertia_ * turning * turning);
  }
  if (wanted("gravity")) {
    const ex height = hanging_depth_[links_] - (cos_tilt_ * load_down_ + sin_tilt_ * load_side_);
    add_potential("gravity", load_mass_ * gravity_ * height);
  }
}

// The length of cable that bends in joint i.
ex Chain::spacing(Link i) const { return (i == 1 ? length_[1] : length_[i - 1] + length_[i]) / 2; }

void Chain::pull_back() {
  std::vector<ex> cut_side(static_cast<size_t>(links_) + 2), cut_down(cut_side);
  std::vector<ex> moment(cut_side);
  const auto keep = [&](std::vector<ex>& where, const ex& variable, int index) {
    const auto found = generalised_force_.find(definitions_.number_of(variable));
    where[static_cast<size_t>(index)] = found == generalised_force_.end() ? ex(0) : found->second;
  };
  // Later variables are functions of earlier ones, so the last one comes first.
  for (auto variable = variables_.rbegin(); variable != variables_.rend(); ++variable) {
    const int number = *variable;
    if (definitions_[number].is_input ||
        (!generalised_force_.contains(number) && !force_of_effect_.contains(number)))
      continue;
    const Symbol symbol = definitions_[number];
    const ex force = definitions_.define(force_family(symbol.family), force_index(symbol),
                                         generalised_force_of(number));
    generalised_force_[number] = force;
    for (const int argument : definitions_.symbols_of(symbol.value)) {
      const Symbol below = definitions_[argument];
      const ex partial = symbol.value.diff(GiNaC::ex_to<GiNaC::symbol>(below.symbol));
      if (variables_.count(argument)) {
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
  for (Link i = 1; i <= links_; ++i) {
    keep(cut_side, joint_side_[i - 1], i);
    keep(cut_down, joint_down_[i - 1], i);
    keep(moment, joint_angle_[i], i);
    const ex above = i == 1 ? ex(0) : theta_[i - 1];
    curvatures_.push_back(definitions_.named((theta_[i] - above) / spacing(i), "curvature", i));
    tensions_.push_back(
        definitions_.named(-(cut_side[i] * sine_[i] + cut_down[i] * cosine_[i]), "tension", i));
    moments_.push_back(definitions_.named(-moment[i], "moment", i));
  }
  support_force_side_ = cut_side[1];
  support_force_down_ = cut_down[1];
}

// The force that moves the support does work.
void Chain::add_support_power() {
  const ex power = support_force_side_ * time_.of(joint_side_[0]) +
                   support_force_down_ * time_.of(joint_down_[0]);
  if (!power.is_zero()) add_energy("support", EnergyItem::kSupplied, power);
}

}  // namespace catena
