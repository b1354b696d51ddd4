// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adds the terms of effects to the chain. Expressions are parsed with the symbols of their place.
// They become potentials, dissipation functions, forces and torques (virtual work), kinetic
// energies, extra states and sensor expressions.
#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "description/expression_syntax.hpp"
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

ex Chain::effect_parameter(const Effect& effect, const EffectParameter& parameter, Link i) {
  const bool shared = parameter.scope == Scope::kModel;
  return definitions_.input(effect.id + "_" + parameter.name, shared ? kNoIndex : i);
}

ExpressionContext Chain::context(const Effect& effect, Knowledge knowledge, Place place, Link i) {
  ExpressionContext context;
  const auto add = [&](const std::string& name, const ex& value, const std::string& unit) {
    context.add(name, value, Unit::parse(unit));
  };
  add("time", time_symbol_, "s");
  add("gravity", gravity_, "m/s^2");
  for (const EffectParameter& parameter : effect.parameters) {
    // A parameter per joint or link has no value at the load and at the support.
    if (parameter.scope != Scope::kModel && i == 0) continue;
    add(parameter.name, effect_parameter(effect, parameter, i), parameter.unit);
  }
  for (const Constant& constant : effect.constants) {
    add(constant.name, exact_number(constant.text), constant.unit);
  }
  for (const SignalChannel& signal : effect.signals) {
    const std::string name = effect.id + "_" + signal.name;
    add(signal.name, definitions_.input(name), signal.unit);
    add(signal.name + "_rate", definitions_.input(name + "_rate"), signal.unit + "/s");
    add(signal.name + "_acceleration", definitions_.input(name + "_acceleration"),
        signal.unit + "/s^2");
  }
  const auto add_point = [&](const ex& side, const ex& down) {
    add("side", side, "m");
    add("down", down, "m");
    add("depth", cos_tilt_ * down + sin_tilt_ * side, "m");
    add("velocity_side", time_.of(side), "m/s");
    add("velocity_down", time_.of(down), "m/s");
  };
  const auto add_directions = [&](const ex& side, const ex& down, Link link) {
    const ex v_side = time_.of(side), v_down = time_.of(down);
    add("velocity_normal", v_side * cosine_[link] - v_down * sine_[link], "m/s");
    add("velocity_tangential", v_side * sine_[link] + v_down * cosine_[link], "m/s");
  };
  const auto add_angle = [&](Link link) {
    add("angle", theta_[link], "rad");
    add("rate", theta_dot_[link], "rad/s");
  };
  const bool motion = knowledge == kMotion;
  if (place == Place::kLink || place == Place::kLinkCentre) {
    add("length", length_[i], "m");
    add("mass", mass_[i], "kg");
    add("inertia", inertia_[i], "kg m^2");
    for (const Coordinate& coordinate : effect.coordinates) {
      const ex symbol = effect_symbols_.at(effect.id + "." + coordinate.name)[i];
      add(coordinate.name, symbol, coordinate.unit);
      add(coordinate.name + "_rate", time_.of(symbol), coordinate.unit + "/s");
    }
    if (motion) add_angle(i);
    if (motion && place == Place::kLinkCentre) {
      add_point(middle_[kSide][i], middle_[kDown][i]);
      add_directions(middle_[kSide][i], middle_[kDown][i], i);
    }
  } else if (place == Place::kJoint || place == Place::kPivot) {
    add("stiffness", stiffness_[i], "N m/rad");
    add("damping", damping_[i], "N m s/rad");
    add("arc", arc_[i - 1], "m");
    add("spacing", spacing(i), "m");
    if (motion) {
      add_point(joint_[kSide][i - 1], joint_[kDown][i - 1]);
      add("joint_angle", joint_angle_[i], "rad");
      add("joint_rate", time_.of(joint_angle_[i]), "rad/s");
      for (const ExtraState& state : effect.states) {
        if (state.at == Place::kPivot && i != 1) continue;
        add(state.name, effect_symbols_.at(effect.id + "." + state.name)[i], state.unit);
      }
    }
  } else if (place == Place::kLoad && motion) {
    add("load_mass", load_mass_, "kg");
    add_angle(links_);
    add_point(load_[kSide], load_[kDown]);
    add_directions(load_[kSide], load_[kDown], links_);
  }
  return context;
}

ex Chain::evaluate(const Effect& effect, const Expression& expression, Knowledge knowledge,
                   Place place, Link i, const char* unit) {
  if (!expression.given()) return 0;
  ExpressionContext symbols = context(effect, knowledge, place, i);
  for (const Definition& definition : effect.definitions) {
    const bool here =
        definition.at == place || (definition.at == Place::kJoint && place == Place::kPivot);
    if (definition.at != Place::kAnywhere && (!here || knowledge == kShape)) continue;
    add_definition(definition, symbols);
  }
  return parse_expression(expression, symbols, Unit::parse(unit));
}

ex Chain::kinematic(Expression Kinematics::*quantity, const char* unit, Place place, Link i) {
  ex sum = 0;
  for (const Effect& effect : description_.effects) {
    sum += evaluate(effect, effect.kinematics.*quantity, kShape, place, i, unit);
  }
  return sum;
}

