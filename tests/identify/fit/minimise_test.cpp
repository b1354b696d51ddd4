// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/minimise.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

using namespace catena;

namespace {

double himmelblau(const Eigen::VectorXd& at, Eigen::VectorXd* gradient) {
  const double x = at[0], y = at[1], a = x * x + y - 11, b = x + y * y - 7;
  if (gradient) *gradient = Eigen::Vector2d(4 * a * x + 2 * b, 2 * a + 4 * b * y);
  return a * a + b * b;
}

MinimiserOptions fine(FitMethod method) {
  MinimiserOptions options;
  options.method = method;
  options.first_steps = Eigen::Vector2d(1, 1);
  options.x_tolerance = options.value_tolerance = 1e-12;
  return options;
}

}  // namespace

TEST_CASE("each of Himmelblau's four minimisers (5.4) is found from beside it") {
  const Eigen::Vector2d minimisers[] = {
      {3.0, 2.0}, {-2.805118, 3.131312}, {-3.779310, -3.283186}, {3.584428, -1.848126}};
  for (const FitMethod method :
       {FitMethod::kNelderMead, FitMethod::kLbfgs, FitMethod::kSlsqp, FitMethod::kMma})
    for (const Eigen::Vector2d& minimiser : minimisers) {
      CAPTURE(static_cast<int>(method));
      CAPTURE(minimiser.transpose());
      const Minimum found =
          minimise(himmelblau, minimiser + Eigen::Vector2d(0.3, -0.2), fine(method));
      CHECK((found.x - minimiser).norm() < 2e-6);  // they are given to six decimals
      CHECK(found.value < 1e-10);
      CHECK(!found.stopped);
    }
}

TEST_CASE("bounds hold, infinite values are avoided, the caller can stop") {
  MinimiserOptions options = fine(FitMethod::kNelderMead);
  options.lower = Eigen::Vector2d(-6, -6);
  options.upper = Eigen::Vector2d(2, 6);
  const Minimum bounded = minimise(himmelblau, Eigen::Vector2d(1, 1), options);
  CHECK(bounded.x[0] <= 2);
  // on the right half nothing but failures: the best is on the left
  const Objective wall = [](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    return x[0] > 0 ? std::numeric_limits<double>::infinity() : himmelblau(x, nullptr);
  };
  const Minimum left = minimise(wall, Eigen::Vector2d(-0.5, 0.5), fine(FitMethod::kNelderMead));
  CHECK(left.x[0] <= 0);
  CHECK(left.value < 1e-10);
  int evaluations = 0;
  const Objective counted = [&](const Eigen::VectorXd& x, Eigen::VectorXd*) {
    ++evaluations;
    return himmelblau(x, nullptr);
  };
  options.must_stop = [&] { return evaluations >= 9; };
  CHECK(minimise(counted, Eigen::Vector2d(1, 1), options).stopped);
  CHECK(evaluations == 9);
  CHECK_THROWS_AS(minimise(himmelblau, Eigen::Vector2d(0, 0), fine(FitMethod::kLeastSquares)),
                  std::invalid_argument);
}
