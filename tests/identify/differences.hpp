// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace catena::testing {

/// The derivative of the vector `function` by x_j, as a central difference over x_j - h to x_j + h.
template <class Function>
Eigen::VectorXd central_difference(const Function& function, const Eigen::VectorXd& x,
                                   Eigen::Index j, double h) {
  Eigen::VectorXd above = x, below = x;
  above[j] += h;
  below[j] -= h;
  return (function(above) - function(below)) / (2 * h);
}

}  // namespace catena::testing
