// SPDX-License-Identifier: GPL-3.0-or-later
//
// An equation of motion stated by hand may be one of the chain's equations r_j = 0, a sum of
// several, each times a factor, or the equations solved for an acceleration.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/flat_derivation.hpp"

namespace catena::checking {

/// divisor h = sum_j factor_j r_j, where h = 0 is the stated equation.
struct Combination {
  std::map<int, GiNaC::ex> factors;  ///< by number of the equation; those that are not zero
  GiNaC::ex divisor = 1;
};

/// Candidates for h, which the caller proves or refutes. The factors are found from symbols that
/// only r_j has (T_j, I_j thetaddot_j), from symbols that r_j and r_{j-1} share (c_j, k_j), and for
/// up to kMostSolvedLinks links from the accelerations, M f = dh/dthetaddot.
std::vector<Combination> possible_combinations(const GiNaC::ex& hand, const ChainSymbols& chain,
                                               const FlatDerivation& model);

/// With more links the determinant of M is too long for proofs.
inline constexpr int kMostSolvedLinks = 3;

}  // namespace catena::checking
