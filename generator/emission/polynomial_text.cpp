// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/polynomial_text.hpp"

#include <algorithm>
#include <compare>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <vector>

namespace catena {

using GiNaC::ex;
using GiNaC::numeric;

OperationCount& OperationCount::operator+=(const OperationCount& other) {
  additions += other.additions;
  multiplications += other.multiplications;
  divisions += other.divisions;
  functions += other.functions;
  return *this;
}

namespace {

struct Key {
  int family_rank;
  int offset;  // index relative to the link; large for symbols of no link
  int number;
  auto operator<=>(const Key& other) const {
    return std::tie(family_rank, offset) <=> std::tie(other.family_rank, other.offset);
  }
  bool operator==(const Key& other) const { return (*this <=> other) == 0; }
};

struct Monomial {
  numeric coefficient = 1;
  std::map<Key, int> powers;
};
using Sum = std::vector<Monomial>;

class Writer {
 public:
  Writer(const Definitions& definitions, int link, const SymbolText& text, Language language,
         OperationCount& count)
      : definitions_(definitions), link_(link), text_(text), language_(language), count_(count) {}

  Sum read(const ex& e) const {
    Sum sum;
    if (GiNaC::is_a<GiNaC::add>(e)) {
      for (size_t i = 0; i < e.nops(); ++i) sum.push_back(read_product(e.op(i)));
    } else if (!e.is_zero()) {
      sum.push_back(read_product(e));
    }
    std::sort(sum.begin(), sum.end(),
              [](const Monomial& a, const Monomial& b) { return a.powers < b.powers; });
    return sum;
  }

  // A sum as text; `as_factor` asks for parentheses where there are several terms.
  std::string write(Sum sum, bool as_factor) {
    if (sum.empty()) return number_text(0);
    if (sum.size() == 1) return write_product(sum[0], "");
    // What all terms share stands in front.
    Monomial common = shared(sum);
    if (!common.powers.empty() || !common.coefficient.is_equal(1)) {
      for (Monomial& term : sum) divide(term, common);
      const std::string rest = write(std::move(sum), true);
      return write_product(common, rest);
    }
    std::string text = write_terms(std::move(sum));
    return as_factor ? "(" + text + ")" : text;
  }

 private:
  Key key(int number) const {
    const Symbol& symbol = definitions_[number];
    return {symbol.family_rank, symbol.index == kNoIndex ? 1'000'000 : symbol.index - link_,
            number};
  }

  Monomial read_product(const ex& e) const {
    Monomial monomial;
    const auto factor = [&](const ex& f) {
      if (GiNaC::is_a<numeric>(f)) {
        monomial.coefficient = monomial.coefficient * GiNaC::ex_to<numeric>(f);
      } else if (GiNaC::is_a<GiNaC::symbol>(f)) {
        monomial.powers[key(definitions_.number_of(f))] += 1;
      } else if (GiNaC::is_a<GiNaC::power>(f) && GiNaC::is_a<GiNaC::symbol>(f.op(0)) &&
                 f.op(1).info(GiNaC::info_flags::integer)) {
        monomial.powers[key(definitions_.number_of(f.op(0)))] +=
            GiNaC::ex_to<numeric>(f.op(1)).to_int();
      } else {
        std::ostringstream what;
        what << "not a polynomial in symbols: " << f;
        throw std::logic_error(what.str());
      }
    };
    if (GiNaC::is_a<GiNaC::mul>(e)) {
      for (size_t i = 0; i < e.nops(); ++i) factor(e.op(i));
    } else {
      factor(e);
    }
    return monomial;
  }

  static Monomial shared(const Sum& sum) {
    Monomial common = sum[0];
    common.coefficient = GiNaC::abs(common.coefficient);
    bool all_negative = true;
    for (const Monomial& term : sum) {
      all_negative = all_negative && term.coefficient.is_negative();
      if (!GiNaC::abs(term.coefficient).is_equal(common.coefficient)) common.coefficient = 1;
      for (auto it = common.powers.begin(); it != common.powers.end();) {
        const auto found = term.powers.find(it->first);
        const int power = found == term.powers.end() ? 0 : found->second;
        // Only what all have with the same sign of the exponent is shared.
        if (power > 0 && it->second > 0) {
          it->second = std::min(it->second, power);
        } else if (power < 0 && it->second < 0) {
          it->second = std::max(it->second, power);
        } else {
          it->second = 0;
        }
        it = it->second == 0 ? common.powers.erase(it) : std::next(it);
      }
    }
    if (all_negative) common.coefficient = -common.coefficient;
    return common;
  }

  static void divide(Monomial& term, const Monomial& by) {
    term.coefficient = term.coefficient / by.coefficient;
    for (const auto& [key, power] : by.powers) {
      int& left = term.powers[key];
      left -= power;
      if (left == 0) term.powers.erase(key);
    }
  }

