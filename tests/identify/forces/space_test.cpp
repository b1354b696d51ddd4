// SPDX-License-Identifier: BSD-3-Clause
//
// The missing force of a chain in space.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "identify/forces/force_pattern.hpp"
#include "identify/models/model_provider.hpp"
#include "tests/identify/forces/hidden_force.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kLinks = 6;
constexpr double kLength = 2.585, kNoise = 1e-3;  // m
constexpr double kSpring = 0.5;                   // N/m
constexpr double kWallPlace = 2.5 / kLinks * kLength;
constexpr double kGust = 0.06, kSlow = 3, kFast = 9;  // N/m, rad/s

/// The cable of the tests in the plane, swinging round the vertical.
const char* const kChain = R"(format = 1
kind = "case"
[model]
description = "chain.toml"
links = 6
[cable]
length = 2.585
density = 0.1424
load_mass = 1.381
[[parameter]]
name = "EI"
sets = "bending_stiffness"
value = 0.014
free = true
lower = 0.0001
upper = 1.0
[[parameter]]
name = "damping"
sets = "damping_length"
value = 0.008
free = true
lower = 0.0001
upper = 1.0
[initial]
shape = "angles"
angles = [0.7, 0.65, 0.6, 0.5, 0.45, 0.4]
azimuths = [0.3, 0.3, 0.3, 0.3, 0.3, 0.3]
velocity = { shape = "angles", rates = [0, 0, 0, 0, 0, 0], azimuth_rates = [1.2, 1.2, 1.2, 1.2, 1.2, 1.2] }
)";

/// Pushes the whole cable to the side and across, by a force that follows no law.
const std::string kGusts = fmt::format(R"toml(format = 1
kind = "effect"
id = "gusts"
title = "Gusts"
description = "Two oscillations in each direction."
[parameters.size]
unit = "N/m"
neutral = 0
description = "Of each"
[constants.slow]
value = {}
unit = "1/s"
[constants.fast]
value = {}
unit = "1/s"
[[force]]
at = "link_centre"
per = "length"
side = "size*(sin(slow*time) + cos(fast*time))"
across = "size*(cos(slow*time) - sin(fast*time))"
)toml",
                                       kSlow, kFast);

/// Pulls the middle of link 3 to the plane in which nothing is across.
const std::string kWall = fmt::format(R"toml(format = 1
kind = "effect"
id = "wall"
title = "Spring to a wall"
description = "From the middle of link 3."
[parameters.spring]
unit = "N/m"
neutral = 0
description = "Stiffness"
[constants.place]
value = {}
unit = "m"
[constants.width]
value = 1e-5
unit = "m"
[[potential]]
at = "link_centre"
value = "(tanh((place - arc + length/2)/width) - tanh((place - arc - length/2)/width))/2*spring*across^2/2"
)toml",
                                      kWallPlace);

struct Filmed {
  MissingForce found;
  Trajectory truth;
};

/// What a film of so many frames says of the missing force, where `effect` acts and the model does not know it.
Filmed film(const std::string& id, const std::string& effect, const std::string& parameter,
            double value, int frames) {
  const testing::TemporaryFolder folder;
  folder.write("chain.toml", "format = 1\nkind = \"model\"\nid = \"chain\"\nspace = \"3d\"\n");
  if (!id.empty()) {
    folder.write(id + ".toml", effect);
    folder.write("truth.toml",
                 fmt::format("format = 1\nkind = \"model\"\nid = \"truth\"\nspace = \"3d\"\n"
                             "effects = [\"{}.toml\"]\n",
                             id));
  }
  Case the_case = read_case(folder.write("case.toml", kChain));
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  if (!id.empty()) {
    truth.description = folder.path() / "truth.toml";
    ParameterSpec hidden;
    hidden.name = hidden.sets = parameter;
    hidden.value = value;
    truth.parameters.push_back(hidden);
  }
  std::vector<double> places;
  for (int marker = 1; marker <= kLinks; ++marker) places.push_back(marker * kLength / kLinks);
  const Model true_model = provide_model(truth.description, kLinks, {});
  const Recording recording = testing::with_truth(
      truth, true_model, testing::empty_markers(places, frames, 1.0 / 60, true), kNoise);
  const Problem true_problem(truth, true_model, {recording});
  const auto problem = std::make_shared<const Problem>(
      the_case, provide_model(the_case.description, kLinks, {}), std::vector<Recording>{recording});
  const FittedModel baseline = fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  REQUIRE(baseline.ok);
  return {missing_force(*problem, baseline.x, {kNoise}),
          true_problem.predict(true_problem.start(), 0, false).trajectory};
}

