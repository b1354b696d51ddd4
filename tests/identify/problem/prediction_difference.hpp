// SPDX-License-Identifier: BSD-3-Clause
//
// The derivative of a prediction by one unknown, from differences: the witness of sensitivities.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "identify/problem/problem.hpp"

namespace catena::testing {

/// The derivative by unknown j of what the first experiment predicts, by central differences.
inline Eigen::MatrixXd difference_along(const Problem& problem, const Eigen::VectorXd& x,
                                        Eigen::Index j) {
  const double step = 1e-5 * (1 + std::abs(x[j]));
  Eigen::VectorXd more = x, less = x;
  more[j] += step;
  less[j] -= step;
  return (problem.predict(more, 0, true).simulated - problem.predict(less, 0, true).simulated) /
         (2 * step);
}

}  // namespace catena::testing
