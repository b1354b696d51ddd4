// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// Cases made from cases: with effects, with more links, with a freer start.

/// The case with every parameter of the candidates added as a free quantity, at its neutral or
/// default value, with its prior; phases and shapes are free only if `shapes`. The description is left as it is:
/// the model that has these effects is chosen where the problem is made (DiagnosisContext).
Case with_effects(const Case& the_case, const std::vector<Candidate>& candidates, bool shapes);

/// The case without the parameters of an effect, which then stays at its default.
Case without_effect(const Case& the_case, const std::string& id);

/// The same case with another number of links, all physical quantities kept: per-joint stiffness
/// and damping change with the spacing. Empty, with the reason in `why_not`, where links are real
/// parts (lengths, masses or angles given link by link) or something sits at a joint the other
/// chain has not.
std::optional<Case> with_links(const Case& the_case, int links, std::string& why_not);

/// The same case with a start that may bend more (`more_terms` further polynomials) and move
/// (`rate_terms` polynomials of the rates). Empty if the start is not a polynomial.
std::optional<Case> with_freer_start(const Case& the_case, int more_terms, int rate_terms);

/// Unknowns of `to` from those of `from` by name; coefficients of the start that are new are zero,
/// other new unknowns start as their case says.
Eigen::VectorXd transfer(const Problem& from, const Eigen::VectorXd& x, const Problem& to);

/// Place of an unknown by its name; -1 if there is none.
Eigen::Index unknown_index(const Problem& problem, const std::string& name);

}  // namespace catena
