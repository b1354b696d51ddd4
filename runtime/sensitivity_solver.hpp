// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/sensitivity.hpp"
#include "runtime/step_solver.hpp"

namespace catena {

/// Solves the equations of one step for one sensitivity, after StepSolver has solved for the state.
///
/// They are the linearisation of the step's own equations: with (sq, sv, sz) the derivative of the
/// state along a seed and a = (e_v + rl1 zn1_v) / gamma as there, dr along (sq, sv, sa, sz, dp) =
/// 0. The Newton matrix is factored anew at the solution, once for all seeds; no iteration is
/// needed.
class SensitivitySolver {
 public:
  SensitivitySolver(Dynamics& dynamics, NewtonMatrix& matrix, StepSolver& step_solver,
                    const std::vector<Seed>& seeds, SUNContext context);

  /// To be given to CVodeSetNonlinearSolverSensStg1; lives as long as this object.
  SUNNonlinearSolver handle() const { return handle_.get(); }

  long factorisations() const { return factorisations_; }

 private:
  static int solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction, N_Vector,
                   double, booleantype, void* cvode);

  Dynamics& dynamics_;
  NewtonMatrix& matrix_;
  StepSolver& step_solver_;
  const std::vector<Seed>& seeds_;
  int n_, states_;
  std::vector<double> dq_, dv_, da_, dz_, change_;
  long factorisations_ = 0;
  SunNonlinearSolverHandle handle_;
};

}  // namespace catena
