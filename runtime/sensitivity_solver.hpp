// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/direction_batch.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/step_solver.hpp"

namespace catena {

/// The sensitivities along all directions as one vector, which CVODES treats as one sensitivity.
/// CATENA_DIRECTIONS directions make a batch, in which each element of (sq, sv, sz) has that many
/// numbers side by side. The last batch is filled with zeros.
///
/// The equations of a step are the linearised equations of StepSolver, solved after those for the
/// state: dr along (sq, sv, sa, sz, dp) = 0, where (sq, sv, sz) is the derivative of the state
/// along a direction and sa follows from a = (e_v + rl1 zn1_v) / gamma. The Newton matrix is
/// factored at the solution, once for all directions. No iteration is needed.
class SensitivitySolver {
 public:
  /// All must outlive it.
  SensitivitySolver(Dynamics& dynamics, NewtonMatrix& matrix, StepSolver& step_solver,
                    const std::vector<SensitivityDirection>& directions, SUNContext context);

  /// For CVodeSetNonlinearSolverSensStg1. Lives as long as this object.
  SUNNonlinearSolver handle() const { return handle_.get(); }

  /// Length of the vector.
  int size() const { return batches_ * batch_size(); }
  /// The vector at the start.
  void start(double* s) const;
  /// ds/dt at (t, y), where the accelerations are `a`. Returns 0, or the 1-based coordinate whose
  /// pivot vanished. The matrix has other factors afterwards.
  int rates(double t, const double* y, const double* a, const double* s, double* sdot);
  /// 1 / (relative tolerance * |s| + absolute tolerance / p) for every number s of such a vector, p
  /// what the direction's variable has to change by for parameters to change by themselves or
  /// states by 1. A direction has one such p, whichever is the least. The norm with these weights
  /// is the root mean square over the directions.
  void error_weights(const double* s, const SimulationOptions& options, double* weight) const;
  /// Element `element` of (q, v, z) along direction number `direction`, from 0, in such a vector.
  double element(const double* s, std::size_t direction, int element) const;

  /// Of the Newton matrix, made here.
  long factorisations() const { return factorisations_; }

 private:
  static int solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction, N_Vector,
                   double, booleantype, void* cvode);
  int batch_size() const { return CATENA_DIRECTIONS * dynamics_.size(); }
  const double* parameters(int batch) const;

  Dynamics& dynamics_;
  NewtonMatrix& matrix_;
  StepSolver& step_solver_;
  const std::vector<SensitivityDirection>& directions_;
  BatchTangents tangents_;
  int batches_;
  int n_, states_;                          // numbers of a batch: of q, of z
  std::vector<DirectionBatch> parameters_;  // of each batch
  std::vector<double> changes_;             // 1 / p of each direction, see error_weights
  std::vector<DirectionBatch> dq_, da_, zero_, change_;
  long factorisations_ = 0;
  SunNonlinearSolverHandle handle_;
};

}  // namespace catena
