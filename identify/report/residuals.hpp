// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/results/result_file.hpp"

namespace catena::report {

using namespace results;

/// Measured minus predicted at the measured times, in mm, or mrad for angles; NaN where a point was
/// not seen.
struct Residuals {
  bool angles = false;
  std::string unit;  ///< "mm" or "mrad"
  Row time;          ///< s
  std::vector<Point> points;
  Rows side, down;  ///< markers
  Rows across;      ///< markers in space
  Rows angle;       ///< angles
  Rows radial;      ///< markers: of the distance from the support, as in (6.7)-(6.10)
  Rows size;        ///< distance (6.5), or size of the angle's residual: [point][time]
};

/// Empty (no points) where nothing was measured or predicted.
Residuals residuals_of(const Experiment& experiment);

/// Mean over the points, NaN left out, at each time.
Row mean_over_points(const Rows& rows, std::size_t times);

/// Mean of the sizes of all entries that are not NaN; NaN if there is none.
double mean_absolute(const Row& row);

/// Root mean square over all entries that are not NaN; NaN if there is none.
double root_mean_square(const Row& row);

}  // namespace catena::report
