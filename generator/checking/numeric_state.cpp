// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/numeric_state.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <random>
#include <sstream>
#include <utility>

#include "generator/checking/expression_text.hpp"

namespace catena::checking {
namespace {

std::string name_of_symbol(const GiNaC::ex& symbol) {
  std::ostringstream text;
  text << symbol;
  return text.str();
}

}  // namespace

std::vector<GiNaC::ex> symbols_in(const std::vector<GiNaC::ex>& expressions) {
  std::map<SymbolOrder, GiNaC::ex> found;
  for (const GiNaC::ex& expression : expressions)
    for (GiNaC::const_preorder_iterator i = expression.preorder_begin();
         i != expression.preorder_end(); ++i)
      if (GiNaC::is_a<GiNaC::symbol>(*i)) found.emplace(SymbolOrder(name_of_symbol(*i)), *i);
  std::vector<GiNaC::ex> result;
  for (const auto& [order, symbol] : found) result.push_back(symbol);
  return result;
}

NumericState random_state(const std::vector<GiNaC::ex>& symbols, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  NumericState state;
  for (const GiNaC::ex& symbol : symbols) {
    const bool positive = symbol.info(GiNaC::info_flags::positive);
    // Hundredths; never 0, where too much is equal by accident.
    const int size = 10 + static_cast<int>(random() % 291U);
    const int hundredths = !positive && random() % 2U == 1U ? -size : size;
    state.values[symbol] = GiNaC::numeric(hundredths, 100);
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", hundredths / 100.0);
    state.assignments.push_back(name_of_symbol(symbol) + " = " + text);
  }
  return state;
}

std::optional<GiNaC::numeric> evaluate_at(const GiNaC::ex& expression, const NumericState& state) {
  GiNaC::Digits = kStateDigits;
  try {
    const GiNaC::ex value = expression.subs(state.values, GiNaC::subs_options::no_pattern).evalf();
    if (!GiNaC::is_a<GiNaC::numeric>(value)) return std::nullopt;
    const GiNaC::numeric number = GiNaC::ex_to<GiNaC::numeric>(value);
    if (!number.is_real()) return std::nullopt;
    return number;
  } catch (const std::exception&) {  // a pole at this state, or a domain left
    return std::nullopt;
  }
}

}  // namespace catena::checking
