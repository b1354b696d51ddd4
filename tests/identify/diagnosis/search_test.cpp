// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/search.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_links.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

TEST_CASE("where the best refits leave a gap all others are refitted, and only there") {
  const std::vector<std::string> possible = {"load_drag", "clock_offset"};
  const testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with(possible);
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  Candidate hidden = *context.find("load_drag");
  hidden.parameters.front().value = 0.002;
  const Model model = context.model_with({"load_drag"}, 2);
  the_case = testing::measured(
      the_case, folder,
      testing::with_truth(with_effects(the_case, {hidden}, true), model,
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 120, 1.0 / 60), 1e-3));
  const auto plain = std::make_shared<const Problem>(the_case, model);
  const FittedModel base = fit_model(plain, plain->start(), {}, fit_least_squares, nullptr);
  // So many of those whose score promises most are refitted first.
  const auto refitted = [&](int best) {
    const DiagnosisOptions options{.refits = best};
    DiagnosisState state(context, options);
    state.enter(base, {}, "");
    REQUIRE_FALSE(state.far());
    std::vector<std::string> ids;
    for (const Explanation& each : look(state, base, {}))
      if (each.refitted && each.is_effect()) ids.push_back(each.id);
    std::sort(ids.begin(), ids.end());
    return ids;
  };
  // The right one closes the gap.
  CHECK(refitted(1) == std::vector<std::string>{"load_drag"});
  // None was refitted, so that the gap is open still.
  CHECK(refitted(0) == std::vector<std::string>{"clock_offset", "load_drag"});
}
