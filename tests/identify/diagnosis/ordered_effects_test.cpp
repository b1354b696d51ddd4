// SPDX-License-Identifier: BSD-3-Clause
//
// Effects of which one coefficient does not exceed another.
#include <doctest/doctest.h>

#include <algorithm>

#include "identify/diagnosis/bounded_fit.hpp"
#include "identify/diagnosis/candidate_scores.hpp"
#include "identify/diagnosis/refits.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace ordered_effects_test {
namespace {

constexpr double kNoise = 1e-3;  // m
const std::string kNormal = "air_drag_linear.normal", kTangential = "air_drag_linear.tangential";

/// Two links with such drag (N s/m^2) filmed for 4 s, and what a search finds.
struct Search {
  testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with({"air_drag_linear"});
  DiagnosisContext context{
      the_case, {}, folder.path(), fit_least_squares, testing::provider_of_build()};
  std::vector<NoiseModel> noise = {{.level = kNoise}};
  Explanation found;

  Search(double normal, double tangential) {
    Candidate hidden = *context.find("air_drag_linear");
    hidden.parameters[0].value = normal;
    hidden.parameters[1].value = tangential;
    const Model model = context.model_with({"air_drag_linear"}, 2);
    Case truth = with_effects(the_case, {hidden}, true);
    for (ParameterSpec& parameter : truth.parameters) parameter.at_most.clear();
    the_case = testing::measured(
        the_case, folder,
        testing::with_truth(truth, model,
                            testing::empty_markers({0.25, 0.5, 0.75, 1.0}, 240, 1.0 / 60), kNoise));
    const auto plain = std::make_shared<const Problem>(the_case, model);
    const CandidateSearch search{
        context, fit_model(plain, plain->start(), {}, fit_least_squares, nullptr), {}, noise};
    std::vector<Explanation> all = CandidateScores(search).score(false);
    refit_best(search, all, 2, false);
    found = *std::find_if(all.begin(), all.end(),
                          [](const Explanation& each) { return each.is_effect(); });
  }

  double start_of(const std::string& name) const {
    for (const auto& [unknown, value] : found.start.of_effect)
      if (unknown == name) return value;
    return NAN;
  }
  double value_of(const std::string& name) const {
    return found.model.x[unknown_index(*found.model.problem, name)];
  }
};

}  // namespace

TEST_CASE("drag along the cable is found to be no more than across it") {
  const Search impossible(0.02, 2);
  REQUIRE(impossible.found.refitted);
  CHECK(impossible.start_of(kTangential) <= impossible.start_of(kNormal));
  CHECK(impossible.value_of(kNormal) > 0);
  CHECK(impossible.value_of(kTangential) == impossible.value_of(kNormal));

  const Search possible(0.5, 0.1);
  REQUIRE(possible.found.refitted);
  CHECK(possible.start_of(kNormal) == catena::near(0.5, 0.3));
  CHECK(possible.value_of(kNormal) == catena::near(0.5, 0.1));
  CHECK(possible.value_of(kTangential) < 0.9 * possible.value_of(kNormal));
}

TEST_CASE("a linearised fit keeps the order, too") {
  const Search film(0.1, 0.1);
  const Problem& problem = *film.found.model.problem;
  Eigen::VectorXd x = film.found.model.x;
  const Eigen::Index normal = unknown_index(problem, kNormal);
  const Eigen::Index tangential = unknown_index(problem, kTangential);
  x[normal] = 0.1;
  x[tangential] = 0.05;
  const Eigen::MatrixXd along = Eigen::MatrixXd::Identity(x.size() + 1, x.size());
  const BoundedFit fit(problem, x, along);
  // Wanted: 0.2 less across, and 0.3 more along. Equal they are 0.1, of which the squares are least.
  Eigen::VectorXd error = Eigen::VectorXd::Zero(x.size() + 1);
  error[normal] = -0.2;
  error[tangential] = 0.3;
  const Eigen::VectorXd there = x + fit(error);
  CHECK(there[tangential] == doctest::Approx(there[normal]));
  CHECK(there[normal] == doctest::Approx((0.1 - 0.2 + 0.05 + 0.3) / 2));
}

}  // namespace ordered_effects_test
