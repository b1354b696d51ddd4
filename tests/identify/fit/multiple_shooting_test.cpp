// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>

#include "common/input_error.hpp"
#include "identify/fit/error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

// Two arms that turn over: after some seconds nothing of the start is left in the motion.
const char* const kArms = R"(
[model]
links = 2
[cable]
length = 0.4
density = 0.5
[[parameter]]
name = "mass of the lower arm"
sets = "mass_2"
value = 0.07
free = true
lower = 0.01
upper = 1.0
[[parameter]]
name = "c"
sets = "damping"
value = 2e-4
free = true
lower = 1e-6
upper = 0.1
[[parameter]]
name = "spring"
sets = "stiffness"
value = 0.0
[initial]
shape = "angles"
free = true
velocity = {shape = "angles", free = true}
[optimiser]
method = "least_squares"
max_evaluations = 60
[simulation]
relative_tolerance = 1e-10
absolute_tolerance_position = 1e-12
absolute_tolerance_velocity = 1e-11
)";

constexpr double kNoise = 2e-3;  // rad

/// Both angles at 100 Hz for 8 s, noise added.
Recording film() {
  Case truth = testing::sections(kArms);
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 1e-4;
  truth.initial.coefficients = {2.3, 2.6};
  truth.initial.velocity_coefficients = {0.0, 0.0};
  testing::add_experiment(truth, "run", DataKind::kAngles);
  Recording recording;
  for (int k = 0; k <= 800; ++k) recording.time.push_back(0.01 * k);
  for (int link = 1; link <= 2; ++link) {
    PointSpec point;
    point.name = "arm " + std::to_string(link);
    point.link = link;
    recording.points.push_back(point);
    recording.channels.push_back({link - 1, Component::kAngle, point.name});
  }
  recording.measured.setZero(2, 801);
  recording.fit_frames = 801;
  return testing::with_truth(truth, Model::built_in(2), recording, kNoise, 4);
}

Problem arms(double window, bool joined) {
  Case the_case = testing::sections(kArms);
  testing::add_experiment(the_case, "run", DataKind::kAngles);
  the_case.experiments[0].window = window;
  the_case.experiments[0].joined = joined;
  return Problem(the_case, Model::built_in(2), {film()});
}

}  // namespace

TEST_CASE(
    "a chaotic recording traps a fit of the whole; joined windows find what it was made with") {
  const Problem whole = arms(kNotGiven, false);
  CHECK(strategy_of(whole) == std::string("whole"));
  const FitResult trapped = fit(whole, {}, fit_least_squares);
  CHECK(trapped.error > 20 * kNoise);

  const Problem joined = arms(0.5, true);
  CHECK(strategy_of(joined) == std::string("multiple shooting"));
  const FitResult found = fit(joined, {}, fit_least_squares);
  CHECK(found.error == catena::near(kNoise, 0.05));
  const Evaluation evaluation = evaluate(joined, found.x, false, true);
  REQUIRE(evaluation.ok);
  const SoftConstraints defects = shooting_defects_of(joined, evaluation);
  CHECK(defects.value.size() == 15 * 4);
  CHECK(defects.value.cwiseAbs().maxCoeff() < 1e-5);  // one motion, not pieces
  const Uncertainty uncertainty = uncertainty_of(joined, found.x);
  CHECK(uncertainty.noise == catena::near(kNoise, 0.05));
  const double truth[] = {0.1, 1e-4};
  for (Eigen::Index j = 0; j < 2; ++j) {
    const double error = uncertainty.estimates[static_cast<std::size_t>(j)].standard_error;
    CHECK(std::abs(found.x[j] - truth[j]) < 4 * error);
    CHECK(error < 1e-2 * truth[j]);
  }

  // that the motion is one makes the numbers sharper than windows on their own
  const Problem separate = arms(0.5, false);
  CHECK(strategy_of(separate) == std::string("separate windows"));
  const FitResult pieces = fit(separate, {}, fit_least_squares);
  CHECK(uncertainty_of(separate, pieces.x).estimates[1].standard_error >
        2 * uncertainty.estimates[1].standard_error);
}

TEST_CASE("derivatives of the shooting defects agree with differences") {
  const Problem problem = arms(0.5, true);
  const Eigen::VectorXd x = problem.start();
  const SoftConstraints defects = shooting_defects_of(problem, evaluate(problem, x, false, true));
  REQUIRE(defects.jacobian.cols() == x.size());
  const auto defects_at = [&](const Eigen::VectorXd& at_x) {
    return shooting_defects_of(problem, evaluate(problem, at_x, false, false)).value;
  };
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const double h = 1e-4 * std::max(std::abs(x[j]), 1e-2);
    const Eigen::VectorXd difference = testing::central_difference(defects_at, x, j, h);
    CHECK((difference - defects.jacobian.col(j)).norm() <= 1e-3 * (1 + difference.norm()));
  }
}

TEST_CASE("what cannot be joined is refused") {
  const auto refused = [](const std::string& from, const std::string& to) {
    std::string text = kArms;
    text.replace(text.find(from), from.size(), to);
    Case the_case = testing::sections(text);
    testing::add_experiment(the_case, "run", DataKind::kAngles);
    the_case.experiments[0].window = 1;
    the_case.experiments[0].joined = true;
    CHECK_THROWS_AS(Problem(the_case, Model::built_in(2), {film()}), InputError);
  };
  refused("method = \"least_squares\"", "method = \"nelder_mead\"");
  refused("max_evaluations = 60", "growing_windows = [1.0, 2.0]");
  refused("velocity = {shape = \"angles\", free = true}", "");
}
