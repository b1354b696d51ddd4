// SPDX-License-Identifier: BSD-3-Clause
//
// Parameters of which one does not exceed another.
#include <doctest/doctest.h>

#include "identify/fit/fit.hpp"
#include "identify/fit/multi_start.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace ordered_unknowns_test {
namespace {

const std::string kStiffnesses = R"(
[[parameter]]
name = "lower joint"
sets = "stiffness_2"
value = 0.05
free = true
lower = 0.001
upper = 1.0
scale = "linear"
at_most = "upper joint"
[[parameter]]
name = "upper joint"
sets = "stiffness_1"
value = 0.06
free = true
lower = 0.001
upper = 1.0
scale = "linear"
)";
const std::string kOneStiffness = R"(
[[parameter]]
name = "both joints"
sets = "stiffness"
value = 0.05
free = true
lower = 0.001
upper = 1.0
scale = "linear"
)";

Case two_links(const std::string& parameters) {
  Case the_case = testing::sections(R"(
[model]
links = 2
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "c"
sets = "damping"
value = 0.005
[initial]
shape = "straight"
angle = 0.6
)" + parameters);
  testing::add_experiment(the_case, "run");
  return the_case;
}

/// A film of two joints with these stiffnesses (N m/rad).
Recording film(double upper, double lower) {
  Case truth = two_links(kStiffnesses);
  truth.parameters[1].value = lower;
  truth.parameters[2].value = upper;
  return testing::with_truth(truth, Model::built_in(2),
                             testing::empty_markers({0.5, 1.0}, 60, 1.0 / 30), 1e-4);
}

}  // namespace

TEST_CASE("where the data want the other order, both are what one for both would be") {
  const Recording reversed = film(0.1, 0.2);
  const Problem one(two_links(kOneStiffness), Model::built_in(2), {reversed});
  const double expected = fit_least_squares(one, {}).x[0];
  for (const FitMethod method :
       {FitMethod::kLeastSquares, FitMethod::kNelderMead, FitMethod::kLbfgs}) {
    CAPTURE(static_cast<int>(method));
    Case the_case = two_links(kStiffnesses);
    the_case.optimiser.method = method;
    const Problem problem(the_case, Model::built_in(2), {reversed});
    const FitResult result = fit(problem, {}, fit_least_squares);
    CHECK(result.status == FitStatus::kConverged);
    CHECK(result.x[0] <= result.x[1]);
    CHECK(result.x[0] == catena::near(expected, 1e-3));
    CHECK(result.x[1] == catena::near(expected, 1e-3));
    if (method == FitMethod::kLeastSquares)
      CHECK(uncertainty_of(problem, result.x).estimates[0].verdict == Verdict::kAtBound);
  }
}

TEST_CASE("where the data want this order, it changes nothing") {
  const Recording recording = film(0.2, 0.1);
  Case free = two_links(kStiffnesses);
  free.parameters[1].at_most.clear();
  const auto found = [&](const Case& the_case) {
    return fit_least_squares(Problem(the_case, Model::built_in(2), {recording}), {}).x;
  };
  const Eigen::VectorXd expected = found(free), x = found(two_links(kStiffnesses));
  CHECK(expected[0] == catena::near(0.1, 0.02));
  CHECK((x - expected).norm() < 1e-4 * expected.norm());
}

TEST_CASE("one that is known bounds the other") {
  for (const bool lower_known : {false, true}) {
    Case the_case = two_links(kStiffnesses);
    the_case.parameters[lower_known ? 1 : 2].free = false;
    const Problem problem(the_case, Model::built_in(2), {film(0.1, 0.2)});
    const Unknown& left = problem.unknowns()[0];
    CHECK(left.least == (lower_known ? 0.05 : 0.001));
    CHECK(left.most == (lower_known ? 1.0 : 0.06));
  }
}

TEST_CASE("starts that are drawn keep the order") {
  const Problem problem(two_links(kStiffnesses), Model::built_in(2), {film(0.1, 0.2)});
  for (const Eigen::VectorXd& x : start_points(problem, 20, 1)) {
    CHECK(x[0] <= x[1]);
    CHECK(x.maxCoeff() <= 1);
  }
}

}  // namespace ordered_unknowns_test
