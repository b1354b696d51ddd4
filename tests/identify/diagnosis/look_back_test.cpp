// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/look_back.hpp"

#include <doctest/doctest.h>

#include <array>
#include <numbers>
#include <random>

#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/verdict.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace look_back_test {
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
  Recording recording =
      testing::empty_markers({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, 2 * kFrames, 1 / kRate);
  recording.fit_frames = kFrames;
  FittedModel model;
  model.fit_residual = {residuals(fitted, 1)};
  model.held_out_residual = {residuals(held_out, 2)};
  recording.measured << -model.fit_residual[0], -model.held_out_residual[0];
  model.problem = std::make_shared<const Problem>(the_case, Model::built_in(2),
                                                  std::vector<Recording>{std::move(recording)});
  model.x = model.problem->start();
  model.ok = true;
  model.predicted = {Eigen::MatrixXd::Zero(kChannels, Eigen::Index{2} * kFrames)};
  return model;
}

Stage stage_of(const DiagnosisState& state, FittedModel model) {
  Stage stage;
  stage.fit = fit_gap(model, state.found.noise);
  stage.held_out = held_out_gap(model, state.found.noise);
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
  TwoEffects open(kNoise, kNoise);
  REQUIRE(gap_left(open.state.last()));
  CHECK(needless(open.state, stage_of(open.state, leaving(1.4 * kNoise, 1.4 * kNoise))));
}

TEST_CASE("an effect is needless where the model without it leaves no gap") {
  TwoEffects closed(0, 0);
  CHECK(needless(closed.state, stage_of(closed.state, leaving(0.1 * kNoise, 0.1 * kNoise))));
}

TEST_CASE("an effect that others imitate where it was fitted is needed where it was held out") {
  const TwoEffects both(3 * kNoise, 3 * kNoise);
  CHECK(needless(both.state, stage_of(both.state, leaving(3 * kNoise, 3 * kNoise))));
  CHECK_FALSE(needless(both.state, stage_of(both.state, leaving(3 * kNoise, 4 * kNoise))));
}

TEST_CASE("a lead where it was fitted that is lost where it was held out decides nothing") {
  const FittedModel worse = leaving(4 * kNoise, 5 * kNoise);
  const std::vector<NoiseModel> noise = {{.level = kNoise}};
  CHECK(decide(leaving(1 * kNoise, 5 * kNoise), worse, noise).decided);
  CHECK_FALSE(decide(leaving(1 * kNoise, 6 * kNoise), worse, noise).decided);
}

TEST_CASE("a model reopens a gap through the held-out part, too") {
  TwoEffects closed(0, 0);
  CHECK_FALSE(closed.state.reopens_gap(leaving(0, 0)));
  CHECK(closed.state.reopens_gap(leaving(0, 2 * kNoise)));
  CHECK(closed.state.reopens_gap(leaving(0.7 * kNoise, 0)));
  TwoEffects open(0.7 * kNoise, 0);
  CHECK_FALSE(open.state.reopens_gap(leaving(0.7 * kNoise, 0)));
}

namespace {

/// An effect of so many unknowns, as refitted.
Explanation explanation_of(const DiagnosisState& state, const std::string& id, int unknowns,
                           FittedModel model) {
  Explanation explanation;
  explanation.id = id;
  explanation.candidate = 0;
  explanation.refitted = true;
  explanation.comparison = compare(state.last().model, model, state.found.noise);
  explanation.comparison.added = unknowns;
  explanation.chance = 1.0 / 200;
  explanation.fit = fit_gap(model, state.found.noise);
  explanation.held_out = held_out_gap(model, state.found.noise);
  explanation.model = std::move(model);
  return explanation;
}

}  // namespace

TEST_CASE("what was held out rules out an effect that only imitates the fitted part") {
  testing::TemporaryFolder folder;
  DiagnosisContext context({}, {}, folder.path(), fit_least_squares, {});
  DiagnosisOptions options;
  DiagnosisState state(context, options);
  state.found.tried = 26;
  state.enter(leaving(8 * kNoise, 20 * kNoise), {}, "");
  std::vector<Explanation> both;
  both.push_back(explanation_of(state, "imitates", 1, leaving(3 * kNoise, 15 * kNoise)));
  both.push_back(explanation_of(state, "predicts", 2, leaving(4 * kNoise, 5 * kNoise)));
  CHECK(choose(state, both)->id == "predicts");
  // Where both predict alike, the fitted part decides.
  both[0] = explanation_of(state, "imitates", 1, leaving(3 * kNoise, 5 * kNoise));
  CHECK(choose(state, both)->id == "imitates");
}