Vector3d direction_of(const Trajectory& truth, Index k, Index link) {
  return Vector3d(truth.q(link, k), truth.q(kLinks + link, k), truth.q(Index{2} * kLinks + link, k))
      .normalized();
}

}  // namespace

TEST_CASE("forces of patterns on links in space are those of virtual work, and turn with them") {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  const LinkChain chain{VectorXd::LinSpaced(3, 0.2, 0.4), true};
  VectorXd q(9);
  for (double& value : q) value = normal(random);
  std::vector<ForcePattern> patterns = moment_patterns(1, chain);
  for (const ForceDirection direction : force_directions(true)) {
    patterns.push_back(point_pattern(direction, 0.45, chain));
    patterns.push_back(density_pattern(direction, "linear", VectorXd::LinSpaced(3, 1, 2), chain));
  }
  constexpr double kStep = 1e-6;
  for (const ForcePattern& pattern : patterns) {
    CAPTURE(pattern.name);
    const auto force_at = [&](const VectorXd& at) {
      VectorXd force = VectorXd::Zero(9);
      add_generalised_force(pattern, chain.lengths, at.data(), 1, force.data());
      return force;
    };
    std::vector<double> turning(27, 0.0);
    add_turning(pattern, chain.lengths, q.data(), 1, turning.data());
    for (Index j = 0; j < 9; ++j) {
      const VectorXd step = kStep * VectorXd::Unit(9, j);
      const VectorXd by = (force_at(q + step) - force_at(q - step)) / (2 * kStep);
      for (Index i = 0; i < 9; ++i) {
        const Index link = i % 3;
        const double expected =
            link == j % 3 ? turning[static_cast<std::size_t>(9 * link + i / 3 * 3 + j / 3)] : 0;
        CHECK(by[i] == doctest::Approx(expected).epsilon(1e-6).scale(1));
      }
    }
    if (pattern.unit != "N") continue;
    // The force at 0.45 m, in the second link, times the change of its position there.
    const auto position = [&](const VectorXd& at) {
      const auto along = [&](Index link) {
        return Vector3d(at[link], at[3 + link], at[6 + link]).normalized();
      };
      return Vector3d(0.2 * along(0) + 0.25 * along(1));
    };
    for (Index j = 0; j < 9; ++j) {
      const VectorXd step = kStep * VectorXd::Unit(9, j);
      const Vector3d by = (position(q + step) - position(q - step)) / (2 * kStep);
      CHECK(force_at(q)[j] ==
            doctest::Approx(by[static_cast<Index>(pattern.direction)]).epsilon(1e-6).scale(1));
    }
  }
}

