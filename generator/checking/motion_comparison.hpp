// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>

#include "generator/checking/chain_motion.hpp"
#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/comparison.hpp"

namespace catena::checking {

/// Compares an expression that should be thetaddot_k (or 0, if k = 0) with the chain's motion. Adds
/// to `finding` a state where they differ, both values there and the source of the difference; or a
/// remark if they differ at no state.
void compare_with_motion(const GiNaC::ex& expression, int k, ChainMotion& motion,
                         const ChainSymbols& chain, std::uint64_t seed, Finding& finding);

}  // namespace catena::checking
