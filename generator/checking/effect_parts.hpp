// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "description/effect.hpp"
#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/contribution.hpp"

namespace catena::checking {

/// What effects add to the energies and equations of the plain chain, in the symbols of a derivation.
struct EffectParts {
  Contributions kinetic, potential, dissipation;  ///< J, J, W
  std::vector<Contributions> equation;            ///< 1..n, N m; 0 is not used
};

/// Derives the chain with the effects and without them: the difference is what they add. Each part
/// keeps the effect it comes from; what several effects add together counts as the last one's. Throws
/// InputError for an effect that needs what derivations have no symbols for: coordinates, states,
/// signals and the time.
EffectParts parts_of_effects(const std::vector<Effect>& effects, const ChainSymbols& symbols);

}  // namespace catena::checking
