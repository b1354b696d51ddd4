// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// The generalised force that would close the gap.
///
/// The residuals are taken as a small difference of link angles, d(s, t): polynomials along the
/// cable times cubic B-splines in time, fitted to all residuals at once through the derivative of
/// the positions. The large motion comes from the model, so that only the smooth difference is
/// differentiated, never the data. The true motion is then the simulated one minus d, and the
/// linearised equations tell what moves it:
///
///     Q = dr/dq d + dr/dv d' + dr/da d''
///
/// The distance of the knots says what is resolved. Given as the moment at each joint that would do
/// the work of Q: moment_i = sum over the links below of Q_k.
struct MissingMoment {
  int experiment = 0;
  std::vector<double> time;
  Eigen::MatrixXd moment;  ///< joints x times, N m, on the link below from the joint above
  double noise = 0;        ///< rms of what noise alone would give, N m
  double resolution = 0;   ///< s, distance of the knots
  /// Share of the largest joint's moment (its mean square) that single quantities explain.
  struct Dependence {
    std::string on;  ///< "position", "velocity", "speed times velocity", "time (harmonic)", ...
    double share = 0;
  };
  std::vector<Dependence> dependence;  ///< largest first
  std::vector<std::string> words;
};

/// Of the first experiment with a fitted part. `sigmas`: the noise of every experiment, m or rad.
/// `moment` is empty where it cannot be told: fewer than 30 frames, a motion that cannot be
/// simulated, or accelerations that cannot be solved for, which `words` says.
MissingMoment missing_moment(const FittedModel& model, const std::vector<double>& sigmas);

}  // namespace catena
