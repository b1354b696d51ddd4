// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expressions without definitions, for exact comparisons.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <set>
#include <string>
#include <utility>

#include "generator/derivation/definitions.hpp"

namespace catena {

/// Replaces every definition by its value and expands, but for those of the families `kept`. Functions
/// of inputs stay functions.
class WrittenOut {
 public:
  explicit WrittenOut(const Definitions& definitions, std::set<std::string> kept = {})
      : definitions_(definitions), kept_(std::move(kept)) {}
  /// In inputs and in symbols of the families kept.
  GiNaC::ex of(const GiNaC::ex& expression);

 private:
  GiNaC::ex of_symbol(int number);

  const Definitions& definitions_;
  std::set<std::string> kept_;
  std::map<int, GiNaC::ex> known_;
};

/// cos(a - b) -> cos a cos b + sin a sin b, and sin(a - b), for arguments that are symbols or
/// differences of two.
struct WriteOutDifferences : GiNaC::map_function {
  GiNaC::ex operator()(const GiNaC::ex& expression) override;
};

/// sin(x)^2 -> 1 - cos(x)^2, also in higher powers; expanded.
GiNaC::ex without_sine_squares(const GiNaC::ex& expression);

}  // namespace catena
