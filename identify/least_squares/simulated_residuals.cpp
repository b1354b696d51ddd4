// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/simulated_residuals.hpp"

#include <limits>

namespace catena {

SimulatedResiduals::SimulatedResiduals(const Problem& problem, FitJournal& journal,
                                       const Eigen::VectorXd& y, const Problem* rough)
    : problem_(problem),
      rough_(rough),
      journal_(journal),
      y_(y),
      error_of_jacobian_(std::numeric_limits<double>::infinity()) {}

// Ceres asks for the cost of a trial point and, if it is good, for the derivatives at the same
// point. After a good point the next is expected to be good too: cost and derivatives come from one
// simulation. After a bad one, or where it may be the last, derivatives wait until they are asked
// for. `new_point` also comes for points that were seen a moment ago.
void SimulatedResiduals::PrepareForEvaluation(bool jacobians, bool) {
  const bool known = here_.size() == y_.size() && here_ == y_;
  if (known && jacobians && !with_jacobian_ && journal_.must_stop(rough_ ? 1 : 0)) {
    misfit_.ok = false;  // which ends it
    return;
  }
  if (!known || (jacobians && !with_jacobian_)) {
    with_jacobian_ = jacobians || (!known && jacobian_used_ && more_wanted_);
    if (!known) jacobian_used_ = false;
    simulate(with_jacobian_);
  }
  if (jacobians && misfit_.ok && !jacobian_used_) {
    jacobian_used_ = true;
    error_before_ = error_of_jacobian_;
    error_of_jacobian_ = misfit_.error;
    if (told_) more_wanted_ = told_();
  }
}

void SimulatedResiduals::tell(std::function<bool()> told) {
  told_ = std::move(told);
  more_wanted_ = !told_ || told_();
}

void SimulatedResiduals::simulate(bool jacobian) {
  here_ = y_;
  const Eigen::VectorXd x = from_scaled(problem_, y_);
  Misfit misfit = rough_ ? journal_.evaluate_roughly(*rough_, x, jacobian)
                         : journal_.evaluate_residuals(x, jacobian);
  misfit_.ok = misfit.ok;
  if (!misfit_.ok) return;
  misfit_ = std::move(misfit);
  if (jacobian) scale_derivatives(x);
}

void SimulatedResiduals::refine() {
  bool known = misfit_.ok && with_jacobian_ && here_ == y_;
  for (std::size_t e = 0; e < problem_.experiments().size(); ++e)
    known &= problem_.experiments()[e].recording.fit_frames ==
             rough_->experiments()[e].recording.fit_frames;
  rough_ = nullptr;
  const Eigen::MatrixXd jacobian = std::move(misfit_.residuals.jacobian);
  simulate(!known);
  if (known && misfit_.ok) misfit_.residuals.jacobian = jacobian;
  with_jacobian_ = true;
  jacobian_used_ = false;
}

/// From derivatives by the unknowns to those by what Ceres moves.
void SimulatedResiduals::scale_derivatives(const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient;
  error_and_gradient(problem_, misfit_, gradient);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const Unknown& unknown = problem_.unknowns()[static_cast<std::size_t>(j)];
    // What a bound keeps from falling further rests; the others move as if it were known.
    const bool rests =
        (x[j] <= unknown.least && gradient[j] > 0) || (x[j] >= unknown.most && gradient[j] < 0);
    const double slope = rests ? 0 : unknown.scale == Scale::kLogarithmic ? x[j] : 1;
    misfit_.residuals.jacobian.col(j) *= slope;
    misfit_.constraints.jacobian.col(j) *= slope;
    gradient[j] *= slope;
  }
  steepness_ = misfit_.error > 0 ? gradient.norm() / misfit_.error : 0;
}

}  // namespace catena
