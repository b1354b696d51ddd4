// SPDX-License-Identifier: BSD-3-Clause
//
// Fits whose residuals are made white with a noise that they showed before.
#include "identify/fit/estimated_noise.hpp"

#include <doctest/doctest.h>

#include "common/input_error.hpp"
#include "identify/fit/error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using Eigen::Index;

namespace {

constexpr int kFrames = 150;
constexpr Index kMarkers = 6;
constexpr double kSigma = 1e-3, kAutoregression = 0.6, kShaking = 2, kNoisier = 6;

/// Two links filmed at 60 Hz by a camera that shakes; noise is correlated in time, one marker is
/// noisier than the others.
std::shared_ptr<const Problem> filmed(unsigned seed) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  the_case.error.noise_estimated = true;
  Case truth = the_case;
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  const Model model = Model::built_in(2);
  std::vector<double> places;
  for (int k = 1; k <= kMarkers; ++k) places.push_back(k / static_cast<double>(kMarkers));
  Recording recording =
      testing::with_truth(truth, model, testing::empty_markers(places, kFrames, 1.0 / 60));
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss(0, kSigma * std::sqrt(1 - std::pow(kAutoregression, 2)));
  Eigen::VectorXd noise = Eigen::VectorXd::Zero(2 * kMarkers), shaking = Eigen::VectorXd::Zero(2);
  for (Index k = 0; k < kFrames; ++k) {
    for (double& value : noise) value = kAutoregression * value + gauss(random);
    for (double& value : shaking) value = kAutoregression * value + kShaking * gauss(random);
    for (Index c = 0; c < noise.size(); ++c)
      recording.measured(c, k) += (c < 2 ? kNoisier : 1) * noise[c] + shaking[c % 2];
  }
  return std::make_shared<const Problem>(the_case, model, std::vector<Recording>{recording});
}

FitResult fitted_plainly(const std::shared_ptr<const Problem>& problem) {
  FitResult found = fit(*before_noise_is_known(problem), {}, fit_least_squares);
  REQUIRE(found.status == FitStatus::kConverged);
  return found;
}

}  // namespace

TEST_CASE("white residuals have the derivatives they say, and leave out what is far off") {
  auto problem = filmed(1);
  std::vector<Experiment> experiments = problem->experiments();
  experiments[0].recording.measured(5, 70) += 100 * kSigma;
  experiments[0].recording.measured(3, 40) = std::nan("");
  problem = std::make_shared<const Problem>(problem->the_case(), problem->model(), experiments);
  const Problem white = with_noise_seen_at(*problem, fitted_plainly(problem).x);
  REQUIRE(white.experiments()[0].noise->told);
  REQUIRE(white.experiments()[0].noise->outliers == 1);
  const Eigen::VectorXd x = white.start();
  const Residuals at = fitted_residuals(white, evaluate(white, x, false, true));
  CHECK(at.value.size() == 2 * kMarkers * kFrames - 2);
  const auto residuals = [&](const Eigen::VectorXd& at_x) {
    return fitted_residuals(white, evaluate(white, at_x, false, false)).value;
  };
  for (Index j = 0; j < x.size(); ++j) {
    // Over less the difference is of what two simulations err: steps of other sizes.
    const Eigen::VectorXd difference = testing::central_difference(residuals, x, j, 1e-3 * x[j]);
    CHECK((difference - at.jacobian.col(j)).cwiseAbs().maxCoeff() <
          2e-3 * at.jacobian.col(j).cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a fit that knows the noise errs much less, and by as much as it says") {
  constexpr int kRecordings = 40;
  double plain_error = 0, white_error = 0, in_deviations = 0;
  for (unsigned seed = 1; seed <= kRecordings; ++seed) {
    const auto problem = filmed(seed);
    const FitResult plain = fitted_plainly(problem);
    const WeighedFit white = fit_with_noise(problem, plain, {}, fit_least_squares);
    REQUIRE(white.fit.status == FitStatus::kConverged);
    CHECK(white.fit.error == catena::near(1, 0.1));
    CHECK(white.fit.evaluations > plain.evaluations);
    const Uncertainty uncertainty = uncertainty_of(*white.problem, white.fit.x);
    const Eigen::Vector2d truth(0.1, 0.005);
    plain_error += (plain.x - truth).cwiseQuotient(truth).squaredNorm();
    white_error += (white.fit.x - truth).cwiseQuotient(truth).squaredNorm();
    for (Index j = 0; j < truth.size(); ++j)
      in_deviations +=
          std::pow((white.fit.x[j] - truth[j]) /
                       uncertainty.estimates[static_cast<std::size_t>(j)].standard_error,
                   2);
  }
  const double values = 2 * kRecordings;
  MESSAGE("relative error, RMS: " << std::sqrt(plain_error / values) << " and, white, "
                                  << std::sqrt(white_error / values) << "; in standard errors "
                                  << std::sqrt(in_deviations / values));
  CHECK(white_error < 0.25 * plain_error);
  // Three standard deviations of a mean square about 1.
  const double chance = 3 * std::sqrt(2 / values);
  CHECK(in_deviations / values > 1 - chance);
  CHECK(in_deviations / values < 1 + chance);
}

TEST_CASE("a prior and a loss need no stated noise where it is estimated") {
  const auto problem = filmed(1);
  Case the_case = problem->the_case();
  the_case.parameters[0].measured = 0.11;
  the_case.parameters[0].standard_deviation = 1e-6;
  the_case.error.loss = Loss::kHuber;
  const auto held =
      std::make_shared<const Problem>(the_case, problem->model(), problem->experiments());
  CHECK(before_noise_is_known(held)->the_case().error.loss == Loss::kNone);
  const FitResult plain = fitted_plainly(held);
  CHECK(std::abs(plain.x[0] - 0.11) > 1e-3);  // neither counts in the first fit
  const WeighedFit found = fit_with_noise(held, plain, {}, fit_least_squares);
  CHECK(found.fit.x[0] == catena::near(0.11, 1e-4));
  CHECK(found.problem->the_case().error.loss == Loss::kHuber);
  CHECK(noise_in_words(*found.problem).size() >= 3);  // correlated, a noisy marker, shaking
  CHECK(noise_in_words(*held).empty());
}

TEST_CASE("what only validates is counted in the level of the fitted part") {
  const auto problem = filmed(1);
  std::vector<Experiment> experiments = problem->experiments();
  experiments.push_back(experiments[0]);
  experiments[1].spec.use = Use::kValidate;
  const Problem both(problem->the_case(), problem->model(), experiments);
  const Eigen::VectorXd x = fitted_plainly(problem).x;
  const Problem white = with_noise_seen_at(both, x);
  const Evaluation evaluation = evaluate(white, x, true, false);
  const double rms = gaps_of(white, evaluation).back().rms;
  CHECK(error_of(white, evaluation, Part::kValidation) ==
        doctest::Approx(rms / white.experiments()[0].noise->level));
  CHECK(std::string(error_unit(white)) == "1");
  CHECK(std::string(error_unit(both)) == "m");
}

TEST_CASE("frames that show no noise are refused") {
  const auto problem = filmed(1);
  std::vector<Experiment> experiments = problem->experiments();
  experiments[0].recording.fit_frames = 3;
  const Problem few(problem->the_case(), problem->model(), experiments);
  CHECK_THROWS_WITH_AS(with_noise_seen_at(few, problem->start()),
                       doctest::Contains("3 fitted frames show no noise"), InputError);
}
