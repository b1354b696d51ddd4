// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/noise/segments.hpp"

namespace catena {

/// The frequencies at which residuals show noise and no misfit.
struct NoiseBand {
  std::vector<bool> use;  ///< per frequency of the segments
  double share = 0;       ///< of all frequencies; 0: too few are free of motion
  bool compared = false;  ///< a direction had enough channels for their coherence to tell
  Eigen::VectorXd sigma;  ///< per channel: a first estimate
};

/// `direction` of each channel, as of estimate_noise().
NoiseBand noise_band(const Segments& segments, const std::vector<int>& direction);

}  // namespace catena
