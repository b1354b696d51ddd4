// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/cost_function.h>

#include <vector>

#include "identify/least_squares/linearised_distances.hpp"
#include "identify/least_squares/quadratic_model.hpp"
#include "identify/least_squares/simulated_residuals.hpp"

namespace catena {

/// Distances, not their squares, as Ceres can minimise them. The residual r of one point (two
/// numbers, or one) enters the cost as w (d + offset), d = |r|, exactly.
///
/// Ceres steps to the minimum of a quadratic model; distances have kinks. Where they are many, the
/// model has the sum's gradient g and, H, its curvature smoothed over as many points as make it
/// smooth. Where they are few, the minimum of the sum of distances of the linearised residuals is
/// found, kinks and all (see LinearisedDistances), and Ceres is given the quadratic model whose
/// minimum is there and as deep (QuadraticModel). Where less is gained than the tolerance, the gradient is 0: Ceres is done. Far from the minimum,
/// where the error still falls by much, H is that of plain reweighting, which does not overshoot.
///
/// All this leaves out that r itself is curved. Where the last step s changed J, v = (change of J)'
/// w u tells how the gradient changed by that (u = r / d). Where v's > 0, H has v's z z' / (z's)^2
/// added, z = H s + v: the curvature along s is then s'Hs + v's, as it was found.
///
/// Where an unknown y_j hardly shows, its curvature is next to nothing and the step as long as one
/// likes. So each has |g_j| / reach_j added to it: no step is longer than reach_j on its account,
/// and near the minimum nothing is added.
///
/// Of residuals and derivatives Ceres needs the sum of squares, J'r and J'J. It gets them from as
/// many rows as there are unknowns and one more.
class DistanceCost : public ceres::CostFunction {
 public:
  /// How far the unknowns may go, and how far in one step; infinite where nothing is known.
  struct Box {
    Eigen::VectorXd lower, upper, reach;
  };

  /// `tolerance`: share of the cost that is not worth a step.
  DistanceCost(const SimulatedResiduals& simulated, std::vector<WeightedDistance> points,
               double offset, double tolerance, Box box);

  /// Notes gradient and curvature at a point y with derivatives, after a step from the last such
  /// point.
  void step_to(const Eigen::VectorXd& y);

  /// Share of the cost that the best step from there promises; infinite if it is far.
  double gain() const { return gain_; }

  /// What the offsets add to the cost.
  double all_offsets() const;

  /// The interface of Ceres.
  bool Evaluate(double const* const* y, double* residuals, double** jacobians) const override;

 private:
  double smooth_width() const;
  Eigen::MatrixXd bend_since(const Eigen::VectorXd& y, const Eigen::MatrixXd& curvature) const;

  const SimulatedResiduals& simulated_;
  std::vector<WeightedDistance> points_;
  double offset_, tolerance_, gain_ = 0;
  Box box_;
  Eigen::VectorXd y_;         // of the last point
  Eigen::MatrixXd jacobian_;  // of the residuals, there
  QuadraticModel model_;      // there
};

}  // namespace catena
