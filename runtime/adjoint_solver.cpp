// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/adjoint_solver.hpp"

#include <algorithm>
#include <cmath>
#include <new>

#include "common/number_text.hpp"

namespace catena {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

}  // namespace

AdjointSolver::AdjointSolver(Integrator& forward, const Model& model,
                             const Eigen::VectorXd& parameters, const SimulationOptions& options,
                             const Signals& signals)
    : cvodes_(forward.cvodes()),
      options_(options),
      dynamics_(model, parameters, signals),
      matrix_(make_newton_matrix(model, options.linear_solver, used_)),
      n_(model.coordinates()),
      states_(model.states()),
      motion_(new_state_vector(dynamics_.size(), forward.context())),
      lambda_(new_state_vector(dynamics_.size(), forward.context())),
      integral_(new_state_vector(model.parameters(), forward.context())),
      a_(static_cast<std::size_t>(n_)),
      right_(static_cast<std::size_t>(n_ + states_)),
      minus_z_(static_cast<std::size_t>(states_)),
      dq_(static_cast<std::size_t>(n_)),
      dv_(static_cast<std::size_t>(n_)),
      dz_(static_cast<std::size_t>(states_)),
      dp_(static_cast<std::size_t>(model.parameters())),
      time_(kUnknown) {
  std::fill_n(elements(lambda_.get()), dynamics_.size(), 0.0);
  std::fill_n(elements(integral_.get()), dp_.size(), 0.0);
  handle_ = own_nonlinear_solver(forward.context(), this, &AdjointSolver::solve);
}

void AdjointSolver::begin(double t, const Trajectory& slope) {
  // lambda needs no relative accuracy where it is small compared with the slopes.
  const double largest = std::max({slope.q.size() > 0 ? slope.q.cwiseAbs().maxCoeff() : 0.0,
                                   slope.v.cwiseAbs().maxCoeff(),
                                   slope.z.size() > 0 ? slope.z.cwiseAbs().maxCoeff() : 0.0});
  const double absolute =
      std::max(1e-2 * options_.relative_tolerance * largest, std::numeric_limits<double>::min());
  require(CVodeCreateB(cvodes_, CV_BDF, &which_), "CVodeCreateB");
  require(CVodeInitB(cvodes_, which_, &AdjointSolver::rates, t, lambda_.get()), "CVodeInitB");
  require(CVodeSetUserDataB(cvodes_, which_, this), "CVodeSetUserDataB");
  require(CVodeSStolerancesB(cvodes_, which_, options_.relative_tolerance, absolute),
          "CVodeSStolerancesB");
  require(CVodeSetMaxNumStepsB(cvodes_, which_, options_.max_steps), "CVodeSetMaxNumStepsB");
  require(CVodeSetNonlinearSolverB(cvodes_, which_, handle_.get()), "CVodeSetNonlinearSolverB");
  require(CVodeQuadInitB(cvodes_, which_, &AdjointSolver::parameter_rates, integral_.get()),
          "CVodeQuadInitB");
}

void AdjointSolver::add_slope(const Trajectory& slope, std::size_t column) {
  const auto k = static_cast<Eigen::Index>(column);
  double* const lambda = elements(lambda_.get());
  Eigen::Map<Eigen::VectorXd>(lambda, n_) += slope.q.col(k);
  Eigen::Map<Eigen::VectorXd>(lambda + n_, n_) += slope.v.col(k);
  Eigen::Map<Eigen::VectorXd>(lambda + 2 * n_, states_) += slope.z.col(k);
}

void AdjointSolver::run(const std::vector<double>& times, const Trajectory& slope,
                        AdjointSimulation& result) {
  for (std::size_t k = times.size() - 1; k > 0; --k) {
    add_slope(slope, k);
    time_ = kUnknown;
    if (k + 1 == times.size()) {
      begin(times[k], slope);
    } else {
      require(CVodeReInitB(cvodes_, which_, times[k], lambda_.get()), "CVodeReInitB");
      require(CVodeQuadReInitB(cvodes_, which_, integral_.get()), "CVodeQuadReInitB");
    }
    int flag = CVodeB(cvodes_, times[k - 1], CV_NORMAL);
    double t = times[k - 1];
    if (flag >= 0) flag = CVodeGetB(cvodes_, which_, &t, lambda_.get());
    if (flag >= 0) flag = CVodeGetQuadB(cvodes_, which_, &t, integral_.get());
    if (flag == CV_MEM_FAIL) throw std::bad_alloc();
    if (flag < 0) {
      result.status = Status::kStepFailure;
      result.message =
          "the adjoint equations cannot be integrated from t = " + number_text(times[k]) +
          " s back to " + number_text(times[k - 1]) + " s (status " + std::to_string(flag) +
          " of CVODES)";
      return;
    }
    if (options_.keep_going && !options_.keep_going(times[k - 1])) {
      result.status = Status::kInterrupted;
      result.message = "interrupted on the way back, at t = " + number_text(times[k - 1]) + " s";
      return;
    }
  }
  add_slope(slope, 0);
  const double* lambda = elements(lambda_.get());
  result.gradient.q = Eigen::Map<const Eigen::VectorXd>(lambda, n_);
  result.gradient.v = Eigen::Map<const Eigen::VectorXd>(lambda + n_, n_);
  result.gradient.z = Eigen::Map<const Eigen::VectorXd>(lambda + 2 * n_, states_);
  result.gradient.parameters = Eigen::Map<const Eigen::VectorXd>(
      elements(integral_.get()), static_cast<Eigen::Index>(dp_.size()));
}

