// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cvodes/cvodes.h>

#include <limits>
#include <memory>
#include <vector>

#include "runtime/dynamics.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/own_nonlinear_solver.hpp"
#include "runtime/status.hpp"

namespace catena {

/// Solves the equations of one step of CVODES for a second-order system, in place of its general
/// nonlinear and linear solvers.
///
/// CVODES asks for the correction e of the prediction y_p with e + rl1 zn1 = gamma f(t, y_p + e),
/// where rl1 zn1 is its history and f the right-hand side. For y = (q, v, z) the rows of q give q
/// directly. In the other rows f is not needed: with a = (e_v + rl1 zn1_v) / gamma the equation for
/// v is the residual form of the equations of motion, r(t, q, v, a, z) = 0. An iteration of
/// Newton's method takes one residual and one solution, but no acceleration and no product with M.
///
/// For CVODES it is of the kind "fixed point", the kind that needs no linear solver of CVODES.
class StepSolver {
 public:
  /// All must outlive it.
  StepSolver(Dynamics& dynamics, NewtonMatrix& matrix, SUNContext context);

  /// For CVodeSetNonlinearSolver. Lives as long as this object.
  SUNNonlinearSolver handle() const { return handle_.get(); }

  /// Why the last step that failed did so: kNoConvergence, kNotFinite or kSingular, and in the
  /// equation of which element of (q, z), as its place in (q, v, z).
  struct Failure {
    Status status = Status::kSuccess;
    int element = 0;
    double t = 0.0;
  };
  /// Of the last step that failed.
  const Failure& failure() const { return failure_; }

  /// The time and accelerations of the step solved last.
  double time() const { return time_; }
  const double* acceleration() const { return a_.data(); }
  /// dz/dt there.
  const double* state_rate() const { return zdot_.data(); }

  /// Call it after the matrix was factored elsewhere for another purpose,
  void forget_factors() { factored_gamma_ = std::numeric_limits<double>::quiet_NaN(); }
  /// or this one, if it was factored at the solution of the last step.
  void factors_renewed(double gamma) {
    factored_gamma_ = gamma;
    steps_since_factored_ = 0;
  }

  /// Counted since the start.
  long residual_evaluations() const { return residual_evaluations_; }
  long factorisations() const { return factorisations_; }
  long iterations() const { return all_iterations_; }
  long failures() const { return all_failures_; }

 private:
  struct Step {  // of CVODES, for the step at hand
    double t, gamma, rl1;
    const double *predicted, *history, *weight;
    double* correction;
    double tolerance;
  };

  static int solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction,
                   N_Vector weight, double tolerance, booleantype, void* cvode);
  int solve(const Step& step);
  bool factors_are_old(double gamma) const;
  int factor(const Step& step);
  int iterate(const Step& step);
  void set_point(const Step& step);
  int farthest_from_met(const Step& step, const catena_point& at);
  int fail(Status status, int equation, double t);

  Dynamics& dynamics_;
  NewtonMatrix& matrix_;
  int n_, states_;
  std::vector<double> q_, v_, a_, z_, zdot_, change_;
  double factored_gamma_ = std::numeric_limits<double>::quiet_NaN();
  long steps_since_factored_ = 0;
  double rate_ = 1.0;  // by which an iteration shrinks the error
  Failure failure_;
  double time_ = std::numeric_limits<double>::quiet_NaN();
  long residual_evaluations_ = 0, factorisations_ = 0, all_iterations_ = 0, all_failures_ = 0;
  long iterations_ = 0;  // of the last solve
  SunNonlinearSolverHandle handle_;
};

}  // namespace catena
