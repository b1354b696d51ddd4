// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "identify/forces/missing_force.hpp"
#include "tests/identify/forces/hidden_force.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

void check_constant(const CandidateLaw::Constant& constant, double truth, const char* unit) {
  CAPTURE(constant.name);
  CAPTURE(constant.value);
  CHECK(constant.unit == unit);
  CHECK(constant.deviation > 0);
  CHECK(constant.deviation < 0.02 * std::abs(truth));
  CHECK(std::abs(constant.value - truth) < 0.02 * std::abs(truth));
}

}  // namespace

TEST_CASE("the law of a spring to a wall: stiffness and rest position") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.wall_spring = 0.3;  // N/m
  hidden.wall_side = 0.3;    // m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  CHECK(found.law->found);
  CHECK(found.law->force == "side force");
  CHECK(found.law->variable == "side position");
  CHECK(found.law->confirmed == catena::near(1, 0.02));
  CHECK(found.sensor->log_evidence < found.log_evidence);
  CHECK(std::abs(found.law->site.arc_length - testing::true_place(film)) <
        3 * found.law->place_deviation);
  REQUIRE(found.law->formula.constants.size() == 2);
  check_constant(found.law->formula.constants[0], 0.3, "N/m");
  check_constant(found.law->formula.constants[1], 0.3, "m");
  CHECK(std::any_of(found.words.begin(), found.words.end(), [](const std::string& words) {
    return words.starts_with("its law: side force = -linear x (side position - rest), linear = ");
  }));
}

TEST_CASE("the law of a tie between two places: its stiffness and both places") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.tie = 5;        // N/m
  hidden.tie_slack = 1;  // m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  const ForceLaw& law = *found.law;
  CHECK(law.found);
  CHECK(law.force == "force that parts two places");
  CHECK(law.variable == "their distance");
  CHECK(law.site.kind == SiteKind::kPair);
  const double length = film.cable().length, last = length - 0.5 * length / film.links;
  CHECK(std::abs(law.site.arc_length - testing::true_place(film)) < 3 * law.place_deviation);
  CHECK(std::abs(law.site.other_arc_length - last) < 3 * law.other_place_deviation);
  CHECK(law.place_deviation < 0.01 * length);
  CHECK(law.other_place_deviation < 0.01 * length);
  REQUIRE(law.formula.constants.size() == 2);
  CHECK(law.formula.constants[0].value == catena::near(5, 0.1));
  CHECK(law.formula.constants[1].value == catena::near(1, 0.02));
}

TEST_CASE("the law of drag at a place: along the velocity, with the square of the speed") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.place_drag = 0.1;  // kg/m
  const testing::Filmed filmed = testing::film(film, hidden);
  const MissingForce found = testing::force_in(filmed);
  REQUIRE(found.law.has_value());
  CHECK(found.law->found);
  CHECK(found.law->force == "force along the velocity");
  CHECK(found.law->variable == "speed");
  CHECK(std::abs(found.best->arc_length - testing::true_place(film)) <
        0.05 * filmed.film.cable().length);
  REQUIRE(found.law->formula.constants.size() == 1);
  CHECK(found.law->formula.constants[0].name == "quadratic");
  check_constant(found.law->formula.constants[0], 0.1, "N s^2/m^2");
}

TEST_CASE(
    "a string to a hook: the hook is found, and a one-sided spring to the side is told as its "
    "class") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.string = 0.5;  // N/m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  std::vector<ForceLaw> all = found.law->rivals;
  all.push_back(*found.law);
  const auto string = std::find_if(all.begin(), all.end(), [](const ForceLaw& law) {
    return law.variable == "distance from it" && law.formula.constants.front().name == "spring";
  });
  REQUIRE(string != all.end());
  const auto check = [&](std::size_t i, const char* name, double truth) {
    const CandidateLaw::Constant& constant = string->formula.constants[i];
    CAPTURE(constant.value);
    CHECK(constant.name == name);
    CHECK(std::abs(constant.value - truth) < 3 * constant.deviation);
    CHECK(constant.deviation < 0.2);
  };
  check(0, "spring", hidden.string);
  check(1, "edge", hidden.string_slack);
  check(2, "point_side", hidden.string_side);
  check(3, "point_down", hidden.string_down);
}

