// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/numeric_state.hpp"

#include <cstdio>
#include <map>
#include <random>
#include <sstream>
#include <stdexcept>

#include "generator/checking/budget.hpp"
#include "generator/checking/expression_text.hpp"
#include "generator/checking/shared_tree.hpp"

namespace catena::checking {
namespace {

std::string name_of_symbol(const GiNaC::ex& symbol) {
  std::ostringstream text;
  text << symbol;
  return text.str();
}

/// An operation with numbers of so many bits takes as long as one that is symbolic.
constexpr double kBitsPerOperation = 100;

/// The sine of a greater number would need as many digits of pi as the number has.
const GiNaC::numeric& greatest_argument() {
  static const GiNaC::numeric value = GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(1000));
  return value;
}

}  // namespace

const GiNaC::numeric& closeness() {
  static const GiNaC::numeric value = GiNaC::pow(GiNaC::numeric(10), GiNaC::numeric(-40));
  return value;
}

std::vector<GiNaC::ex> symbols_in(const std::vector<GiNaC::ex>& expressions) {
  std::map<SymbolOrder, GiNaC::ex> found;
  for (const GiNaC::ex& expression : expressions)
    for_each_part(expression, [&](const GiNaC::ex& part) {
      if (GiNaC::is_a<GiNaC::symbol>(part)) found.emplace(SymbolOrder(name_of_symbol(part)), part);
      return true;
    });
  std::vector<GiNaC::ex> result;
  for (const auto& [order, symbol] : found) result.push_back(symbol);
  return result;
}

NumericState random_state(const std::vector<GiNaC::ex>& symbols, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  NumericState state;
  for (const GiNaC::ex& symbol : symbols) {
    const bool positive = symbol.info(GiNaC::info_flags::positive);
    // Hundredths; never 0, where different expressions are often equal.
    const int size = 10 + static_cast<int>(random() % 291U);
    const int hundredths = !positive && random() % 2U == 1U ? -size : size;
    state.values[symbol] = GiNaC::numeric(hundredths, 100);
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", hundredths / 100.0);
    state.assignments.push_back(name_of_symbol(symbol) + " = " + text);
  }
  return state;
}

std::optional<GiNaC::numeric> Evaluation::operator()(const GiNaC::ex& expression) {
  GiNaC::Digits = kStateDigits;
  try {
    const GiNaC::numeric number = value_of(expression);
    if (!number.is_real()) return std::nullopt;
    return number;
  } catch (const std::exception&) {  // a pole at this state, or a domain left
    return std::nullopt;
  }
}

GiNaC::numeric Evaluation::value_of(const GiNaC::ex& e) {
  using GiNaC::ex_to, GiNaC::is_a, GiNaC::numeric;
  if (is_a<numeric>(e)) return ex_to<numeric>(e);
  const auto known = values_.find(e);
  if (known != values_.end()) return ex_to<numeric>(known->second);
  const auto spend_bits = [](double bits) { Budget::spend(1 + bits / kBitsPerOperation); };
  numeric result;
  if (is_a<GiNaC::add>(e)) {
    for (const GiNaC::ex& term : e) {
      result = result + value_of(term);
      spend_bits(bits_of(result));
    }
  } else if (is_a<GiNaC::mul>(e)) {
    result = 1;
    for (const GiNaC::ex& factor : e) {
      result = result * value_of(factor);
      spend_bits(bits_of(result));
    }
  } else if (is_a<GiNaC::power>(e) && e.op(1).info(GiNaC::info_flags::integer)) {
    const numeric base = value_of(e.op(0)), exponent = ex_to<numeric>(e.op(1));
    spend_bits(bits_of(base) * GiNaC::abs(exponent).to_double());
    result = GiNaC::pow(base, exponent);
  } else {  // a function, a root, pi
    GiNaC::exmap arguments;
    for (const GiNaC::ex& argument : e) {
      const numeric value = value_of(argument);
      if (GiNaC::abs(value) > greatest_argument()) throw std::domain_error("too great an argument");
      arguments[argument] = value;
    }
    const GiNaC::ex value = Replacement(arguments)(e).evalf();
    if (!is_a<numeric>(value)) throw std::domain_error("a symbol without a value");
    result = ex_to<numeric>(value);
  }
  values_[e] = result;
  return result;
}

std::optional<GiNaC::numeric> evaluate_at(const GiNaC::ex& expression, const NumericState& state) {
  const std::optional<GiNaC::numeric> value = Evaluation(state.values)(expression);
  if (!value) return std::nullopt;
  return GiNaC::ex_to<GiNaC::numeric>(GiNaC::ex(*value).evalf());
}

std::string twelve_digits(const GiNaC::numeric& value) {
  std::ostringstream text;
  text.precision(12);
  text << value.to_double();
  return text.str();
}

}  // namespace catena::checking
