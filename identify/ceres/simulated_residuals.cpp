// SPDX-License-Identifier: BSD-3-Clause
#include "identify/ceres/simulated_residuals.hpp"

#include <limits>

namespace catena {

SimulatedResiduals::SimulatedResiduals(const Problem& problem, FitJournal& journal,
                                       const Eigen::VectorXd& y)
    : problem_(problem),
      journal_(journal),
      y_(y),
      error_of_jacobian_(std::numeric_limits<double>::infinity()) {}

// Ceres asks for the cost of a trial point and, if it is good, for the derivatives at the same
// point. After a good point the next is expected to be good too: cost and derivatives come from one
// simulation. After a bad one, derivatives wait until they are asked for. `new_point` also comes
// for points that were seen a moment ago.
void SimulatedResiduals::PrepareForEvaluation(bool jacobians, bool) {
  const bool known = here_.size() == y_.size() && here_ == y_;
  if (!known || (jacobians && !with_jacobian_)) {
    with_jacobian_ = jacobians || (!known && jacobian_used_);
    if (!known) jacobian_used_ = false;
    here_ = y_;
    const Eigen::VectorXd x = from_scaled(problem_, y_);
    Misfit misfit = journal_.evaluate_residuals(x, with_jacobian_);
    misfit_.ok = misfit.ok;
    if (!misfit_.ok) return;
    misfit_ = std::move(misfit);
    if (with_jacobian_) scale_derivatives(x);
  }
  if (jacobians && misfit_.ok && !jacobian_used_) {
    jacobian_used_ = true;
    error_before_ = error_of_jacobian_;
    error_of_jacobian_ = misfit_.error;
    if (on_derivatives) on_derivatives();
  }
}

/// From derivatives by the unknowns to those by what Ceres moves.
void SimulatedResiduals::scale_derivatives(const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient;
  error_and_gradient(problem_, misfit_, gradient);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Unknown& unknown = problem_.unknowns()[static_cast<std::size_t>(j)];
    // What a bound keeps from falling further rests; the others move as if it were known.
    const bool rests =
        (x[j] <= unknown.lower && gradient[j] > 0) || (x[j] >= unknown.upper && gradient[j] < 0);
    const double slope = rests ? 0 : unknown.scale == Scale::kLogarithmic ? x[j] : 1;
    misfit_.residuals.jacobian.col(j) *= slope;
    misfit_.joints.jacobian.col(j) *= slope;
    gradient[j] *= slope;
  }
  steepness_ = misfit_.error > 0 ? gradient.norm() / misfit_.error : 0;
}

}  // namespace catena
