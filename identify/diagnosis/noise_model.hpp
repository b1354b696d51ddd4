// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/diagnosis/noise_shape.hpp"

namespace catena {

/// The residuals of one window of a recording, fitted and held out, and what was predicted there.
struct NoiseWindow {
  Eigen::MatrixXd residual;      ///< channels x frames, m or rad; NaN: not seen
  Eigen::MatrixXd predicted;     ///< channels x frames
  std::vector<double> time;      ///< s
  Eigen::Index fitted = 0;       ///< so many frames were fitted, the others are held out
  Eigen::Index shows_noise = 0;  ///< the first so many frames tell the noise
};

/// The noise of one recording, as its residuals show it where the motion has no power.
///
/// Every channel has noise of its own. All have the same spectrum. The channels of one direction may
/// share a further one, of the same spectrum: a camera that shakes. Single values far off (outliers)
/// count as not seen.
struct NoiseModel {
  double level = 0;        ///< root mean square over all channels, m or rad; NaN: too few frames
  Eigen::VectorXd sigma;   ///< per channel: standard deviation of its own noise
  Eigen::VectorXd common;  ///< per channel: of what its direction shares; 0: nothing
  NoiseShape shape;
  /// Whether enough frequencies are free of motion. If not, the noise is taken as white, with one
  /// size for all channels.
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
  std::vector<int> direction;  ///< per channel: 0 and 1 may shake, negative ones do not
  std::vector<int> frame;      ///< number of every column, in steps of the frame rate
  Eigen::MatrixXi pattern;     ///< channels x columns: in `filters`; -1: not seen
  /// Prediction of a frame from those seen before: coefficients at lags 1, 2, ..., and the standard
  /// deviation of its error over that of the noise.
  struct Filter {
    Eigen::VectorXd coefficients;
    double deviation = 1;
  };
  std::vector<Filter> filters;
};

/// White noise of one size in every channel of a window in which all is seen.
NoiseModel white_noise(double sigma, Eigen::Index channels, Eigen::Index frames);

/// Of every experiment.
using NoiseModels = std::vector<NoiseModel>;

/// One for each window of a recording; they share everything but the whitening. `direction`: of each
/// channel, 0 and 1; the channels of one may shake together. A negative one shakes alone. Noise below
/// `stated` (m or rad) is made as large as that.
NoiseModels estimate_noise(const std::vector<NoiseWindow>& windows,
                           const std::vector<int>& direction, double stated = 0);

}  // namespace catena
