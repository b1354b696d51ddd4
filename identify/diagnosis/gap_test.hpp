// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/noise_model.hpp"

namespace catena {

/// Statistics of residuals in time. Residuals come as channels x frames; NaN where nothing was
/// measured. Everything in the unit of the residuals (m or rad).

/// Whether residuals are larger or smoother than noise. A gap is there if it is significant and worth
/// the name (DiagnosisThresholds). Both are asked of the residuals made white; values far off
/// (NoiseModel) count as not seen.
struct GapTest {
  double noise = 0;  ///< the level it is held against
  double rms = 0;    ///< root mean square of the residuals, as they are
  /// Their part that neighbouring frames share beyond what their noise does: root of the covariance
  /// at lag 1 of the white residuals, times the level.
  double misfit = 0;
  /// Correlations of the white residuals in time and across neighbouring points, in standard
  /// deviations.
  double autocorrelation = 0;
  double size = 0;  ///< excess of their mean square over 1, in standard deviations
  bool present = false;
  bool good_enough = false;  ///< the RMS is within what the case accepts
  long count = 0;            ///< residuals

  /// The RMS over the noise level.
  double ratio() const { return noise > 0 ? rms / noise : 0; }
};

/// Tests residuals of several recordings together, each with its own noise; `noise`, `rms` and
/// `misfit` are those of the whole, weighted with the counts. `first`: at which frame of its window
/// each begins; empty: at the first.
GapTest test_gap(const std::vector<Eigen::MatrixXd>& residuals,
                 const std::vector<NoiseModel>& noise, const std::vector<Eigen::Index>& first = {});

/// Long-run variance over variance of residuals: how many times fewer independent ones there are
/// than their number says, from the correlations in time (lags until they fade) and across channels
/// of the same kind. At least 1.
double autocorrelation_factor(const std::vector<Eigen::MatrixXd>& residuals);

/// log10 of the probability that chi-square with `degrees` degrees of freedom exceeds `x`.
double log10_chi_square_tail(double x, int degrees);

}  // namespace catena
