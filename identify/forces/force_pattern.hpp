// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/model.hpp"

namespace catena {

/// In the order of the columns of ForcePattern::carried; a chain in the plane has no force across.
enum class ForceDirection { kSide, kDown, kAcross };
/// "side", "down", "across".
const char* word_of(ForceDirection direction);
/// Those that a chain has.
std::vector<ForceDirection> force_directions(bool in_space);

/// A force of unit size, distributed along the chain, that keeps its direction: how much of it acts
/// below each place. In the plane its generalised force on the angle of link k is
///
///     Q_k = l_k (cos(theta_k) side_k - sin(theta_k) down_k) + torque_k
///
/// with the forces that act on half of link k, or more of it, and on everything below. In space that on the
/// vector q_k of link k, which points along e_k = q_k/|q_k|, is
///
///     Q_k = (1 - e_k e_k') (l_k carried_k + torque_k x e_k)/|q_k|
///
/// Coordinates that effects add get none.
struct ForcePattern {
  std::string name;  ///< "side density, mode 1", "side force at arc length 1.2 m"
  std::string unit;  ///< of its size: N/m, N or N m
  /// N per unit, carried by the link's end: links x directions.
  Eigen::MatrixXd carried;
  /// N m per unit: links x 1, towards growing angles; in space links x 3, about the axes side, down and across.
  Eigen::MatrixXd torque;
  /// Of a density: its values at the middles of the links; else empty.
  Eigen::VectorXd density;
  ForceDirection direction =
      ForceDirection::kSide;  ///< of a density, a force at a point, or an axis in space
  int group = 0;              ///< patterns of a group have one prior variance

  bool in_space() const { return carried.cols() == 3; }
};

/// Arc lengths of the middles of links of these lengths, m.
Eigen::VectorXd link_middles(const Eigen::VectorXd& lengths);

/// The chain that patterns act on.
struct LinkChain {
  Eigen::VectorXd lengths;  ///< of the links, m
  bool in_space = false;
};

/// A density along the cable, given at the middles of the links. `shape`: what the name says of it,
/// as "around arc length 1.2 m". N/m.
ForcePattern density_pattern(ForceDirection direction, const std::string& shape,
                             const Eigen::VectorXd& density, const LinkChain& chain);

/// A force at arc length s (m), 0 < s <= L. N.
ForcePattern point_pattern(ForceDirection direction, double s, const LinkChain& chain);

/// Torques on one link alone: one in the plane, three in space. N m.
std::vector<ForcePattern> torque_patterns(Eigen::Index link, const LinkChain& chain);

/// Moments in a joint, on the link below it and against that above: one in the plane, in space one about each axis;
/// joint 0 is the support. N m.
std::vector<ForcePattern> moment_patterns(Eigen::Index joint, const LinkChain& chain);
/// "torque at the support", "moment in the joint at arc length 1.2 m".
std::string moment_name(Eigen::Index joint, const Eigen::VectorXd& lengths);

/// Adds Q of a pattern at the coordinates q of the links (angles; in space all components side, then down,
/// then across).
void add_generalised_force(const ForcePattern& pattern, const Eigen::VectorXd& lengths,
                           const double* q, double size, double* force);
/// Adds its derivative by q: of link k one number, in space three rows of three, at `turning` + 9 k.
void add_turning(const ForcePattern& pattern, const Eigen::VectorXd& lengths, const double* q,
                 double size, double* turning);
/// Q as torques on the links about their upper ends, N m: in the plane the same, in space three of each link, link by
/// link, those that turn it.
Eigen::VectorXd link_torques(const ForcePattern& pattern, const Eigen::VectorXd& lengths,
                             const double* q);

}  // namespace catena
