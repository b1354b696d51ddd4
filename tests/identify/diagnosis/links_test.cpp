// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/links.hpp"

#include <doctest/doctest.h>

#include "identify/diagnosis/look_back.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace links_test {
namespace {

constexpr double kNoise = 1e-3;  // m
const std::vector<std::string> kPossible = {"pivot_stiffness", "joint_stiffness_cubic"};

/// A chain of more links than the case has, filmed, with an effect or none.
struct Film {
  testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with(kPossible);
  DiagnosisContext context{
      the_case, {}, folder.path(), fit_least_squares, testing::provider_of_build()};
  DiagnosisOptions options;
  DiagnosisState state{context, options};
  std::vector<NoiseModel> noise = {{.level = kNoise}};

  Film(int links, const std::vector<std::string>& hidden, double amount, int frames = 240) {
    std::string why_not;
    Case truth = *with_links(the_case, links, why_not);
    truth.parameters[0].value = 0.1;
    truth.parameters[1].value = 0.005;
    for (const std::string& id : hidden) {
      Candidate candidate = *context.find(id);
      candidate.parameters.front().value = amount;
      truth = with_effects(truth, {candidate}, true);
    }
    the_case = testing::measured(
        the_case, folder,
        testing::with_truth(truth, context.model_with(kPossible, links),
                            testing::empty_markers({0.25, 0.5, 0.75, 1.0}, frames, 1.0 / 60),
                            kNoise));
  }

  FittedModel fitted(const std::vector<std::string>& effects, int links = 2) {
    Case with = the_case;
    for (const std::string& id : effects) with = with_effects(with, {*context.find(id)}, true);
    std::string why_not;
    const auto problem = std::make_shared<const Problem>(*with_links(with, links, why_not),
                                                         context.model_with(effects, links));
    return fit_model(problem, problem->start(), noise, fit_least_squares, nullptr);
  }
};

}  // namespace

TEST_CASE("with twice the links a law of the joints' angles begins as the law of the same cable") {
  const std::vector<std::string> effects = {"joint_stiffness_cubic"};
  Film film(4, effects, 50);
  const FittedModel model = film.fitted(effects, 4);
  std::string why_not;
  const Problem finer(*with_links(model.problem->the_case(), 8, why_not),
                      film.context.model_with(effects, 8));
  const Eigen::VectorXd as_it_is = transfer(*model.problem, model.x, finer);
  const Eigen::VectorXd start = start_with_links(model, finer, effects, film.noise, film.context);
  const Eigen::Index cubic = unknown_index(finer, "joint_stiffness_cubic.cubic");
  CHECK(start[cubic] > 3 * as_it_is[cubic]);
  CHECK(error_to_fit(finer, start, film.noise, {}) <
        0.7 * error_to_fit(finer, as_it_is, film.noise, {}));
}

TEST_CASE("more links take the place of a stiff clamp that imitates them") {
  Film film(4, {}, 0, 120);
  DiagnosisState& state = film.state;
  state.enter(film.fitted({}), {}, "");
  Explanation stiff;
  stiff.id = "pivot_stiffness";
  stiff.candidate = static_cast<int>(film.context.find(stiff.id) - film.context.library().data());
  stiff.model = film.fitted({stiff.id});
  stiff.refitted = true;
  state.found.stages[0].explanations = {stiff};
  state.enter(stiff.model, {stiff.id}, stiff.id);
  state.found.noise = film.noise;
  state.found.effects = {stiff.id};
  CHECK(state.last().fit.ratio() < 0.6 * state.found.stages[0].fit.ratio());
  CHECK(look_back(state));
  CHECK(state.found.effects.empty());
  CHECK(state.last().links == 4);
  CHECK(state.last().removed == stiff.id);
}

}  // namespace links_test
