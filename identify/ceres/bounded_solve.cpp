// SPDX-License-Identifier: BSD-3-Clause
#include "identify/ceres/bounded_solve.hpp"

#include <vector>

namespace catena {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr int kMostReleases = 2;  // of one unknown: it may go to and fro where residuals are noisy

/// The unknowns of a problem, some of them held at their bounds.
class Bounded {
 public:
  Bounded(ceres::Problem& problem, VectorXd& y, const VectorXd& lower, const VectorXd& upper)
      : problem_(problem),
        y_(y),
        lower_(lower),
        upper_(upper),
        held_(static_cast<std::size_t>(y.size())),
        watched_(held_.size(), true),
        releases_(held_.size()) {}

  /// Whether an unknown that is neither held nor known to turn back stands at a bound.
  bool arrived() const {
    for (Index j = 0; j < y_.size(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (!held_[k] && watched_[k] && side(j) != 0) return true;
    }
    return false;
  }

  /// Holds what would go beyond its bound and lets go what would turn back. Returns whether anything
  /// was let go.
  bool sort() {
    bool any = false;
    for (Index j = 0; j < y_.size(); ++j)
      any = any || held_[static_cast<std::size_t>(j)] || side(j) != 0;
    if (!any) return false;
    problem_.SetManifold(y_.data(), nullptr);
    std::vector<double> gradient;
    problem_.Evaluate(ceres::Problem::EvaluateOptions(), nullptr, nullptr, &gradient, nullptr);
    bool released = false;
    for (Index j = 0; j < y_.size() && !gradient.empty(); ++j) {
      const auto k = static_cast<std::size_t>(j);
      const bool beyond = side(j) * gradient[k] < 0;  // downhill is past the bound
      watched_[k] = side(j) == 0 || beyond;
      if (held_[k] && !beyond && releases_[k] < kMostReleases) {
        held_[k] = false;
        ++releases_[k];
        released = true;
      } else if (beyond) {
        held_[k] = true;
      }
    }
    std::vector<int> constant;
    for (std::size_t k = 0; k < held_.size(); ++k)
      if (held_[k]) constant.push_back(static_cast<int>(k));
    all_held_ = constant.size() == held_.size();
    if (!constant.empty() && !all_held_)
      problem_.SetManifold(y_.data(),
                           new ceres::SubsetManifold(static_cast<int>(y_.size()), constant));
    return released;
  }

  bool all_held() const { return all_held_; }

 private:
  /// -1 at the lower bound, 1 at the upper one, 0 between them.
  int side(Index j) const { return y_[j] <= lower_[j] ? -1 : y_[j] >= upper_[j] ? 1 : 0; }

  ceres::Problem& problem_;
  VectorXd& y_;
  const VectorXd &lower_, &upper_;
  std::vector<bool> held_, watched_;
  std::vector<int> releases_;
  bool all_held_ = false;
};

/// Stops Ceres where an unknown has come to a bound.
class Arrival : public ceres::IterationCallback {
 public:
  explicit Arrival(const Bounded& bounded) : bounded_(bounded) {}
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& step) override {
    stopped = step.iteration > 0 && step.step_is_successful && bounded_.arrived();
    return stopped ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
  bool stopped = false;

 private:
  const Bounded& bounded_;
};

}  // namespace

ceres::Solver::Summary solve_within_bounds(ceres::Solver::Options settings, ceres::Problem& problem,
                                           VectorXd& y, const VectorXd& lower,
                                           const VectorXd& upper) {
  Bounded bounded(problem, y, lower, upper);
  Arrival arrival(bounded);
  settings.callbacks.push_back(&arrival);
  settings.update_state_every_iteration = true;
  ceres::Solver::Summary summary;
  for (bool again = true; again && !bounded.all_held();) {
    arrival.stopped = false;
    ceres::Solve(settings, &problem, &summary);
    const bool converged = summary.termination_type == ceres::CONVERGENCE;
    again = arrival.stopped;
    if (arrival.stopped || converged) again = bounded.sort() || again;
  }
  problem.SetManifold(y.data(), nullptr);
  return summary;
}

}  // namespace catena
