// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/noise_shape.hpp"

namespace catena {

/// The spectra of tapered segments of the residuals and predictions of all windows of a recording, one by each
/// taper (slepian_tapers).
class Segments {
 public:
  /// Of each window a matrix, channels x frames on a grid; NaN: not seen, and filled in as for noise
  /// of `shape`. Segments have the length of the tapers and overlap by half or more.
  Segments(const std::vector<Eigen::MatrixXd>& residuals,
           const std::vector<Eigen::MatrixXd>& predictions, const NoiseShape& shape,
           const Eigen::MatrixXd& tapers);

  std::vector<Eigen::MatrixXcd> residual;  ///< per segment and taper, channels x frequencies
  Eigen::MatrixXd motion_power;            ///< channels x frequencies
  double values = 0;                       ///< independent residuals that stand behind them

  /// Mean power of the residuals, channels x frequencies.
  Eigen::MatrixXd power() const;
};

}  // namespace catena
