// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "identify/forces/force_sizes.hpp"
#include "identify/forces/forces_everywhere.hpp"
#include "tests/identify/forces/hidden_force.hpp"
#include "tests/support/near.hpp"

using namespace catena;

TEST_CASE("the smoother's covariances between times are those of all numbers at once") {
  constexpr Eigen::Index kNodes = 4;
  constexpr double kVariance = 2, kStart = 0.5, kByState = 0.9, kByForce = 0.5, kByRate = 0.1;
  constexpr double kSeen = 3;
  const auto number = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  LinearRecording recording;
  recording.start_offset = recording.own_mean = Eigen::VectorXd::Zero(1);
  recording.start_by_parameter = number(1);
  recording.own_deviation = number(kStart);
  const LinearRecording::Step step{.by_state = number(kByState),
                                   .by_force = Eigen::RowVector2d(kByForce, kByRate),
                                   .by_parameter = number(0),
                                   .offset = number(0),
                                   .duration = 0.05};
  recording.steps.assign(kNodes - 1, step);
  recording.seen.assign(
      kNodes, {.value = number(0.3), .by_state = number(kSeen), .by_parameter = number(0)});
  const ForcePrior prior;
  const Smoothed smoothed = smooth_forces({Eigen::VectorXd(), Eigen::VectorXd(), {recording}},
                                          {{0, 0}}, {kVariance}, prior, true, kNodes - 1);
  // All numbers: the start, then w and its rate at each node; what is seen of them.
  const Eigen::Matrix2d a = prior.transition(step.duration);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(1 + 2 * kNodes, 1 + 2 * kNodes);
  covariance(0, 0) = kStart * kStart;
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    Eigen::Matrix2d between = kVariance * Eigen::Matrix2d::Identity();
    for (Eigen::Index j = i; j < kNodes; ++j, between = a * between) {
      covariance.block<2, 2>(1 + 2 * j, 1 + 2 * i) = between;
      covariance.block<2, 2>(1 + 2 * i, 1 + 2 * j) = between.transpose();
    }
  }
  Eigen::MatrixXd seen(kNodes, 1 + 2 * kNodes);
  Eigen::RowVectorXd state = Eigen::RowVectorXd::Unit(1 + 2 * kNodes, 0);
  for (Eigen::Index i = 0; i < kNodes; ++i) {
    seen.row(i) = kSeen * state;
    state *= kByState;
    state.segment<2>(1 + 2 * i) += Eigen::RowVector2d(kByForce, kByRate * prior.rate());
  }
  const Eigen::MatrixXd both = seen * covariance;
  const Eigen::MatrixXd of_seen =
      both * seen.transpose() + Eigen::MatrixXd::Identity(kNodes, kNodes);
  const Eigen::MatrixXd after = covariance - both.transpose() * inverse(of_seen) * both;
  for (Eigen::Index i = 0; i < kNodes; ++i)
    for (Eigen::Index j = i; j < kNodes; ++j) {
      const auto& at = smoothed.recordings[0].covariance[static_cast<std::size_t>(i)];
      CAPTURE(i);
      CAPTURE(j);
      CHECK(at.at(static_cast<std::size_t>(j - i))(0, 0) ==
            catena::near(after(1 + 2 * i, 1 + 2 * j), 1e-9));
    }
}

