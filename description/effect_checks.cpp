// SPDX-License-Identifier: BSD-3-Clause
#include "description/effect_checks.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "description/expression_syntax.hpp"

namespace catena {
namespace {

class Checks {
 public:
  explicit Checks(const Effect& effect) : effect_(effect) {}

  void check_physics() const {
    bool changes_kinematics = false;
    each_kinematic([&](const Expression&) { changes_kinematics = true; });
    if (effect_.forces.empty() && effect_.scalars.empty() && !effect_.support.given() &&
        !effect_.held_end.holds() && !changes_kinematics && !effect_.sensor.given() &&
        effect_.events.empty()) {
      fail(
          "the effect does nothing; give it a force, torque, potential, dissipation, kinetic, "
          "support, held_end, held_joint, kinematics, sensor or event");
    }
    if (effect_.flow.given() && effect_.forces.empty()) {
      fail(
          "[flow] moves nothing by itself; give a force that uses relative_normal or another of "
          "its "
          "symbols");
    }
    if (!effect_.coordinates.empty() && effect_.scalars.empty() && effect_.forces.empty()) {
      fail("a new coordinate needs a potential, dissipation or force that governs it");
    }
  }

  // Definitions are put in where their names stand, again and again: what comes of it must stay small.
  void check_size() const {
    constexpr double kMostOperations = 1e5;  // two tables of 24 points within one another have 3e4
    std::map<std::string, double> sizes;
    const std::function<double(const SyntaxNode&)> size_of = [&](const SyntaxNode& node) {
      const auto known = node.kind == SyntaxNode::kName ? sizes.find(node.name) : sizes.end();
      double size = known == sizes.end() ? 1 : known->second;
      for (const SyntaxNode& operand : node.operands) size += size_of(operand);
      return size;
    };
    for (const Definition& definition : effect_.definitions) {
      const double size = sizes[definition.name] = size_of(parse_syntax(definition.value));
      if (size > kMostOperations)
        fail_at(definition.value, "with the definitions in it, it has " + shortest_number(size) +
                                      " numbers, names and operations; the most is 100 000. Use a "
                                      "definition less often, or put fewer within one another");
    }
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(effect_.source_file + ":1: " + problem);
  }

  // Calls act(expression) for each that is given.
  template <class Action>
  void each_kinematic(const Action& act) const {
    for (const Expression* expression : effect_.kinematics.all()) {
      if (expression->given()) act(*expression);
    }
  }

  // The names given here and those made from them by definitions.
  std::set<std::string> with_definitions(std::set<std::string> names) const {
    for (const Definition& definition : effect_.definitions) {
      for (const std::string& used : names_in(definition.value)) {
        if (names.contains(used)) names.insert(definition.name);
      }
    }
    return names;
  }

  static void refuse(const Expression& expression, const std::set<std::string>& names,
                     const std::string& why) {
    for (const std::string& used : names_in(expression)) {
      if (names.contains(used)) fail_at(expression, in_quotes(used) + " " + why);
    }
  }

  // A potential depends on the shape only, a kinetic energy on shape and rates. If they depended on
  // anything else, the energy balance would lack its work.
  void check_energies() const {
    std::set<std::string> times = {"time"}, rates = {"rate", "joint_rate", "distance_rate"}, states;
    for (const SignalChannel& signal : effect_.signals) {
      times.insert({signal.name, signal.name + "_rate", signal.name + "_acceleration"});
    }
    std::set<std::string> relative;
    for (const char* direction : {"side", "down", "across", "normal", "tangential"}) {
      rates.insert(std::string("velocity_") + direction);
      relative.insert(std::string("relative_") + direction);
    }
    for (const Coordinate& coordinate : effect_.coordinates)
      rates.insert(coordinate.name + "_rate");
    if (effect_.moves_load())
      for (const Definition& definition : effect_.definitions)
        rates.insert(definition.name + "_rate");
    for (const ExtraState& state : effect_.states) states.insert(state.name);
    times = with_definitions(times), rates = with_definitions(rates);
    states = with_definitions(states), relative = with_definitions(relative);
    const std::set<std::string> tensions = with_definitions({kSteadyTension});
    const std::string instead = "; give a force or a torque instead";
    for (const ScalarTerm& term : effect_.scalars) {
      refuse(term.value, relative, "cannot stand here: the fluid that moves does work" + instead);
      if (term.kind != ScalarKind::kTorque)
        refuse(term.value, tensions,
               "cannot stand here: its own change with the motion would be a force, too" + instead);
      if (term.kind != ScalarKind::kPotential && term.kind != ScalarKind::kKinetic) continue;
      refuse(term.value, times, "cannot stand in an energy: it would change with time" + instead);
      refuse(term.value, states, "cannot stand in an energy: states are not coordinates" + instead);
      if (term.kind == ScalarKind::kPotential) {
        refuse(term.value, rates,
               "cannot stand in a potential: it depends on the motion" + instead);
      }
    }
    const HeldEnd& end = effect_.held_end;
    for (const Expression* expression :
         {&end.clamp_stiffness, &end.clamp_damping, &end.torsional_stiffness}) {
      if (expression->given())
        refuse(*expression, times, "cannot stand here: the stiffness would change with time");
    }
    for (const Expression* expression : {&effect_.chord.from, &effect_.chord.to})
      if (expression->given())
        refuse(*expression, times, "cannot stand here: the places would change with time");
    each_kinematic([&](const Expression& expression) {
      refuse(expression, times, "cannot stand here: the shape of the chain would change with time");
    });
  }

