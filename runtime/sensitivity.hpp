// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "runtime/simulation.hpp"

namespace catena {

/// One direction in the space of parameters and initial states: d(parameters), dq(0), dv(0), dz(0),
/// with the sizes of the model. Zeros where nothing varies.
struct Seed {
  Eigen::VectorXd parameters;
  Eigen::VectorXd q, v, z;

  static Seed zero(const Model& model);
  /// Only the parameter of that index varies, at rate one.
  static Seed parameter(const Model& model, int index);
};

struct SensitiveSimulation : Simulation {
  /// Per seed the derivative of the trajectory along it: dq, dv, dz at the same times, no energies.
  std::vector<Trajectory> sensitivity;
};

/// simulate, and with it the derivative of the solution along each seed. Each step that is accepted
/// differentiates its own equations, with the Newton matrix at the solution: the result is the
/// derivative of the numbers that simulate gives at the same steps, to the tolerance of Newton's
/// iteration. Errors of the sensitivities do not choose the steps. The price is one
/// residual_tangent and one solve per seed and step, and one factorisation per step.
SensitiveSimulation simulate_with_sensitivities(
    const Model& model, const Eigen::VectorXd& parameters, const State& initial,
    const std::vector<Seed>& seeds, const std::vector<double>& times,
    const SimulationOptions& options = {}, const Signals& signals = {});

}  // namespace catena