TEST_CASE(
    "a magnet below the load: its fixed point is under the middle of the arc, not under an end of "
    "it") {
  testing::Film film = testing::short_film();
  film.camera.duration = 3.5;
  film.camera.markers = 12;
  truth::Hidden hidden;
  hidden.magnet = 0.02;  // N m^2
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "distance from it");
  REQUIRE(found.law->formula.constants.size() == 3);
  CHECK(found.law->formula.constants[0].name == "pull");
  check_constant(found.law->formula.constants[0], hidden.magnet, "N m^2");
  CHECK(std::abs(found.law->formula.constants[1].value) < 0.01);
  CHECK(found.law->formula.constants[2].value ==
        catena::near(film.cable().length + hidden.magnet_depth, 0.005));
}

TEST_CASE("a force that follows the velocity and drives it is no law") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.place_drag = -0.1;  // kg/m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.one_place);
  CHECK(found.at_best.at(0).rows == std::vector<std::string>{"side", "down"});
  REQUIRE(found.law.has_value());
  CHECK_FALSE(found.law->found);
}

TEST_CASE("a mass at a place: it pulls down, and lags behind") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  film.camera.markers = 12;
  truth::Hidden hidden;
  hidden.insect = 0.02;  // kg
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "acceleration less gravity");
  CHECK(std::abs(found.law->site.arc_length - testing::true_place(film)) <
        3 * found.law->place_deviation);
  REQUIRE(found.law->formula.constants.size() == 1);
  check_constant(found.law->formula.constants[0], hidden.insect, "kg");
}

TEST_CASE("a spring before a dashpot in a joint: its stiffness and its lag") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.maxwell = 0.3;      // N m/rad
  hidden.maxwell_lag = 0.3;  // s
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "relaxing joint angle");
  CHECK(found.law->site.joint == 3);
  const auto& constants = found.law->formula.constants;
  REQUIRE(constants.size() == 2);
  const double truth[] = {hidden.maxwell, hidden.maxwell_lag};
  for (const std::size_t i : {0, 1}) {
    CAPTURE(constants[i].value);
    CAPTURE(constants[i].deviation);
    CHECK(std::abs(constants[i].value - truth[i]) < 3 * constants[i].deviation);
    CHECK(constants[i].deviation < 0.1 * truth[i]);
  }
}

TEST_CASE("a tension that pulls beside the middle of a joint: its lever") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  film.held_side = 1.4, film.held_down = 2.16;  // taut: a cable that snaps has no steady tension
  truth::Hidden hidden;
  hidden.eccentric_pull = 0.01;  // m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "tension");
  CHECK(found.law->site.joint == 3);
  REQUIRE(found.law->formula.constants.size() == 1);
  check_constant(found.law->formula.constants[0], hidden.eccentric_pull, "m");
}

TEST_CASE("a viscous joint and an elastic one remember nothing") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden viscous, elastic;
  viscous.brake = 0.1;  // N m s/rad
  viscous.brake_rate = 1e3;
  elastic.joint_stop = 0.2;  // N m/rad
  elastic.joint_gap = 0;
  for (const auto& [hidden, variable] :
       {std::pair{viscous, "joint rate"}, std::pair{elastic, "joint angle"}}) {
    const MissingForce found = testing::force_in(testing::film(film, hidden));
    REQUIRE(found.law.has_value());
    REQUIRE(found.law->found);
    CHECK(found.law->variable == variable);
  }
}

/// The formulas of a push, that of the law and those of its rivals.
std::map<std::string, CandidateLaw::Formula> by_direction(const ForceLaw& law) {
  std::map<std::string, CandidateLaw::Formula> formulas = {{law.force, law.formula}};
  for (const ForceLaw& rival : law.rivals) formulas.emplace(rival.force, rival.formula);
  return formulas;
}

TEST_CASE("a kick is a pulse in time: when, and with how much of an impulse") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.kick = 0.05;  // N s
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "time");
  CHECK(found.law->by_points);
  // So short a push does in one direction nearly what it does in another: exact fits have to decide.
  const auto directions = by_direction(*found.law);
  CHECK(directions.size() == 2);
  REQUIRE(directions.contains("side force"));
  const auto& constants = directions.at("side force").constants;
  REQUIRE(constants.size() == 3);
  CHECK(constants[1].name == "duration");
  CHECK(constants[2].value == catena::near(hidden.kick_time, 0.02));
  // The integral of a bell is sqrt(2 pi) amplitude width.
  const double impulse = std::sqrt(2 * std::numbers::pi) * constants[0].value * constants[1].value;
  CHECK(std::abs(impulse - hidden.kick) < 0.1 * hidden.kick);
}

TEST_CASE(
    "a push that is too short to see its direction has every direction as the law or a rival") {
  testing::Film film = testing::short_film();
  film.camera.duration = 3;
  film.camera.seed = 4;  // the linear equations decide against the side force
  truth::Hidden hidden;
  hidden.kick = 0.05;  // N s
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(by_direction(*found.law).size() == 2);
}

