// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/sensitivity_solver.hpp"

#include <cmath>

#include "runtime/state_vector.hpp"

namespace catena {

SensitivitySolver::SensitivitySolver(Dynamics& dynamics, NewtonMatrix& matrix,
                                     StepSolver& step_solver, const std::vector<Seed>& seeds,
                                     SUNContext context)
    : dynamics_(dynamics),
      matrix_(matrix),
      step_solver_(step_solver),
      seeds_(seeds),
      n_(dynamics.coordinates()),
      states_(dynamics.states()) {
  const auto n = static_cast<std::size_t>(n_), states = static_cast<std::size_t>(states_);
  for (std::vector<double>* values : {&dq_, &dv_, &da_}) values->assign(n, 0.0);
  dz_.assign(states, 0.0);
  change_.assign(n + states, 0.0);

  handle_ = own_nonlinear_solver(context, this, &SensitivitySolver::solve);
}

int SensitivitySolver::solve(SUNNonlinearSolver solver, N_Vector predicted, N_Vector correction,
                             N_Vector, double, booleantype, void* cvode) {
  auto& self = *static_cast<SensitivitySolver*>(solver->content);
  const int n = self.n_, states = self.states_;
  double t, gamma, rl1;
  N_Vector prediction, state, rate, history;
  N_Vector *predictions, *sensitivities, *histories;
  void* user;
  int which = 0;
  CVodeGetNonlinearSystemData(cvode, &t, &prediction, &state, &rate, &gamma, &rl1, &history, &user);
  CVodeGetNonlinearSystemDataSens(cvode, &t, &predictions, &sensitivities, &gamma, &rl1, &histories,
                                  &user);
  CVodeGetCurrentSensSolveIndex(cvode, &which);

  const double *q = elements(state), *v = q + n, *z = v + n;
  const catena_point at = self.dynamics_.at(t, q, v, self.step_solver_.acceleration(), z);
  if (which == 0) {
    ++self.factorisations_;
    if (self.matrix_.factor(self.dynamics_, at, gamma) != 0) {
      self.step_solver_.forget_factors();
      return SUN_NLS_CONV_RECVR;
    }
    self.step_solver_.factors_renewed(gamma);
  }

  const double *sq = elements(predicted), *sv = sq + n, *sz = sv + n;
  const double* past_q = elements(histories[which]);
  const double *past_v = past_q + n, *past_z = past_v + n;
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    self.dq_[k] = sq[i] + (gamma * sv[i] - rl1 * past_q[i]);
    self.dv_[k] = sv[i];
    self.da_[k] = rl1 * past_v[i] / gamma;
  }
  for (int i = 0; i < states; ++i) self.dz_[static_cast<std::size_t>(i)] = sz[i];
  const catena_point along{0.0,
                           self.dq_.data(),
                           self.dv_.data(),
                           self.da_.data(),
                           self.dz_.data(),
                           self.dynamics_.zero(),
                           self.seeds_[static_cast<std::size_t>(which)].parameters.data()};
  double* const change = self.change_.data();
  self.dynamics_.table().residual_tangent(&at, &along, change);
  for (int i = 0; i < n; ++i) change[i] *= -gamma;
  if (states > 0) {
    self.dynamics_.table().state_rate_tangent(&at, &along, change + n);
    for (int i = 0; i < states; ++i) change[n + i] = gamma * change[n + i] - rl1 * past_z[i];
  }
  self.matrix_.solve(change);

  double* const e = elements(correction);
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(change[i])) return SUN_NLS_CONV_RECVR;
    e[n + i] = change[i];
    e[i] = gamma * (sv[i] + change[i]) - rl1 * past_q[i];
  }
  for (int i = n; i < n + states; ++i) e[n + i] = change[i];
  return SUN_NLS_SUCCESS;
}

}  // namespace catena