TEST_CASE("a hidden spring to a wall is found: its place, its force over time, its interval") {
  truth::Hidden hidden;
  hidden.wall_spring = 1;  // N/m
  const testing::Filmed filmed = testing::film(testing::short_film(), hidden);
  const FittedModel baseline = filmed.baseline();
  REQUIRE(baseline.ok);
  const MissingForce found =
      missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
  REQUIRE(found.found);
  CHECK(found.share > 0.9);
  REQUIRE(found.one_place);
  REQUIRE(found.best.has_value());
  const double length = filmed.film.cable().length;
  CHECK(std::abs(found.best->arc_length - testing::true_place(filmed.film)) < 0.02 * length);
  const testing::Recovery recovery = testing::recovery_at_place(filmed, hidden, found);
  CHECK(recovery.error < 0.05);
  CHECK(recovery.covered > 0.9);
  // Without knowing that it acts at one place, from what forces along the whole cable do.
  const testing::Recovery modes = testing::recovery_of_modes(filmed, hidden, found);
  CHECK(modes.error < 0.2);
  CHECK(modes.covered > 0.9);
  // Of 27 patterns only those that are shown are left: the others would widen every interval.
  CHECK(found.patterns.size() == 27);
  CHECK(found.everywhere.at(0).size.rows() < 5);
  CHECK(found.everywhere.at(0).rows.size() ==
        static_cast<std::size_t>(found.everywhere.at(0).size.rows()));
  // The spring does not push down. A down force would follow the noise, and the side force with it.
  CHECK(found.at_best.at(0).rows == std::vector<std::string>{"side"});
  // The fit without the force has made EI three times as large.
  CHECK(found.parameters.at(0).name == "EI");
  CHECK(found.parameters.at(0).value == catena::near(0.014, 0.1));
  REQUIRE(found.words.size() >= 2);
  CHECK(found.words[0].starts_with("a side force at arc length 1."));
}

TEST_CASE("a force along the whole cable: its two lowest modes, with intervals that hold it") {
  double covered = 0;
  constexpr int kFilms = 6;
  for (int seed = 1; seed <= kFilms; ++seed) {
    CAPTURE(seed);
    testing::Film film = testing::short_film();
    film.camera.seed = static_cast<unsigned>(seed);
    testing::Filmed filmed = testing::film(film, {});
    testing::push(filmed, {.size = 0.1, .seed = static_cast<unsigned>(seed), .spread = true});
    const MissingForce found = testing::force_in(filmed);
    REQUIRE(found.found);
    CHECK_FALSE(found.one_place);
    CHECK(std::any_of(found.words.begin(), found.words.end(), [](const std::string& words) {
      return words.starts_with("a force in time, no law");
    }));
    const testing::Recovery modes = testing::recovery_of_modes(filmed, {}, found);
    CHECK(modes.error < 0.2);
    covered += modes.covered / kFilms;
    // Those of the force at one instant, which hold what the prior allows, are four times as wide.
    const MissingForce::OverTime& shown = found.everywhere.at(0).normal_modes.at(0);
    CHECK(shown.deviation.row(0).norm() < 0.1 * filmed.gust_modes.row(0).norm());
  }
  CHECK(covered > 0.9);
}

TEST_CASE("a force of no known form is expected to be no stronger than the weight") {
  testing::Film film = testing::short_film();
  film.camera.duration = 1;
  truth::Hidden hidden;
  hidden.wall_spring = 30;  // N/m
  const testing::Filmed filmed = testing::film(film, hidden);
  const truth::Cable cable = film.cable();
  const double weight = (cable.density * cable.length + cable.load_mass) * cable.gravity;
  const MissingForce found = testing::force_in(filmed);
  REQUIRE(found.found);
  double largest = 0;
  for (const MissingForce::Pattern& pattern : found.patterns)
    if (pattern.unit == "N/m") largest = std::max(largest, pattern.prior_deviation);
  CHECK(largest == doctest::Approx(weight / cable.length));
  CHECK(found.best->arc_length == catena::near(testing::true_place(film), 0.05));

  const FittedModel baseline = filmed.baseline();
  ChainMeasures chain(*baseline.problem, baseline.x, 0);
  std::vector<ForcePattern> patterns = forces_everywhere(chain);
  const auto deviation_of = [&](const std::string& name) {
    const std::vector<double> variances = largest_variances(patterns, chain);
    for (std::size_t m = 0; m < patterns.size(); ++m)
      if (patterns[m].name == name) return std::sqrt(variances[m]);
    return 0.0;
  };
  CHECK(deviation_of("side force at arc length 2.58 m") == doctest::Approx(weight));
  CHECK(deviation_of("torque at the support") == doctest::Approx(weight * cable.length));
  patterns = moment_patterns(5, chain);
  const double link = cable.length / film.links;
  CHECK(deviation_of(moment_name(5, chain.lengths)) ==
        doctest::Approx((cable.density * link + cable.load_mass) * cable.gravity * link));
  // What pushes does not depend on gravity.
  chain.gravity = 1e-3;
  CHECK(deviation_of(moment_name(5, chain.lengths)) ==
        doctest::Approx((cable.density * link + cable.load_mass) * 9.80665 * link));
}

