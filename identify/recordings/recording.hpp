// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"

namespace catena {

enum class Component { kSide, kDown, kAngle, kAcross };

/// One measured quantity over time.
struct Channel {
  int point = 0;  ///< index into Recording::points
  Component component = Component::kSide;
  std::string name;  ///< "marker 3 side"
};

/// What was measured in one experiment, in SI units and the model's axes.
struct Recording {
  std::vector<double> time;  ///< s, increasing: the experiment's window
  std::vector<PointSpec> points;
  /// Of point 1, of point 2, ...: side, down and, in space, across of a marker, or an angle.
  std::vector<Channel> channels;
  Eigen::MatrixXd measured;           ///< channels x frames; NaN: not seen
  Eigen::MatrixXd sealed;             ///< measured, but kept from `measured`; empty: nothing is
  Eigen::Index fit_frames = 0;        ///< the first so many are to be fitted, the rest validates
  std::vector<std::string> warnings;  ///< e.g. motion out of the plane

  /// Channels of each point: 1, 2 or, in space, 3.
  Eigen::Index components() const {
    return static_cast<Eigen::Index>(channels.size() / points.size());
  }
};

/// Reads the data of an experiment, from its file or from the table handed in, with a cable of
/// `links` links and length `cable_length` (m; default markers are spread evenly over it).
/// `in_space`: markers have three components, and angles have no meaning. Throws InputError naming
/// file, line or column.
Recording read_recording(const ExperimentSpec& experiment, int links, double cable_length,
                         bool in_space = false);

/// Moves what is sealed back to `measured`.
void open_seal(Recording& recording);

}  // namespace catena
