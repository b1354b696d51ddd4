// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "runtime/model.hpp"
#include "runtime/signals.hpp"
#include "runtime/state.hpp"
#include "runtime/status.hpp"
#include "runtime/trajectory.hpp"

namespace catena {

enum class LinearSolver {
  kAutomatic,   ///< structured where the model has it, else dense
  kStructured,  ///< the emitted factorisation, O(links)
  kDense,       ///< LU, O(links^3)
};

enum class Method {
  kBdf,    ///< implicit, order 1 to 5: the chain is stiff
  kAdams,  ///< implicit, order 1 to 12: for soft chains
};

struct SimulationOptions {
  double relative_tolerance = 1e-8;
  double absolute_tolerance_position = 1e-10;  ///< rad, and the units of further coordinates
  double absolute_tolerance_velocity = 1e-9;   ///< rad/s; also taken for extra states
  long max_steps = 1'000'000;
  LinearSolver linear_solver = LinearSolver::kAutomatic;
  Method method = Method::kBdf;
  bool energy = true;  ///< fill Trajectory::energy and energy_imbalance
  /// Asked after each step with the time reached (s); false stops with kInterrupted.
  std::function<bool(double t)> keep_going;
};

struct Statistics {
  long steps = 0;
  long residual_evaluations = 0;
  long jacobian_evaluations = 0;  ///< factorisations of the Newton matrix
  long newton_iterations = 0;
  long error_test_failures = 0;
  long newton_failures = 0;
  LinearSolver used = LinearSolver::kAutomatic;  ///< which of the two was used
  double cpu_seconds = 0.0;
};

struct Simulation {
  Status status = Status::kNotRun;
  /// Empty on success; else what failed, which state and when: "the error test fails with ever
  /// smaller steps for theta_7 at t = 1.23 s".
  std::string message;
  Trajectory trajectory;
  Statistics statistics;
  /// Largest |stored + dissipated - supplied - initial| over the output times, J. NaN if energies
  /// were not asked for.
  double energy_imbalance = 0.0;
};

/// Solves the equations of motion (3.4) from `initial` at times[0] with CVODES and reports the
/// state at every time (s, strictly increasing, at least one). The tolerances bound the error of
/// each step in the root-mean-square over the states of error / (relative * |state| + absolute).
/// Throws std::invalid_argument naming what is wrong with the arguments: sizes, values that are not
/// finite, parameters out of their bounds, tolerances not positive, signals missing or too short.
/// A failure on the way is a status, and the trajectory ends before it.
Simulation simulate(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                    const std::vector<double>& times, const SimulationOptions& options = {},
                    const Signals& signals = {});

/// simulate for many sets of parameters and starts, as many of each, on up to `threads` threads.
/// Result i is that of set i simulated alone, bit for bit (but for cpu_seconds). options.keep_going
/// is called from several threads. All sets are checked before the first is simulated; what is
/// thrown names the set.
std::vector<Simulation> simulate_sets(const Model& model,
                                      const std::vector<Eigen::VectorXd>& parameters,
                                      const std::vector<State>& initial,
                                      const std::vector<double>& times, int threads,
                                      const SimulationOptions& options = {},
                                      const Signals& signals = {});

}  // namespace catena
