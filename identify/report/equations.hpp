// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/results/result.hpp"

namespace catena::report {

using namespace results;

/// Formulas under one heading.
struct EquationGroup {
  std::string heading;
  std::vector<Formula> formulas;
};

/// What an effect adds to the equations: as the result says, else from the effect's text, else from
/// the built-in effect of that id; an effect known by none of these has a heading alone.
EquationGroup formulas_of(const EffectEntry& effect);

}  // namespace catena::report