TEST_CASE("gusts in space: the two lowest modes of the force normal to the cable") {
  const auto [found, truth] = film("gusts", kGusts, "gusts.size", kGust, 121);
  REQUIRE(found.found);
  CHECK_FALSE(found.one_place);
  const MissingForce::History& history = found.everywhere.at(0);
  REQUIRE(history.densities.size() == 3);
  REQUIRE(history.normal_modes.size() == 3);
  const auto frames = static_cast<Index>(history.time.size());
  REQUIRE(frames == truth.q.cols());
  MatrixXd modes = MatrixXd::Zero(6, frames), value(6, frames), deviation(6, frames);
  for (Index k = 0; k < frames; ++k) {
    const double t = history.time[static_cast<std::size_t>(k)];
    const Vector3d gust = kGust * Vector3d(std::sin(kSlow * t) + std::cos(kFast * t), 0,
                                           std::cos(kSlow * t) - std::sin(kFast * t));
    for (Index link = 0; link < kLinks; ++link) {
      const Vector3d along = direction_of(truth, k, link);
      const Vector3d across = (gust - along.dot(gust) * along) / kLinks;
      const double from_middle = 2 * (static_cast<double>(link) + 0.5) / kLinks - 1;
      for (Index i = 0; i < 3; ++i) {
        modes(2 * i, k) += across[i];
        modes(2 * i + 1, k) += 3 * from_middle * across[i];
      }
    }
  }
  for (Index i = 0; i < 3; ++i) {
    value.middleRows(2 * i, 2) = history.normal_modes[static_cast<std::size_t>(i)].value;
    deviation.middleRows(2 * i, 2) = history.normal_modes[static_cast<std::size_t>(i)].deviation;
  }
  const testing::Recovery modes_found = testing::recovery(
      value, deviation, testing::means_over_time(modes, history.time), history.time);
  MESSAGE("error ", modes_found.error, ", covered ", modes_found.covered, ", CPU ", found.seconds);
  CHECK(modes_found.error < 0.2);
  CHECK(modes_found.covered > 0.9);
}

TEST_CASE(
    "a spring across is found in space: its place, its direction, its force over time, its law") {
  const Filmed filmed = film("wall", kWall, "wall.spring", kSpring, 241);
  const MissingForce& found = filmed.found;
  const Trajectory& truth = filmed.truth;
  REQUIRE(found.found);
  CHECK(found.share > 0.9);
  REQUIRE(found.one_place);
  CHECK(std::abs(found.best->arc_length - kWallPlace) < 0.02 * kLength);
  const MissingForce::History& history = found.at_best.at(0);
  CHECK(history.rows == std::vector<std::string>{"across"});
  REQUIRE(static_cast<Index>(history.time.size()) == truth.q.cols());
  MatrixXd force(1, truth.q.cols());
  for (Index k = 0; k < force.cols(); ++k)
    force(0, k) = -kSpring * kLength / kLinks *
                  (direction_of(truth, k, 0) + direction_of(truth, k, 1) +
                   0.5 * direction_of(truth, k, 2))[2];
  const testing::Recovery recovery =
      testing::recovery(history.size, history.deviation, force, history.time);
  MESSAGE("error ", recovery.error, ", covered ", recovery.covered, ", CPU ", found.seconds);
  CHECK(recovery.error < 0.05);
  CHECK(recovery.covered > 0.9);
  REQUIRE(found.words.size() >= 2);
  CHECK(found.words[0].starts_with("a force across at arc length 1."));
  REQUIRE(found.law.has_value());
  for (const std::string& words : found.law->words) MESSAGE(words);
  REQUIRE(found.law->found);
  CHECK(found.law->force == "across force");
  CHECK(found.law->variable == "across position");
  REQUIRE(found.law->formula.constants.size() == 2);
  const auto check = [&](std::size_t i, const char* name, double value) {
    const CandidateLaw::Constant& constant = found.law->formula.constants[i];
    CAPTURE(name);
    CHECK(constant.name == name);
    CHECK(constant.deviation < 0.02);
    CHECK(std::abs(constant.value - value) < 3 * constant.deviation);
  };
  check(0, "linear", kSpring);
  check(1, "rest", 0);
}

TEST_CASE("no force is found in space where nothing is hidden") {
  const auto [found, truth] = film("", "", "", 0, 121);
  REQUIRE(found.everywhere.size() == 1);  // the motion was followed
  CHECK_FALSE(found.found);
  CHECK(found.share < 0.01);
}
