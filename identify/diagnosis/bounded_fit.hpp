// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/problem/problem.hpp"

namespace catena {

/// The fit of a model near fitted unknowns, linearised: least squares. Unknowns that would go beyond their bounds
/// stay at them, and the others are found again.
class BoundedFit {
 public:
  /// `along`: derivatives of what is left by the unknowns, at `x`.
  BoundedFit(const Problem& problem, const Eigen::VectorXd& x, Eigen::MatrixXd along);

  /// The change of the unknowns that explains an error best, the least |along change - error|.
  Eigen::VectorXd operator()(const Eigen::VectorXd& error) const;

  /// The sum of squares that is left of an error without bounds.
  double left(const Eigen::VectorXd& error) const;

 private:
  std::vector<Unknown> unknowns_;
  Eigen::VectorXd scale_, low_, high_;  // of the unknowns apart (ordered_unknowns.hpp)
  Eigen::MatrixXd range_, triangle_;
};

}  // namespace catena
