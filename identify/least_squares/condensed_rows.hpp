// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/fit/error.hpp"

namespace catena {

/// Rows of a linear least squares problem: value + jacobian * step is to be small.
struct LinearRows {
  Eigen::VectorXd value;
  Eigen::MatrixXd jacobian;  ///< rows x unknowns
};

/// Residuals and constraints, each times its weight, as one row more than there are unknowns, from
/// which every step leaves the same sum of squares: J'J, J'r and r'r are those of all rows, to
/// rounding. First the rows of each experiment become the triangle of their QR decomposition. Columns
/// that are zero there, the starts of other windows, are left out of it, so with many windows the
/// problem as a whole is never decomposed. Then what is left of all becomes one triangle.
///
/// `residuals`: with a Jacobian, in the order of experiments. `weights`: one for each of them.
LinearRows condensed(const Residuals& residuals, const Eigen::VectorXd& weights,
                     const SoftConstraints& constraints);

}  // namespace catena
