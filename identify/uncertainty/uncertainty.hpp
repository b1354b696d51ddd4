// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"

namespace catena {

// Notation. y: the scaled unknowns (logarithms where the scale is logarithmic, else the unknown
// over its range: its bounds, or its size where they are infinite). J: d(residual)/dy, residuals r
// over their noise. J = U S V': a direction V_i of the unknowns is known to 1/S_i.

enum class Verdict { kIdentifiable, kPracticallyNot, kStructurallyNot, kAtBound };
/// "identifiable", "practically_not", "structurally_not", "at_bound"
const char* name_of(Verdict verdict);

/// A combination of unknowns that the data hardly determine, or not at all.
struct WeakDirection {
  double deviation = 0;  ///< standard deviation along it in scaled units; infinite: none at all
  Eigen::VectorXd direction;  ///< unit length, in the scaled unknowns
  std::string text;           ///< "0.71 ln EI + 0.70 ln damping"
};

struct Estimate {
  double standard_error = 0;    ///< in the unit of the unknown; infinite in null directions
  double lower = 0, upper = 0;  ///< 95 % interval; infinite in null directions
  Verdict verdict = Verdict::kIdentifiable;
};

struct Uncertainty {
  std::vector<Estimate> estimates;  ///< one per unknown
  Eigen::MatrixXd correlation;      ///< of the scaled unknowns; NaN with one that is not determined
  double noise = 0;  ///< standard deviation of the residuals, m or rad (or over the stated noise)
  double autocorrelation = 0;            ///< correlation of a residual with the one a frame before
  bool autocorrelated = false;           ///< more than chance: errors then allow for it
  Eigen::VectorXd singular_values;       ///< of J, descending
  std::vector<WeakDirection> weak;       ///< directions known to no better than a scaled unit
  std::vector<std::string> suggestions;  ///< what to fix so that the rest is determined
};

/// What the data say about the unknowns at x, by the sensitivities there. After a fit, the noise is
/// the size of the residuals. Before a fit it is `expected_noise` (> 0; m or rad, or over the noise
/// that the case states).
///
/// Errors are those of least squares: (J'J)^-1 where the residuals are white, else the sandwich (J'J)^-1 J'WJ
/// (J'J)^-1 with W of an AR(1) process in every channel. Where sums over frames with Bartlett's weights
/// (Newey and West 1987, bandwidth of Andrews 1991) give more than twice that variance, theirs is taken:
/// markers that err together, autocorrelation that lasts. For measures other than least squares they are an
/// approximation. Under a robust loss they are those of an M-estimator. Throws std::runtime_error where the
/// simulation fails.
Uncertainty uncertainty_of(const Problem& problem, const Eigen::VectorXd& x,
                           double expected_noise = 0);

/// The noise sigma of one channel (m or rad), its error and interval, from the scatter of its
/// residuals, autocorrelated or not. It is a property of the sensor, no unknown of the physics.
Estimate noise_estimate(const ChannelNoise& channel, const Uncertainty& uncertainty);

}  // namespace catena
