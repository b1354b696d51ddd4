// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/certificate/exact_evaluation.hpp"

#include <stdexcept>
#include <utility>

namespace catena {

using GiNaC::ex;

ExactEvaluation::ExactEvaluation(const Definitions& definitions, Inputs inputs)
    : definitions_(definitions), inputs_(std::move(inputs)) {}

GiNaC::numeric ExactEvaluation::of(const ex& expression) {
  GiNaC::exmap values;
  for (const int number : definitions_.symbols_of(expression)) {
    values[definitions_[number].symbol] = of_symbol(number);
  }
  const ex value = expression.subs(values, GiNaC::subs_options::no_pattern).evalf();
  if (!GiNaC::is_a<GiNaC::numeric>(value)) {
    throw std::logic_error("ExactEvaluation: an expression has no numeric value");
  }
  return GiNaC::ex_to<GiNaC::numeric>(value);
}

const ex& ExactEvaluation::of_symbol(int number) {
  const auto known = known_.find(number);
  if (known != known_.end()) return known->second;
  const Symbol symbol = definitions_[number];
  const ex value = !symbol.is_input        ? ex(of(symbol.value))
                   : symbol.family == "pi" ? ex(GiNaC::Pi.evalf())
                                           : ex(inputs_(full_name(symbol)).evalf());
  return known_[number] = value;
}

std::string full_name(const Symbol& symbol) {
  if (symbol.index == kNoIndex) return symbol.family;
  return symbol.family + "[" + std::to_string(symbol.index) + "]";
}

}  // namespace catena
