// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/noise_model.hpp"

namespace catena {

/// The residuals of one window of a recording, fitted and held out, and what was predicted there.
struct NoiseWindow {
  Eigen::MatrixXd residual;      ///< channels x frames, m or rad; NaN: not seen
  Eigen::MatrixXd predicted;     ///< channels x frames
  std::vector<double> time;      ///< s
  Eigen::Index fitted = 0;       ///< so many frames were fitted, the others are held out
  Eigen::Index shows_noise = 0;  ///< the first so many frames tell the noise
};

/// One for each window of a recording; they share everything but the whitening. `direction`: of each
/// channel, 0 and 1; the channels of one may shake together. A negative one shakes alone. Noise below
/// `stated` (m or rad) is made as large as that.
std::vector<NoiseModel> estimate_noise(const std::vector<NoiseWindow>& windows,
                                       const std::vector<int>& direction, double stated = 0);

}  // namespace catena
