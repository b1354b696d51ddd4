// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/verdict.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;

namespace {

const std::vector<std::string> kEffects = {"load_drag", "load_mass"};

bool has(const FittedModel& model, const std::string& unknown) {
  return unknown_index(*model.problem, unknown) >= 0;
}

}  // namespace

TEST_CASE("without its laws a model keeps errors of what is known, fitted again") {
  const testing::TemporaryFolder folder;
  DiagnosisContext context(testing::two_links_with(kEffects), {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  const DiagnosisOptions options;
  DiagnosisState state(context, options);
  const Model model = context.model_with(kEffects, 2);
  const Case asked = testing::measured(
      testing::two_links_with(kEffects), folder,
      testing::with_truth(testing::two_links_with(kEffects), model,
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 60, 1.0 / 60), 1e-3));
  const auto fitted = [&](const std::vector<std::string>& effects) {
    std::vector<Candidate> candidates;
    candidates.reserve(effects.size());
    for (const std::string& id : effects) candidates.push_back(*context.find(id));
    const auto problem =
        std::make_shared<const Problem>(with_effects(asked, candidates, true), model);
    return fit_model(problem, problem->start(), {}, fit_least_squares, nullptr);
  };
  state.enter(fitted({}), {}, "");
  const FittedModel both = fitted(kEffects);
  REQUIRE(both.ok);

  const FittedModel of_load = without_laws(state, both, kEffects);
  CHECK(has(of_load, "load_mass.correction"));
  CHECK_FALSE(has(of_load, "load_drag.coefficient"));
  CHECK(of_load.ok);
  // Of errors alone nothing is taken away; laws alone leave the model without effects.
  CHECK(without_laws(state, both, {"load_mass"}).problem == both.problem);
  CHECK(without_laws(state, both, {"load_drag"}).problem == state.last().model.problem);
}

TEST_CASE("what explains most of a misfit, and of what was held out, stands beside a gap") {
  // Drag, and a small force of the support's motion that the case calls impossible.
  const testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with({"load_drag"});
  Case truth = testing::two_links_with({"load_drag", "support_motion"});
  DiagnosisContext known(truth, {}, folder.path(), fit_least_squares, testing::provider_of_build());
  Candidate drag = *known.find("load_drag"), motion = *known.find("support_motion");
  const auto set = [](Candidate& candidate, const std::string& name, double value) {
    for (CandidateParameter& parameter : candidate.parameters)
      if (parameter.name == name) parameter.value = value;
  };
  set(drag, "load_drag.coefficient", 0.01);
  set(motion, "support_motion.side_amplitude", 0.001);
  set(motion, "support_motion.frequency", 4.3);
  the_case = testing::measured(
      the_case, folder,
      testing::with_truth(with_effects(truth, {drag, motion}, true),
                          known.model_with({"load_drag", "support_motion"}, 2),
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 240, 1.0 / 60), 5e-4));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  const Diagnosis found = diagnose(the_case, context, {.max_links = 2});
  CAPTURE(diagnosis_table(found, find_out(found)));
  REQUIRE(found.shares.effects.size() == 1);
  CHECK(found.shares.effects.front().fitted.share > 0.9);
  CHECK(found.shares.left_fitted.share > 0.01);
  CHECK(found.verdict == DiagnosisVerdict::kPartly);
  CHECK(found.certain == std::vector<std::string>{"load_drag"});
}

TEST_CASE("a warning of a recording stands at the recording, and not among the notes, too") {
  const testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with({});
  the_case = testing::measured(
      the_case, folder,
      testing::with_truth(the_case, Model::built_in(2),
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 120, 1.0 / 60), 1e-3));
  folder.write("markers.csv",
               "time_ms" + testing::text_of(folder.path() / "markers.csv").substr(6));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  const Diagnosis found = diagnose(the_case, context, {.max_effects = 0, .max_links = 2});
  const std::vector<std::string> warnings = found.final.problem->warnings();
  REQUIRE(!warnings.empty());
  CHECK(warnings.front().starts_with("run: time_unit: "));
  for (const std::string& note : found.notes) CHECK_FALSE(note.starts_with("run: "));
}
