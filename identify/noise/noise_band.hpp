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

/// Leaves out frequencies at which there is far more power than noise of this shape has by chance: a misfit that
/// is a vibration. `power`: over the channels; `values`: that stand behind it. Returns whether any was left out.
bool leave_out_vibrations(const Eigen::VectorXd& power, const Eigen::VectorXd& expected, double values,
                          NoiseBand& band);

}  // namespace catena
