// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <memory>
#include <string>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/syntax_tree.hpp"

namespace catena::checking {

/// What a hand derivation can state about the chain. kIdentity needs no chain.
enum class Quantity {
  kLagrangian,
  kKinetic,
  kPotential,
  kDissipation,
  kMass,
  kDamping,
  kStiffness,
  kCoriolis,
  kGravity,
  kEquation,
  kIdentity
};

/// The name of the quantity in a derivation: "M", "equation".
std::string name_of(Quantity quantity);

/// One statement to be checked, evaluated.
struct Entry {
  Quantity quantity = Quantity::kIdentity;
  int row = 0;                        ///< 1..n, where the quantity has rows
  int column = 0;                     ///< 1..n, where it has columns
  std::string label;                  ///< "M[1,2]", "equation 1" or the identity's own label
  GiNaC::ex value;                    ///< as derived by hand; left side of an equation or identity
  GiNaC::ex right = 0;                ///< right side of an equation or identity
  Location at;                        ///< where this value was assigned
  std::vector<Location> overwritten;  ///< where values were assigned before
};

/// A hand derivation after its loops and sums have been evaluated.
struct Derivation {
  std::unique_ptr<ChainSymbols> chain;  ///< null for a scalar derivation
  std::vector<Effect> effects;          ///< of the chain
  GiNaC::exmap given;                   ///< parameter -> value, holds on both sides
  std::vector<Entry> entries;           ///< in the order of Quantity, then of indices
  std::vector<std::string> notes;       ///< remarks that are not errors
};

}  // namespace catena::checking
