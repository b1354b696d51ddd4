// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"

namespace catena {

enum class Component { kSide, kDown, kAngle };

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
  std::vector<Channel> channels;      ///< markers: side and down of point 1, of point 2, ...
  Eigen::MatrixXd measured;           ///< channels x frames; NaN: not seen
  Eigen::MatrixXd sealed;             ///< measured, but kept from `measured`; empty: nothing is
  Eigen::Index fit_frames = 0;        ///< the first so many are to be fitted, the rest validates
  std::vector<std::string> warnings;  ///< e.g. motion out of the plane
};

/// Reads the data of an experiment, from its file or from the table handed in, with a cable of `links` links and length `cable_length` (m;
/// default markers are spread evenly over it). Throws InputError naming file, line or column.
Recording read_recording(const ExperimentSpec& experiment, int links, double cable_length);

/// Moves what is sealed back to `measured`.
void open_seal(Recording& recording);

}  // namespace catena
