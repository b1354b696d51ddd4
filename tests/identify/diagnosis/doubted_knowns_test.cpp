// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/doubted_knowns.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/diagnosis_folder.hpp"
#include "identify/diagnosis/diagnosis_text.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

const std::vector<std::string> kPossible = {"load_drag", "marker_places", "cable"};

/// What is said of a film with marks at these places of a cable of 1 m and so much drag, kg/m. The case takes the
/// marks to be evenly spread, and the cable to be so long, m.
Diagnosis diagnosed(const testing::TemporaryFolder& folder, const std::vector<double>& places,
                    double drag, double stated = 1) {
  Case the_case = testing::two_links_with(kPossible);
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  Candidate hidden = *context.find("load_drag");
  hidden.parameters.front().value = drag;
  const Recording film = testing::with_truth(with_effects(the_case, {hidden}, true),
                                             context.model_with({"load_drag"}, 2),
                                             testing::empty_markers(places, 240, 1.0 / 60), 1e-3);
  the_case.cable.length = stated;
  the_case = testing::measured(the_case, folder, film);
  Diagnosis found = diagnose(the_case, context, {.max_links = 2});
  write_diagnosis(record_of(found, find_out(found), context), folder.path(), folder.path());
  return found;
}

}  // namespace

TEST_CASE("a mark that sits elsewhere is found, and the case says so when it is read again") {
  const testing::TemporaryFolder folder;
  const Diagnosis found = diagnosed(folder, {0.25, 0.5, 0.758, 1.0}, 0);
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"marker_places"});
  CHECK(found.sentence.find("Marker 3 sits ") != std::string::npos);
  CHECK(found.sentence.find(" farther from the support than the case says") != std::string::npos);
  // The others are where they should be: of them nothing is said.
  CHECK(found.sentence.find("arker 1 ") == std::string::npos);
  CHECK(found.sentence.find("arker 2 ") == std::string::npos);

  const Case again = read_case(folder.path() / "diagnosed.toml");
  const auto place =
      std::find_if(again.parameters.begin(), again.parameters.end(),
                   [](const ParameterSpec& spec) { return spec.sets == "marker_places.marker 3"; });
  REQUIRE(place != again.parameters.end());
  CHECK(place->value == catena::near(8e-3, 0.05));
  CHECK(place->free);
}

TEST_CASE("a wrong length of the cable is no wrong mark, but a wrong length") {
  const testing::TemporaryFolder folder;
  const Diagnosis found = diagnosed(folder, {0.25, 0.5, 0.75, 1.0}, 0, 1.01);
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"cable"});
  CHECK(found.sentence.find("The cable is ") != std::string::npos);
  CHECK(found.sentence.find(" shorter than the case says") != std::string::npos);
  const Case again = read_case(folder.path() / "diagnosed.toml");
  const auto length =
      std::find_if(again.parameters.begin(), again.parameters.end(),
                   [](const ParameterSpec& spec) { return spec.sets == "cable.length"; });
  REQUIRE(length != again.parameters.end());
  CHECK(length->value == catena::near(1.0, 2e-3));
}

TEST_CASE("drag is no wrong mark, and marks where they should be are not blamed") {
  const testing::TemporaryFolder folder;
  const std::vector<double> evenly = {0.25, 0.5, 0.75, 1.0};
  const Diagnosis found = diagnosed(folder, evenly, 0.005);
  CAPTURE(found.sentence);
  CHECK(found.effects == std::vector<std::string>{"load_drag"});
  CHECK(diagnosed(folder, evenly, 0).verdict == DiagnosisVerdict::kNone);
}

TEST_CASE("what the case sets itself and what it calls impossible is no candidate") {
  Case the_case = testing::two_links_with(kPossible);
  const Problem problem(the_case, Model::built_in(2),
                        std::vector<Recording>{testing::empty_markers({0.5, 1.0}, 60, 0.1)});
  const auto amplitudes = [&] {
    std::vector<std::string> names;
    for (const Candidate& each : doubted_knowns(the_case, problem.experiments()))
      for (const CandidateParameter& parameter : each.parameters) names.push_back(parameter.name);
    return names;
  };
  using Names = std::vector<std::string>;
  CHECK(amplitudes() == Names{"marker_places.marker 1", "marker_places.marker 2", "cable.length"});
  the_case.error.measure = Measure::kMeanDistance;
  CHECK(amplitudes().empty());
  the_case.error.measure = Measure::kLeastSquares;
  ParameterSpec known;
  known.sets = "marker_places.marker 2";
  the_case.parameters.push_back(known);
  known.sets = "cable.density";
  the_case.parameters.push_back(known);
  CHECK(amplitudes() == Names{"marker_places.marker 1"});
  the_case.diagnosis.impossible.emplace_back("marker_places");
  CHECK(amplitudes().empty());
}

namespace {

/// Two links whose model has a rest angle of the pivot, at its default, which the case calls doubtful.
Case askew(const testing::TemporaryFolder& folder) {
  Case the_case = testing::two_links_with({"load_drag"});
  Description clamped = plain_chain();
  clamped.effects = {built_in_effect("pivot_rest_angle")};
  clamped.links = {2};
  the_case.description = folder.path() / "clamped.toml";
  write_description(clamped, the_case.description);
  the_case.diagnosis.doubtful = {"pivot_rest_angle.rest"};
  return the_case;
}

ParameterSpec rest_of(double angle) {
  ParameterSpec rest;
  rest.name = rest.sets = "pivot_rest_angle.rest";
  rest.value = angle;
  return rest;
}

}  // namespace

TEST_CASE("a parameter that the case calls doubtful is found to be off, and no physics beside it") {
  const testing::TemporaryFolder folder;
  Case the_case = askew(folder);
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  Case truth = the_case;
  truth.parameters.push_back(rest_of(0.6));
  const Recording film =
      testing::with_truth(truth, context.model_with({}, 2),
                          testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 240, 1.0 / 60), 1e-3);
  the_case = testing::measured(the_case, folder, film);
  const Diagnosis found = diagnose(the_case, context, {.max_links = 2});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  CHECK(found.effects == std::vector<std::string>{"pivot_rest_angle.rest"});
  REQUIRE(found.parameters.size() == 3);
  CHECK(found.parameters.back().effect == "pivot_rest_angle.rest");
  write_diagnosis(record_of(found, find_out(found), context), folder.path(), folder.path());
  const Case again = read_case(folder.path() / "diagnosed.toml");
  REQUIRE(again.parameters.size() == 3);
  CHECK(again.parameters.back().sets == "pivot_rest_angle.rest");
  CHECK(again.parameters.back().value == catena::near(0.6, 0.1));
}

TEST_CASE("only a parameter of the model that the case leaves at its default is doubtful") {
  const testing::TemporaryFolder folder;
  Case the_case = askew(folder);
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  const Model model = context.model_with({}, 2);
  CHECK(doubtful_parameters(the_case, model).size() == 1);
  const auto refused = [&] { return failure([&] { doubtful_parameters(the_case, model); }); };
  the_case.diagnosis.doubtful = {"pivot_rest_angle.rset"};
  CHECK(refused().find("did you mean \"pivot_rest_angle.rest\"?") != std::string::npos);
  the_case.diagnosis.doubtful = {"pivot_rest_angle.rest"};
  the_case.parameters.push_back(rest_of(0));
  CHECK(refused().find("\"pivot_rest_angle.rest\" is set by the case") != std::string::npos);
}
