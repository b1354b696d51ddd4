// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "identify/ceres/simulated_residuals.hpp"

namespace catena {

/// Distances, not their squares, as Ceres can minimise them. The residual r of one point (two numbers,
/// or one) enters the cost as w (d + offset), d = |r|, exactly. Its derivatives by r, with u = r / d and
/// t across it:
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
/// with h a share of the mean distance: b spreads the kinks of all points over a width of h, so that
/// their sum has the curvature of the smooth sum over many points; near the end, where the minimum may
/// lie on a few kinks, h narrows. Far from the minimum, where the
/// error still falls by much, b = a: plain reweighting, which does not overshoot. The first row's own
/// curvature is w / (2 (d + offset)): small for a large offset.
///
/// All this leaves out that r itself is curved. Where the last step s changed the gradient by y and
/// y's exceeds s'Hs, one more row with residual 0 makes up for it: sqrt(1 / y's - s'Hs / (y's)^2) y'
/// (the curvature along s is then y's, as it was found).
class Distances {
 public:
  struct Term {
    Eigen::Index first = 0, count = 0;  // residuals
    double weight = 0;
  };

  Distances(const SimulatedResiduals& simulated, std::vector<Term> terms, double offset);

  /// Notes gradient and curvature at a point y with derivatives, after a step from the last such point.
  void step_to(const Eigen::VectorXd& y);

  const SimulatedResiduals& simulated() const { return simulated_; }
  double offset() const { return offset_; }
  /// The curvatures a and b of a distance.
  std::pair<double, double> curvature(double distance) const;
  const Eigen::RowVectorXd& secant_row() const { return secant_row_; }

 private:
  const SimulatedResiduals& simulated_;
  std::vector<Term> terms_;
  double offset_;
  double width_ = 0.3;            // h, of the mean distance
  Eigen::VectorXd y_, gradient_;  // of the last point
  Eigen::RowVectorXd secant_row_;
};

/// One distance.
class DistanceBlock : public ceres::CostFunction {
 public:
  DistanceBlock(const Distances& distances, const Distances::Term& term, int unknowns);
  bool Evaluate(double const* const* y, double* residuals, double** jacobians) const override;

 private:
  const Distances& distances_;
  Distances::Term term_;
};

/// The row that makes up for the curvature of the residuals.
class SecantBlock : public ceres::CostFunction {
 public:
  SecantBlock(const Distances& distances, int unknowns);
  bool Evaluate(double const* const* y, double* residuals, double** jacobians) const override;

 private:
  const Distances& distances_;
};

}  // namespace catena
