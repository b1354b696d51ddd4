// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "identify/forces/missing_force.hpp"
#include "tests/identify/forces/hidden_force.hpp"

using namespace catena;

namespace {

/// What a curve does against its variable, N or N m.
double curve_at(const CandidateLaw::Formula& formula, double x) {
  std::map<std::string, double> of;
  for (const CandidateLaw::Constant& constant : formula.constants)
    of[constant.name] = constant.value;
  for (const CandidateLaw::Constant& constant : formula.fixed) of[constant.name] = constant.value;
  const auto value = [&](const std::string& name) { return of.contains(name) ? of.at(name) : 0.0; };
  if (of.contains("spacing_of_knots")) {  // 0 before the first and after the last
    double sum = 0, knot = of.at("moment");
    for (char n = 'a'; of.contains(std::string("force_") + n); ++n) {
      knot += of.at("spacing_of_knots");
      sum += of.at(std::string("force_") + n) *
             std::max(0.0, 1 - std::abs(x - knot) / of.at("spacing_of_knots"));
    }
    return sum;
  }
  if (of.contains("constant")) {  // its slope changes at knots
    double sum = of.at("constant") + of.at("linear") * x;
    for (char n = 'a'; of.contains(std::string("bend_") + n); ++n)
      sum += of.at(std::string("bend_") + n) * std::max(0.0, x - of.at(std::string("knot_") + n));
    return sum;
  }
  const double size = std::abs(x);
  double last_knot = 0, last = 0;
  for (char n = 'a'; of.contains(std::string("knot_") + n); ++n) {
    const double knot = of.at(std::string("knot_") + n);
    const double here = value(std::string("resistance_") + n) +
                        value(std::string(x > 0 ? "forward_" : "backward_") + n);
    if (size <= knot)
      return std::copysign(last + (here - last) * (size - last_knot) / (knot - last_knot), x);
    last_knot = knot, last = here;
  }
  return std::copysign(last, x);
}

/// Root mean square of the curve less the true one where the motion goes, over that of the true one.
template <class True>
double curve_error(const CandidateLaw::Formula& formula, const std::vector<double>& visited,
                   const True& true_law) {
  double error = 0, whole = 0;
  for (const double x : visited) {
    error += std::pow(curve_at(formula, x) - true_law(x), 2);
    whole += std::pow(true_law(x), 2);
  }
  return std::sqrt(error / whole);
}

testing::Film curve_film() {
  testing::Film film = testing::short_film();
  film.camera.duration = 5;
  film.camera.markers = 12;
  return film;
}

/// The law of a film, which is a curve against this variable, and what was visited.
struct FoundCurve {
  CandidateLaw::Formula formula;
  std::vector<truth::OutsideForces> truth;
};
FoundCurve curve_found(const testing::Film& film, const truth::Hidden& hidden,
                       const std::string& variable) {
  const testing::Filmed filmed = testing::film(film, hidden);
  const MissingForce found = testing::force_in(filmed);
  std::string words;
  for (const std::string& line : found.words) words += line + "\n";
  CAPTURE(words);
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == variable);
  REQUIRE(found.law->formula.curve);
  CAPTURE(found.law->formula.text);
  return {found.law->formula,
          truth::outside_forces(film.cable(), hidden, film.start(), filmed.recording.time)};
}

}  // namespace

TEST_CASE("a spring beside an end stop: no formula fits, the law is a curve") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  film.camera.seed = 3;
  truth::Hidden hidden;
  hidden.wall_spring = 0.3;  // N/m
  hidden.stop = 2;
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.law.has_value());
  REQUIRE(found.law->found);
  CHECK(found.law->variable == "side position");
  const CandidateLaw::Formula& formula = found.law->formula;
  REQUIRE(formula.curve);
  CHECK(formula.energy.find("knot_d") != std::string::npos);
  // The slope is that of the spring at first, and of both at last.
  double last = 0;
  for (const CandidateLaw::Constant& constant : formula.constants)
    if (constant.unit == "N/m") last += constant.value;
  REQUIRE(formula.constants.at(1).name == "linear");
  CHECK(last > 4 * formula.constants.at(1).value);
  CHECK(std::count(found.words.begin(), found.words.end(),
                   "no formula fits: it is a curve of straight pieces between knots") == 1);
}

TEST_CASE("a damper with play in a joint: a curve against the rate, which leaves the play out") {
  truth::Hidden hidden;
  hidden.loose = 0.1;  // N m s/rad
  hidden.loose_rate = 0.7;
  testing::Film film = curve_film();
  const FoundCurve found = curve_found(film, hidden, "joint rate");
  std::vector<double> rates;
  for (const truth::OutsideForces& at : found.truth) rates.push_back(at.joint_rate);
  CHECK(curve_error(found.formula, rates, [](double w) {
          return 0.1 * (std::max(0.0, w - 0.7) - std::max(0.0, -w - 0.7));
        }) < 0.1);
}

