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
  if (jacobian) change_derivatives(x);
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
void SimulatedResiduals::change_derivatives(const Eigen::VectorXd& x) {
  Eigen::VectorXd gradient;
  error_and_gradient(problem_, misfit_, gradient);
  Eigen::MatrixXd slopes = gradient.transpose();
  for (Eigen::MatrixXd* columns :
       {&misfit_.residuals.jacobian, &misfit_.constraints.jacobian, &slopes})
    scale_derivatives(problem_, x, *columns);
  gradient = slopes.transpose();
  const UnknownBounds bounds = scaled_bounds(problem_);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    // What a bound keeps from falling further rests; the others move as if it were known.
    const bool rests = (y_[j] <= bounds.lower[j] && gradient[j] > 0) ||
                       (y_[j] >= bounds.upper[j] && gradient[j] < 0);
    if (!rests) continue;
    misfit_.residuals.jacobian.col(j).setZero();
    misfit_.constraints.jacobian.col(j).setZero();
    gradient[j] = 0;
  }
  steepness_ = misfit_.error > 0 ? gradient.norm() / misfit_.error : 0;
}

}  // namespace catena
