// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/error.hpp"

#include <doctest/doctest.h>

#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

Problem problem_with(Measure measure, const Eigen::MatrixXd& offsets) {
  Case the_case = testing::sections(testing::kTwoLinks);
  the_case.error.measure = measure;
  testing::add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  Recording recording = testing::empty_markers({0.5, 1.0}, static_cast<int>(offsets.cols()), 0.1);
  recording = testing::with_truth(the_case, model, recording);
  recording.measured -= offsets;  // so that simulated minus measured is what we say
  return Problem(the_case, model, {recording});
}

}  // namespace

TEST_CASE("the measures are what the text says, gaps left out") {
  // rows: marker 1 side, down, marker 2 side, down; three frames
  Eigen::MatrixXd offsets(4, 3);
  offsets << 3, 0, 0, 4, 0, 0, 0, 6, 0, 0, 8, 0;
  offsets *= 1e-3;
  const auto error = [](const Problem& problem) {
    return error_of(problem, evaluate(problem, problem.start(), true, false), Part::kFit);
  };
  struct Row {
    Measure measure;
    double expected;
  };
  const Row rows[] = {
      {Measure::kLeastSquares, std::sqrt((9.0 + 16 + 36 + 64) / 12)},
      {Measure::kMeanDistance, (5.0 + 10) / 6},  // (6.5), (6.6): two of six distances
      {Measure::kMeanAbsolute, (1 + 4.0 / 3 + 2 + 8.0 / 3) / 4},  // (7.1)-(7.5)
  };
  for (const Row& row : rows) {
    CAPTURE(static_cast<int>(row.measure));
    CHECK(error(problem_with(row.measure, offsets)) == catena::near(1e-3 * row.expected, 1e-9));
  }
  // marker 2 is not seen in the second frame: its 10 mm do not count, nor does it dilute the rest
  Eigen::MatrixXd hidden = offsets;
  hidden(2, 1) = hidden(3, 1) = NAN;
  CHECK(error(problem_with(Measure::kMeanDistance, hidden)) == catena::near(1e-3, 1e-9));
  // each channel has one offset in three frames: its root mean square is that over sqrt(3)
  CHECK(error(problem_with(Measure::kLikelihood, offsets)) ==
        catena::near(1e-3 * std::pow(3.0 * 4 * 6 * 8, 0.25) / std::sqrt(3.0), 1e-9));
  const Problem problem = problem_with(Measure::kLeastSquares, offsets);
  const std::vector<Gap> gaps = gaps_of(problem, evaluate(problem, problem.start(), true, false));
  REQUIRE(gaps.size() == 1);
  CHECK(gaps[0].count == 12);
  CHECK(gaps[0].largest == doctest::Approx(8e-3));
  CHECK(gaps[0].mean_distance == doctest::Approx(15e-3 / 6));
}

TEST_CASE("gradients of the measures agree with differences") {
  Eigen::MatrixXd offsets = Eigen::MatrixXd::Constant(4, 10, 2e-3);
  offsets.row(1) *= -2;
  for (const Measure measure : {Measure::kLeastSquares, Measure::kMeanDistance,
                                Measure::kMeanAbsolute, Measure::kLikelihood}) {
    CAPTURE(static_cast<int>(measure));
    const Problem problem = problem_with(measure, offsets);
    const Eigen::VectorXd x = problem.start();
    Eigen::VectorXd gradient, unused;
    const Misfit misfit = misfit_of(problem, evaluate(problem, x, false, true));
    const double error = error_and_gradient(problem, misfit, gradient);
    CHECK(error ==
          doctest::Approx(error_of(problem, evaluate(problem, x, false, false), Part::kFit)));
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const auto moved = [&](double h) {
        Eigen::VectorXd y = x;
        y[j] += h;
        return error_of(problem, evaluate(problem, y, false, false), Part::kFit);
      };
      const double h = 1e-4 * x[j];
      CHECK(gradient[j] == catena::near((moved(h) - moved(-h)) / (2 * h), 1e-4));
    }
  }
}
