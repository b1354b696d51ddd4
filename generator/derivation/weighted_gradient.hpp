// SPDX-License-Identifier: GPL-3.0-or-later
//
// The gradient of a sum of weighted expressions with respect to all their symbols, by reverse
// accumulation: each definition passes its derivative on to the symbols in its value. All
// derivatives together cost a small multiple of the expressions.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "generator/derivation/definitions.hpp"

namespace catena {

class WeightedGradient {
 public:
  /// `prefix` starts the names of the families it defines.
  WeightedGradient(Definitions& definitions, std::string prefix);

  /// Adds weight times expression to the sum. The expression belongs to link `link`.
  void add(const GiNaC::ex& expression, const GiNaC::ex& weight, int link);
  /// Computes the derivatives. Call it once, after the last add().
  void accumulate();
  /// The derivative of the sum with respect to a symbol, after accumulate().
  GiNaC::ex of(const GiNaC::ex& symbol) const;

 private:
  void pass_on(const GiNaC::ex& expression, const GiNaC::ex& arrived, int link);
  GiNaC::ex total(int number, const std::map<int, GiNaC::ex>& parts);

  Definitions& definitions_;
  std::string prefix_;
  // Number of a symbol -> link -> derivative that comes from there. The latest symbols come first,
  // since the users of a symbol come after it.
  std::map<int, std::map<int, GiNaC::ex>, std::greater<>> open_;
  std::map<int, GiNaC::ex> done_;
};

}  // namespace catena
