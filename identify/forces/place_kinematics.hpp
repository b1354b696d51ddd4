// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/forces/force_pattern.hpp"

namespace catena {

/// Side and down, in space also across.
using ChainVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1>;
/// Derivatives of such a vector by the turn of a link: by its angle, in space by a turn about each axis.
using LinkTurns = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3>;

/// How a link points: its direction, of length one and away from the support, the derivative of that, and how fast the
/// link turns, rad/s.
struct LinkMotion {
  ChainVector along;
  LinkTurns by_turn;
  ChainVector rate;  ///< one number in the plane
};
/// `state`: (q, v, z) with `coordinates` of q and of v, those of the links first.
LinkMotion link_motion(const Eigen::VectorXd& state, Eigen::Index coordinates,
                       const LinkChain& chain, Eigen::Index link);

/// Where a place of the chain is, m, how it moves, m/s, and the direction of its link.
struct PlaceMotion {
  ChainVector position, velocity, along;
};

/// The motion of the place at arc length s.
struct PlaceKinematics {
  PlaceMotion motion;
  /// Of the position by the turns of the links, link by link; likewise of the velocity by how fast they turn.
  Eigen::MatrixXd by_turns;
};
/// `state`, `coordinates`: as in link_motion; 0 <= s <= length of the cable, m.
PlaceKinematics place_kinematics(const Eigen::VectorXd& state, Eigen::Index coordinates,
                                 const LinkChain& chain, double s);

/// Whether a place is the end of the cable, but for rounding.
inline bool at_end(double s, double length) { return s > length * (1 - 1e-6); }

}  // namespace catena
