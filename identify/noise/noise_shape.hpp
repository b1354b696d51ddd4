// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace catena {

/// What a program that tracks markers may have done to its tracks: each frame is a weighted mean of
/// its neighbours.
struct SmoothingKernel {
  std::string name;  ///< "moving average"; empty: none
  Eigen::VectorXd weights;
  double floor = 0;  ///< power of white noise that was added later, over the largest power

  int frames() const { return static_cast<int>(weights.size()); }
};
/// Those that are looked for; entry 0 is none.
const std::vector<SmoothingKernel>& smoothing_kernels();

/// The spectrum of noise in one channel, its variance being 1: white noise that went through an
/// autoregression and was then smoothed.
struct NoiseShape {
  int kernel = 0;                    ///< in smoothing_kernels()
  std::vector<double> partial = {};  ///< partial autocorrelations of the autoregression

  /// Its kernel; whether there is neither kernel nor autoregression.
  const SmoothingKernel& smoothing() const;
  bool white() const { return kernel == 0 && partial.empty(); }
  /// a of x(k) = a1 x(k-1) + a2 x(k-2) + ... + white noise, before the smoothing.
  Eigen::VectorXd autoregression() const;
  /// Correlation of two frames that are 0, 1, ... `lags` frames apart.
  Eigen::VectorXd autocorrelation(int lags) const;
  /// Variance of a frame once all others are known.
  double unpredictable() const;
};

/// Of tapered segments of `length` frames: the power that noise of a shape is expected to have at
/// frequencies j / length per frame, j = 0 to length / 2, with what the taper lets leak. White noise
/// of variance 1 has the power 1.
class ExpectedPower {
 public:
  explicit ExpectedPower(int length);
  /// At length / 2 + 1 frequencies.
  Eigen::VectorXd operator()(const NoiseShape& shape) const;
  const Eigen::MatrixXd& tapers() const { return tapers_; }

 private:
  Eigen::MatrixXd tapers_;
  Eigen::MatrixXd leakage_;                // frequencies x finer frequencies
  std::vector<Eigen::VectorXd> smoothed_;  // per kernel: power at the finer frequencies
};

/// The shape that explains `power` best, by Whittle's likelihood and the Bayesian information
/// criterion. `use`: the frequencies that show the noise. Where they leave several shapes
/// possible, the other frequencies decide, in favour of noise. `count`: the residuals behind `power`.
NoiseShape fit_noise_shape(const ExpectedPower& expected, const Eigen::VectorXd& power,
                           const std::vector<bool>& use, double count);

}  // namespace catena
