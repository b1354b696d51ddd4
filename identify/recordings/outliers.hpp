// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/recordings/recording.hpp"

namespace catena {

/// A measured point that lies beside the motion of its marker (or link).
struct Outlier {
  int point = 0;  ///< index into Recording::points
  Eigen::Index frame = 0;
  double size = 0;  ///< how far it lies from where its neighbours in time say, m or rad
};

/// When a point counts as an outlier.
struct OutlierLimits {
  /// In standard deviations of the marker's own scatter. White noise passes it less than once in
  /// 10^13 points.
  double scatter = 8;
  /// In units of the largest difference of its neighbours in time. Motion too fast for the camera
  /// shows in several frames alike: a sampled sine at a quarter of the frame rate gives 1.
  double neighbours = 5;
  /// Share of the cable's length; rad for angles. Smaller ones hardly move a fit, and are left.
  double size = 0.01;
};

/// Compares every point with the cubic through the two frames before and the two after it in which
/// the marker was seen (at the ends of a recording, the four nearest). An outlier stands alone: of
/// the four frames on either side at most one more does, and the neighbouring markers did not jump
/// the same way in its frame. `size`: m, the length of the cable; 1 for angles.
///
/// Longer runs of wrong points are not found, nor are those beside a gap of many frames. In the
/// order of point and frame.
std::vector<Outlier> find_outliers(const Recording& recording, double size,
                                   const OutlierLimits& limits = {});

}  // namespace catena
