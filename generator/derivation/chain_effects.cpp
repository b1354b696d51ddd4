// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adds the terms of effects to the chain. Expressions are parsed with the symbols of their place.
// They become potentials, dissipation functions, forces and torques (virtual work), kinetic
// energies, extra states and sensor expressions.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "description/expression_syntax.hpp"
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// Whether a power of `square` that is not whole stands somewhere: the size of the vector itself.
bool has_root_of(const ex& expression, const ex& square) {
  if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(0).is_equal(square) &&
      !expression.op(1).info(GiNaC::info_flags::integer))
    return true;
  for (const ex& part : expression)
    if (has_root_of(part, square)) return true;
  return false;
}

}  // namespace

ex Chain::without_sizes(ex value, const Expression& expression, const Surroundings& here,
                        bool in_energy) const {
  for (const Size& size : here.sizes) {
    if (has_root_of(value, size.placeholder))
      fail_at(expression, in_quotes(size.name) +
                              " is the size of a vector in space, which has no derivative at zero; "
                              "write it with even powers only, as " +
                              in_quotes(size.name + "^2"));
    value = value.subs(size.placeholder == (in_energy ? size.in_energy : size.square),
                       GiNaC::subs_options::no_pattern);
  }
  return value;
}

ex Chain::evaluate(const Effect& effect, const Expression& expression, Knowledge knowledge,
                   Place place, Link i, const char* unit, bool in_energy) {
  if (!expression.given()) return 0;
  Surroundings here = surroundings(effect, knowledge, place, i);
  add_definitions(effect, knowledge, place, here);
  return without_sizes(parse_expression(expression, here.known, Unit::parse(unit)), expression,
                       here, in_energy);
}

std::vector<std::string> Chain::state_components() const {
  std::vector<std::string> components;
  if (in_plane()) return {""};
  for (const Axis axis : axes()) components.push_back(ending(axis));
  return components;
}

// A term that is an odd function of the size w of one vector and even in all others is this vector times its
// quotient by w, which is even in all.
std::optional<Chain::AlongVector> Chain::along_one_vector(const ex& term,
                                                          const Surroundings& here) {
  const auto is_even = [&](const ex& factor) {
    return std::none_of(here.sizes.begin(), here.sizes.end(),
                        [&](const Size& size) { return has_root_of(factor, size.placeholder); });
  };
  for (const Size& along : here.sizes) {
    if (along.direction.empty()) continue;
    ex factor = term * GiNaC::pow(along.placeholder, ex(GiNaC::numeric(-1, 2)));
    if (!is_even(factor)) factor = factor.expand();
    if (!is_even(factor)) continue;
    for (const Size& size : here.sizes)
      factor = factor.subs(size.placeholder == size.square, GiNaC::subs_options::no_pattern);
    return AlongVector{along.name, along.direction, factor};
  }
  return std::nullopt;
}

std::vector<ex> Chain::evaluate_vector(const Effect& effect, const Expression& expression,
                                       Place place, Link i, const char* unit) {
  Surroundings here = surroundings(effect, kMotion, place, i);
  add_definitions(effect, kMotion, place, here);
  const ex value = parse_expression(expression, here.known, Unit::parse(unit)).expand();
  std::vector<ex> vector(axes().size());
  const auto add_term = [&](const ex& term) {
    const auto along = along_one_vector(term, here);
    if (!along)
      fail_at(expression,
              "in space this is a vector along joint_rate and states; write a sum of terms that "
              "are odd "
              "in one of them and even in the others, as moment*slip/reach");
    for (std::size_t k = 0; k < vector.size(); ++k)
      vector[k] += along->factor * along->direction[k];
  };
  if (GiNaC::is_a<GiNaC::add>(value)) {
    for (const ex& term : value) add_term(term);
  } else if (!value.is_zero()) {
    add_term(value);
  }
  return vector;
}

// A force normal to the link, by axis: along velocity_normal or relative_normal.
std::vector<ex> Chain::force_along_normal(const Effect& effect, const ForceTerm& force, Link i,
                                          const ex& scale, const char* unit) {
  Surroundings here = surroundings(effect, kMotion, force.at, i);
  add_definitions(effect, kMotion, force.at, here);
  const auto along =
      along_one_vector(parse_expression(force.normal, here.known, Unit::parse(unit)), here);
  if (!along)
    fail_at(force.normal,
            "in space a force normal to a link has the direction of velocity_normal or of "
            "relative_normal; write an odd function of one of them, such as "
            "-c*velocity_normal*sqrt(velocity_normal^2 + floor^2)");
  const ex factor =
      definitions_.define(effect.id + "_" + named_at(force.at) + "normal_force_per_" + along->name,
                          index_at(force.at, i), scale * along->factor);
  std::vector<ex> components;
  for (const ex& component : along->direction) components.push_back(factor * component);
  components.resize(axes().size());
  return components;
}

