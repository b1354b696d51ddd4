// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// Statistics of residuals in time. Residuals come as channels x frames; NaN where nothing was
/// measured. Everything in the unit of the residuals (m or rad).

/// The noise of one recording, from its residuals themselves.
///
/// Differences of order d of neighbouring frames wipe out what is smooth (the motion and what the
/// model misses of it) and keep white noise, whose variance they multiply by the binomial (2d over
/// d). The smallest estimate of orders 2 to 6 is taken: a higher order wipes out more, a lower one
/// is surer. The median over blocks of frames keeps short events from counting as noise.
struct NoiseFloor {
  double sigma = 0;  ///< standard deviation of white noise; NaN: too few neighbouring frames
  double sigma_of_second = 0;  ///< the same from second differences
  /// Noise that is not white (smoothed tracks) leaves less and less in higher differences: then
  /// sigma is no noise floor. True if the residuals are not dominated by misfit and orders 2 and 6
  /// differ by more than a third.
  bool coloured = false;
};
NoiseFloor noise_floor(const Eigen::MatrixXd& residual, const std::vector<double>& time);

/// Whether residuals are larger or smoother than noise.
struct GapTest {
  double floor = 0;  ///< the noise it is held against
  double rms = 0;    ///< root mean square of the residuals
  double misfit =
      0;  ///< their part that neighbouring frames share: root of the covariance at lag 1
  double colour =
      0;            ///< correlations in time and across neighbouring points, in standard deviations
  double size = 0;  ///< excess of the mean square over the floor, in standard deviations
  bool present = false;
  long count = 0;  ///< residuals

  double ratio() const { return floor > 0 ? rms / floor : 0; }
};

/// A gap is there if it is significant and worth the name (misfit above four tenths of the noise).
inline constexpr double kGapSignificance = 4.5;  // standard deviations
inline constexpr double kGapShare = 0.4;         // of the noise

/// Tests residuals of several recordings together, each in units of its own noise; `floor`, `rms`
/// and `misfit` are those of the whole, weighted with the counts.
GapTest test_gap(const std::vector<Eigen::MatrixXd>& residuals, const std::vector<double>& floors);

/// Long-run variance over variance of residuals: how many times fewer independent ones there are
/// than their number says, from the correlations in time (lags until they fade) and across channels
/// of the same kind. At least 1.
double colour_factor(const std::vector<Eigen::MatrixXd>& residuals);

/// log10 of the probability that chi-square with `degrees` degrees of freedom exceeds `x`.
double log10_chi_square_tail(double x, int degrees);

}  // namespace catena
