// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/errors_of_knowns.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/look_back.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace errors_of_knowns_test {
namespace {

constexpr double kNoise = 1e-3;
constexpr int kFrames = 240;
const std::vector<double> kPlaces = {0.25, 0.5, 0.75, 1.0};

Case two_links() {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  // Few effects, so that the model is made in a second.
  for (const std::string& id : built_in_effect_ids())
    if (id != "load_drag" && id != "centre_offset" && id != "load_mass" && id != "scale" &&
        id != "clock_offset" && id != "gravity_tilt")
      the_case.diagnosis.impossible.push_back(id);
  return the_case;
}

ProviderOptions provider() {
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  return options;
}

/// A motion with an effect and a cable that is heavier than stated by the share `heavier`, and what a diagnosis knows
/// of it.
struct Film {
  testing::TemporaryFolder folder;
  DiagnosisContext context{two_links(), {}, folder.path(), fit_least_squares, provider()};
  DiagnosisOptions options;
  DiagnosisState state{context, options};
  Model model = context.model_with({"load_drag", "centre_offset"}, 2);
  Case asked;

  /// The effect's first parameter is `amount`.
  Film(const std::string& effect, double amount, double heavier) {
    Case truth = with_effect(two_links(), effect);
    truth.parameters[0].value = 0.1;
    truth.parameters[1].value = 0.005;
    truth.parameters[2].value = amount;
    truth.cable.density *= 1 + heavier;
    asked = testing::measured(
        two_links(), folder,
        testing::with_truth(truth, model, testing::empty_markers(kPlaces, kFrames, 1.0 / 60),
                            kNoise));
    enter("");
  }

  Case with_effect(const Case& the_case, const std::string& effect) const {
    return with_effects(the_case, {*context.find(effect)}, false);
  }
  FittedModel fitted(const Case& the_case) const {
    const auto problem = std::make_shared<const Problem>(the_case, model);
    return fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  }
  /// Takes the model with an effect, or with none, as the best so far.
  void enter(const std::string& effect) {
    std::vector<std::string> effects;
    if (!effect.empty()) effects.push_back(effect);
    state.enter(fitted(effect.empty() ? asked : with_effect(asked, effect)), effects, effect);
    state.found.noise = {NoiseModel{.level = kNoise}};
    state.found.effects = effects;
    state.found.final = state.last().model;
  }
  /// The model with an effect as an explanation of what the first one lacks.
  Explanation explanation(const std::string& effect) const {
    Explanation explanation;
    explanation.id = effect;
    explanation.candidate = static_cast<int>(context.find(effect) - context.library().data());
    explanation.model = fitted(with_effect(asked, effect));
    explanation.refitted = true;
    explanation.chance = 0;
    explanation.comparison =
        compare(state.found.stages[0].model, explanation.model, state.found.noise);
    explanation.fit = fit_gap(explanation.model, state.found.noise);
    explanation.held_out = held_out_gap(explanation.model, state.found.noise);
    return explanation;
  }
};

/// What the effect explains beyond errors of knowns.
BeyondErrorsOfKnowns beyond(const std::string& effect, double amount, double heavier) {
  Film film(effect, amount, heavier);
  film.enter(effect);
  // In the fitted part the effect explains what there is.
  CHECK(film.state.found.stages[0].fit.ratio() > 1.3);
  CHECK(film.state.found.stages[1].fit.ratio() < 1.1);
  return beyond_errors_of_knowns(film.state, effect);
}

}  // namespace

TEST_CASE("drag of the load is no error of a known") {
  const BeyondErrorsOfKnowns of_drag = beyond("load_drag", 0.05, 0);
  CHECK(of_drag.of_misfit > 3 * kThresholds.worthwhile);
  CHECK(of_drag.of_effect > 3 * kThresholds.worthwhile);
}

TEST_CASE("mass centres off mid-link are not certain where the cable may be heavier than stated") {
  const BeyondErrorsOfKnowns of_offset = beyond("centre_offset", 0, 0.03);
  CHECK(of_offset.of_misfit < kThresholds.worthwhile);
  CHECK(of_offset.of_effect < kThresholds.worthwhile);
}

TEST_CASE("a law takes the place of another one for no lead that errors of knowns could leave") {
  Film heavier("load_drag", 5e-4, 0.02);
  const Explanation right = heavier.explanation("load_drag"),
                    wrong = heavier.explanation("centre_offset");
  CHECK(decide(wrong.model, right.model, heavier.state.found.noise).decided);
  heavier.state.found.stages[0].explanations = {right, wrong};
  heavier.enter("load_drag");
  look_back(heavier.state);
  CHECK(heavier.state.found.effects == std::vector<std::string>{"load_drag"});
  // With such errors drag leads.
  REQUIRE(heavier.state.found.runners_up.size() == 1);
  CHECK(heavier.state.found.runners_up[0].explanation.id == "centre_offset");
}

TEST_CASE("effects of sensors and of wrong knowns are errors of knowns, physics is none") {
  for (const char* id : {"scale", "camera_lens", "encoder_error", "load_mass", "gravity_tilt"})
    CHECK(is_error_of_known(candidate_of(built_in_effect(id))));
  for (const char* id : {"load_drag", "joint_hysteresis", "support_motion", "added_mass"})
    CHECK_FALSE(is_error_of_known(candidate_of(built_in_effect(id))));
}

}  // namespace errors_of_knowns_test
