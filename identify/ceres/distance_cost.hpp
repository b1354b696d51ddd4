// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "identify/ceres/simulated_residuals.hpp"

namespace catena {

/// Distances, not their squares, as Ceres can minimise them. The residual r of one point (two
/// numbers, or one) enters the cost as w (d + offset), d = |r|, exactly. Its derivatives by r, with
/// u = r / d and t across it:
///
///     gradient  w u,   curvature  w t t' / d:  none along u, but for the kink at d = 0
///
/// which Ceres' robust losses replace by w I / d (reweighting), too much along u: many small steps.
/// Here Ceres is given
///
///     residual sqrt(2 w (d + offset)), row w u'J / residual                 the gradient
///     residual 0, rows sqrt(w a) t'J and sqrt(w b) u'J                      the curvature
///     a = 1 / sqrt(d^2 + h^2),  b = h^2 a^3
///
/// with h a share of the mean distance: b spreads the kinks of all points over a width of h, so
/// that their sum has the curvature of the smooth sum over many points; near the end, where the
/// minimum may lie on a few kinks, h narrows. Far from the minimum, where the error still falls by
/// much, b = a: plain reweighting, which does not overshoot. The first row's own curvature is w /
/// (2 (d + offset)): small for a large offset.
///
/// All this leaves out that r itself is curved. Where the last step s changed the gradient by y and
/// y's exceeds s'Hs, one more row with residual 0 makes up for it: sqrt(1 / y's - s'Hs / (y's)^2)
/// y' (the curvature along s is then y's, as it was found).
///
/// Where an unknown y_j hardly shows, its curvature is next to nothing and the step as long as one
/// likes. So each has |g_j| / reach_j added to it, g the gradient: no step is longer than reach_j
/// on its account, and near the minimum nothing is added.
///
/// Of all these rows Ceres needs the sum of squares, J'r and J'J. It gets them from as many rows as
/// there are unknowns and one more.
class DistanceCost : public ceres::CostFunction {
 public:
  struct Term {
    Eigen::Index first = 0, count = 0;  // residuals
    double weight = 0;
  };

  /// `reach` of each unknown; infinite where none is known.
  DistanceCost(const SimulatedResiduals& simulated, std::vector<Term> terms, double offset,
               const Eigen::VectorXd& reach);

  /// Notes gradient and curvature at a point y with derivatives, after a step from the last such
  /// point.
  void step_to(const Eigen::VectorXd& y);

  /// What the offsets add to the cost.
  double all_offsets() const;

  bool Evaluate(double const* const* y, double* residuals, double** jacobians) const override;

 private:
  const SimulatedResiduals& simulated_;
  std::vector<Term> terms_;
  double offset_;
  Eigen::VectorXd reach_;
  double width_ = 0.3;            // h, of the mean distance
  Eigen::VectorXd y_, gradient_;  // of the last point; J'r
  Eigen::MatrixXd curvature_;     // J'J
};

}  // namespace catena
