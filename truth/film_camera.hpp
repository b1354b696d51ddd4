// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "truth/cable.hpp"
#include "truth/hidden.hpp"
#include "truth/noise.hpp"

namespace truth {

/// A camera that follows marks on the cable.
struct Camera {
  double rate = 60;     // frames per second
  double duration = 6;  // s
  int markers = 12;     // evenly spaced, the last one at the load
  double noise = 1e-3;  // m, standard deviation per coordinate
  double lost = 0;      // share of marks not seen, half of them in runs of ten frames
  double pixel = 0;     // m; after the noise, positions are rounded to whole pixels; 0: no rounding
  double lens = 0;  // at a cable's length from the middle of the picture, marks are seen by this
                    // share farther out; in between by its cube
  double shutter =
      0;  // s; the picture is read from the support down, a cable's length in this time
  double misplaced =
      0;  // m, standard deviation of the marks' places along the cable; the last is right
  double drift = 0;        // m by which the camera has drifted to the side at the end
  double slip = 0;         // m by which the mark `slipping` slides down the cable, evenly, from the
                           // first to the last frame
  int slipping = 3;        // from 1
  NoiseKind kind = {};     // of the noise
  std::uint64_t seed = 1;  // of noise and loss
};

/// What is written to markers.csv; NaN where a marker was not seen.
struct Recording {
  std::vector<double> time;                     // s
  std::vector<double> arc;                      // m
  std::vector<std::vector<double>> side, down;  // [frame][marker], m
};

/// A motion, seen at points `arc` at times `time` (increasing, from 0).
using Moves =
    std::function<Motion(const std::vector<double>& arc, const std::vector<double>& time)>;

/// The recording of a motion. Effects of the sensor (clock, scale, tilt, offset, then lens) are applied
/// before the noise.
Recording film(const Cable& cable, const Hidden& hidden, const Moves& moves, const Camera& camera);

/// The same of the chain of links from rest at these angles.
Recording film(const Cable& cable, const Hidden& hidden, const std::vector<double>& start_angles,
               const Camera& camera, const Integration& integration = {});

}  // namespace truth
