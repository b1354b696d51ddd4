// SPDX-License-Identifier: BSD-3-Clause
//
// Each parallel part on several threads, so small that the thread sanitiser watches it in seconds (.ci/run).
#include <doctest/doctest.h>

#include <atomic>

#include "identify/fit/multi_start.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/bootstrap.hpp"
#include "identify/uncertainty/profile.hpp"
#include "runtime/rest_states.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;

namespace {

Problem swing() {
  std::string text = testing::kTwoLinks;
  for (const auto& [from, to] : {std::pair{"0.05\nfree = true\nlower = 0.001\nupper = 1.0",
                                           "0.08\nfree = true\nlower = 0.05\nupper = 0.2"},
                                 {"0.002\nfree = true\nlower = 0.0001\nupper = 1.0",
                                  "0.004\nfree = true\nlower = 0.002\nupper = 0.01"}})
    text = testing::replaced(text, from, to);
  Case the_case = testing::sections(text);
  the_case.optimiser.method = FitMethod::kLeastSquares;
  the_case.optimiser.starts = 3;
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  const Model model = Model::built_in(2);
  return Problem(
      the_case, model,
      {testing::with_truth(truth, model, testing::empty_markers({0.7, 1.0}, 15, 0.05), 1e-3)});
}

}  // namespace

TEST_CASE("a batch of simulations on several threads is that on one") {
  const Model model = Model::built_in(2);
  const Problem problem = swing();
  const Eigen::VectorXd p = problem.model_parameters(problem.start(), 0);
  const std::vector<Eigen::VectorXd> parameters(6, p);
  std::vector<State> initial;
  for (int i = 0; i < 6; ++i) initial.push_back(straight(model, 0.1 * i));
  const std::vector<double> times = {0.0, 0.1, 0.2};
  std::atomic<int> asked = 0;
  SimulationOptions options;
  options.keep_going = [&](double) { return ++asked > 0; };
  const auto threaded = simulate_batch(model, parameters, initial, times, 3, options);
  const auto single = simulate_batch(model, parameters, initial, times, 1, options);
  for (std::size_t i = 0; i < threaded.size(); ++i)
    CHECK(threaded[i].trajectory.q == single[i].trajectory.q);
}

TEST_CASE("starts, profiles and bootstrap on several threads, with one log, are those on one") {
  const testing::TemporaryFolder folder;
  const Problem problem = swing();
  RunLog log(folder.path() / "run.log", "key", 2, false);
  std::atomic<bool> stop = false;
  int evaluations = 0;  // progress is told by one thread at a time
  FitOptions options;
  options.stop = &stop;
  options.progress = [&](const Progress& progress) { evaluations = progress.evaluations; };
  const auto threaded = fit_from_many(problem, options, fit_least_squares, 3, &log);
  const auto single = fit_from_many(problem, {}, fit_least_squares, 1, nullptr);
  REQUIRE(threaded.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) CHECK(threaded[i].x == single[i].x);
  CHECK(evaluations > 3);
  const FitResult& best = threaded[best_of(threaded)];
  const Uncertainty uncertainty = uncertainty_of(problem, best.x);
  const auto profiles = profiles_of(problem, best, uncertainty, fit_least_squares, 2, &stop, &log);
  const auto again = profiles_of(problem, best, uncertainty, fit_least_squares, 1);
  REQUIRE(profiles.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) CHECK(profiles[i].cost == again[i].cost);
  const Eigen::MatrixXd rows =
      bootstrap(problem, best, uncertainty, fit_least_squares, 4, 7, 3, &stop, &log);
  CHECK(rows == bootstrap(problem, best, uncertainty, fit_least_squares, 4, 7, 1));
}
