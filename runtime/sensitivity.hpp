// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/simulation.hpp"

namespace catena {

/// A direction in the space of parameters and initial states. Entries are derivatives by the
/// variable along the direction; all vectors have the sizes of the model.
struct SensitivityDirection {
  Eigen::VectorXd parameters;
  Eigen::VectorXd q, v, z;

  /// The direction along which nothing changes.
  static SensitivityDirection zero(const Model& model);
  /// The direction along which only the parameter number `index`, from 0, changes, with derivative
  /// 1.
  static SensitivityDirection parameter(const Model& model, int index);
};

struct SensitiveSimulation : Simulation {
  /// For each direction the derivative of the trajectory along it: dq, dv, dz at the same times,
  /// without energies.
  std::vector<Trajectory> sensitivity;
};

/// simulate, and the derivative of the solution along each direction. Each accepted step differentiates its
/// own equations, with the Newton matrix at the solution. The result is the derivative of what simulate gives
/// with the same steps, to the tolerance of Newton's iteration. The error test includes the sensitivities if
/// options.sensitivities_in_error_test says so; without, they were 5 to 26 times less accurate than with it,
/// in 0.5 to 1 of the time (docs/performance.md). The cost is one residual_tangent and one solution per
/// direction and step, and one factorisation per step.
///
///     const Model model = Model::built_in(4);
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.1);
///     State initial = State::zero(model);
///     initial.q.setConstant(0.6);  // rad
///     const auto stiffness =
///         SensitivityDirection::parameter(model, model.parameter_index("stiffness_1"));
///     const SensitiveSimulation run =
///         simulate_with_sensitivities(model, parameters, initial, {stiffness}, {0.0, 1.0});
///     const double derivative = run.sensitivity[0].q(3, 1);  // of angle 4 at 1 s, rad per N m/rad
///
/// Other arguments are those of simulate. Throws std::invalid_argument for what simulate refuses,
/// and for a direction of other sizes or with values that are not finite, with its number (from 1).
SensitiveSimulation simulate_with_sensitivities(
    const Model& model, const Eigen::VectorXd& parameters, const State& initial,
    const std::vector<SensitivityDirection>& directions, const std::vector<double>& times,
    const SimulationOptions& options = {}, const Signals& signals = {});

}  // namespace catena
