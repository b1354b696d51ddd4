// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/relative_steps.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "tests/support/near.hpp"

using namespace catena;

namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

VectorXd sum_of(const RelativeSteps& steps, const VectorXd& y, const VectorXd& step) {
  VectorXd sum(y.size());
  REQUIRE(steps.Plus(y.data(), step.data(), sum.data()));
  return sum;
}

}  // namespace

TEST_CASE("a step multiplies what a logarithm is of, and is added to what is none") {
  const RelativeSteps steps({true, false});
  const Vector2d y(std::log(3.0), 5);
  for (const double step : {-0.75, -0.3, 0.0, 0.5, 1000.0}) {
    const VectorXd sum = sum_of(steps, y, Vector2d(step, step));
    CHECK(std::exp(sum[0]) == doctest::Approx(3 * (1 + step)));
    CHECK(sum[1] == doctest::Approx(5 + step));
  }
}

TEST_CASE("steps and what they lead to are each other's inverse, smoothly") {
  const RelativeSteps steps({true, true});
  const Vector2d y(0.3, -2);
  for (const double step : {-5.0, -1.5, -0.8, -0.7, 0.0, 0.25, 2.75}) {
    const Vector2d both(step, step + 1e-6);
    const VectorXd sum = sum_of(steps, y, both);
    Vector2d back;
    REQUIRE(steps.Minus(sum.data(), y.data(), back.data()));
    CHECK((back - both).norm() < 1e-12);
    const double slope = ((sum[1] - y[1]) - (sum[0] - y[0])) / 1e-6;
    CHECK(slope == catena::near(1 / std::max(1 + step, 0.25), 1e-5));
  }
}

TEST_CASE("the steps that are allowed end at bounds, and at a quarter") {
  const RelativeSteps steps({true, true, false});
  const VectorXd y = Eigen::Vector3d(std::log(2.0), std::log(2.0), 1);
  const double none = std::numeric_limits<double>::infinity();
  const RelativeSteps::Box box =
      steps.box(y, Eigen::Vector3d(0, -none, -1), Eigen::Vector3d(std::log(6.0), none, 1));
  CHECK(box.lower[0] == doctest::Approx(-0.5));
  CHECK(box.upper[0] == doctest::Approx(2));
  CHECK(box.lower[1] == doctest::Approx(-0.75));
  CHECK(box.upper[1] == none);
  CHECK(box.lower[2] == doctest::Approx(-2));
  CHECK(box.upper[2] == 0);
}