ex Chain::kinematic(Expression Kinematics::*quantity, const char* unit, Place place, Link i) {
  ex sum = 0;
  for (const Effect& effect : description_.effects) {
    sum += evaluate(effect, effect.kinematics.*quantity, kShape, place, i, unit);
  }
  return sum;
}

void Chain::add_effect_terms(const Effect& effect) {
  for (const ExtraState& state : effect.states) {
    const std::string unit = state.unit + "/s";
    if (state.at == Place::kLoad) {
      states_.push_back(effect_symbols_.at(effect.id + "." + state.name)[0]);
      state_rates_.push_back(
          definitions_.named(evaluate(effect, state.rate, kMotion, state.at, 0, unit.c_str()),
                             effect.id + "_" + state.name + "_rate", kNoIndex));
      continue;
    }
    const std::vector<std::string> components = state_components();
    std::vector<std::vector<ex>> rates(1);  // [joint][component]
    at_each(state.at, [&](Link i) {
      if (in_plane()) {
        rates.push_back({evaluate(effect, state.rate, kMotion, state.at, i, unit.c_str())});
      } else {
        rates.push_back(evaluate_vector(effect, state.rate, state.at, i, unit.c_str()));
      }
    });
    // In the order of the table: all joints of a component.
    for (std::size_t k = 0; k < components.size(); ++k) {
      const std::string name = state.name + components[k];
      at_each(state.at, [&](Link i) {
        states_.push_back(effect_symbols_.at(effect.id + "." + name)[i]);
        state_rates_.push_back(definitions_.named(rates[static_cast<std::size_t>(i)][k],
                                                  effect.id + "_" + name + "_rate", i));
      });
    }
  }
  if (effect.held_end.twists()) {
    states_.push_back(path_);
    state_rates_.push_back(
        definitions_.named(time_.of(path_), effect.id + "_twist_of_path_rate", kNoIndex));
  }
  if (!wanted(effect.id)) return;

  for (const ForceTerm& force : effect.forces)
    at_each(force.at, [&](Link i) { add_force_term(effect, force, i); });
  for (const ScalarTerm& term : effect.scalars)
    at_each(term.at, [&](Link i) { add_scalar_term(effect, term, i); });
}

void Chain::add_force_along(const Effect& effect, const ForceTerm& force, Link i) {
  Surroundings here = surroundings(effect, kMotion, force.at, i);
  add_definitions(effect, kMotion, force.at, here);
  const auto [velocity, unit] = parse_expression(force.along, here.known);
  const Unit wanted = Unit::parse(force.per_length ? "W/m" : "W") / unit;
  const ex size =
      without_sizes(parse_expression(force.value, here.known, wanted), force.value, here);
  const ex along = without_sizes(velocity, force.along, here);
  if (along.is_zero()) return;  // a point that does not move, such as the support
  const auto coefficients = coefficients_of_rates(along);
  if (!coefficients || coefficients->empty())
    fail_at(
        force.along,
        "it is not linear in velocities and rates; a force does work along one of them, such as "
        "velocity_side, or along a sum of them times functions of the shape");
  const ex value =
      definitions_.define(effect.id + "_" + named_at(force.at) + "force_along",
                          index_at(force.at, i), (force.per_length ? length_[i] : ex(1)) * size);
  for (const auto& [rate, coefficient] : *coefficients) {
    const auto variable = variable_of_rate_.find(rate);
    add_generalised_force(variable == variable_of_rate_.end() ? rate : variable->second,
                          -value * coefficient);
  }
  add_energy(effect.id, EnergyItem::kSupplied, value * along);
}

void Chain::add_force_term(const Effect& effect, const ForceTerm& force, Link i) {
  if (force.along.given()) return add_force_along(effect, force, i);
  const char* unit = force.per_length ? "N/m" : "N";
  const ex scale = force.per_length ? length_[i] : ex(1);
  const auto part = [&](const char* what, const Expression& expression) {
    return definitions_.define(effect.id + "_" + named_at(force.at) + "force_" + what,
                               index_at(force.at, i),
                               scale * evaluate(effect, expression, kMotion, force.at, i, unit));
  };
  std::vector<ex> components = {part("side", force.side), part("down", force.down)};
  if (!in_plane()) components.push_back(part("across", force.across));
  const bool vector_normal = !in_plane() || effect.flow.across.given();
  if (force.normal.given() && vector_normal) {
    const std::vector<ex> normal = force_along_normal(effect, force, i, scale, unit);
    for (std::size_t k = 0; k < components.size(); ++k) components[k] += normal[k];
  } else if (force.normal.given()) {
    const Link link = force.at == Place::kLoad ? links_ : i;
    const ex normal = part("normal", force.normal);
    components[kSide] += normal * cosine_[link];
    components[kDown] += -normal * sine_[link];
  }
  const std::vector<ex> point = point_at(force.at, i), direction = direction_at(force.at, i);
  const ex tangential = part("tangential", force.tangential);
  std::vector<Component> forces;
  for (std::size_t k = 0; k < components.size(); ++k)
    forces.push_back({point[k], components[k] + tangential * direction[k]});
  add_force(effect.id, forces);
}

