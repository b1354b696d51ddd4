// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/errors_of_knowns.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/diagnosis_state.hpp"
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

/// What the effect explains beyond errors of knowns, of a motion with the effect's first parameter at
/// `amount` and a cable that is heavier than stated by the share `heavier`.
BeyondErrorsOfKnowns beyond(const std::string& effect, double amount, double heavier) {
  const testing::TemporaryFolder folder;
  DiagnosisContext context(two_links(), {}, folder.path(), fit_least_squares, provider());
  const DiagnosisOptions options;
  DiagnosisState state(context, options);
  const auto with_effect = [&](const Case& the_case) {
    return with_effects(the_case, {*context.find(effect)}, false);
  };
  const Model model = context.model_with({effect}, 2);
  Case truth = with_effect(two_links());
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  truth.parameters[2].value = amount;
  truth.cable.density *= 1 + heavier;
  Case asked = testing::measured(
      two_links(), folder,
      testing::with_truth(truth, model, testing::empty_markers(kPlaces, kFrames, 1.0 / 60),
                          kNoise));
  const auto fitted = [&](const Case& the_case) {
    const auto problem = std::make_shared<const Problem>(the_case, model);
    return fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  };
  const auto enter = [&](const Case& the_case, const std::vector<std::string>& effects) {
    state.enter(fitted(the_case), effects, effects.empty() ? "" : effects.back());
    state.found.noise = {NoiseModel{.level = kNoise}};
  };
  enter(asked, {});
  enter(with_effect(asked), {effect});
  state.found.effects = {effect};
  state.found.final = state.last().model;
  // In the fitted part the effect explains what there is.
  CHECK(state.found.stages[0].fit.ratio() > 1.3);
  CHECK(state.found.stages[1].fit.ratio() < 1.1);
  return beyond_errors_of_knowns(state, effect);
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

TEST_CASE("effects of sensors and of wrong knowns are errors of knowns, physics is none") {
  for (const char* id : {"scale", "camera_lens", "encoder_error", "load_mass", "gravity_tilt"})
    CHECK(is_error_of_known(candidate_of(built_in_effect(id))));
  for (const char* id : {"load_drag", "joint_hysteresis", "support_motion", "added_mass"})
    CHECK_FALSE(is_error_of_known(candidate_of(built_in_effect(id))));
}

}  // namespace errors_of_knowns_test
