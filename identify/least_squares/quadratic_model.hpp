// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/least_squares/condensed_rows.hpp"

namespace catena {

/// A quadratic model of how a cost changes by a step s of the unknowns, g's + s'As / 2.
struct QuadraticModel {
  Eigen::VectorXd gradient;   ///< g
  Eigen::MatrixXd curvature;  ///< A

  /// -(g's + s'As / 2)
  double gain(const Eigen::VectorXd& step) const;

  /// Puts the minimum, wherever it was, to a step along which the cost falls, g's < 0, and makes it so
  /// much deeper than here:
  ///
  ///     gradient  c g,   curvature  c (A - A s s'A / s'As - g g' / g's),   c = -2 gain / g's.
  void put_minimum(const Eigen::VectorXd& step, double gain);

  /// As least squares: J'r = g and J'J = A, by as many rows as there are unknowns. Of curvature that is rounding
  /// there is none.
  LinearRows rows() const;
};

}  // namespace catena
