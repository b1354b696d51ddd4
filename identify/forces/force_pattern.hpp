// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "runtime/model.hpp"

namespace catena {

enum class ForceDirection { kSide, kDown };

/// A force of unit size, distributed along the chain, that keeps its direction: how much of it acts
/// below each place. Its generalised force on the angle of link k is
///
///     Q_k = l_k (cos(theta_k) side_k - sin(theta_k) down_k) + torque_k
///
/// with the forces that act on half of link k, or more of it, and on everything below. Coordinates
/// that effects add get none.
struct ForcePattern {
  std::string name;            ///< "side density, mode 1", "side force at arc length 1.2 m"
  std::string unit;            ///< of its size: N/m, N or N m
  Eigen::VectorXd side, down;  ///< per link, N per unit: carried by the link's end
  Eigen::VectorXd torque;      ///< per link, N m per unit
  /// Of a density: its values at the middles of the links; else empty.
  Eigen::VectorXd density;
  ForceDirection direction = ForceDirection::kSide;  ///< of a density or a force at a point
  int group = 0;  ///< patterns of a group have one prior variance
};

/// Arc lengths of the middles of links of these lengths, m.
Eigen::VectorXd link_middles(const Eigen::VectorXd& lengths);

/// A density along the cable, given at the middles of the links. `shape`: what the name says of it,
/// as "around arc length 1.2 m". `lengths`: of the links, m. N/m.
ForcePattern density_pattern(ForceDirection direction, const std::string& shape,
                             const Eigen::VectorXd& density, const Eigen::VectorXd& lengths);

/// A force at arc length s (m), 0 < s <= L. N.
ForcePattern point_pattern(ForceDirection direction, double s, const Eigen::VectorXd& lengths);

/// A torque on one link alone. N m.
ForcePattern torque_pattern(Eigen::Index link, Eigen::Index links);

/// A moment in a joint, on the link below it and against that above; joint 0 is the support. N m.
ForcePattern moment_pattern(Eigen::Index joint, const Eigen::VectorXd& lengths);

/// Q of a pattern of size 1 at the angles: one number per link.
void add_generalised_force(const ForcePattern& pattern, const Eigen::VectorXd& lengths,
                           const double* angles, double size, double* force);

}  // namespace catena