  // What acts along a chord needs its ends, and these need something that acts there.
  void check_chord() const {
    const auto on_chord = [](const auto& term) { return term.at == Place::kChord; };
    const auto force = std::find_if(effect_.forces.begin(), effect_.forces.end(), on_chord);
    const auto scalar = std::find_if(effect_.scalars.begin(), effect_.scalars.end(), on_chord);
    const auto event = std::find_if(effect_.events.begin(), effect_.events.end(), on_chord);
    const bool acts = force != effect_.forces.end() || scalar != effect_.scalars.end() ||
                      event != effect_.events.end();
    if (acts && !effect_.chord.given())
      fail_at(
          force != effect_.forces.end()     ? force->value
          : scalar != effect_.scalars.end() ? scalar->value
                                            : event->value,
          "at = \"chord\" needs a table [chord], which says from where to where, as from = 0.2, "
          "to = 0.8");
    if (!acts && effect_.chord.given())
      fail_at(effect_.chord.from,
              "nothing acts along this chord; give a potential, a dissipation, a force or an event "
              "with at = \"chord\"");
  }

  void check_all_used() const {
    const std::set<std::string> used = names_in(effect_);
    if (effect_.flow.given() && std::none_of(used.begin(), used.end(), [](const std::string& name) {
          return name.starts_with("relative_");
        })) {
      fail(
          "nothing uses the velocity that [flow] gives; write relative_normal or another of its "
          "symbols in a force, or leave the table out");
    }
    const auto check = [&](const std::string& name) {
      if (!used.contains(name) && !used.contains(name + "_rate")) {
        fail(in_quotes(name) + " stands in no expression; use it or take it away");
      }
    };
    for (const EffectParameter& parameter : effect_.parameters) check(parameter.name);
    for (const Constant& constant : effect_.constants) check(constant.name);
    for (const SignalChannel& signal : effect_.signals) check(signal.name);
    for (const Coordinate& coordinate : effect_.coordinates) check(coordinate.name);
    for (const ExtraState& state : effect_.states) check(state.name);
    for (const Definition& definition : effect_.definitions) check(definition.name);
  }

 private:
  const Effect& effect_;
};

}  // namespace

std::set<std::string> names_in(const Effect& effect) {
  std::set<std::string> used;
  const auto use = [&](const Expression& expression) { used.merge(names_in(expression)); };
  for (const Definition& definition : effect.definitions) use(definition.value);
  for (const ForceTerm& force : effect.forces) {
    for (const Expression* expression : {&force.side, &force.down, &force.across, &force.normal,
                                         &force.tangential, &force.along, &force.value})
      use(*expression);
  }
  for (const ScalarTerm& term : effect.scalars) use(term.value);
  for (const ExtraState& state : effect.states) use(state.rate);
  for (const EventValue& event : effect.events) use(event.value);
  for (const Expression* expression :
       {&effect.flow.side, &effect.flow.down, &effect.flow.across, &effect.sensor.side,
        &effect.sensor.down, &effect.sensor.across, &effect.sensor.angle, &effect.sensor.clock}) {
    use(*expression);
  }
  for (const Expression* expression : effect.support.all()) use(*expression);
  for (const Expression* expression : effect.held_end.all()) use(*expression);
  for (const Expression* expression : {&effect.chord.from, &effect.chord.to}) use(*expression);
  for (const Expression* expression : effect.kinematics.all()) use(*expression);
  return used;
}

void check_consistency(const Effect& effect) {
  const Checks checks(effect);
  checks.check_size();
  checks.check_physics();
  checks.check_energies();
  checks.check_chord();
  checks.check_all_used();
}

}  // namespace catena
