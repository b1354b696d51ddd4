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

struct SimulationOptions {
  double relative_tolerance = 1e-8;
  double absolute_tolerance_position = 1e-10;  ///< rad; units of the coordinates that effects add
  double absolute_tolerance_velocity = 1e-9;   ///< rad/s; also for extra states, in their units
  long max_steps = 1'000'000;
  LinearSolver linear_solver = LinearSolver::kAutomatic;
  /// With sensitivities: they are in the error test too, each with the relative tolerance of its
  /// state. Steps are then shorter.
  bool sensitivities_in_error_test = false;
  bool energy = true;  ///< compute Trajectory::energy and Simulation::energy_imbalance
  /// Steps end at the events of the model, which Simulation::events then lists, and begin anew there. Not in
  /// simulate_with_gradient.
  bool events = false;
  /// Called after each step with the time reached (s); false stops with kInterrupted.
  std::function<bool(double t)> keep_going;
};

struct Statistics {
  long steps = 0;
  long residual_evaluations = 0;
  long jacobian_evaluations = 0;  ///< factorisations of the Newton matrix
  long newton_iterations = 0;
  long error_test_failures = 0;
  long newton_failures = 0;
  LinearSolver used = LinearSolver::kAutomatic;  ///< kStructured or kDense, once run
  double cpu_seconds = 0.0;
};

/// One of the model's event values has changed its sign.
struct Event {
  double time = 0;      ///< s
  std::string name;     ///< as in the model's table: "sea_floor.touch_down_3"
  bool rising = false;  ///< from negative to positive
};

struct Simulation {
  Status status = Status::kNotRun;
  /// Empty on success; else what failed, in which state and when: "the error test fails however
  /// small the step: theta_7 at t = 1.23 s".
  std::string message;
  Trajectory trajectory;  ///< the output times; those before the failure if there was one
  Statistics statistics;
  std::vector<Event> events;  ///< by time; those up to the failure if there was one
  /// Largest |stored + dissipated - supplied - initial| over the output times, J. NaN if
  /// options.energy is false.
  double energy_imbalance = 0.0;
};

/// Solves the equations of motion (3.4) with CVODES.
///
///     const Model model = Model::built_in(4);
///     Eigen::VectorXd parameters(model.parameters());
///     parameters << Eigen::VectorXd::Constant(4, 0.25),    // length_1 .. length_4, m
///         Eigen::VectorXd::Constant(4, 0.03),              // mass_1 .., kg
///         Eigen::VectorXd::Constant(4, 1.6e-4),            // inertia_1 .., kg m^2
///         Eigen::VectorXd::Constant(4, 0.1),               // stiffness_1 .., N m/rad
///         Eigen::VectorXd::Constant(4, 1e-3),              // damping_1 .., N m s/rad
///         Eigen::VectorXd::Zero(4),                        // torque_1 .., N m
///         0.2, 9.81;                                       // load_mass, kg; gravity, m/s^2
///     const Simulation run = simulate(model, parameters, State::zero(model), {0.0, 0.5, 1.0});
///     if (run.status != Status::kSuccess) throw std::runtime_error(run.message);
///     const Eigen::VectorXd angles = run.trajectory.q.col(2);  // rad, at 1 s
///
/// `parameters`: one entry per parameter of the model, in the order of its table. `initial`: the
/// state at times[0]. `times`: s, strictly increasing, at least one; the state is reported at each.
/// `signals`: the channels that the model asks for, in its order, over all of `times`. The
/// tolerances bound the error of each step: the root mean square over the states of
/// error / (relative * |state| + absolute).
/// Throws std::invalid_argument that names the argument, its value and the rule: sizes, values that
/// are not finite, parameters out of their bounds, tolerances not positive, signals missing or too
/// short. A failure of the integration is not thrown but is the status of the result.
Simulation simulate(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                    const std::vector<double>& times, const SimulationOptions& options = {},
                    const Signals& signals = {});

/// simulate for parameters[i] and initial[i], i = 0, 1, ..., on up to `threads` threads. Returns
/// one result for each i: that of simulate, bit for bit, but for Statistics::cpu_seconds. Throws as
/// simulate does, before the first simulation, with a message that names i + 1, and if the numbers
/// of `parameters` and `initial` differ. options.keep_going is called from several threads.
std::vector<Simulation> simulate_batch(const Model& model,
                                       const std::vector<Eigen::VectorXd>& parameters,
                                       const std::vector<State>& initial,
                                       const std::vector<double>& times, int threads,
                                       const SimulationOptions& options = {},
                                       const Signals& signals = {});

}  // namespace catena
