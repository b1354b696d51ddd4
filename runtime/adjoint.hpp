// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "runtime/sensitivity.hpp"

namespace catena {

/// What is differentiated: a number J that depends on the motion at the output times. Given the
/// motion, fills in dJ/dq, dJ/dv, dJ/dz at each of its times: q, v, z of `slope`, of the motion's
/// sizes and zero when called.
using MotionObjective = std::function<void(const Trajectory& motion, Trajectory& slope)>;

struct AdjointSimulation : Simulation {
  /// dJ with respect to every parameter and to the initial state.
  Seed gradient;
};

/// simulate, and with it the gradient of J with respect to all parameters and the initial state, by
/// integrating the adjoint equations back from the last output time (CVODES, check points). With
/// (lambda_q, lambda_v, lambda_z) the derivative of J with respect to the state at t and
/// M' mu = lambda_v,
///     d(lambda_q)/dt = d(mu.r - lambda_z.f)/dq,
///     d(lambda_v)/dt = d(mu.r - lambda_z.f)/dv - lambda_q,
///     d(lambda_z)/dt = d(mu.r - lambda_z.f)/dz,
///     dJ/dp          = - integral of d(mu.r - lambda_z.f)/dp dt,
/// r the residual (3.4), f the rates of z; lambda jumps by the slope at each output time. The price
/// does not depend on the number of parameters; the error is of the order of the tolerances.
/// An integration that fails is a status of the result, its gradient then zero.
/// Throws std::invalid_argument for what simulate refuses, and for a slope that is not finite.
AdjointSimulation simulate_with_gradient(const Model& model, const Eigen::VectorXd& parameters,
                                         const State& initial, const std::vector<double>& times,
                                         const MotionObjective& objective,
                                         const SimulationOptions& options = {},
                                         const Signals& signals = {});

}  // namespace catena