  // Terms without a common factor: the symbol that most of them have is drawn out of those.
  std::string write_terms(Sum sum) {
    std::map<Key, int> occurrences;
    for (const Monomial& term : sum) {
      for (const auto& [key, power] : term.powers) {
        if (power > 0) ++occurrences[key];
      }
    }
    const Key* best = nullptr;
    int most = 1;
    for (const auto& [key, times] : occurrences) {
      if (times > most) {
        most = times;
        best = &key;
      }
    }
    if (best != nullptr) {
      Sum with, without;
      for (Monomial& term : sum) {
        const auto found = term.powers.find(*best);
        (found != term.powers.end() && found->second > 0 ? with : without)
            .push_back(std::move(term));
      }
      std::string text = write(std::move(without), false);
      std::string drawn = write(std::move(with), false);
      ++count_.additions;
      // A leading minus becomes a difference.
      if (text[0] == '-') std::swap(text, drawn);
      return drawn[0] == '-' ? text + " - " + drawn.substr(1) : text + " + " + drawn;
    }
    // A positive term first, so that no text begins with a minus needlessly.
    const auto positive = std::find_if(
        sum.begin(), sum.end(), [](const Monomial& m) { return m.coefficient.is_positive(); });
    if (positive != sum.end()) std::rotate(sum.begin(), positive, positive + 1);
    std::string text;
    for (const Monomial& term : sum) {
      std::string product = write_product(term, "");
      if (text.empty()) {
        text = product;
        continue;
      }
      ++count_.additions;
      text += product[0] == '-' ? " - " + product.substr(1) : " + " + product;
    }
    return text;
  }

  std::string number_text(const numeric& value) const {
    if (!value.is_rational()) throw std::logic_error("numbers in equations must be rational");
    if (language_ == Language::kC) {
      if (value.is_integer()) return integer_text(value);
      return "(" + integer_text(value.numer()) + " / " + integer_text(value.denom()) + ")";
    }
    if (value.is_integer()) return "T(" + integer_text(value) + ")";
    return "ratio<T>(" + integer_text(value.numer()) + ", " + integer_text(value.denom()) + ")";
  }

  // What an int may not hold is written as a double literal: the nearest double either way.
  std::string integer_text(const numeric& value) const {
    std::ostringstream out;
    if (GiNaC::abs(value) < numeric(1'000'000'000)) {
      out << value;
      if (language_ == Language::kC) out << ".0";
    } else {
      out.precision(17);
      out << std::scientific << value.to_double();
    }
    return out.str();
  }

  std::string write_product(const Monomial& monomial, const std::string& last_factor) {
    std::vector<std::string> above, below;
    const bool negative = monomial.coefficient.is_negative();
    const numeric size = GiNaC::abs(monomial.coefficient);
    if (!size.is_equal(1)) above.push_back(number_text(size));
    for (const auto& [key, power] : monomial.powers) {
      const std::string text = text_(key.number);
      for (int k = 0; k < std::abs(power); ++k) (power > 0 ? above : below).push_back(text);
    }
    if (!last_factor.empty()) above.push_back(last_factor);
    if (above.empty()) above.push_back(number_text(1));
    std::string text;
    for (const std::string& factor : above) text += (text.empty() ? "" : " * ") + factor;
    count_.multiplications += static_cast<long>(above.size()) - 1;
    if (!below.empty()) {
      std::string divisor;
      for (const std::string& factor : below) divisor += (divisor.empty() ? "" : " * ") + factor;
      count_.multiplications += static_cast<long>(below.size()) - 1;
      ++count_.divisions;
      text += below.size() == 1 ? " / " + divisor : " / (" + divisor + ")";
    }
    return negative ? "-" + text : text;
  }

  const Definitions& definitions_;
  int link_;
  const SymbolText& text_;
  Language language_;
  OperationCount& count_;
};

}  // namespace

std::string expression_text(const Definitions& definitions, const ex& expression, int link,
                            const SymbolText& symbol_text, Language language,
                            OperationCount* count) {
  OperationCount unasked;
  OperationCount& operations = count == nullptr ? unasked : *count;
  if (GiNaC::is_a<GiNaC::function>(expression)) {
    ++operations.functions;
    return GiNaC::ex_to<GiNaC::function>(expression).get_name() + "(" +
           symbol_text(definitions.number_of(expression.op(0))) + ")";
  }
  if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(1).is_equal(numeric(1, 2))) {
    ++operations.functions;
    return "sqrt(" + symbol_text(definitions.number_of(expression.op(0))) + ")";
  }
  Writer writer(definitions, link, symbol_text, language, operations);
  return writer.write(writer.read(expression), false);
}

}  // namespace catena
