// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/evaluation_callback.h>

#include <functional>

#include "identify/fit/error.hpp"
#include "identify/fit/fit_journal.hpp"

namespace catena {

/// The residuals at the point Ceres looks at, and their derivatives by the scaled unknowns. All
/// come from one simulation, so they are made here once for a point and the blocks read them.
class SimulatedResiduals : public ceres::EvaluationCallback {
 public:
  /// `y`: what Ceres moves. With `rough` (rough() of easier_problems.hpp), the simulations are of that, until
  /// refine().
  SimulatedResiduals(const Problem& problem, FitJournal& journal, const Eigen::VectorXd& y,
                     const Problem* rough = nullptr);

  /// From now on simulations are of the problem itself. Derivatives at y that are known from the
  /// rough one, of the same residuals, are believed.
  void refine();

  /// The interface of Ceres.
  void PrepareForEvaluation(bool jacobians, bool new_point) override;

  /// Calls `told` now and at every point whose derivatives Ceres is about to use. It says whether
  /// those of the next point are likely to be wanted, should that be good.
  void tell(std::function<bool()> told);

  /// Whether the simulation succeeded; what it left.
  bool ok() const { return misfit_.ok; }
  const Residuals& residuals() const { return misfit_.residuals; }
  const SoftConstraints& constraints() const { return misfit_.constraints; }
  /// In the case's measure, here and at the point before whose derivatives were asked for.
  double error() const { return misfit_.error; }
  double error_before() const { return error_before_; }
  /// Norm of the error's gradient by y over the error.
  double steepness() const { return steepness_; }

 private:
  void simulate(bool jacobian);
  void change_derivatives(const Eigen::VectorXd& x);

  std::function<bool()> told_;
  const Problem& problem_;
  const Problem* rough_;
  FitJournal& journal_;
  const Eigen::VectorXd& y_;
  Eigen::VectorXd here_;  // where the residuals are from
  bool with_jacobian_ = false, jacobian_used_ = true, more_wanted_ = true;
  Misfit misfit_;
  double error_before_ = 0, error_of_jacobian_ = 0, steepness_ = 0;
};

}  // namespace catena
