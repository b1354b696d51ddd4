// SPDX-License-Identifier: BSD-3-Clause
#include "description/effect_reader.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tests/support/failure.hpp"

using namespace catena;

namespace effect_reader_test {
namespace {

const std::string kHead =
    "format = 1\nkind = \"effect\"\nid = \"drag\"\ntitle = \"Drag\"\ndescription = \"d\"\n";
const std::string kForce = "[[force]]\nat = \"load\"\nside = \"-c*velocity_side\"\n";
const std::string kParameter = "[parameters.c]\nunit = \"N s/m\"\ndescription = \"c\"\n";

// A force that uses its parameter, and one that has none.
const std::string kForceAlone = "[[force]]\nat = \"load\"\nside = \"load_mass*gravity\"\n";

std::string energy(const char* kind, const char* value, const char* at = "load") {
  return std::string("[[") + kind + "]]\nat = \"" + at + "\"\nvalue = \"" + value + "\"\n";
}

std::string event(const std::string& at, const std::string& value) {
  return "[[event]]\nname = \"met\"\nat = \"" + at + "\"\nunit = \"m\"\nvalue = \"" + value +
         "\"\n";
}

Effect read(const std::string& body) {
  return read_effect(TomlTable::parse(kHead + body, "drag.toml", "effect"));
}

}  // namespace

TEST_CASE("an effect is read whole") {
  const Effect effect =
      read(kParameter + "lower = 0.0\nupper = inf\nneutral = 0.0\nscope = \"joint\"\n" +
           "[constants.floor]\nvalue = 1e-6\nunit = \"m/s\"\n" +
           "[[signal]]\nname = \"wind\"\nunit = \"m/s\"\n" +
           "[[coordinate]]\nname = \"strain\"\nunit = \"1\"\nper = \"link\"\n" +
           "[[state]]\nname = \"slip\"\nunit = \"rad\"\nper = \"joint\"\nrate = \"joint_rate\"\n" +
           "[[definition]]\nname = \"speed\"\nat = \"load\"\nvalue = \"velocity_side + floor - "
           "wind\"\n" +
           "[[torque]]\nat = \"joint\"\nvalue = \"slip\"\n" +
           "[[force]]\nat = \"load\"\nside = \"-c*speed\"\n" +
           "[[potential]]\nat = \"link\"\nper = \"length\"\nvalue = \"c*strain\"\n" +
           "[support]\nside = \"c\"\n[kinematics]\nload_mass = 2\n[sensor]\nclock = \"time\"\n");
  CHECK(effect.id == "drag");
  CHECK(effect.source_file == "drag.toml");
  REQUIRE(effect.parameters.size() == 1);
  CHECK(effect.parameters[0].scope == Scope::kJoint);
  CHECK(effect.parameters[0].default_value == 0);  // the neutral value
  CHECK(std::isinf(effect.parameters[0].upper));
  REQUIRE(effect.constants.size() == 1);
  CHECK(effect.constants[0].text == "1e-06");
  CHECK(effect.signals.size() == 1);
  CHECK(effect.coordinates.size() == 1);
  REQUIRE(effect.states.size() == 1);
  CHECK(effect.states[0].at == Place::kJoint);
  REQUIRE(effect.definitions.size() == 1);
  CHECK(effect.definitions[0].at == Place::kLoad);
  REQUIRE(effect.forces.size() == 1);
  CHECK(effect.forces[0].side.text == "-c*speed");
  CHECK(effect.forces[0].side.key == "force.side");
  CHECK(effect.forces[0].side.file == "drag.toml");
  CHECK(effect.forces[0].side.line == 37);
  CHECK_FALSE(effect.forces[0].down.given());
  REQUIRE(effect.scalars.size() == 2);  // torques first, then energies
  CHECK(effect.scalars[0].kind == ScalarKind::kTorque);
  CHECK(effect.scalars[1].kind == ScalarKind::kPotential);
  CHECK(effect.scalars[1].per_length);
  CHECK(effect.support.side.given());
  CHECK(effect.kinematics.load_mass.text == "2");
  CHECK(effect.sensor.given());
}

TEST_CASE("numbers are not taken for names") {
  CHECK(read("[[force]]\nat = \"load\"\nside = \"1e-6*2.5e3\"\n").forces.size() == 1);
  CHECK(read("[[force]]\nat = \"load\"\nside = \"0.0e0 + 1e-300 + 1E+300\"\n").forces.size() == 1);
}

TEST_CASE("a value at which the effect vanishes only in the limit gives no default") {
  const Effect effect = read(kParameter + "neutral = inf\n" + kForce);
  CHECK(std::isnan(effect.parameters[0].default_value));
  CHECK(std::isinf(effect.parameters[0].neutral));
}

namespace {

std::string table(const char* points, const char* values, const char* rest = "rounding = 0.5\n",
                  const std::string& of = "depth") {
  return "[[table]]\nname = \"speed\"\nof = \"" + of +
         "\"\nof_unit = \"m\"\nunit = " + "\"m/s\"\npoints = " + points + "\nvalues = " + values +
         "\n" + rest + "[flow]\nside = \"speed\"\n[[force]]\nat = \"load\"\nside = " +
         "\"load_mass*gravity*relative_side/relative_down\"\n";
}

/// Each has the one before twice, as grains on a chessboard.
std::string doubled_definitions() {
  std::string text = "[[definition]]\nname = \"grain0\"\nvalue = \"depth\"\n";
  for (int k = 1; k < 64; ++k) {
    const std::string before = "grain" + std::to_string(k - 1);
    text.append("[[definition]]\nname = \"grain").append(std::to_string(k));
    text.append("\"\nvalue = \"").append(before).append(" + ").append(before).append("\"\n");
  }
  return text;
}

}  // namespace

TEST_CASE("a table is a definition whose constants carry its units") {
  const Effect effect = read(table("[0, 10]", "[2.0, 1.5]"));
  REQUIRE(effect.definitions.size() == 1);
  CHECK(effect.definitions[0].name == "speed");
  REQUIRE(effect.constants.size() == 2);
  CHECK(effect.constants[0].unit == "m");
  CHECK(effect.constants[1].unit == "m/s");
}

TEST_CASE("an effect that extends a built-in one has all that it declares, and its own") {
  const Effect base = built_in_effect("load_body");
  const Effect effect = read("extends = \"load_body\"\n" + kParameter +
                             "[[force]]\nat = \"load\"\nalong = \"yaw_rate\"\nvalue = "
                             "\"c*added_lateral*relative_speed_lateral\"\n");
  CHECK(effect.id == "drag");
  CHECK(effect.source_file == "drag.toml");
  CHECK(effect.space == base.space);
  CHECK_FALSE(effect.rare);
  REQUIRE(effect.parameters.size() == base.parameters.size() + 1);
  CHECK(effect.parameters.front().name == base.parameters.front().name);
  CHECK(effect.parameters.back().name == "c");
  CHECK(effect.definitions.size() == base.definitions.size());
  CHECK(effect.coordinates.size() == base.coordinates.size());
  CHECK(effect.scalars.size() == base.scalars.size());
  CHECK(effect.kinematics.load_side.text == base.kinematics.load_side.text);
  REQUIRE(effect.forces.size() == base.forces.size() + 1);
  CHECK(effect.forces.back().along.text == "yaw_rate");
  CHECK(effect.forces.back().along.file == "drag.toml");
  CHECK(effect.forces.front().value.file == "built in: load_body");
}

TEST_CASE("errors in an effect name their line") {
  struct Row {
    std::string body, said;
  };
  const Row rows[] = {
      {"", "drag.toml:1: the effect does nothing; give it"},
      {"extends = \"load_boby\"\n" + kForceAlone,
       "drag.toml:6: extends: \"load_boby\" is not a built-in effect; did you mean \"load_body\"?"},
      {"extends = \"load_body\"\n[kinematics]\nload_side = \"1\"\n",
       "drag.toml:7: kinematics: stands in \"load_body\", too, which this effect extends; leave"},
      {"extends = \"load_body\"\n[parameters.pressure]\nunit = \"m\"\ndescription = \"c\"\n",
       "drag.toml:7: parameters.pressure: \"pressure\" is given twice in this effect"},
      {"[[forse]]\n" + kForce, "drag.toml:6: unknown key \"forse\"; did you mean \"force\"?"},
      {"[parameters.c]\ndescription = \"c\"\n" + kForce,
       "drag.toml:6: parameters.c: \"unit\" is missing"},
      {"[parameters.c]\nunit = \"N s/mm\"\ndescription = \"c\"\n" + kForce,
       "drag.toml:7: parameters.c.unit: unit \"N s/mm\": \"mm\" is not a coherent SI unit"},
      {"[parameters.\"2c\"]\nunit = \"1\"\n" + kForce, "drag.toml:6: parameters.2c: \"2c\" is not"},
      {"[parameters.sin]\nunit = \"1\"\n" + kForce,
       "drag.toml:6: parameters.sin: \"sin\" has a meaning in expressions already"},
      {"[parameters.c_2]\nunit = \"1\"\n" + kForce,
       "drag.toml:6: parameters.c_2: \"c_2\" ends like the name of one joint or link"},
      {kParameter + "[constants.c]\nvalue = 1\nunit = \"1\"\n" + kForce,
       "drag.toml:9: constants.c: \"c\" is given twice in this effect"},
      {kParameter + "lower = 2.0\nupper = 1.0\n" + kForce,
       "drag.toml:10: parameters.c.upper: 1 is not above the lower bound, 2"},
      {kParameter + "lower = 0.0\nneutral = -1.0\n" + kForce,
       "drag.toml:10: parameters.c.neutral: -1 lies outside the bounds, 0 to inf"},
      {kParameter + "upper = 1.0\ndefault = 2.0\n" + kForce,
       "drag.toml:10: parameters.c.default: 2 lies outside the bounds, -inf to 1"},
      {kParameter + "default = inf\n" + kForce, "drag.toml:9: parameters.c.default: is infinite"},
      {kParameter + "neutral = 0.0\nabove = \"it is heavier\"\n" + kForce,
       "drag.toml:10: parameters.c.above: write {} once"},
      {kParameter + "neutral = 0.0\nabove = \"{} or {} heavier\"\n" + kForce,
       "drag.toml:10: parameters.c.above: write {} once"},
      {kParameter + "neutral = 0.0\nscope = \"link\"\nabove = \"it is {} heavier\"\n" + kForce,
       "drag.toml:11: parameters.c.above: goes with a finite neutral value and one value"},
      {kParameter + "neutral = inf\ndefault = 1.0\nbelow = \"it is {} lighter\"\n" + kForce,
       "drag.toml:11: parameters.c.below: goes with a finite neutral value"},
      {kParameter + "at_most = \"d\"\n" + kForce,
       "drag.toml:9: parameters.c.at_most: \"d\" is no other parameter of this effect"},
      {kParameter + "at_most = \"c\"\n" + kForce,
       "drag.toml:9: parameters.c.at_most: \"c\" is no other parameter of this effect"},
      {kParameter + "at_most = \"d\"\n[parameters.d]\nunit = \"1\"\ndescription = \"d\"\n" + kForce,
       "drag.toml:9: parameters.c.at_most: \"d\" needs the same unit"},
      {kParameter + "scope = \"links\"\n" + kForce,
       "drag.toml:9: parameters.c.scope: \"links\" is not known here; did you mean \"link\"?"},
      {"[constants.e]\nvalue = inf\nunit = \"1\"\n" + kForce,
       "drag.toml:7: constants.e.value: is not finite"},
      {"[[force]]\nat = \"tip\"\nside = \"1\"\n",
       "drag.toml:7: force.at: \"tip\" is not known here; known are joint, link_centre and load"},
      {"[[force]]\nside = \"1\"\n", "drag.toml:6: force: \"at\" is missing"},
      {"[[force]]\nat = \"load\"\n",
       "drag.toml:6: force: give the force as side, down and across, or"},
      {"[[force]]\nat = \"load\"\nside = \"1\"\nnormal = \"1\"\n",
       "drag.toml:6: force: give the force as side, down and across, or"},
      {"[[force]]\nat = \"joint\"\nnormal = \"1\"\n", "drag.toml:6: force: a joint has no normal"},
      {"[[force]]\nat = \"load\"\nper = \"length\"\nside = \"1\"\n",
       "drag.toml:8: force.per: \"length\" goes with at = \"link_centre\""},
      {"[[force]]\nat = \"link_centre\"\nper = \"mass\"\nside = \"1\"\n",
       "drag.toml:8: force.per: \"mass\" is not known here; known are length"},
      {"[[force]]\nat = \"load\"\nside = \"  \"\n", "drag.toml:8: force.side: is empty"},
      {"[[force]]\nat = \"load\"\nside = true\n",
       "drag.toml:8: force.side: true is true or false where a number is wanted"},
      {"[[torque]]\nat = \"link_centre\"\nvalue = \"1\"\n",
       "drag.toml:7: torque.at: \"link_centre\" is not known here"},
      {"[[torque]]\nat = \"joint\"\n", "drag.toml:6: torque: \"value\" is missing"},
      {table("[0, 20, 10]", "[1, 2, 3]"),
       "drag.toml:11: table.points: 10 after 20; points must increase"},
      {table("[0, 0]", "[1, 2]"), "drag.toml:11: table.points: 0 after 0; points must increase"},
      {table("[0]", "[1]"), "drag.toml:11: table.points: 1 numbers; give 2 to 24"},
      {table("[0, 1]", "[1]"), "drag.toml:12: table.values: 1 numbers; there are 2 points"},
      {table("[0, 1]", "[1, 2]", "rounding = 0.0\n"),
       "drag.toml:13: table.rounding: 0; must be at least 1e-50, and 1e-07 to 1 times the distance "
       "from the first"},
      {table("[0, 10]", "[1, 2]", "rounding = 1e-200\n"),
       "drag.toml:13: table.rounding: 1e-200; must be"},
      {table("[0, 10]", "[1, 2]", "rounding = 1e200\n"),
       "drag.toml:13: table.rounding: 1e+200; must be"},
      {table("[-1e308, 1e308]", "[1, 2]"),
       "drag.toml:11: table.points: must be finite, and at most 1e50 in size"},
      {table("[0, 1e300]", "[1, 2]", "rounding = 1e299\n"),
       "drag.toml:11: table.points: must be finite, and at most 1e50 in size"},
      {table("[0, 1e-300]", "[1, 1]", "rounding = 1e-301\n"),
       "drag.toml:13: table.rounding: 1e-301; must be at least 1e-50"},
      {table("[0, 1]", "[1e49, -1e50]"),
       "drag.toml:12: table.values: change too steeply at the point 0; no slope may be above "
       "1e50"},
      {table("[0, nan]", "[1, 2]"), "drag.toml:11: table.points: nan in the list is not a number"},
      {table("[0, 1]", "[1, inf]"), "drag.toml:12: table.values: must be finite"},
      {table("[0, 1]", "[1, 2]", "rounding = 0.5\n", "depth) + (depth"),
       "drag.toml:8: table.of: in \"depth) + (depth\": \")\" cannot stand here, at its character "
       "6"},
      {doubled_definitions(),
       "drag.toml:56: definition.value: in \"grain15 + grain15\": with the definitions in it, it "
       "has 131071"},
      {"[flow]\n" + kForce, "drag.toml:6: flow: has none of side, down and across; give one"},
      {"[flow]\nside = \"1\"\n" + kForce,
       "drag.toml:1: nothing uses the velocity that [flow] gives; write relative_normal"},
      {"[flow]\nside = \"1\"\n" + energy("dissipation", "relative_side^2"),
       "drag.toml:1: [flow] moves nothing by itself; give a force"},
      {"[flow]\nside = \"1\"\n[[force]]\nat = \"load\"\nside = \"relative_side\"\n" +
           energy("kinetic", "relative_side^2"),
       "drag.toml:13: kinetic.value: in \"relative_side^2\": \"relative_side\" cannot stand here"},
      {"[parameters.relative_normal]\nunit = \"1\"\n" + kForce,
       "drag.toml:6: parameters.relative_normal: \"relative_normal\" has a meaning in expressions"},
      {"[support]\n", "drag.toml:6: support: has neither side nor down"},
      {"[held_end]\nclamp_down = \"1\"\n",
       "drag.toml:6: held_end: has none of side, down and across"},
      {"[held_end]\nside = \"1\"\nclamp_stiffness = \"stiffness\"\n",
       "drag.toml:6: held_end: has a clamp without a direction"},
      {"[held_end]\nside = \"1\"\nclamp_down = \"1\"\nclamp_stiffness = \"stiffness*time\"\n",
       "drag.toml:9: held_end.clamp_stiffness: in \"stiffness*time\": \"time\" cannot stand here"},
      {"[held_end]\nside = \"1\"\ntorsional_stiffness = \"1\"\n",
       "drag.toml:6: held_end: has torsion, but an end that is free to turn is not twisted; give"},
      {"[held_end]\nside = \"1\"\nclamp_down = \"1\"\nroll = \"1\"\n",
       "drag.toml:6: held_end: has a roll, which twists nothing; give torsional_stiffness, too"},
      {"[held_end]\nside = \"1\"\nclamp_down = \"1\"\ntorsional_stiffness = \"time\"\n",
       "drag.toml:9: held_end.torsional_stiffness: in \"time\": \"time\" cannot stand here"},
      {"[held_joint]\nlink = 2\n", "drag.toml:6: held_joint: has none of side, down and across"},
      {"[held_joint]\nside = \"1\"\n",
       "drag.toml:6: held_joint: \"link\" is missing; give a whole number"},
      {"[held_joint]\nlink = 0\nside = \"1\"\n",
       "drag.toml:7: held_joint.link: is 0; name the link whose far end is held, from 1"},
      {"[held_joint]\nlink = 2\nside = \"1\"\nclamp_down = \"1\"\n",
       "drag.toml:9: unknown key \"held_joint.clamp_down\""},
      {"[held_end]\nside = \"1\"\n[held_joint]\nlink = 2\nside = \"1\"\n",
       "drag.toml:8: held_joint: stands beside [held_end]; an effect holds one place"},
      {"[chord]\nfrom = \"0.1\"\n", "drag.toml:6: chord: \"to\" is missing"},
      {"[chord]\nfrom = \"0.1\"\nto = \"0.4\"\n" + kForce,
       "drag.toml:7: chord.from: in \"0.1\": nothing acts along this chord"},
      {energy("potential", "distance", "chord"),
       "drag.toml:8: potential.value: in \"distance\": at = \"chord\" needs a table [chord]"},
      {event("chord", "distance"),
       "drag.toml:10: event.value: in \"distance\": at = \"chord\" needs a table [chord]"},
      {event("anywhere", "time"), "drag.toml:8: event.at: \"anywhere\" is not known here"},
      {event("load", "depth") + event("load", "depth"),
       "drag.toml:12: event.name: \"met\" is given twice in this effect"},
      {"[[event]]\nname = \"met\"\nat = \"load\"\nvalue = \"depth\"\n",
       "drag.toml:6: event: \"unit\" is missing"},
      {"[chord]\nfrom = \"0.1\"\nto = \"time\"\n" + energy("potential", "distance", "chord"),
       "drag.toml:8: chord.to: in \"time\": \"time\" cannot stand here: the places would change"},
      {"[chord]\nfrom = \"0.1\"\nto = \"0.4\"\n" + energy("potential", "distance_rate^2", "chord"),
       "drag.toml:11: potential.value: in \"distance_rate^2\": \"distance_rate\" cannot stand"},
      {"[chord]\nfrom = \"0.1\"\nto = \"0.4\"\n" + energy("kinetic", "distance_rate^2", "chord"),
       "drag.toml:10: kinetic.at: \"chord\" is not known here"},
      {"[parameters.distance]\nunit = \"m\"\n" + kForce,
       "drag.toml:6: parameters.distance: \"distance\" has a meaning in expressions already"},
      {"[kinematics]\ncenter_offset = \"1\"\n",
       "drag.toml:7: unknown key \"kinematics.center_offset\"; did you mean \"centre_offset\"?"},
      {"[[coordinate]]\nname = \"x\"\nunit = \"m\"\nper = \"joint\"\n" + kForce,
       "drag.toml:9: coordinate.per: \"joint\" is not known here"},
      {"[[state]]\nname = \"x\"\nunit = \"m\"\nper = \"link\"\nrate = \"1\"\n" + kForce,
       "drag.toml:9: state.per: \"link\" is not known here"},
      {"[[force]]\nat = \"load\"\nvalue = \"1\"\n", "drag.toml:6: force: \"along\" is missing"},
      {"[[force]]\nat = \"load\"\nside = \"1\"\nalong = \"rate\"\nvalue = \"1\"\n",
       "drag.toml:6: force: give the force as side, down and across, or as normal and tangential, "
       "or "
       "as value and along"},
      {"space = \"4d\"\n" + kForce, "drag.toml:6: space: \"4d\" is not known here"},
      {"[[coordinate]]\nname = \"x\"\nunit = \"m\"\nper = \"load\"\n[[definition]]\nname = "
       "\"x\"\nat = \"load\"\nvalue = \"1\"\n" +
           kForce,
       "drag.toml:11: definition.name: \"x\" is given twice"},
      {"[[coordinate]]\nname = \"x\"\nunit = \"m\"\nper = \"load\"\n[[potential]]\nat = "
       "\"load\"\nvalue = \"load_mass*x_rate^2\"\n",
       "drag.toml:12: potential.value: in \"load_mass*x_rate^2\": \"x_rate\" cannot stand in a "
       "potential"},
      {"[[coordinate]]\nname = \"x\"\nunit = \"m\"\nper = \"link\"\n[kinematics]\nextension = "
       "\"x\"\n",
       "drag.toml:1: a new coordinate needs a potential, dissipation or force"},
      {"[[state]]\nname = \"z\"\nunit = \"m\"\nper = \"joint\"\n" + kForce,
       "drag.toml:6: state: \"rate\" is missing"},
      {kParameter + kForceAlone, "drag.toml:1: \"c\" stands in no expression; use it or take"},
      {"[constants.e]\nvalue = 1e-6\nunit = \"1\"\n" + kForceAlone,
       "drag.toml:1: \"e\" stands in no expression"},
      {"[[force]]\nat = \"load\"\nside = \"2e3333333333333333333333\"\n",
       "drag.toml:8: force.side: in \"2e3333333333333333333333\": \"2e3333333333333333333333\" is "
       "too large or too small: at most 1e300, and 0 or at least 1e-300"},
      {"[[force]]\nat = \"load\"\nside = \"0e-99999999999999999999\"\n",
       "drag.toml:8: force.side: in \"0e-99999999999999999999\": \"0e-99999999999999999999\" is "},
      {"[[force]]\nat = \"load\"\nside = \"0.0001e-298\"\n",
       "drag.toml:8: force.side: in \"0.0001e-298\": \"0.0001e-298\" is too large or too small"},
      {energy("potential", "gravity*time"),
       "drag.toml:8: potential.value: in \"gravity*time\": \"time\" cannot stand in an energy"},
      {energy("kinetic", "gravity*time"),
       "drag.toml:8: kinetic.value: in \"gravity*time\": \"time\" cannot stand in an energy"},
      {energy("potential", "rate^2"),
       "drag.toml:8: potential.value: in \"rate^2\": \"rate\" cannot stand in a potential"},
      {"[[definition]]\nname = \"w\"\nat = \"load\"\nvalue = \"velocity_side\"\n" +
           energy("potential", "w"),
       "drag.toml:12: potential.value: in \"w\": \"w\" cannot stand in a potential"},
      {energy("dissipation", "steady_tension"),
       "drag.toml:8: dissipation.value: in \"steady_tension\": \"steady_tension\" cannot stand "
       "here: "
       "its own change"},
      {"[[definition]]\nname = \"t\"\nat = \"joint\"\nvalue = \"steady_tension\"\n" +
           energy("kinetic", "t"),
       "drag.toml:12: kinetic.value: in \"t\": \"t\" cannot stand here: its own change"},
      {"[parameters.steady_tension]\nunit = \"N\"\n" + kForce,
       "drag.toml:6: parameters.steady_tension: \"steady_tension\" has a meaning in expressions"},
      {"[[state]]\nname = \"z\"\nunit = \"m\"\nper = \"joint\"\nrate = \"1\"\n" +
           energy("potential", "z"),
       "drag.toml:13: potential.value: in \"z\": \"z\" cannot stand in an energy: states are not"},
      {"[kinematics]\nload_offset = \"time\"\n",
       "drag.toml:7: kinematics.load_offset: in \"time\": \"time\" cannot stand here"},
      {"[[signal]]\nname = \"u\"\nunit = \"m\"\n[[signal]]\nname = \"u_rate\"\nunit = \"m\"\n" +
           kForce,
       "drag.toml:10: signal.name: \"u_rate\" is given twice"},
  };
  for (const Row& row : rows) {
    const std::string said = failure([&] { read(row.body); });
    CAPTURE(row.body);
    CAPTURE(said);
    CHECK(said.find(row.said) == 0);
  }
}

}  // namespace effect_reader_test