/// Solves N' (mu, lambda_z) = right with the Newton matrix at gamma, and differentiates
/// mu.r - lambda_z.f there.
bool AdjointSolver::evaluate(double t, N_Vector y, double gamma, double* right) {
  const double *q = elements(y), *v = q + n_, *z = v + n_;
  const Model& model = dynamics_.model();
  const catena_point at = dynamics_.at(t, q, v, a_.data(), z);
  if (model.acceleration(at, a_.data()) != 0) return false;
  if (matrix_->factor(dynamics_, at, gamma) != 0) return false;
  matrix_->solve_transposed(right);
  for (int i = 0; i < states_; ++i) minus_z_[static_cast<std::size_t>(i)] = -right[n_ + i];
  model.residual_adjoint(at, right, minus_z_.data(), dq_.data(), dv_.data(), dz_.data(),
                         dp_.data());
  time_ = t;
  return true;
}

// A step from later to earlier: lambda = c + gamma d(lambda)/dt with gamma < 0. With g = -gamma,
// elimination of lambda_q and lambda_v leaves N(g)' (mu, lambda_z) = (c_v + g c_q, c_z).
int AdjointSolver::solve(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction,
                         N_Vector, double, booleantype, void* cvodes) {
  auto& self = *static_cast<AdjointSolver*>(solver->content);
  const int n = self.n_, states = self.states_;
  double t, gamma, rl1;
  N_Vector prediction, state, rate, history;
  void* user;
  CVodeGetNonlinearSystemData(cvodes, &t, &prediction, &state, &rate, &gamma, &rl1, &history,
                              &user);
  if (CVodeGetAdjY(self.cvodes_, t, self.motion_.get()) < 0) return SUN_NLS_CONV_RECVR;
  const double g = -gamma;
  const double *before = elements(predicted), *past = elements(history);
  const auto c = [&](int i) { return before[i] - rl1 * past[i]; };
  double* const right = self.right_.data();
  for (int i = 0; i < n; ++i) right[i] = c(n + i) + g * c(i);
  for (int i = n; i < n + states; ++i) right[i] = c(n + i);
  if (!self.evaluate(t, self.motion_.get(), g, right)) return SUN_NLS_CONV_RECVR;
  double* const e = elements(correction);
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const double lambda_q = c(i) - g * self.dq_[k];
    e[i] = lambda_q - before[i];
    e[n + i] = c(n + i) - g * (self.dv_[k] - lambda_q) - before[n + i];
    if (!std::isfinite(e[i]) || !std::isfinite(e[n + i])) return SUN_NLS_CONV_RECVR;
  }
  for (int i = n; i < n + states; ++i) e[n + i] = right[i] - before[n + i];
  return SUN_NLS_SUCCESS;
}

int AdjointSolver::rates(double t, N_Vector y, N_Vector lambda, N_Vector rate, void* user) {
  auto& self = *static_cast<AdjointSolver*>(user);
  const int n = self.n_, states = self.states_;
  if (t != self.time_) {
    std::copy_n(elements(lambda) + n, n + states, self.right_.data());
    if (!self.evaluate(t, y, 0.0, self.right_.data())) return 1;  // N is M, and 1 for the states
  }
  double* const out = elements(rate);
  std::copy_n(self.dq_.data(), n, out);
  for (int i = 0; i < n; ++i)
    out[n + i] = self.dv_[static_cast<std::size_t>(i)] - elements(lambda)[i];
  std::copy_n(self.dz_.data(), states, out + 2 * n);
  return 0;
}

int AdjointSolver::parameter_rates(double t, N_Vector y, N_Vector lambda, N_Vector rate,
                                   void* user) {
  auto& self = *static_cast<AdjointSolver*>(user);
  if (t != self.time_) {
    std::copy_n(elements(lambda) + self.n_, self.n_ + self.states_, self.right_.data());
    if (!self.evaluate(t, y, 0.0, self.right_.data())) return 1;
  }
  std::copy(self.dp_.begin(), self.dp_.end(), elements(rate));
  return 0;
}

}  // namespace catena
