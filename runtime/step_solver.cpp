// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/step_solver.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/state_vector.hpp"

namespace catena {
namespace {

// The values of CVODE's own Newton iteration (Hindmarsh and others 2005, section 2.1).
constexpr int kMaxIterations = 4;
constexpr double kRateMemory = 0.3;   // how much of the old rate of convergence is kept
constexpr double kDivergence = 2.0;   // growth of a correction that means divergence
constexpr double kGammaChange = 0.2;  // change of gamma that calls for new factors
constexpr long kStepsPerFactors = 8;

}  // namespace

StepSolver::StepSolver(Dynamics& dynamics, NewtonMatrix& matrix, SUNContext context)
    : dynamics_(dynamics), matrix_(matrix), n_(dynamics.coordinates()), states_(dynamics.states()) {
  const auto n = static_cast<std::size_t>(n_), states = static_cast<std::size_t>(states_);
  for (std::vector<double>* values : {&q_, &v_, &a_}) values->assign(n, 0.0);
  for (std::vector<double>* values : {&z_, &zdot_}) values->assign(states, 0.0);
  change_.assign(n + states, 0.0);

  handle_ = own_nonlinear_solver(context, this, &StepSolver::solve);
  handle_->ops->getnumiters = [](SUNNonlinearSolver solver, long* count) {
    *count = static_cast<StepSolver*>(solver->content)->iterations_;
    return 0;
  };
}

int StepSolver::solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction,
                      N_Vector weight, double tolerance, booleantype, void* cvode) {
  Step step;
  N_Vector unused_prediction, state, rate, history;
  void* user;
  CVodeGetNonlinearSystemData(cvode, &step.t, &unused_prediction, &state, &rate, &step.gamma,
                              &step.rl1, &history, &user);
  step.predicted = elements(predicted);
  step.history = elements(history);
  step.weight = elements(weight);
  step.correction = elements(correction);
  step.tolerance = tolerance;
  return static_cast<StepSolver*>(self->content)->solve(step);
}

int StepSolver::solve(const Step& step) {
  iterations_ = 0;
  if (step.t <= time_) forget_factors();  // begun again from a check point
  bool fresh = false;
  if (factors_are_old(step.gamma)) {
    if (const int flag = factor(step)) return flag;
    fresh = true;
  }
  int flag = iterate(step);
  if (flag != SUN_NLS_SUCCESS && !fresh) {
    if (const int factor_flag = factor(step)) return factor_flag;
    flag = iterate(step);
  }
  if (flag != SUN_NLS_SUCCESS) {
    forget_factors();
    return flag;
  }
  ++steps_since_factored_;
  time_ = step.t;
  return SUN_NLS_SUCCESS;
}

bool StepSolver::factors_are_old(double gamma) const {
  return !(std::abs(gamma / factored_gamma_ - 1.0) <= kGammaChange) ||
         steps_since_factored_ >= kStepsPerFactors;
}

int StepSolver::factor(const Step& step) {
  std::fill_n(step.correction, 2 * n_ + states_, 0.0);
  set_point(step);
  const catena_point at = dynamics_.at(step.t, q_.data(), v_.data(), a_.data(), z_.data());
  ++factorisations_;
  if (const int pivot = matrix_.factor(dynamics_, at, step.gamma)) {
    forget_factors();
    return fail(Status::kSingular, pivot - 1, step.t);
  }
  factored_gamma_ = step.gamma;
  steps_since_factored_ = 0;
  rate_ = 1.0;
  return SUN_NLS_SUCCESS;
}

/// q, v, a, z from the correction of v and z; the correction of q follows from that of v.
void StepSolver::set_point(const Step& step) {
  const double *predicted_q = step.predicted, *predicted_v = predicted_q + n_;
  const double *history_q = step.history, *history_v = history_q + n_;
  const double* correction_v = step.correction + n_;
  const double gamma = step.gamma, rl1 = step.rl1;
  for (int i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    v_[k] = predicted_v[i] + correction_v[i];
    a_[k] = (rl1 * history_v[i] + correction_v[i]) / gamma;
    q_[k] = predicted_q[i] + (gamma * v_[k] - rl1 * history_q[i]);
  }
  for (int i = 0; i < states_; ++i)
    z_[static_cast<std::size_t>(i)] = predicted_v[n_ + i] + correction_v[n_ + i];
}

