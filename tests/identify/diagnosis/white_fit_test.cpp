// SPDX-License-Identifier: BSD-3-Clause
//
// Fits whose residuals are made white with the noise model.
#include <doctest/doctest.h>

#include "identify/diagnosis/final_model.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/fit/error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"

using namespace catena;
using Eigen::Index;

namespace {

constexpr int kFrames = 150, kMarkers = 6;
constexpr double kSigma = 1e-3, kAutoregression = 0.6, kShaking = 2, kNoisier = 6;

/// Two links filmed at 60 Hz by a camera that shakes; noise is correlated in time, one marker is
/// noisier than the others.
std::shared_ptr<const Problem> filmed(unsigned seed) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
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

FittedModel fitted(const std::shared_ptr<const Problem>& problem,
                   const std::vector<NoiseModel>& noise) {
  FittedModel model = fit_model(problem, problem->start(), noise, fit_least_squares, nullptr);
  REQUIRE(model.ok);
  return model;
}

}  // namespace

TEST_CASE("white residuals have the derivatives they say, and leave out what is far off") {
  auto problem = filmed(1);
  std::vector<Experiment> experiments = problem->experiments();
  experiments[0].recording.measured(5, 70) += 100 * kSigma;
  experiments[0].recording.measured(3, 40) = std::nan("");
  const auto plain =
      std::make_shared<const Problem>(problem->the_case(), problem->model(), experiments);
  const std::vector<NoiseModel> noise = noise_of(fitted(plain, {}));
  REQUIRE(noise[0].told);
  REQUIRE(noise[0].outliers == 1);
  experiments[0].noise = std::make_shared<const NoiseModel>(noise[0]);
  const Problem white(problem->the_case(), problem->model(), experiments);
  const Eigen::VectorXd x = white.start();
  const Residuals at = fitted_residuals(white, evaluate(white, x, false, true));
  CHECK(at.value.size() == 2 * kMarkers * kFrames - 2);
  const auto residuals = [&](const Eigen::VectorXd& at_x) {
    return fitted_residuals(white, evaluate(white, at_x, false, false)).value;
  };
  for (Index j = 0; j < x.size(); ++j) {
    const Eigen::VectorXd difference = testing::central_difference(residuals, x, j, 1e-4 * x[j]);
    CHECK((difference - at.jacobian.col(j)).cwiseAbs().maxCoeff() <
          2e-3 * at.jacobian.col(j).cwiseAbs().maxCoeff());
  }
}

TEST_CASE("a fit that knows the noise errs much less, and by as much as it says") {
  constexpr int kRecordings = 40;
  double plain_error = 0, white_error = 0, in_deviations = 0;
  for (unsigned seed = 1; seed <= kRecordings; ++seed) {
    const auto problem = filmed(seed);
    const FittedModel plain = fitted(problem, {});
    const std::vector<NoiseModel> noise = noise_of(plain);
    const FittedModel white = fitted(problem, noise);
    const Eigen::VectorXd truth = Eigen::Vector2d(0.1, 0.005);
    plain_error += (plain.x - truth).cwiseQuotient(truth).squaredNorm();
    white_error += (white.x - truth).cwiseQuotient(truth).squaredNorm();
    in_deviations += (white.x - truth).cwiseQuotient(standard_errors(white, noise)).squaredNorm();
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
