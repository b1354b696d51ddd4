// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// A simulation with the positions of its points: support, far end of each link, load, one row
/// each.
struct Motion {
  Simulation simulation;
  Eigen::MatrixXd side, down;  ///< (links + 2) x times, m
};

/// Simulates from `initial` at times[0], energies included.
Motion simulate_motion(const Model& model, const Eigen::VectorXd& parameters, const State& initial,
                       const std::vector<double>& times, const SimulationSpec& settings,
                       const Signals& signals, const std::function<bool()>& keep_going = {});

/// One experiment at its frames (from its start on), with the unknowns x.
Motion motion_of(const Problem& problem, const Eigen::VectorXd& x, int experiment,
                 const std::function<bool()>& keep_going = {});

/// time_s, side_i_m, down_i_m for the far end of each link i, side_load_m, down_load_m. 17 digits.
std::string positions_csv(const Motion& motion);
/// time_s, coordinates, their rates, extra states: theta_1_rad .. rate_1_rad_s ..
std::string angles_csv(const Model& model, const Motion& motion);
/// time_s and every energy item in J.
std::string energy_csv(const Model& model, const Motion& motion);

/// experiment, part, point, component, time_s, measured, simulated, residual (m or rad) of all
/// frames.
std::string residuals_csv(const Problem& problem, const Evaluation& evaluation);

/// step, error (in the case's measure; inf where the simulation failed) and the unknowns of every
/// evaluation of a fit, in their order.
std::string history_csv(const Problem& problem, const FitResult& fit);

}  // namespace catena
