// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "identify/fit/fit.hpp"
#include "identify/fit/links_study.hpp"
#include "identify/problem/motion.hpp"
#include "identify/uncertainty/profile.hpp"
#include "identify/uncertainty/uncertainty.hpp"

namespace catena {

/// Short tables for the terminal. Lengths in mm, angles in mrad.

/// Steps, energy balance and where the load ended.
std::string simulation_table(const Motion& motion);

/// Gap of every experiment and part, after and (if given) before.
std::string gap_table(const Problem& problem, const Evaluation* before, const Evaluation& after);

/// "3.02 mm": an error in the case's measure.
std::string measured_error(const Problem& problem, double error);

/// Start and best value of every unknown of the physics and the sensors, with 95 % intervals.
std::string parameter_table(const Problem& problem, const FitResult& fit,
                            const std::optional<Uncertainty>& uncertainty);

/// What the data can and cannot determine.
std::string identifiability_table(const Problem& problem, const Uncertainty& uncertainty);

/// Verdicts of profiles.
std::string profile_table(const Problem& problem, const std::vector<Profile>& profiles);

/// One line per number of links: error, held-out error, parameters.
std::string links_table(const std::vector<LinksResult>& results);

/// Errors of a multi-start, best first.
std::string waterfall(const Problem& problem, const std::vector<FitResult>& starts);

}  // namespace catena