TEST_CASE("a push that begins and stays: when, how fast, how strong") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.push = 0.2;  // N
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "time");
  CHECK(found.law->formula.text ==
        "side force = amplitude x (1 + tanh((time - moment)/duration))/2");
  const double truth[] = {hidden.push, 0.2, hidden.push_time};  // 0.2 s: truth/cable.cpp
  for (const std::size_t i : {0, 1, 2}) {
    const CandidateLaw::Constant& constant = found.law->formula.constants.at(i);
    CAPTURE(constant.name);
    CAPTURE(constant.value);
    CHECK(std::abs(constant.value - truth[i]) < 3 * constant.deviation);
    CHECK(constant.deviation < 0.1 * truth[i]);
  }
}

TEST_CASE("dry friction of the support: a sign alone, and its moment") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  truth::Hidden hidden;
  hidden.pivot_friction = 0.045;  // N m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->formula.text == "torque at the support = -friction x sign of rate of link 1");
  const CandidateLaw::Constant& friction = found.law->formula.constants.at(0);
  CAPTURE(friction.value);
  CHECK(std::abs(friction.value - hidden.pivot_friction) < 0.05 * hidden.pivot_friction);
}

// Least squares choose friction of another place, about the motion found. About its own motion it leaves ten times as much.
TEST_CASE("a law that leaves too much about the motion that it makes is left out") {
  testing::Film film = testing::short_film();
  film.links = film.case_links = 2;
  film.camera.markers = 2;
  film.camera.duration = 15;
  film.angles = {0.8, 0.8};
  truth::Hidden hidden;
  hidden.pivot_friction = 1.5;  // N m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->force == "torque at the support");
  CHECK(found.law->variable == "rate of link 1");
  REQUIRE(found.law->formula.constants.size() == 1);
  check_constant(found.law->formula.constants[0], hidden.pivot_friction, "N m");
}

TEST_CASE("friction that holds joints, with the tension and without") {
  testing::Film film = testing::short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  truth::Hidden pressed, plain;
  pressed.tension_friction = 0.003;  // m
  plain.joint_friction = 0.045;      // N m
  for (const auto& [hidden, force] : {std::pair(pressed, "bending moment over the tension"),
                                      std::pair(plain, "bending moment")}) {
    const MissingForce found = testing::force_in(testing::film(film, hidden));
    REQUIRE(found.law.has_value());
    REQUIRE(found.law->found);
    CHECK(found.law->formula.text ==
          fmt::format("{} = -friction x sign of rate of curvature", force));
    CHECK(found.law->site.kind == SiteKind::kJoints);
    // As sharp as the truth, which rounds it over 0.008 rad/s.
    const auto& fixed = found.law->formula.fixed;
    const auto step =
        std::find_if(fixed.begin(), fixed.end(), [](const auto& of) { return of.name == "step"; });
    REQUIRE(step != fixed.end());
    CHECK(step->value * film.cable().length / film.links < 0.01);
    // Where the cable snaps, its tension is not the steady one: only the other friction has a size to compare.
    if (hidden.joint_friction == 0) continue;
    const CandidateLaw::Constant& friction = found.law->formula.constants.at(0);
    CAPTURE(friction.value);
    CHECK(std::abs(friction.value - hidden.joint_friction) < 0.1 * hidden.joint_friction);
  }
}

TEST_CASE(
    "play of a joint: a dead zone, not the curve that follows the noise of the motion found") {
  testing::Film film = testing::short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  film.camera.seed = 62074;
  truth::Hidden hidden;
  hidden.joint_stop = 1;  // N m/rad
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->formula.text == "moment = -spring x ((joint angle) beyond -gap to gap)");
  const auto& constants = found.law->formula.constants;
  REQUIRE(constants.size() == 2);
  const double truth[] = {hidden.joint_stop, hidden.joint_gap};
  for (const std::size_t i : {0, 1}) {
    CAPTURE(constants[i].name);
    CAPTURE(constants[i].value);
    CHECK(std::abs(constants[i].value - truth[i]) < 3 * constants[i].deviation);
    CHECK(constants[i].deviation < 0.05 * truth[i]);
  }
}

TEST_CASE("a force in time that follows no law has none") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  testing::Filmed filmed = testing::film(film, {});
  testing::push(filmed, {0.05, 1});
  const MissingForce found = testing::force_in(filmed);
  REQUIRE(found.found);
  REQUIRE(found.one_place);
  REQUIRE(found.law.has_value());
  CHECK_FALSE(found.law->found);
  CHECK(found.law->formula.text.empty());
  CHECK(found.law->chance > 0.01);
}
