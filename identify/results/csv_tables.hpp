// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/fit/fit.hpp"
#include "identify/problem/evaluation.hpp"
#include "identify/problem/motion.hpp"

namespace catena {

// Results as CSV texts: a line of names, then rows of numbers with 17 digits. A value that is not
// there is an empty field.

/// time_s, side_i_m, down_i_m for the far end of each link i, side_load_m, down_load_m. 17 digits.
std::string positions_csv(const Motion& motion);
/// time_s, coordinates, their rates, extra states: theta_1_rad .. rate_1_rad_s ..
std::string angles_csv(const Model& model, const Motion& motion);
/// time_s, then moment_i_N_m of every joint, tension_i_N of every link, curvature_i_rad_m of every
/// joint: InternalForces.
std::string forces_csv(const Motion& motion);
/// time_s and every energy item in J.
std::string energy_csv(const Model& model, const Motion& motion);
/// time_s, the event's name, and whether its value rises through zero or falls.
std::string events_csv(const Motion& motion);

/// experiment, part, point, component, time_s, measured, simulated, residual (m or rad) of all
/// frames.
std::string residuals_csv(const Problem& problem, const Evaluation& evaluation);

/// step, error (in the case's measure; inf where the simulation failed) and the unknowns of every
/// evaluation of a fit, in their order.
std::string history_csv(const Problem& problem, const FitResult& fit);

}  // namespace catena
