// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/evaluation_callback.h>

#include <functional>

#include "identify/error.hpp"
#include "identify/fit_journal.hpp"

namespace catena {

/// The residuals at the point Ceres looks at, and their derivatives by the scaled unknowns. All come
/// from one simulation, so they are made here once for a point and the blocks read them.
class SimulatedResiduals : public ceres::EvaluationCallback {
 public:
  /// `y`: what Ceres moves.
  SimulatedResiduals(const Problem& problem, FitJournal& journal, const Eigen::VectorXd& y);

  void PrepareForEvaluation(bool jacobians, bool new_point) override;

  /// Called at every point whose derivatives Ceres is about to use.
  std::function<void()> on_derivatives;

  bool ok() const { return ok_; }
  const Residuals& residuals() const { return residuals_; }
  const Joints& joints() const { return joints_; }
  /// In the case's measure, here and at the point before whose derivatives were asked for.
  double error() const { return error_; }
  double error_before() const { return error_before_; }
  /// Norm of the error's gradient by y over the error.
  double steepness() const { return steepness_; }

 private:
  void scale_derivatives(const Eigen::VectorXd& x, const Evaluation& evaluation);

  const Problem& problem_;
  FitJournal& journal_;
  const Eigen::VectorXd& y_;
  Eigen::VectorXd here_;  // where the residuals are from
  bool ok_ = false, with_jacobian_ = false, jacobian_used_ = true;
  Residuals residuals_;
  Joints joints_;
  double error_ = 0, error_before_ = 0, error_of_jacobian_ = 0, steepness_ = 0;
};

}  // namespace catena
