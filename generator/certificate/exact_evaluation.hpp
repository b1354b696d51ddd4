// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <functional>
#include <map>
#include <string>

#include "description/description.hpp"
#include "generator/derivation/definitions.hpp"

namespace catena {

/// Values of the definitions of a derivation at one point, with GiNaC::Digits digits. They are
/// computed from the definitions, not from emitted text.
class ExactEvaluation {
 public:
  /// Returns the value of an input, "theta[2]" or "load_mass". It is not called for "pi".
  using Inputs = std::function<GiNaC::ex(const std::string& name)>;

  /// `definitions` must outlive it.
  ExactEvaluation(const Definitions& definitions, Inputs inputs);

  /// Throws std::logic_error where it has no numeric value.
  GiNaC::numeric of(const GiNaC::ex& expression);

 private:
  const GiNaC::ex& of_symbol(int number);

  const Definitions& definitions_;
  Inputs inputs_;
  std::map<int, GiNaC::ex> known_;
};

/// "theta[2]", "load_mass": the name of a symbol.
std::string full_name(const Symbol& symbol);

}  // namespace catena