namespace {

/// What is chosen of a passive effect and of a driven one that leave these misfits, in noise levels.
std::string chosen_of(double passive_fitted, double passive_held_out, double driven_fitted,
                      double driven_held_out, int unknowns_of_passive = 1) {
  testing::TemporaryFolder folder;
  DiagnosisContext context({}, {}, folder.path(), fit_least_squares, {});
  DiagnosisOptions options;
  DiagnosisState state(context, options);
  state.enter(leaving(20 * kNoise, 20 * kNoise), {}, "");
  std::vector<Explanation> both;
  both.push_back(explanation_of(state, "load_drag", unknowns_of_passive,
                                leaving(passive_fitted * kNoise, passive_held_out * kNoise)));
  both.push_back(explanation_of(state, "support_motion", 5,
                                leaving(driven_fitted * kNoise, driven_held_out * kNoise)));
  return choose(state, both)->id;
}

}  // namespace

TEST_CASE("what drives the cable must predict better than what is passive") {
  CHECK(chosen_of(2, 3, 1, 2.9) == "support_motion");
  CHECK(chosen_of(2, 3, 1, 3.1) == "load_drag");
  CHECK(chosen_of(2, 3, 1, 3.1, 6) == "load_drag");  // not because it is simpler
}

TEST_CASE("many unknowns cost more than a small lead where what is left is smooth") {
  CHECK(chosen_of(4, 3, 3.5, 2.9) == "load_drag");
  CHECK(chosen_of(4, 3, 0, 2.9) == "support_motion");
}

TEST_CASE("a detail of what was fitted is none if it is a good part of what was held out") {
  TwoEffects effects(1.5 * kNoise, 10 * kNoise);
  const FittedModel& base = effects.state.last().model;
  CHECK_FALSE(more_than_a_detail(effects.state, base, leaving(kNoise, 10 * kNoise)));
  CHECK(more_than_a_detail(effects.state, base, leaving(kNoise, 5 * kNoise)));
}

TEST_CASE("a third effect must predict better, not only as well") {
  TwoEffects effects(5 * kNoise, 5 * kNoise);
  const FittedModel base = effects.state.last().model;
  const auto third = [&](double held_out) {
    return acceptable(effects.state, base,
                      explanation_of(effects.state, "third", 1, leaving(kNoise, held_out)));
  };
  CHECK_FALSE(third(5 * kNoise));
  CHECK(third(3 * kNoise));
}

TEST_CASE("what chance explains as well is no explanation") {
  TwoEffects effects(5 * kNoise, 5 * kNoise);
  const FittedModel base = effects.state.last().model;
  Explanation explanation = explanation_of(effects.state, "third", 1, leaving(kNoise, 3 * kNoise));
  REQUIRE(acceptable(effects.state, base, explanation));
  explanation.chance = 0.02;
  CHECK_FALSE(acceptable(effects.state, base, explanation));
}

TEST_CASE("effects of an earlier best model are recognised in any order") {
  const TwoEffects effects(0, 0);
  CHECK(effects.state.had({"clock_offset", "air_drag_quadratic"}));
  CHECK_FALSE(effects.state.had({"clock_offset"}));
}

TEST_CASE("an effect stands that shows in both parts, and well in one") {
  Diagnosis found;
  found.shares.has_held_out = true;
  // The share, and how small it may be in other stretches of motion.
  const auto stands = [&](std::array<double, 2> fitted, std::array<double, 2> held_out) {
    found.shares.effects = {{"drag",
                             {.share = fitted[0], .least = fitted[1]},
                             {.share = held_out[0], .least = held_out[1]}}};
    return !standing_effects(found).empty();
  };
  CHECK(stands({0.2, 0.06}, {0.9, 0.86}));
  CHECK(stands({0.8, 0.7}, {0.1, 0.01}));
  CHECK_FALSE(stands({0.8, 0.7}, {0.1, -0.01}));
  CHECK_FALSE(stands({0.1, -0.01}, {0.9, 0.86}));
  CHECK_FALSE(stands({0.1, 0.01}, {0.1, 0.01}));
}

TEST_CASE(
    "nothing stands where a freer start does as well; beside another effect one of both does") {
  Diagnosis found;
  found.shares.effects = {{"clock_offset", {.share = 0.9, .least = 0.8}, {}}};
  const auto stands_beside = [&](const char* rival, int candidate) {
    Explanation explanation;
    explanation.id = rival;
    explanation.candidate = candidate;
    found.alternatives = {{"clock_offset", explanation, {}}};
    return !standing_effects(found).empty();
  };
  CHECK(stands_beside("support_motion", 0));
  CHECK_FALSE(stands_beside(kStartShape, -1));
  found.alternatives.front().instead_of = "load_drag";
  CHECK_FALSE(standing_effects(found).empty());
}

}  // namespace look_back_test
