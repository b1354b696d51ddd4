// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/noise/noise_shape.hpp"
#include "identify/noise/prediction_filter.hpp"

namespace catena {

/// The noise of one recording, as its residuals show it where the motion has no power.
///
/// Every channel has noise of its own. All have the same spectrum. The channels of one direction may
/// share a further one, of the same spectrum: a camera that shakes. Single values far off (outliers)
/// count as not seen.
struct NoiseModel {
  double level = 0;  ///< root mean square over all channels, m or rad; NaN: too few frames
  /// Per channel: standard deviation of its own noise. Empty: white noise of `level` in all.
  Eigen::VectorXd sigma = {};
  Eigen::VectorXd common = {};  ///< per channel: of what its direction shares; 0: nothing
  NoiseShape shape = {};
  /// Whether enough frequencies are free of motion, enough channels (4 of a direction) show that they
  /// are, and what looks like noise is not alike in neighbouring channels. If not, the noise is taken as
  /// white, with one size for all channels.
  bool told = false;
  double excess_kurtosis = 0;  ///< 0: normally distributed; more: heavier tails
  long outliers = 0;           ///< in the whole recording

  /// Degrees of freedom of a Student distribution with such tails; infinite: normal.
  double degrees_of_freedom() const;
  /// What is unusual of it, each in some words.
  std::vector<std::string> words() const;

  /// Makes white noise of variance 1 of this noise, by a linear operation. `matrix`: channels x
  /// frames of the window, from its frame `first` on; residuals, or a derivative of them. NaN where
  /// nothing was seen.
  Eigen::MatrixXd whitened(const Eigen::MatrixXd& matrix, Eigen::Index first = 0) const;

  // How the window is whitened.
  std::vector<int> direction = {};  ///< per channel: 0 and 1 may shake, negative ones do not
  std::vector<int> frame = {};      ///< number of every column, in steps of the frame rate
  Eigen::MatrixXi pattern = {};     ///< channels x columns: in `filters`; -1: not seen
  std::vector<PredictionFilter> filters = {};
};

/// Of every experiment, m or rad.
std::vector<double> levels(const std::vector<NoiseModel>& noise);

/// x of one frame and direction, its own noise of variance 1, without the common mode with loadings
/// a: (1 + a a^T)^(-1/2) x.
void take_out_common(Eigen::VectorXd& x, const Eigen::VectorXd& a);

}  // namespace catena
