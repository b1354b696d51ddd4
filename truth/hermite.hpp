// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace truth {

/// Cubic Hermite interpolation within a step of length `step`, s: coordinates where `share` of the
/// step, 0 to 1, has gone by, from coordinates q and rates v at its two ends.
inline Eigen::VectorXd hermite(const Eigen::VectorXd& q_before, const Eigen::VectorXd& v_before,
                               const Eigen::VectorXd& q, const Eigen::VectorXd& v, double step,
                               double share) {
  const double s = share;
  const double h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s);
  const double h01 = s * s * (3 - 2 * s), h11 = s * s * (s - 1);
  return h00 * q_before + h01 * q + step * (h10 * v_before + h11 * v);
}

}  // namespace truth
