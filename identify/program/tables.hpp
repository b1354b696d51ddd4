// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/fit.hpp"
#include "identify/motion.hpp"

namespace catena {

/// Short tables for the terminal. Lengths in mm, angles in mrad.

/// Steps, energy balance and where the load ended.
std::string simulation_table(const Motion& motion);

/// Gap of every experiment and part, after and (if given) before.
std::string gap_table(const Problem& problem, const Evaluation* before, const Evaluation& after);

/// "3.02 mm": an error in the case's measure.
std::string measured_error(const Problem& problem, double error);

/// Start and best value of every unknown of the physics and the sensors.
std::string parameter_table(const Problem& problem, const FitResult& fit);

}  // namespace catena
