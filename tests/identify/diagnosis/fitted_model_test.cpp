// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/fitted_model.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/diagnosis/residual_frequencies.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace fitted_model_test {
namespace {

const std::vector<NoiseModel> kNoise = {{.level = 1e-3}};
constexpr int kFrames = 200, kFitted = 121;
constexpr double kStep = 0.05;  // s: 6 s are fitted, 4 s are held out

/// One marker whose residuals are a sine of 5 mm at `hertz` in the whole recording.
FittedModel with_sine(double hertz, double good_enough = std::nan("")) {
  Case the_case = testing::sections(testing::kTwoLinks);
  the_case.diagnosis.good_enough = good_enough;
  testing::add_experiment(the_case, "run");
  Recording recording = testing::empty_markers({1.0}, kFrames, kStep);
  recording.fit_frames = kFitted;
  Eigen::MatrixXd residual(2, kFrames);
  for (int k = 0; k < kFrames; ++k)
    residual.col(k).setConstant(5e-3 * std::sin(2 * std::numbers::pi * hertz * kStep * k));
  FittedModel model;
  model.problem = std::make_shared<const Problem>(the_case, Model::built_in(2),
                                                  std::vector<Recording>{recording});
  model.fit_residual = {residual.leftCols(kFitted)};
  model.held_out_residual = {residual.rightCols(kFrames - kFitted)};
  return model;
}

}  // namespace

TEST_CASE("a gap that the case accepts is closed, in both parts") {
  for (const double good_enough : {std::nan(""), 3e-3, 4e-3}) {
    const FittedModel model = with_sine(1.0, good_enough);  // 3.5 mm RMS
    for (const GapTest& gap : {fit_gap(model, kNoise), held_out_gap(model, kNoise)}) {
      CHECK(gap.rms == catena::near(5e-3 / std::numbers::sqrt2, 0.02));
      CHECK(gap.good_enough == (good_enough == 4e-3));
      CHECK(gap.present == !gap.good_enough);
    }
  }
}

TEST_CASE("an effect is driven at no frequency with fewer than two periods in the fitted part") {
  const FittedModel model = with_sine(0.2);
  const double lowest = lowest_shown_frequency(model);
  CHECK(lowest == doctest::Approx(2.0 / 6.0));
  const auto strongest = strongest_frequencies(model, {1e-3}, 1);
  REQUIRE(strongest.size() == 1);
  CHECK(strongest[0] < lowest);  // it is there, and the recording does not tell it from a drift
  const auto driving = driving_frequencies(model, {1e-3});
  REQUIRE_FALSE(driving.empty());
  CHECK(*std::min_element(driving.begin(), driving.end()) >= lowest);
}

TEST_CASE("a frequency is told from that of the motion if it is one over the duration away") {
  FittedModel model = with_sine(1.0);
  Eigen::MatrixXd motion(2, kFrames);
  for (int k = 0; k < kFrames; ++k)
    motion.col(k) << 0.2 * std::cos(2 * std::numbers::pi * 0.8 * kStep * k), 1.0;
  model.predicted = {motion};
  CHECK_FALSE(told_from_motion(model, 0.8));
  CHECK_FALSE(told_from_motion(model, 0.9));
  CHECK(told_from_motion(model, 1.0));
  CHECK(told_from_motion(model, 0.6));
}

}  // namespace fitted_model_test