void Chain::add_scalar_term(const Effect& effect, const ScalarTerm& term, Link i) {
  const bool joint = term.at == Place::kJoint || term.at == Place::kPivot;
  const ex scale = term.per_length ? length_[i] : ex(1);
  const auto value = [&](const char* unit, const char* unit_per_length) {
    return scale * evaluate(effect, term.value, kMotion, term.at, i,
                            term.per_length ? unit_per_length : unit,
                            term.kind == ScalarKind::kKinetic);
  };
  switch (term.kind) {
    case ScalarKind::kTorque:
      if (!in_plane()) {
        add_torque_of_joint(effect, term, i);
        break;
      }
      add_force(effect.id, {{joint ? joint_angle_[i] : theta_[i == 0 ? links_ : i],
                             definitions_.define(effect.id + "_" + named_at(term.at) + "torque",
                                                 index_at(term.at, i), value("N m", "N"))}});
      break;
    case ScalarKind::kPotential:
      add_potential(effect.id, value("J", "J/m"));
      break;
    case ScalarKind::kDissipation:
      add_dissipation(effect.id, value("W", "W/m"));
      break;
    case ScalarKind::kKinetic:
      add_kinetic(effect.id, value("J", "J/m"));
      break;
  }
}

// In space, between the two links of joint i: virtual work on the difference of their angular velocities.
void Chain::add_torque_of_joint(const Effect& effect, const ScalarTerm& term, Link i) {
  const std::vector<ex> torque = evaluate_vector(effect, term.value, term.at, i, "N m");
  ex power = 0;
  for (const Axis axis : axes()) {
    const ex component = definitions_.define(effect.id + "_torque" + ending(axis), i, torque[axis]);
    add_generalised_force(joint_turning_[axis][i], -component);
    power += component * joint_turning_[axis][i];
  }
  add_energy(effect.id, EnergyItem::kSupplied, power);
}

// Sensor effects act one after the other, in the order of the description. Clock offsets are added.
void Chain::add_sensors() {
  sensor_.seen = {"side", "down", in_plane() ? "angle" : "across"};
  std::vector<ex> seen;
  for (const std::string& name : sensor_.seen) seen.push_back(definitions_.input(name));
  sensor_.clock = time_symbol_;
  for (const Effect& effect : description_.effects) {
    if (!effect.sensor.given()) continue;
    sensor_.given = true;
    ExpressionContext symbols = surroundings(effect, kShape, Place::kAnywhere, 0).known;
    ExpressionContext clock_symbols = symbols;
    const auto add = [&](const std::string& name, const ex& value, const char* unit) {
      // An effect may have a name `across` of its own.
      if (name != "across" || !symbols.symbols.contains(name))
        symbols.add(name, value, Unit::parse(unit));
    };
    for (std::size_t k = 0; k < seen.size(); ++k)
      add(sensor_.seen[k], seen[k], sensor_.seen[k] == "angle" ? "rad" : "m");
    if (in_plane()) add("across", 0, "m");
    for (const Definition& definition : effect.definitions) {
      if (definition.at != Place::kAnywhere) continue;
      for (ExpressionContext* known : {&symbols, &clock_symbols})
        if (has_meaning(definition.value, *known)) add_definition(definition, *known);
    }
    const auto reported = [&](const Expression& by, const ex& before, const char* unit) {
      return by.given() ? parse_expression(by, symbols, Unit::parse(unit)) : before;
    };
    const catena::Sensor& by = effect.sensor;
    const ex side = reported(by.side, seen[0], "m"), down = reported(by.down, seen[1], "m");
    seen[2] = in_plane() ? reported(by.angle, seen[2], "rad") : reported(by.across, seen[2], "m");
    seen[0] = side;
    seen[1] = down;
    if (by.clock.given())
      sensor_.clock += parse_expression(by.clock, clock_symbols, Unit::parse("s")) - time_symbol_;
  }
  for (std::size_t k = 0; k < seen.size(); ++k)
    sensor_.reported.push_back(
        definitions_.named(seen[k], "observed_" + sensor_.seen[k], kNoIndex));
  sensor_.clock = definitions_.named(sensor_.clock, "model_time", kNoIndex);
}

void Chain::add_events() {
  const auto add = [&](const Effect& effect, const EventValue& event) {
    std::vector<ex>& values = events_.emplace_back(Event{event.at, {}}).values;
    at_each(event.at, [&](Link i) {
      values.push_back(definitions_.named(
          evaluate(effect, event.value, kMotion, event.at, i, event.unit.c_str()),
          effect.id + "_" + event.name, index_at(event.at, i)));
    });
  };
  for (const bool of_each_link : {false, true})
    for (const Effect& effect : description_.effects)
      for (const EventValue& event : effect.events)
        if (is_of_each_link(event.at) == of_each_link) add(effect, event);
}

}  // namespace catena
