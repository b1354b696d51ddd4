// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/sensitivity.hpp"
#include "runtime/several.hpp"
#include "runtime/step_solver.hpp"

namespace catena {

/// The sensitivities along all seeds as one vector, which CVODES carries as one sensitivity:
/// CATENA_DIRECTIONS seeds make a block, in which each element of (sq, sv, sz) has that many
/// numbers side by side. The last block is filled with zeros.
///
/// The equations of a step, solved after StepSolver has solved for the state, are the linearisation
/// of the step's own equations: with (sq, sv, sz) the derivative of the state along a seed and a =
/// (e_v + rl1 zn1_v) / gamma as there, dr along (sq, sv, sa, sz, dp) = 0. The Newton matrix is
/// factored anew at the solution, once for all seeds; no iteration is needed.
class SensitivitySolver {
 public:
  SensitivitySolver(Dynamics& dynamics, NewtonMatrix& matrix, StepSolver& step_solver,
                    const std::vector<Seed>& seeds, SUNContext context);

  /// To be given to CVodeSetNonlinearSolverSensStg1; lives as long as this object.
  SUNNonlinearSolver handle() const { return handle_.get(); }

  /// Length of the vector.
  int size() const { return blocks_ * block_size(); }
  /// The vector at the start.
  void start(double* s) const;
  /// ds/dt at (t, y), where the accelerations are `a`. Returns 0, or the 1-based coordinate whose
  /// pivot vanished. The matrix has other factors afterwards.
  int rates(double t, const double* y, const double* a, const double* s, double* sdot);
  /// Element `element` of (q, v, z) along seed number `seed`, in such a vector.
  double element(const double* s, std::size_t seed, int element) const;

  long factorisations() const { return factorisations_; }

 private:
  static int solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction, N_Vector,
                   double, booleantype, void* cvode);
  int block_size() const { return CATENA_DIRECTIONS * dynamics_.size(); }
  const double* parameters(int block) const;

  Dynamics& dynamics_;
  NewtonMatrix& matrix_;
  StepSolver& step_solver_;
  const std::vector<Seed>& seeds_;
  SeveralTangents tangents_;
  int blocks_;
  int n_, states_;                   // numbers of a block: of q, of z
  std::vector<Several> parameters_;  // of each block
  std::vector<Several> dq_, da_, zero_, change_;
  long factorisations_ = 0;
  SunNonlinearSolverHandle handle_;
};

}  // namespace catena
