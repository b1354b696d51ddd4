// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Where, when and how residuals are large.
struct ResidualPlaces {
  std::vector<std::string>
      words;  ///< "largest at marker 12 (the load)", "at high speed", "after 2 s"
  std::string largest_point;
  std::vector<std::string> points;    ///< of the first experiment
  std::vector<double> point_rms;      ///< m or rad
  double slow_rms = 0, fast_rms = 0;  ///< in the slowest and the fastest third of the motion
  double strongest_frequency = 0;     ///< Hz, of the residuals
};
ResidualPlaces residual_places(const FittedModel& model, const std::vector<double>& floors);

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
struct MissingForce {
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
MissingForce missing_force(const FittedModel& model, const std::vector<double>& floors);

}  // namespace catena
