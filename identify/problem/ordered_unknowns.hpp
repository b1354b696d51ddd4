// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/problem/unknowns.hpp"

namespace catena {

/// Unknowns of which one does not exceed another (Unknown::at_most), as numbers with bounds of their own: in
/// place of the greater one stands by how much it is greater. All functions have one value, or one column, per
/// unknown.

struct UnknownBounds {
  Eigen::VectorXd lower, upper;  ///< of apart(x)
};
UnknownBounds bounds_apart(const std::vector<Unknown>& unknowns);

/// The greater ones less the lesser ones; never below zero.
Eigen::VectorXd apart(const std::vector<Unknown>& unknowns, Eigen::VectorXd x);
/// From there back to the unknowns, within their bounds.
Eigen::VectorXd together(const std::vector<Unknown>& unknowns, Eigen::VectorXd y);
/// The same of changes; bounds play no part.
Eigen::VectorXd changes_together(const std::vector<Unknown>& unknowns, Eigen::VectorXd change);

/// Derivatives by the unknowns as those by apart(x).
void differentiate_apart(const std::vector<Unknown>& unknowns, Eigen::MatrixXd& columns);

}  // namespace catena
