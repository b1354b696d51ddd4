// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/quadratic_model.hpp"

#include <cmath>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr double kNoCurvature = 1e-14;  // of the largest, unknowns scaled alike: rounding

}  // namespace

double QuadraticModel::gain(const VectorXd& step) const {
  return -gradient.dot(step) - step.dot(curvature * step) / 2;
}

void QuadraticModel::put_minimum(const VectorXd& step, double gain) {
  const double slope = -gradient.dot(step), scale = 2 * gain / slope;
  const VectorXd bent = curvature * step;
  curvature += gradient * gradient.transpose() / slope - bent * bent.transpose() / step.dot(bent);
  curvature *= scale;
  gradient *= scale;
}

LinearRows QuadraticModel::rows() const {
  // With A = S V L V' S (S a scale) and R = sqrt(L) V' S: R'R = A, and R'r = g by r = R'^-1 g.
  const VectorXd scale =
      curvature.diagonal().cwiseSqrt().unaryExpr([](double size) { return size > 0 ? size : 1.0; });
  const VectorXd inverse = scale.cwiseInverse();
  const EigenPairs scaled =
      symmetric_eigenpairs(inverse.asDiagonal() * curvature * inverse.asDiagonal());
  const double least = kNoCurvature * scaled.values.maxCoeff();
  const VectorXd root =
      scaled.values.unaryExpr([&](double value) { return value > least ? std::sqrt(value) : 0.0; });
  LinearRows rows;
  rows.value = scaled.vectors.transpose() * inverse.asDiagonal() * gradient;
  for (Index j = 0; j < root.size(); ++j) rows.value[j] = root[j] > 0 ? rows.value[j] / root[j] : 0;
  rows.jacobian = root.asDiagonal() * scaled.vectors.transpose() * scale.asDiagonal();
  return rows;
}

}  // namespace catena
