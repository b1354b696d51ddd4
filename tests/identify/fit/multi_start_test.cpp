// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/multi_start.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <set>

#include "common/input_error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;

namespace {

Problem swinging(FitMethod method, int starts) {
  Case the_case = testing::sections(testing::replaced(
      testing::kTwoLinks, "lower = 0.0001\nupper = 1.0", "lower = 0.0\nupper = 0.1"));
  the_case.optimiser.method = method;
  the_case.optimiser.starts = starts;
  the_case.optimiser.max_evaluations = 60;
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  const Model model = Model::built_in(2);
  return Problem(
      the_case, model,
      {testing::with_truth(truth, model, testing::empty_markers({0.7, 1.0}, 40, 0.05), 1e-3)});
}

bool same(const FitResult& a, const FitResult& b) {
  bool equal = a.error == b.error && a.x == b.x && a.evaluations == b.evaluations &&
               a.status == b.status && a.history.size() == b.history.size();
  for (std::size_t i = 0; equal && i < a.history.size(); ++i)
    equal = a.history[i].error == b.history[i].error && a.history[i].x == b.history[i].x;
  return equal;
}

}  // namespace

TEST_CASE("starts are the case's own and a Latin hypercube: every layer of every unknown once") {
  const Problem problem = swinging(FitMethod::kNelderMead, 1);
  const std::vector<Eigen::VectorXd> points = start_points(problem, 11, 4);
  REQUIRE(points.size() == 11);
  CHECK(points[0] == problem.start());
  std::set<int> layers_k, layers_c;
  for (std::size_t i = 1; i < points.size(); ++i) {
    layers_k.insert(static_cast<int>(10 * std::log(points[i][0] / 0.001) / std::log(1000)));
    layers_c.insert(static_cast<int>(10 * points[i][1] / 0.1));
  }
  CHECK(layers_k.size() == 10);
  CHECK(layers_c.size() == 10);
  CHECK(points == start_points(problem, 11, 4));
  CHECK(points != start_points(problem, 11, 5));
}

TEST_CASE("any number of threads gives the same, and so does a run resumed after a cut anywhere") {
  const testing::TemporaryFolder folder;
  for (const FitMethod method : {FitMethod::kNelderMead, FitMethod::kLeastSquares}) {
    CAPTURE(static_cast<int>(method));
    const Problem problem = swinging(method, 4);
    const std::filesystem::path file = folder.path() / "run.log";
    std::vector<FitResult> undisturbed;
    {
      RunLog log(file, "key", 2, false);
      undisturbed = fit_from_many(problem, {}, fit_least_squares, 1, &log);
    }
    const std::vector<FitResult> threaded =
        fit_from_many(problem, {}, fit_least_squares, 3, nullptr);
    for (std::size_t i = 0; i < 4; ++i) CHECK(same(undisturbed[i], threaded[i]));

    std::string whole;
    {
      std::ifstream in(file, std::ios::binary);
      whole.assign(std::istreambuf_iterator<char>(in), {});
    }
    for (const double share : {0.0, 0.1, 0.37, 0.5, 0.83, 0.999, 1.0}) {
      CAPTURE(share);
      const auto length = static_cast<std::size_t>(share * static_cast<double>(whole.size()));
      std::ofstream(file, std::ios::binary) << whole.substr(0, length);
      RunLog log(file, "key", 2, true);
      const std::vector<FitResult> resumed = fit_from_many(problem, {}, fit_least_squares, 2, &log);
      for (std::size_t i = 0; i < 4; ++i) CHECK(same(undisturbed[i], resumed[i]));
    }
  }
}
