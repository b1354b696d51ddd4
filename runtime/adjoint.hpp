// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "runtime/sensitivity.hpp"

namespace catena {

/// A number J that depends on the motion at the output times, given by its derivatives: writes
/// dJ/dq, dJ/dv, dJ/dz at each time into q, v, z of `slope`. These have the sizes of the motion and
/// are zero when the function is called.
using MotionObjective = std::function<void(const Trajectory& motion, Trajectory& slope)>;

struct AdjointSimulation : Simulation {
  /// dJ with respect to every parameter and to the initial state.
  SensitivityDirection gradient;
};

/// simulate, and the gradient of J with respect to all parameters and the initial state. The
/// adjoint equations are integrated back from the last output time (CVODES, check points). With
/// (lambda_q, lambda_v, lambda_z) the derivative of J with respect to the state at t and M' mu =
/// lambda_v, they are
///     d(lambda_q)/dt = d(mu.r - lambda_z.f)/dq,
///     d(lambda_v)/dt = d(mu.r - lambda_z.f)/dv - lambda_q,
///     d(lambda_z)/dt = d(mu.r - lambda_z.f)/dz,
///     dJ/dp          = - integral of d(mu.r - lambda_z.f)/dp dt,
/// where r is the residual (3.4) and f the rates of z. At each output time lambda jumps by the
/// slope. The cost does not depend on the number of parameters. The error is of the order of the
/// tolerances.
///
///     // J: the last angle of a chain of 4 links at the last time
///     const auto last_angle = [](const Trajectory& motion, Trajectory& slope) {
///       slope.q(motion.q.rows() - 1, motion.q.cols() - 1) = 1.0;
///     };
///     const Model model = Model::built_in(4);
///     const Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.parameters(), 0.1);
///     State initial = State::zero(model);
///     initial.q.setConstant(0.6);  // rad
///     const AdjointSimulation run =
///         simulate_with_gradient(model, parameters, initial, {0.0, 1.0}, last_angle);
///     const double slope = run.gradient.parameters[model.parameter_index("stiffness_2")];
///
/// Arguments are those of simulate. Throws std::invalid_argument for what simulate refuses, and for
/// a slope that is not finite. If an integration fails, the status says so and the gradient is
/// zero.
AdjointSimulation simulate_with_gradient(const Model& model, const Eigen::VectorXd& parameters,
                                         const State& initial, const std::vector<double>& times,
                                         const MotionObjective& objective,
                                         const SimulationOptions& options = {},
                                         const Signals& signals = {});

}  // namespace catena