void Chain::add_effect_terms(const Effect& effect) {
  const auto each = [&](Place place, const auto& act) {
    if (place == Place::kLoad) {
      act(0);
    } else {
      const Link last = place == Place::kPivot ? 1 : links_;
      for (Link i = 1; i <= last; ++i) act(i);
    }
  };
  const auto name_of = [&](const char* what, const ex& value, Link i) {
    return i == 0 ? definitions_.define(effect.id + "_load_" + what, kNoIndex, value)
                  : definitions_.define(effect.id + "_" + what, i, value);
  };
  for (const ExtraState& state : effect.states) {
    each(state.at, [&](Link i) {
      const std::string unit = state.unit + "/s";
      const ex rate = evaluate(effect, state.rate, kMotion, state.at, i, unit.c_str());
      states_.push_back(effect_symbols_.at(effect.id + "." + state.name)[i]);
      state_rates_.push_back(definitions_.named(rate, effect.id + "_" + state.name + "_rate", i));
    });
  }
  if (!wanted(effect.id)) return;

  for (const ForceTerm& force : effect.forces) {
    each(force.at, [&](Link i) {
      const char* unit = force.per_length ? "N/m" : "N";
      const ex scale = force.per_length ? length_[i] : ex(1);
      const Link link = force.at == Place::kLoad ? links_ : i;
      const auto part = [&](const char* what, const Expression& expression) {
        return name_of(what, scale * evaluate(effect, expression, kMotion, force.at, i, unit), i);
      };
      ex side = part("force_side", force.side), down = part("force_down", force.down);
      if (force.normal.given() || force.tangential.given()) {
        const ex normal = part("force_normal", force.normal);
        const ex tangential = part("force_tangential", force.tangential);
        side += normal * cosine_[link] + tangential * sine_[link];
        down += -normal * sine_[link] + tangential * cosine_[link];
      }
      const bool centre = force.at == Place::kLinkCentre, load = force.at == Place::kLoad;
      add_force(effect.id, {{centre ? middle_[kSide][i]
                             : load ? load_[kSide]
                                    : joint_[kSide][i - 1],
                             side},
                            {centre ? middle_[kDown][i]
                             : load ? load_[kDown]
                                    : joint_[kDown][i - 1],
                             down}});
    });
  }
  for (const ScalarTerm& term : effect.scalars) {
    each(term.at, [&](Link i) {
      const bool joint = term.at == Place::kJoint || term.at == Place::kPivot;
      const ex scale = term.per_length ? length_[i] : ex(1);
      const auto value = [&](const char* unit, const char* unit_per_length) {
        return scale * evaluate(effect, term.value, kMotion, term.at, i,
                                term.per_length ? unit_per_length : unit);
      };
      switch (term.kind) {
        case ScalarKind::kTorque:
          add_force(effect.id, {{joint ? joint_angle_[i] : theta_[i == 0 ? links_ : i],
                                 name_of("torque", value("N m", "N"), i)}});
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
    });
  }
}

// Sensor effects act one after the other, in the order of the description. Clock offsets are added.
void Chain::add_sensors() {
  sensor_.side = definitions_.input("side");
  sensor_.down = definitions_.input("down");
  sensor_.angle = definitions_.input("angle");
  sensor_.clock = time_symbol_;
  for (const Effect& effect : description_.effects) {
    if (!effect.sensor.given()) continue;
    sensor_.given = true;
    ExpressionContext symbols = context(effect, kShape, Place::kLoad, 0);
    ExpressionContext clock_symbols = symbols;
    symbols.add("side", sensor_.side, Unit::parse("m"));
    symbols.add("down", sensor_.down, Unit::parse("m"));
    symbols.add("angle", sensor_.angle, Unit::parse("rad"));
    for (const Definition& definition : effect.definitions) {
      if (definition.at != Place::kAnywhere) continue;
      for (ExpressionContext* known : {&symbols, &clock_symbols}) {
        const std::set<std::string> names = names_in(definition.value);
        const bool has_meaning = std::all_of(names.begin(), names.end(), [&](const auto& name) {
          return name == "pi" || known->symbols.contains(name);
        });
        if (has_meaning) add_definition(definition, *known);
      }
    }
    const auto replace = [&](ex& what, const Expression& by, const ExpressionContext& known,
                             const char* unit) {
      return by.given() ? parse_expression(by, known, Unit::parse(unit)) : what;
    };
    const ex side = replace(sensor_.side, effect.sensor.side, symbols, "m");
    const ex down = replace(sensor_.down, effect.sensor.down, symbols, "m");
    const ex angle = replace(sensor_.angle, effect.sensor.angle, symbols, "rad");
    sensor_.clock += replace(time_symbol_, effect.sensor.clock, clock_symbols, "s") - time_symbol_;
    sensor_.side = side;
    sensor_.down = down;
    sensor_.angle = angle;
  }
  sensor_.side = definitions_.named(sensor_.side, "observed_side", kNoIndex);
  sensor_.down = definitions_.named(sensor_.down, "observed_down", kNoIndex);
  sensor_.angle = definitions_.named(sensor_.angle, "observed_angle", kNoIndex);
  sensor_.clock = definitions_.named(sensor_.clock, "model_time", kNoIndex);
}

}  // namespace catena
