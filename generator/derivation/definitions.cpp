// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/definitions.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace catena {

using GiNaC::ex;

namespace {

// A symbol with its number. A table from symbols to numbers instead took a fifth of the time of the
// derivation of a long chain.
class NumberedSymbol : public GiNaC::realsymbol {
 public:
  NumberedSymbol(const std::string& name, int number) : realsymbol(name), number_(number) {}
  NumberedSymbol* duplicate() const override {
    auto* copy = new NumberedSymbol(*this);
    copy->setflag(GiNaC::status_flags::dynallocated);
    return copy;
  }
  int number() const { return number_; }

 private:
  int number_;
};

std::string full_name(const std::string& family, int index) {
  return index == kNoIndex ? family : family + "[" + std::to_string(index) + "]";
}

template <class Visit>
void for_each_symbol(const ex& e, const Visit& visit) {
  if (GiNaC::is_a<GiNaC::symbol>(e)) return visit(e);
  for (size_t i = 0; i < e.nops(); ++i) for_each_symbol(e.op(i), visit);
}

bool is_polynomial_in_symbols(const ex& e) {
  if (GiNaC::is_a<GiNaC::numeric>(e) || GiNaC::is_a<GiNaC::symbol>(e)) return true;
  if (GiNaC::is_a<GiNaC::power>(e)) {
    return GiNaC::is_a<GiNaC::symbol>(e.op(0)) && e.op(1).info(GiNaC::info_flags::integer);
  }
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    for (size_t i = 0; i < e.nops(); ++i) {
      if (!is_polynomial_in_symbols(e.op(i))) return false;
    }
    return true;
  }
  return false;
}

// Text that does not depend on GiNaC's order of terms.
std::string structural_key(const ex& e) {
  std::ostringstream out;
  if (GiNaC::is_a<GiNaC::numeric>(e)) {
    out << e;
  } else if (GiNaC::is_a<GiNaC::symbol>(e)) {
    out << GiNaC::ex_to<GiNaC::symbol>(e).get_name();
  } else {
    std::vector<std::string> parts;
    for (size_t i = 0; i < e.nops(); ++i) parts.push_back(structural_key(e.op(i)));
    std::string head;
    if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
      std::sort(parts.begin(), parts.end());
      head = GiNaC::is_a<GiNaC::add>(e) ? "+" : "*";
    } else if (GiNaC::is_a<GiNaC::power>(e)) {
      head = "^";
    } else if (GiNaC::is_a<GiNaC::function>(e)) {
      head = GiNaC::ex_to<GiNaC::function>(e).get_name();
    } else if (e.nops() == 0) {  // constants such as Pi
      out << e;
      return out.str();
    } else {
      throw std::logic_error("structural_key: unexpected kind of expression");
    }
    out << head << '(';
    for (const auto& part : parts) out << part << ',';
    out << ')';
  }
  return out.str();
}

/// Calls make(n) for the symbol `number` and for all that it stands on, those first, where they are not in
/// `known`, to which make adds them. A chain of thousands of links makes a chain of thousands of
/// definitions, and a function that called itself along it would need as much stack.
template <class Make>
void in_order(const Definitions& definitions, int number, const std::map<int, ex>& known,
              const Make& make) {
  struct Waiting {
    int number;
    bool seen;  // what it stands on lies above it
  };
  std::vector<Waiting> waiting = {{number, false}};
  while (!waiting.empty()) {
    const auto [n, seen] = waiting.back();
    if (known.contains(n)) {
      waiting.pop_back();
    } else if (seen || definitions[n].is_input) {
      make(n);
      waiting.pop_back();
    } else {
      waiting.back().seen = true;
      const std::vector<int> below = definitions.symbols_of(definitions[n].value);
      for (auto it = below.rbegin(); it != below.rend(); ++it)
        if (!known.contains(*it)) waiting.push_back({*it, false});
    }
  }
}

}  // namespace

