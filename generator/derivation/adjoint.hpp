// SPDX-License-Identifier: GPL-3.0-or-later
//
// The gradient of a sum of weighted expressions with respect to everything they are made of, by
// reverse accumulation: each definition passes what arrives at it on to the symbols in its value,
// so that all derivatives together cost a small multiple of the expressions.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "generator/derivation/definitions.hpp"

namespace catena {

class Adjoint {
 public:
  /// `prefix` starts the names of the families it defines.
  Adjoint(Definitions& definitions, std::string prefix);

  /// Adds weight times expression, which belongs to a link, to the sum.
  void add(const GiNaC::ex& expression, const GiNaC::ex& weight, int link);
  /// Passes on everything added, once.
  void accumulate();
  /// The derivative of the sum with respect to a symbol, after accumulate().
  GiNaC::ex of(const GiNaC::ex& symbol) const;

 private:
  void pass_on(const GiNaC::ex& expression, const GiNaC::ex& arrived, int link);
  GiNaC::ex total(int number, const std::map<int, GiNaC::ex>& parts);

  Definitions& definitions_;
  std::string prefix_;
  // Number of a symbol -> link -> what arrives from there; the latest symbols first, since a
  // symbol's users come after it.
  std::map<int, std::map<int, GiNaC::ex>, std::greater<>> open_;
  std::map<int, GiNaC::ex> done_;
};

}  // namespace catena
