// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/discovery.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

constexpr double kHiddenDrag = 0.05;  // kg/m, of the load

/// A film of two links whose load is dragged, diagnosed with these effects in the library.
Diagnosis dragged(const std::vector<std::string>& library, bool discover, double noise = 5e-4) {
  const testing::TemporaryFolder folder;
  const std::vector<std::string> hidden = {"load_drag"};
  const Case truth = testing::two_links_with(hidden);
  DiagnosisContext known(truth, {}, folder.path(), fit_least_squares, testing::provider_of_build());
  Candidate drag = *known.find("load_drag");
  drag.parameters.front().value = kHiddenDrag;
  const Case the_case = testing::measured(
      testing::two_links_with(library), folder,
      testing::with_truth(with_effects(truth, {drag}, true), known.model_with(hidden, 2),
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 240, 1.0 / 60), noise));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  return diagnose(the_case, context, {.max_links = 2, .discover = discover});
}

bool any_note(const Diagnosis& found, const std::string& begin, const std::string& part = "") {
  return std::any_of(found.notes.begin(), found.notes.end(), [&](const std::string& note) {
    return note.starts_with(begin) && note.find(part) != std::string::npos;
  });
}

}  // namespace

TEST_CASE("a law is sought beside the effect that closes the gap, and does not take its place") {
  const Diagnosis found = dragged({"load_drag"}, true);
  CAPTURE(diagnosis_table(found, find_out(found)));
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"load_drag"});
  CHECK(any_note(found, "without load_drag: its law: force along the velocity = "));
  CHECK(any_note(found, "the law of ", "was not accepted against load_drag"));
  CHECK(found.law.empty());

  const Diagnosis unasked = dragged({"load_drag"}, false);
  CHECK(unasked.effects == found.effects);
  CHECK_FALSE(any_note(unasked, "without load_drag"));
}

TEST_CASE("a law takes the place of an effect that imitates it") {
  const Diagnosis found = dragged({"pivot_damping"}, true);
  CAPTURE(diagnosis_table(found, find_out(found)));
  CHECK(found.verdict == DiagnosisVerdict::kDiscovered);
  CHECK(found.effects == std::vector<std::string>{found.law});
  REQUIRE(found.force.has_value());
  REQUIRE(found.force->law.has_value());
  CHECK(found.force->law->variable == "speed");
}

TEST_CASE("an imitator that the data do not decide against is undecided, in place of the law") {
  // Drag by the speed, or by the velocity across the cable: the load hardly moves along it.
  const Diagnosis found = dragged({"pivot_damping"}, true, 1e-3);
  CAPTURE(diagnosis_table(found, find_out(found)));
  REQUIRE(found.force.has_value());
  REQUIRE(found.force->law.has_value());
  REQUIRE(found.force->law->rivals.size() == 1);
  REQUIRE(found.alternatives.size() == 1);
  const Alternative& other = found.alternatives.front();
  CHECK(other.instead_of == found.law);
  CHECK(other.explanation.id == "discovered_law_2");
  CHECK(other.explanation.refitted);
  CHECK_FALSE(other.decision.decided);
  CHECK(found.sentence.find("These data do not decide against " + other.explanation.title) !=
        std::string::npos);
  CHECK(std::none_of(found.runners_up.begin(), found.runners_up.end(), [&](const auto& each) {
    return each.explanation.id == other.explanation.id;
  }));

  // One that leaves more is no imitator, but is not forgotten. One that leaves less stays undecided.
  const auto sorted = [&](double residuals) {
    Diagnosis with_another = found;
    Explanation another = other.explanation;
    another.id = "discovered_law_3";
    another.model.fit_residual.front() *= residuals;
    another.model.held_out_residual.front() *= residuals;
    const bool undecided = sort_rival(with_another, found.final, another);
    REQUIRE(with_another.alternatives.size() == (undecided ? 2 : 1));
    REQUIRE(with_another.runners_up.size() == found.runners_up.size() + (undecided ? 0 : 1));
    const auto& last =
        undecided ? with_another.alternatives.back() : with_another.runners_up.back();
    CHECK(last.explanation.id == "discovered_law_3");
    CHECK(last.instead_of == found.law);
    CHECK(last.decision.decided);
    CHECK(diagnosis_table(with_another, {})
              .find(undecided ? "undecided: discovered_law_3" : "runner-up: discovered_law_3") !=
          std::string::npos);
    return undecided;
  };
  CHECK_FALSE(sorted(2));
  CHECK(sorted(0.5));
}
