// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/linearised_distances.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/support/near.hpp"

using namespace catena;

namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

/// Points of one or two residuals that depend on two unknowns.
struct Points {
  VectorXd residuals;
  MatrixXd jacobian, bend = MatrixXd::Zero(2, 2);
  std::vector<WeightedDistance> points;
  Points(int count, int size, unsigned seed) {
    std::mt19937_64 generator(seed);
    std::normal_distribution<double> normal;
    residuals.resize(count * size);
    jacobian.resize(count * size, 2);
    for (double& value : residuals) value = normal(generator);
    for (double& value : jacobian.reshaped()) value = normal(generator);
    for (int i = 0; i < count; ++i) points.push_back({i * size, size, 1.0 + i % 3});
  }
  LinearisedDistances sum() const { return {residuals, jacobian, points, bend}; }
};

const Vector2d kFar(10, 10);

/// No place around is lower by more than a hundredth of what was gained.
void check_minimum(const LinearisedDistances& sum, const Vector2d& found, const Vector2d& lower,
                   const Vector2d& upper) {
  const double least = sum.value(found, 0);
  const double left = 1e-2 * (sum.value(Vector2d::Zero(), 0) - least);
  for (double size = 1; size > 1e-5; size /= 4)
    for (int k = 0; k < 64; ++k) {
      const double angle = 2 * 3.14159265358979 * k / 64;
      const Vector2d beside = (found + size * Vector2d(std::cos(angle), std::sin(angle)))
                                  .cwiseMax(lower)
                                  .cwiseMin(upper);
      CHECK(sum.value(beside, 0) >= least - left - 1e-12 * least);
    }
}

}  // namespace

TEST_CASE("the minimum of a sum of distances is found on its kinks and between them") {
  for (const int size : {1, 2})
    for (unsigned seed = 1; seed <= 20; ++seed) {
      CAPTURE(size);
      CAPTURE(seed);
      Points points(40, size, seed);
      if (seed > 10) points.bend = Vector2d(20, 5).asDiagonal();
      const LinearisedDistances sum = points.sum();
      check_minimum(sum, sum.minimum(0.3, -kFar, kFar), -kFar, kFar);
      const Vector2d lower(-0.02, -10), upper(10, 0.01);
      const Vector2d held = sum.minimum(0.3, lower, upper);
      CHECK((held.array() >= lower.array()).all());
      CHECK((held.array() <= upper.array()).all());
      check_minimum(sum, held, lower, upper);
    }
}

TEST_CASE("gradient and curvature are those of the smoothed sum") {
  for (const int size : {1, 2}) {
    const Points points(30, size, 3);
    const LinearisedDistances sum = points.sum();
    const Vector2d here(0.3, -0.2);
    const double width = 0.5, h = 1e-5;
    const MatrixXd curvature = sum.curvature(here, width, LinearisedDistances::Curvature::kOwn);
    for (int j = 0; j < 2; ++j) {
      const Vector2d step = h * Vector2d::Unit(j);
      const double slope =
          (sum.value(here + step, width) - sum.value(here - step, width)) / (2 * h);
      CHECK(sum.gradient(here, width)[j] == catena::near(slope, 1e-7));
      const VectorXd change =
          (sum.gradient(here + step, width) - sum.gradient(here - step, width)) / (2 * h);
      for (int i = 0; i < 2; ++i) CHECK(curvature(i, j) == catena::near(change[i], 1e-7));
    }
  }
}
