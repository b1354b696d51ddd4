// SPDX-License-Identifier: BSD-3-Clause
//
// Parameters that were measured before, with a standard deviation.
#include <doctest/doctest.h>

#include <cmath>

#include "identify/fit/error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace prior_test {
namespace {

constexpr double kNoise = 1e-3, kTruth = 0.1;

/// Two links filmed for 2 s; the stiffness was measured before, 20 % too large unless stated.
Problem problem(double standard_deviation, double measured = 1.2 * kTruth) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  the_case.experiments[0].noise = kNoise;
  Case truth = the_case;
  truth.parameters[0].value = kTruth;
  truth.parameters[1].value = 0.005;
  const Recording film = testing::with_truth(
      truth, Model::built_in(2), testing::empty_markers({0.5, 1.0}, 60, 1.0 / 30), kNoise);
  the_case.parameters[0].measured = measured;
  the_case.parameters[0].standard_deviation = standard_deviation;
  return Problem(the_case, Model::built_in(2), {film});
}

}  // namespace

TEST_CASE(
    "what is known exactly stays, what is hardly known follows the data, in between by weight") {
  const auto found = [](double standard_deviation, double measured = 1.2 * kTruth) {
    const Problem known = problem(standard_deviation, measured);
    const FitResult result = fit_least_squares(known, {});
    return std::pair(result.x[0], uncertainty_of(known, result.x).estimates[0].standard_error);
  };
  const auto [free, error_of_data] = found(kNotGiven);
  CHECK(free == catena::near(kTruth, 0.05));
  CHECK(found(1e-7).first == catena::near(1.2 * kTruth, 1e-5));
  CHECK(found(10).first == catena::near(free, 1e-3));
  // A prior as sure as the data: half-way. Where it agrees with them, the error is smaller by the root of two.
  CHECK(found(error_of_data).first == catena::near((free + 1.2 * kTruth) / 2, 0.02));
  CHECK(found(error_of_data, free).second == catena::near(error_of_data / std::sqrt(2), 0.05));
}

TEST_CASE("where the case gives no bounds, those of the model hold") {
  // The prior drags the stiffness below zero, where the model ends.
  const Problem bounded = problem(1e-3, -5);
  Case the_case = bounded.the_case();
  the_case.parameters[0].lower = -std::numeric_limits<double>::infinity();
  for (const FitMethod method : {FitMethod::kLeastSquares, FitMethod::kNelderMead}) {
    CAPTURE(static_cast<int>(method));
    the_case.optimiser.method = method;
    the_case.parameters[0].scale = Scale::kLinear;
    const Problem known(the_case, bounded.model(), bounded.experiments());
    const FitResult result = fit(known, {}, fit_least_squares);
    CHECK(result.status == FitStatus::kConverged);
    CHECK(result.x[0] == 0);
    CHECK(result.failures == 0);
    CHECK(uncertainty_of(known, result.x).estimates[0].verdict == Verdict::kAtBound);
  }
}

TEST_CASE("a prior whose square is no number is said to be the reason") {
  const FitResult result = fit_least_squares(problem(1.0, 1e300), {});
  CHECK(result.status == FitStatus::kFailed);
  CHECK(result.message.find("look at noise, and at measured") != std::string::npos);
}

TEST_CASE("the gradient of the error counts the prior") {
  const Problem known = problem(0.01);
  Eigen::VectorXd x = known.start(), gradient;
  const auto error = [&](const Eigen::VectorXd& at) {
    return error_of(known, evaluate(known, at, false, false), Part::kFit);
  };
  error_and_gradient(known, misfit_of(known, evaluate(known, x, false, true)), gradient);
  const double step = 1e-5 * x[0];
  Eigen::VectorXd above = x, below = x;
  above[0] += step;
  below[0] -= step;
  CHECK(gradient[0] == catena::near((error(above) - error(below)) / (2 * step), 1e-4));
}

TEST_CASE("a case written at the fitted values keeps what was measured before") {
  const Problem known = problem(0.01);
  Eigen::VectorXd x = known.start();
  x[0] = 0.11;
  CHECK(known.with(x).parameters[0].value == 0.11);
  CHECK(known.with(x).parameters[0].measured == doctest::Approx(1.2 * kTruth));
}

}  // namespace prior_test
