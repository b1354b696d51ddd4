// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cvodes/cvodes.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "runtime/dynamics.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/sensitivity_solver.hpp"
#include "runtime/state_vector.hpp"
#include "runtime/step_solver.hpp"

namespace catena {

struct SunContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct NVectorDeleter {
  void operator()(N_Vector vector) const { N_VDestroy(vector); }
};
struct CvodesDeleter {
  void operator()(void* cvodes) const { CVodeFree(&cvodes); }
};
using SunContextHandle = std::unique_ptr<std::remove_pointer_t<SUNContext>, SunContextDeleter>;
using NVectorHandle = std::unique_ptr<_generic_N_Vector, NVectorDeleter>;
using CvodesHandle = std::unique_ptr<void, CvodesDeleter>;

/// CVODES reports the arguments that we give it. Throws std::bad_alloc where it lacks memory, and
/// std::logic_error for all else, which is an error of this program.
void require(int flag, const char* call);

/// One run of CVODES on one model, from the initial state through all output times.
class Integrator {
 public:
  /// `start`: the time of `initial`, s. `signals` and `directions` must outlive it. Throws std::invalid_argument for a
  /// solver that the model does not have.
  Integrator(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
             double start, const SimulationOptions& options, const Signals& signals,
             const std::vector<SensitivityDirection>& directions);

  /// Writes `result`, whose sensitivity has one entry per direction.
  void run(const std::vector<double>& times, SensitiveSimulation& result);

  /// Call it before run: then check points are kept, from which AdjointSolver repeats the motion.
  void keep_check_points();
  /// For AdjointSolver.
  void* cvodes() const { return cvodes_.get(); }
  SUNContext context() const { return context_.get(); }

 private:
  static int rates(double t, N_Vector y, N_Vector ydot, void* self);
  static int powers(double t, N_Vector y, N_Vector power, void* self);
  static int sensitivity_rates(int count, double t, N_Vector y, N_Vector ydot, int which,
                               N_Vector s, N_Vector sdot, void* self, N_Vector, N_Vector);
  static int event_values(double t, N_Vector y, double* value, void* self);
  static int error_weights(N_Vector y, N_Vector weight, void* self);

  /// Checks a call with which CVODES makes vectors. Where memory was short, CVodeFree would free some of
  /// them twice: what CVODES has is given up instead.
  void require_made(int flag, const char* call);
  void start_quadratures();
  void start_sensitivities();
  void record_sensitivities(std::size_t column, const double* values,
                            SensitiveSimulation& result) const;
  int step(long number, double last, double& t);
  void record(double t, std::size_t column, SensitiveSimulation& result);
  void record_energy(double t, std::size_t column, SensitiveSimulation& result);
  void explain(int flag, double reached, SensitiveSimulation& result);
  void begin_anew(double t, SensitiveSimulation& result);
  void count_steps(SensitiveSimulation& result) const;
  void count(SensitiveSimulation& result) const;
  std::string name_of(int element) const;

  SimulationOptions options_;
  Dynamics dynamics_;
  int n_;
  LinearSolver used_ = LinearSolver::kAutomatic;
  SunContextHandle context_;
  std::unique_ptr<NewtonMatrix> matrix_;
  std::unique_ptr<StepSolver> step_solver_;
  std::vector<SensitivityDirection> directions_;
  std::unique_ptr<SensitivitySolver> sensitivity_solver_;
  NVectorHandle y_, output_, quadrature_;
  NVectorHandle sensitivities_, sensitivities_output_;
  std::vector<int> integrated_;  // energy items that are powers
  std::vector<double> energies_;
  std::vector<double> acceleration_;  // where a power depends on it
  StepSolver::Failure rates_failure_;
  bool keeps_check_points_ = false;
  CvodesHandle cvodes_;  // last: freed first
};

}  // namespace catena