ex Definitions::make(const std::string& family, int index, bool is_input, const ex& value) {
  const auto rank = family_rank_.emplace(family, static_cast<int>(family_rank_.size()));
  const std::string name = full_name(family, index);
  const int number = size();
  if (!number_by_name_.emplace(name, number).second) {
    throw std::logic_error("defined twice: " + name);
  }
  symbols_.push_back(
      {family, index, rank.first->second, is_input, NumberedSymbol(name, number), value});
  return symbols_.back().symbol;
}

ex Definitions::input(const std::string& family, int index) {
  const auto found = number_by_name_.find(full_name(family, index));
  if (found != number_by_name_.end()) return (*this)[found->second].symbol;
  return make(family, index, true, ex(0));
}

std::string Definitions::unused_family(const std::string& wish, int index) const {
  if (!number_by_name_.count(full_name(wish, index))) return wish;
  for (int k = 2;; ++k) {
    const std::string name = wish + "_" + std::to_string(k);
    if (!number_by_name_.count(full_name(name, index))) return name;
  }
}

ex Definitions::name_of(const std::string& family, int index, const ex& value) {
  if (GiNaC::is_a<GiNaC::numeric>(value) || GiNaC::is_a<GiNaC::symbol>(value)) return value;
  const std::string key = canonical_key(value);
  const auto found = by_value_.find(key);
  if (found != by_value_.end()) return found->second;
  const ex symbol = make(unused_family(family, index), index, false, value);
  by_value_.emplace(key, symbol);
  return symbol;
}

// The arguments of functions and roots are symbols, even if the value is a number.
ex Definitions::symbol_of(const std::string& family, int index, const ex& value) {
  if (!GiNaC::is_a<GiNaC::numeric>(value)) return name_of(family, index, value);
  return make(unused_family(family, index), index, false, value);
}

ex Definitions::define(const std::string& family, int index, const ex& value) {
  if (GiNaC::is_a<GiNaC::function>(value) && GiNaC::is_a<GiNaC::symbol>(value.op(0))) {
    return name_of(family, index, value);
  }
  return name_of(family, index, named(value, family, index));
}

ex Definitions::define_always(const std::string& family, int index, const ex& value) {
  return make(family, index, false, named(value, family, index));
}

