// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expressions without definitions, for exact comparisons.
#pragma once

#include <ginac/ginac.h>

#include <map>

#include "generator/derivation/definitions.hpp"

namespace catena {

/// Replaces every definition by its value and expands. Functions of inputs stay functions.
class WrittenOut {
 public:
  explicit WrittenOut(const Definitions& definitions) : definitions_(definitions) {}
  GiNaC::ex of(const GiNaC::ex& expression);

 private:
  GiNaC::ex of_symbol(int number);

  const Definitions& definitions_;
  std::map<int, GiNaC::ex> known_;
};

/// sin(x)^2 -> 1 - cos(x)^2, expanded.
GiNaC::ex without_sine_squares(const GiNaC::ex& expression);

}  // namespace catena
