// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/verdict.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

Case two_links() {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  // Few effects, so that the model is made in a second.
  for (const std::string& id : built_in_effect_ids())
    if (id != "load_drag" && id != "load_mass") the_case.diagnosis.impossible.push_back(id);
  return the_case;
}

ProviderOptions provider() {
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  return options;
}

bool has(const FittedModel& model, const std::string& unknown) {
  return unknown_index(*model.problem, unknown) >= 0;
}

}  // namespace

TEST_CASE("without its laws a model keeps errors of what is known, fitted again") {
  const testing::TemporaryFolder folder;
  DiagnosisContext context(two_links(), {}, folder.path(), fit_least_squares, provider());
  const DiagnosisOptions options;
  DiagnosisState state(context, options);
  const Model model = context.model_with({"load_drag", "load_mass"}, 2);
  const Case asked = testing::measured(
      two_links(), folder,
      testing::with_truth(two_links(), model,
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
  const FittedModel both = fitted({"load_drag", "load_mass"});
  REQUIRE(both.ok);

  const FittedModel of_load = without_laws(state, both, {"load_drag", "load_mass"});
  CHECK(has(of_load, "load_mass.correction"));
  CHECK_FALSE(has(of_load, "load_drag.coefficient"));
  CHECK(of_load.ok);
  // Of errors alone nothing is taken away; laws alone leave the model without effects.
  CHECK(without_laws(state, both, {"load_mass"}).problem == both.problem);
  CHECK(without_laws(state, both, {"load_drag"}).problem == state.last().model.problem);
}
