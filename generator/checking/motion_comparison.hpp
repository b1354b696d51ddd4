// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <cstdint>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/comparison.hpp"
#include "generator/checking/motion.hpp"

namespace catena::checking {

/// What an expression that should be thetaddot_k (k = 0: that should be 0) comes to along the
/// chain's motion. Completes a finding with a state where it differs, both values there and where
/// the difference comes from; where none does, with a remark.
void compare_with_motion(const GiNaC::ex& expression, int k, Motion& motion,
                         const ChainSymbols& chain, std::uint64_t seed, Finding& finding);

}  // namespace catena::checking
