// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace catena {

/// Where a place of the chain is and how it moves: side, down (m), their rates (m/s), the angle of
/// its link (rad) and its rate (rad/s).
using PlaceMotion = Eigen::Matrix<double, 6, 1>;

/// The motion of the place at arc length s.
struct PlaceKinematics {
  PlaceMotion motion;
  /// Of (side, down) by the angles of the links, 2 x links; likewise of their rates by the rates.
  Eigen::Matrix2Xd by_angles;
};
/// `state`: (q, v, z) with `coordinates` of q and of v, the angles of the links first.
PlaceKinematics place_kinematics(const Eigen::VectorXd& state, Eigen::Index coordinates,
                                 const Eigen::VectorXd& lengths, double s);

/// Whether a place is the end of the cable, but for rounding.
inline bool at_end(double s, double length) { return s > length * (1 - 1e-6); }

}  // namespace catena
