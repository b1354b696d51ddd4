// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/flat_derivation.hpp"
#include "generator/checking/normal_form.hpp"

namespace catena::checking {

/// The sources of a difference (by hand minus model), one sentence each: which of the model's
/// `parts` are missing, have the wrong sign or factor, or differ otherwise. Every term of the
/// chain's equations is linear in exactly one mass, inertia, stiffness, damping or torque, which is
/// its source. Other terms are reported as belonging to no source.
std::vector<std::string> origins_of(const Fraction& difference, const Contributions& parts,
                                    const ChainSymbols& chain, NormalForm& form);

}  // namespace catena::checking
