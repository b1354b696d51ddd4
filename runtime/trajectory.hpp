// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// A motion at given times, one column per time. If the simulation failed, only the times before
/// the failure.
struct Trajectory {
  std::vector<double> time;  ///< s
  Eigen::MatrixXd q;         ///< coordinates x times, rad for angles
  Eigen::MatrixXd v;         ///< coordinates x times, rad/s for angles
  Eigen::MatrixXd z;         ///< extra states x times
  /// Energies x times (J), in the order of energy_item in the model's table: stored energies, and
  /// dissipated and supplied powers integrated since the first time. Empty if not asked for.
  Eigen::MatrixXd energy;
};

/// In space: gives the link vectors q the length one and removes the part of their rates v that is along them.
/// These lengths drift by the error of the steps; nothing else depends on them.
void normalise_directions(Trajectory& trajectory, int links);

}  // namespace catena
