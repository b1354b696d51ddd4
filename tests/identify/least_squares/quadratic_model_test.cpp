// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/quadratic_model.hpp"

#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <random>

using namespace catena;

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

QuadraticModel some_model(unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal;
  MatrixXd jacobian(9, 5);
  VectorXd value(9);
  for (double& each : jacobian.reshaped()) each = normal(generator);
  for (double& each : value) each = normal(generator);
  return {jacobian.transpose() * value, jacobian.transpose() * jacobian};
}

}  // namespace

TEST_CASE("a quadratic model has the minimum that it is given, as deep as it is told") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    CAPTURE(seed);
    QuadraticModel model = some_model(seed);
    const VectorXd best = -model.curvature.ldlt().solve(model.gradient);
    VectorXd step = best;
    step[seed % 5] *= 0.1;  // as if a bound were there
    if (model.gradient.dot(step) >= 0) continue;
    model.put_minimum(step, 0.7);
    CHECK(model.gain(step) == doctest::Approx(0.7));
    CHECK((model.gradient + model.curvature * step).norm() < 1e-10 * model.gradient.norm());
    CHECK(model.curvature.ldlt().isPositive());
  }
}

TEST_CASE("rows of a quadratic model are least squares with its gradient and curvature") {
  QuadraticModel model = some_model(3);
  model.curvature.row(2).setZero();
  model.curvature.col(2).setZero();
  model.gradient[2] = 0;  // an unknown that does nothing
  const LinearRows rows = model.rows();
  REQUIRE(rows.jacobian.rows() == 5);
  CHECK((rows.jacobian.transpose() * rows.value - model.gradient).norm() <
        1e-12 * model.gradient.norm());
  CHECK((rows.jacobian.transpose() * rows.jacobian - model.curvature).norm() <
        1e-12 * model.curvature.norm());
}
