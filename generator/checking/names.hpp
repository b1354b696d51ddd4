// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "generator/checking/chain_symbols.hpp"
#include "generator/checking/derivation.hpp"

namespace catena::checking {

/// A quantity of the chain that a derivation may assign.
struct Target {
  std::string_view name;
  Quantity quantity;
  std::size_t indices;  ///< 2: matrix, 1: vector, 0: scalar
};
inline constexpr std::array<Target, 9> kTargets = {{{"L", Quantity::kLagrangian, 0},
                                                    {"T", Quantity::kKinetic, 0},
                                                    {"V", Quantity::kPotential, 0},
                                                    {"D", Quantity::kDissipation, 0},
                                                    {"M", Quantity::kMass, 2},
                                                    {"C", Quantity::kDamping, 2},
                                                    {"K", Quantity::kStiffness, 2},
                                                    {"F", Quantity::kCoriolis, 1},
                                                    {"G", Quantity::kGravity, 1}}};

/// The target of this name, or null.
const Target* target_named(const std::string& name);

/// theta, l, m, ...: the symbols of the chain that take one index.
using Family = std::vector<GiNaC::ex> ChainSymbols::*;
/// All of them by their names.
const std::map<std::string, Family>& families();

/// Whether this chain has symbols of that name: the plane has no phi.
bool is_family(const std::string& name, const ChainSymbols& chain);

/// sin, exp, ...: the functions of one argument.
using Function = GiNaC::ex (*)(const GiNaC::ex&);
/// All of them by their names.
const std::map<std::string, Function>& functions();

/// A name with the values of its subscripts.
struct Reference {
  std::string name;
  std::vector<int> indices;

  auto operator<=>(const Reference&) const = default;
  [[nodiscard]] std::string text() const;  ///< M[1,2]
};

}  // namespace catena::checking
