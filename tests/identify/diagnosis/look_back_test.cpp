// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/look_back.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <random>

#include "identify/diagnosis/verdict.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

constexpr int kFrames = 240, kChannels = 12;
constexpr double kNoise = 1e-3, kRate = 60;

/// White noise and a slow misfit of so much rms.
Eigen::MatrixXd residuals(double misfit, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss(0, kNoise);
  Eigen::MatrixXd values(kChannels, kFrames);
  for (int k = 0; k < kFrames; ++k)
    for (int c = 0; c < kChannels; ++c)
      values(c, k) = gauss(random) + misfit * std::numbers::sqrt2 *
                                         std::sin(2 * std::numbers::pi * k / kRate + c / 24.0);
  return values;
}

/// A model that leaves these misfits, of two links.
FittedModel leaving(double fitted, double held_out) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  FittedModel model;
  model.problem = std::make_shared<const Problem>(
      the_case, Model::built_in(2),
      std::vector<Recording>{testing::empty_markers({0.5}, kFrames, 1 / kRate)});
  model.x = model.problem->start();
  model.ok = true;
  model.fit_residual = {residuals(fitted, 1)};
  model.held_out_residual = {residuals(held_out, 2)};
  return model;
}

Stage stage_of(const DiagnosisState& state, FittedModel model) {
  Stage stage;
  stage.fit = fit_gap(model, state.found.sigmas);
  stage.held_out = held_out_gap(model, state.found.sigmas);
  stage.model = std::move(model);
  return stage;
}

struct TwoEffects {
  testing::TemporaryFolder folder;
  DiagnosisContext context{{}, {}, folder.path(), fit_least_squares, {}};
  DiagnosisOptions options;
  DiagnosisState state{context, options};

  explicit TwoEffects(double fitted, double held_out) {
    state.found.tried = 26;
    state.enter(leaving(20 * kNoise, 20 * kNoise), {}, "");
    state.enter(leaving(fitted, held_out), {"air_drag_quadratic", "clock_offset"}, "clock_offset");
  }
};

}  // namespace

TEST_CASE("an effect without which a closed gap opens again is needed, a detail as it is") {
  TwoEffects closed(0, 0);
  REQUIRE_FALSE(gap_left(closed.state.last()));
  const Stage without = stage_of(closed.state, leaving(0.7 * kNoise, 0.7 * kNoise));
  REQUIRE(gap_left(without));
  CHECK_FALSE(needless(closed.state, without));

  // With a gap in either case, what explains a detail is needless.
  TwoEffects open(0.5 * kNoise, 0.5 * kNoise);
  REQUIRE(gap_left(open.state.last()));
  CHECK(needless(open.state, stage_of(open.state, leaving(0.7 * kNoise, 0.7 * kNoise))));
}

TEST_CASE("an effect is needless where the model without it leaves no gap") {
  TwoEffects closed(0, 0);
  CHECK(needless(closed.state, stage_of(closed.state, leaving(0.1 * kNoise, 0.1 * kNoise))));
}

TEST_CASE("a model reopens a gap through the held-out part, too") {
  TwoEffects closed(0, 0);
  CHECK_FALSE(closed.state.reopens_gap(leaving(0, 0)));
  CHECK(closed.state.reopens_gap(leaving(0, 2 * kNoise)));
  CHECK(closed.state.reopens_gap(leaving(0.7 * kNoise, 0)));
  TwoEffects open(0.7 * kNoise, 0);
  CHECK_FALSE(open.state.reopens_gap(leaving(0.7 * kNoise, 0)));
}
