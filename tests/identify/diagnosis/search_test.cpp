// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/search.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/candidate_scores.hpp"
#include "identify/diagnosis/close_simulation.hpp"
#include "identify/diagnosis/refits.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace search_test {
namespace {

constexpr double kNoise = 1e-3;  // m
const std::vector<std::string> kPossible = {"load_drag", "clock_offset"};

/// Two links whose load has drag (kg/m), filmed for so many frames, and the model without drag fitted to them.
struct WithHiddenDrag {
  testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with(kPossible);
  DiagnosisContext context{
      the_case, {}, folder.path(), fit_least_squares, testing::provider_of_build()};
  FittedModel base;

  explicit WithHiddenDrag(int frames, double drag = 0.002) {
    Candidate hidden = *context.find("load_drag");
    hidden.parameters.front().value = drag;
    const Model model = context.model_with({"load_drag"}, 2);
    the_case = testing::measured(
        the_case, folder,
        testing::with_truth(with_effects(the_case, {hidden}, true), model,
                            testing::empty_markers({0.25, 0.5, 0.75, 1.0}, frames, 1.0 / 60),
                            kNoise));
    const auto plain = std::make_shared<const Problem>(the_case, model);
    base = fit_model(plain, plain->start(), {}, fit_least_squares, nullptr);
  }
};

}  // namespace

TEST_CASE("where the best refits leave a gap all others are refitted, and only there") {
  WithHiddenDrag film(120);
  DiagnosisContext& context = film.context;
  const FittedModel& base = film.base;
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

TEST_CASE("a refit begins where the linearised fit has the base beside the effect") {
  WithHiddenDrag film(600, 4e-4);
  const std::vector<NoiseModel> noise = {{.level = kNoise}};
  const CandidateSearch search{film.context, film.base, {}, noise};
  CandidateScores scores(search);
  const std::vector<Explanation> found = scores.score(false);
  const auto drag = std::find_if(found.begin(), found.end(),
                                 [](const Explanation& each) { return each.id == "load_drag"; });
  REQUIRE(drag != found.end());
  const auto problem = search.problem_with(*film.context.find("load_drag"));
  // Of the mean square over the noise, what is left beyond noise.
  const auto left_by = [&](const Eigen::VectorXd& of_base) {
    Eigen::VectorXd x = transfer(*film.base.problem, of_base, *problem);
    for (const auto& [name, value] : drag->start.of_effect)
      x[unknown_index(*problem, name)] = value;
    return std::pow(error_to_fit(*problem, x, noise, {}), 2) - 1;
  };
  const double without = std::pow(error_to_fit(*film.base.problem, film.base.x, noise, {}), 2) - 1;
  const double alone = left_by(film.base.x);
  CHECK(left_by(drag->start.of_base) < 0.25 * std::min(without, alone));
}

TEST_CASE(
    "a refit ends where simulations take many times the steps of the base, or where they stall") {
  WithHiddenDrag film(60);
  const testing::TemporaryFolder folder;
  std::vector<long> most_steps;
  std::vector<double> stall;
  const LeastSquares watched = [&](const Problem& problem, const FitOptions& options) {
    most_steps.push_back(options.most_steps);
    stall.push_back(options.stall);
    return fit_least_squares(problem, options);
  };
  DiagnosisContext context(testing::two_links_with({"axial_stretch"}), {}, folder.path(), watched,
                           testing::provider_of_build());
  Explanation stretch;
  stretch.id = "axial_stretch";
  stretch.candidate = static_cast<int>(context.find(stretch.id) - context.library().data());
  stretch.score.admissible = true;
  stretch.start.of_effect = {{"axial_stretch.axial_stiffness", 1e3}};
  std::vector<Explanation> explanations = {stretch};
  refit_rest({context, film.base, {}, {{.level = kNoise}}}, explanations);
  REQUIRE(most_steps.size() == 1);
  CHECK(most_steps[0] > 0);
  CHECK(stall[0] > 0);
}

TEST_CASE("the search simulates as closely as the noise needs, and no closer") {
  WithHiddenDrag film(120);
  const auto simulated_to = [&](double tolerance) {
    Case the_case = film.base.problem->the_case();
    the_case.simulation.relative_tolerance = tolerance;
    the_case.simulation.absolute_tolerance_position = 1e-2 * tolerance;
    the_case.simulation.absolute_tolerance_velocity = 1e-1 * tolerance;
    return std::make_shared<const Problem>(the_case, film.base.problem->model());
  };
  const auto at = [](const std::shared_ptr<const Problem>& problem, const Eigen::VectorXd& x) {
    return assess(problem, x, fit_least_squares, nullptr);
  };
  const FittedModel rough = at(simulated_to(1e-4), film.base.x);
  const auto error_of = [&](const FittedModel& model, double noise) {
    return prediction_distance(model, at(simulated_to(1e-10), model.x), {{.level = noise}});
  };
  CHECK(simulated_closely(rough, {{.level = 1.0}}, film.context).problem == rough.problem);
  const double noise = error_of(rough, 1.0) / 3;  // m
  const FittedModel close = simulated_closely(rough, {{.level = noise}}, film.context);
  CHECK(error_of(close, noise) < 2 * kThresholds.simulation_error);
  CHECK(close.problem->the_case().simulation.relative_tolerance > 1e-8);
}

}  // namespace search_test