int StepSolver::iterate(const Step& step) {
  double* const correction_q = step.correction;
  double* const correction_v = correction_q + n_;
  const double *history_q = step.history, *predicted_v = step.predicted + n_;
  const int size = n_ + states_;
  std::fill_n(step.correction, n_ + size, 0.0);
  double before = 0.0;
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    set_point(step);
    const catena_point at = dynamics_.at(step.t, q_.data(), v_.data(), a_.data(), z_.data());
    dynamics_.model().residual(at, change_.data());
    if (states_ > 0) dynamics_.model().state_rate(at, zdot_.data());
    ++residual_evaluations_;
    ++iterations_;
    ++all_iterations_;
    for (int i = 0; i < n_; ++i) change_[static_cast<std::size_t>(i)] *= -step.gamma;
    for (int i = 0; i < states_; ++i)
      change_[static_cast<std::size_t>(n_ + i)] = step.gamma * zdot_[static_cast<std::size_t>(i)] -
                                                  step.rl1 * step.history[2 * n_ + i] -
                                                  correction_v[n_ + i];
    for (int i = 0; i < size; ++i)
      if (!std::isfinite(change_[static_cast<std::size_t>(i)]))
        return fail(Status::kNotFinite, i, step.t);
    matrix_.solve(change_.data());

    double sum = 0.0;
    for (int i = 0; i < n_; ++i) {
      const double change = change_[static_cast<std::size_t>(i)];
      correction_v[i] += change;
      const double corrected =
          step.gamma * (predicted_v[i] + correction_v[i]) - step.rl1 * history_q[i];
      const double error_q = (corrected - correction_q[i]) * step.weight[i];
      const double error_v = change * step.weight[n_ + i];
      correction_q[i] = corrected;
      sum += error_q * error_q + error_v * error_v;
    }
    for (int i = n_; i < size; ++i) {
      const double change = change_[static_cast<std::size_t>(i)];
      correction_v[i] += change;
      sum += change * step.weight[n_ + i] * (change * step.weight[n_ + i]);
    }
    const double norm = std::sqrt(sum / (n_ + size));
    if (!std::isfinite(norm)) return fail(Status::kNotFinite, farthest_from_met(step, at), step.t);
    if (iteration > 0) rate_ = std::max(kRateMemory * rate_, norm / before);
    if (norm * std::min(1.0, rate_) <= step.tolerance) {
      set_point(step);
      return SUN_NLS_SUCCESS;
    }
    if (iteration > 0 && norm > kDivergence * before) break;
    before = norm;
  }
  int worst = 0;
  for (int i = 1; i < size; ++i)
    if (std::abs(change_[static_cast<std::size_t>(i)] * step.weight[n_ + i]) >
        std::abs(change_[static_cast<std::size_t>(worst)] * step.weight[n_ + worst]))
      worst = i;
  return fail(Status::kNoConvergence, worst, step.t);
}

/// The equation with the largest residual at the point of the last change. A change that is not
/// finite spreads to all unknowns when it is solved for, so that the changes do not tell.
int StepSolver::farthest_from_met(const Step& step, const catena_point& at) {
  dynamics_.model().residual(at, change_.data());
  for (int i = 0; i < n_; ++i) change_[static_cast<std::size_t>(i)] *= step.gamma;
  for (int i = 0; i < states_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    change_[static_cast<std::size_t>(n_ + i)] = step.gamma * zdot_[k] -
                                                step.rl1 * step.history[2 * n_ + i] -
                                                (z_[k] - step.predicted[2 * n_ + i]);
  }
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<int>(std::max_element(change_.begin(), change_.end(), smaller) -
                          change_.begin());
}

int StepSolver::fail(Status status, int equation, double t) {
  ++all_failures_;
  failure_ = {status, equation < n_ ? equation : n_ + equation, t};
  return SUN_NLS_CONV_RECVR;
}

}  // namespace catena
