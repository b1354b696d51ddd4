// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an equation of motion stated by hand may be: not only one of the chain's equations r_j = 0,
// but a sum of several, each times a factor, or the equations solved for an acceleration.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/flat_derivation.hpp"

namespace catena::checking {

/// divisor h = sum_j factor_j r_j, h being the stated equation with everything on its left side.
struct Combination {
  std::map<int, GiNaC::ex> factors;  ///< by number of the equation; those that are not zero
  GiNaC::ex divisor = 1;
};

/// What h may be, to be proved or refuted by the caller: read off where only r_j has a symbol (T_j,
/// I_j thetaddot_j), where r_j and r_{j-1} share it (c_j, k_j), and for up to kMostSolvedLinks
/// links from the accelerations, M f = dh/dthetaddot.
std::vector<Combination> possible_combinations(const GiNaC::ex& hand, const ChainSymbols& chain,
                                               const FlatDerivation& model);

/// More links make the determinant of M too long for proofs.
inline constexpr int kMostSolvedLinks = 3;

}  // namespace catena::checking
