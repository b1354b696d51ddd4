// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

#include "runtime/model.hpp"

namespace catena {

/// A motion at given times, one column per time. Of a simulation that failed, only the times before
/// the failure are there.
struct Trajectory {
  std::vector<double> time;  ///< s
  Eigen::MatrixXd q;         ///< coordinates x times, rad
  Eigen::MatrixXd v;         ///< coordinates x times, rad/s
  Eigen::MatrixXd z;         ///< states x times
  /// energies x times (J), in the order of the table's energy_item: stored energies as they are,
  /// dissipated and supplied powers integrated since the first time. Empty if not asked for.
  Eigen::MatrixXd energy;
};

/// Columns time, the coordinates, their rates (name_rate), the states; 17 significant digits;
/// written whole or not at all. Throws InputError naming the file if it cannot be written.
void write_trajectory_csv(const std::filesystem::path& file, const Model& model,
                          const Trajectory& trajectory);

}  // namespace catena
