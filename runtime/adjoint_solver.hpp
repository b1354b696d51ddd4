// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "runtime/adjoint.hpp"
#include "runtime/integrator.hpp"

namespace catena {

/// Integrates the adjoint equations (adjoint.hpp) from the last time back to the first, after an
/// Integrator that keeps check points has run. The equations are linear, so each step takes one
/// solution with the transpose of the Newton matrix.
class AdjointSolver {
 public:
  /// The arguments are those of `forward`, which must outlive it.
  AdjointSolver(Integrator& forward, const Model& model, const Eigen::VectorXd& parameters,
                const SimulationOptions& options, const Signals& signals);

  /// Writes result.gradient, or status and message if it fails.
  void run(const std::vector<double>& times, const Trajectory& slope, AdjointSimulation& result);

 private:
  static int solve(SUNNonlinearSolver self, N_Vector predicted, N_Vector correction, N_Vector,
                   double, booleantype, void* cvodes);
  static int rates(double t, N_Vector y, N_Vector lambda, N_Vector rate, void* self);
  static int parameter_rates(double t, N_Vector y, N_Vector lambda, N_Vector rate, void* self);

  void begin(double t, const Trajectory& slope);
  void add_slope(const Trajectory& slope, std::size_t column);
  bool evaluate(double t, N_Vector y, double gamma, double* right);

  void* cvodes_;
  SimulationOptions options_;
  Dynamics dynamics_;
  LinearSolver used_;
  std::unique_ptr<NewtonMatrix> matrix_;
  int n_, states_, which_ = 0;
  NVectorHandle motion_, lambda_, integral_;
  std::vector<double> a_, right_, minus_z_;
  std::vector<double> dq_, dv_, dz_, dp_;  // of mu.r - lambda_z.f at time_
  double time_;
  SunNonlinearSolverHandle handle_;
};

}  // namespace catena