TEST_CASE("a valve at a place resists one way: a curve that is not odd") {
  truth::Hidden hidden;
  hidden.valve = 0.1;  // N s/m
  const FoundCurve found = curve_found(curve_film(), hidden, "side velocity");
  std::vector<double> velocities;
  for (const truth::OutsideForces& at : found.truth) velocities.push_back(at.middle.velocity.side);
  CHECK(curve_error(found.formula, velocities, [](double v) { return 0.1 * std::max(0.0, v); }) <
        0.1);
  CHECK(curve_at(found.formula, -2) == 0);
}

TEST_CASE(
    "a dashpot between two places that resists one way: a curve against the rate of their "
    "distance") {
  truth::Hidden hidden;
  hidden.tie_valve = 5;  // N s/m
  const FoundCurve found = curve_found(curve_film(), hidden, "rate of their distance");
  std::vector<double> rates;
  for (const truth::OutsideForces& at : found.truth) rates.push_back(at.tie.rate);
  CHECK(curve_error(found.formula, rates, [](double v) { return 5 * std::max(0.0, v); }) < 0.1);
  CHECK(std::abs(curve_at(found.formula, -0.2)) < 0.05 * curve_at(found.formula, 0.2));
}

/// The error of a curve against the time, of a push to the side.
template <class True>
double error_over_time(const truth::Hidden& hidden, std::uint64_t seed, const True& push) {
  testing::Film film = curve_film();
  film.camera.seed = seed;
  const FoundCurve found = curve_found(film, hidden, "time");
  CHECK(found.formula.text.starts_with("side force = (straight pieces of time through force_a"));
  std::vector<double> times;
  times.reserve(500);
  for (int frame = 0; frame < 500; ++frame) times.push_back(0.01 * frame);  // s
  return curve_error(found.formula, times, push);
}

TEST_CASE("a place that is shaken once: a curve against the time") {
  truth::Hidden hidden;
  hidden.shake = 0.2;  // N
  CHECK(error_over_time(hidden, 1, [&](double t) {
          const double turn = (t - 1.5) / hidden.shake_period;  // truth/cable.cpp
          return turn > 0 && turn < 1 ? hidden.shake * std::sin(2 * std::numbers::pi * turn) : 0.0;
        }) < 0.1);
}

TEST_CASE("a push that fades: a curve against the time, no pulse in another direction") {
  truth::Hidden hidden;
  hidden.shove = 0.4;  // N
  CHECK(error_over_time(hidden, 4, [&](double t) {
          const double since = t - 1.5;  // truth/cable.cpp
          return hidden.shove * std::exp(-std::max(0.0, since) / hidden.shove_fade) /
                 (1 + std::exp(-2 * since / 0.05));
        }) < 0.15);
}

/// A force that grows to a limit and falls beyond.
double slipping(double force, double limit) {
  return force / (1 + std::pow(force / (2 * limit), 2));
}

TEST_CASE("a tie that slips: a curve against the distance of its ends") {
  truth::Hidden hidden;
  hidden.tie = 6;          // N/m
  hidden.tie_limit = 0.3;  // N
  testing::Film film = curve_film();
  film.held_side = 0.9;  // the distance goes from 0.93 to 1.29 m
  film.held_down = 1.5;
  const FoundCurve found = curve_found(film, hidden, "their distance");
  std::vector<double> distances;
  for (const truth::OutsideForces& at : found.truth) distances.push_back(at.tie.distance);
  CHECK(curve_error(found.formula, distances,
                    [](double x) { return slipping(6 * std::max(0.0, x - 1), 0.3); }) < 0.1);
}

TEST_CASE("a spring before a dashpot that slips: a curve against what relaxes, and its lag") {
  truth::Hidden hidden;
  hidden.maxwell = 0.6;        // N m/rad
  hidden.maxwell_limit = 0.1;  // N m
  const FoundCurve found = curve_found(curve_film(), hidden, "relaxing joint angle");
  const auto& constants = found.formula.constants;
  const auto lag = std::find_if(constants.begin(), constants.end(),
                                [](const auto& of) { return of.name == "lag"; });
  REQUIRE(lag != constants.end());
  CHECK(std::abs(lag->value - hidden.maxwell_lag) < 3 * lag->deviation);
  CHECK(lag->deviation < 0.1 * hidden.maxwell_lag);
  std::vector<double> stretches;
  for (int k = -20; k <= 20; ++k) stretches.push_back(0.01 * k);
  CHECK(curve_error(found.formula, stretches, [](double z) { return slipping(0.6 * z, 0.1); }) <
        0.1);
}