ex Definitions::named(const ex& expression, const std::string& family, int index) {
  const ex e = expression.expand();
  if (is_polynomial_in_symbols(e)) return e;
  if (GiNaC::is_a<GiNaC::add>(e) || GiNaC::is_a<GiNaC::mul>(e)) {
    std::vector<std::pair<std::string, ex>> parts;
    for (size_t i = 0; i < e.nops(); ++i) parts.emplace_back(structural_key(e.op(i)), e.op(i));
    std::sort(parts.begin(), parts.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    ex result = GiNaC::is_a<GiNaC::add>(e) ? 0 : 1;
    for (const auto& part : parts) {
      const ex operand = named(part.second, family, index);
      result = GiNaC::is_a<GiNaC::add>(e) ? result + operand : result * operand;
    }
    return result.expand();
  }
  if (GiNaC::is_a<GiNaC::power>(e)) {
    const ex exponent = e.op(1);
    if (!exponent.info(GiNaC::info_flags::rational)) {
      throw std::logic_error("exponents must be rational numbers: " + structural_key(e));
    }
    const ex base = named(e.op(0), family, index);
    if (exponent.info(GiNaC::info_flags::posint)) return GiNaC::pow(base, exponent).expand();
    if (exponent.info(GiNaC::info_flags::integer)) {
      return GiNaC::pow(name_of(family + "_divisor", index, base), exponent);
    }
    const ex radicand = symbol_of(family + "_radicand", index, base);
    if ((2 * exponent).info(GiNaC::info_flags::integer)) {
      return GiNaC::pow(name_of(family + "_root", index, GiNaC::sqrt(radicand)), 2 * exponent);
    }
    const ex logarithm = name_of(family + "_logarithm", index, GiNaC::log(radicand));
    const ex argument = name_of(family + "_exponent", index, exponent * logarithm);
    return name_of(family + "_power", index, GiNaC::exp(argument));
  }
  if (GiNaC::is_a<GiNaC::function>(e) && e.nops() == 1) {
    const auto& function = GiNaC::ex_to<GiNaC::function>(e);
    const ex argument = symbol_of(family + "_argument", index, named(e.op(0), family, index));
    const ex applied = GiNaC::function(function.get_serial(), argument);
    if (!GiNaC::is_a<GiNaC::function>(applied)) return named(applied, family, index);
    return name_of(family + "_" + function.get_name(), index, applied);
  }
  if (e.is_equal(GiNaC::Pi)) return input("pi");
  throw std::logic_error("cannot name " + structural_key(e));
}

std::vector<int> Definitions::symbols_of(const ex& expression) const {
  std::vector<int> numbers;
  for_each_symbol(expression, [&](const ex& symbol) { numbers.push_back(number_of(symbol)); });
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  return numbers;
}

int Definitions::number_of(const ex& symbol) const {
  const auto* numbered = dynamic_cast<const NumberedSymbol*>(&GiNaC::ex_to<GiNaC::basic>(symbol));
  if (numbered == nullptr || numbered->number() >= size() ||
      !(*this)[numbered->number()].symbol.is_equal(symbol)) {
    throw std::logic_error("not a symbol of these definitions: " + structural_key(symbol));
  }
  return numbered->number();
}

std::string Definitions::canonical_key(const ex& expression) const {
  return structural_key(expression);
}

Differential::Differential(Definitions& definitions, std::string (*family_name)(const std::string&))
    : definitions_(definitions), family_name_(family_name) {}

void Differential::set(const ex& symbol, const ex& differential) {
  known_[definitions_.number_of(symbol)] = differential;
}

ex Differential::of_symbol(int number) {
  in_order(definitions_, number, known_, [this](int n) {
    const Symbol symbol = definitions_[n];
    known_[n] = symbol.is_input ? ex(0)
                                : definitions_.define(family_name_(symbol.family), symbol.index,
                                                      of(symbol.value));
  });
  return known_.at(number);
}

ex Differential::of(const ex& expression) {
  ex sum = 0;
  for (const int number : definitions_.symbols_of(expression)) {
    const ex differential = of_symbol(number);
    if (differential.is_zero()) continue;
    const auto& symbol = GiNaC::ex_to<GiNaC::symbol>(definitions_[number].symbol);
    sum += expression.diff(symbol) * differential;
  }
  return sum.expand();
}

Substitution::Substitution(Definitions& definitions, std::string suffix)
    : definitions_(definitions), suffix_(std::move(suffix)) {}

void Substitution::set(const ex& symbol, const ex& replacement) {
  known_[definitions_.number_of(symbol)] = replacement;
}

ex Substitution::of_symbol(int number) {
  in_order(definitions_, number, known_, [this](int n) {
    const Symbol symbol = definitions_[n];
    const ex value = symbol.is_input ? symbol.symbol : of(symbol.value);
    const bool same = symbol.is_input || value.is_equal(symbol.value);
    known_[n] =
        same ? symbol.symbol : definitions_.define(symbol.family + suffix_, symbol.index, value);
  });
  return known_.at(number);
}

ex Substitution::of(const ex& expression) {
  GiNaC::exmap replacements;
  for (const int number : definitions_.symbols_of(expression)) {
    const ex replacement = of_symbol(number);
    const ex& symbol = definitions_[number].symbol;
    if (!replacement.is_equal(symbol)) replacements[symbol] = replacement;
  }
  if (replacements.empty()) return expression;
  return expression.subs(replacements, GiNaC::subs_options::no_pattern).expand();
}

}  // namespace catena