TEST_CASE("no force is found where nothing is hidden") {
  const testing::Filmed filmed = testing::film(testing::short_film(), {});
  const FittedModel baseline = filmed.baseline();
  REQUIRE(baseline.ok);
  const MissingForce found =
      missing_force(*baseline.problem, baseline.x, {filmed.film.camera.noise});
  REQUIRE(found.everywhere.size() == 1);  // the motion was followed
  CHECK_FALSE(found.found);
  CHECK(found.share < 0.01);
  CHECK(found.places.empty());
}

TEST_CASE("two recordings with values that are missing have one force each") {
  truth::Hidden hidden;
  hidden.wall_spring = 1;
  testing::Filmed filmed = testing::film(testing::short_film(), hidden);
  const testing::Filmed other = [&] {
    testing::Film film = testing::short_film();
    film.camera.seed = 2;
    film.camera.lost = 0.2;
    return testing::film(film, hidden);
  }();
  testing::add_experiment(filmed.the_case, "second run");
  const auto problem =
      std::make_shared<const Problem>(filmed.the_case, any_links_model(filmed.film.case_links),
                                      std::vector<Recording>{filmed.recording, other.recording});
  const FittedModel baseline = fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  REQUIRE(baseline.ok);
  const double noise = filmed.film.camera.noise;
  const MissingForce found = missing_force(*problem, baseline.x, {noise, noise});
  REQUIRE(found.found);
  REQUIRE(found.everywhere.size() == 2);
  CHECK(found.everywhere[1].experiment == "second run");
  REQUIRE(found.at_best.size() == 2);
  // The same force was filmed twice.
  const Eigen::RowVectorXd apart = found.at_best[0].size.row(0) - found.at_best[1].size.row(0);
  CHECK(apart.norm() < 0.15 * found.at_best[0].size.row(0).norm());
}

TEST_CASE("a lens, a shutter that rolls, a drift and a slipping marker are no force") {
  struct Wrong {
    const char* name;
    double truth::Camera::*error;
    double size;
  };
  for (const Wrong& wrong :
       {Wrong{"the lens bends lines, or the camera looks at a slant", &truth::Camera::lens, 0.02},
        Wrong{"the picture is read line by line (rolling shutter)", &truth::Camera::shutter, 0.004},
        Wrong{"the camera drifts", &truth::Camera::drift, 0.02},
        Wrong{"marker 3 slips along the cable", &truth::Camera::slip, 0.02}}) {
    CAPTURE(wrong.name);
    testing::Film film = testing::short_film();
    film.camera.*wrong.error = wrong.size;
    const MissingForce found = testing::force_in(testing::film(film, {}));
    CHECK_FALSE(found.found);
    REQUIRE(found.sensor.has_value());
    CHECK(found.sensor->name == wrong.name);
    REQUIRE(found.words.size() == 1);
    CHECK(found.words[0].starts_with("no force on the chain: an error of the camera"));
  }
}

TEST_CASE(
    "drag of the load is a force at one place, however many strengths forces everywhere have") {
  testing::Film film = testing::short_film();
  film.camera.duration = 4;
  film.camera.seed = 101;
  truth::Hidden hidden;
  hidden.load_drag = 0.02;  // kg/m
  const MissingForce found = testing::force_in(testing::film(film, hidden));
  REQUIRE(found.found);
  CHECK(found.one_place);
  CHECK(found.best->arc_length == doctest::Approx(film.cable().length));
}
