// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/expression_text.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <sstream>
#include <tuple>
#include <utility>

#include "generator/checking/budget.hpp"

namespace catena::checking {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr std::array<std::string_view, 11> kFamilies = {
    "g", "l", "m", "m_c", "I", "k", "c", "T", "theta", "thetadot", "thetaddot"};
constexpr int kFirstState = 8;

// Products of more sines and cosines than this stay products: they would become 2^k terms.
constexpr int kMostTrigonometricFactors = 6;

/// Symbols with their exponents, in reading order.
using Monomial = std::map<SymbolOrder, int>;

/// sin or cos of the sum of multiples (k_b / d_b) of basic angles; no angle: the number 1.
struct Wave {
  bool sine = false;
  std::map<std::string, numeric> angle;

  bool operator<(const Wave& other) const {
    if (sine != other.sine) return sine < other.sine;
    return std::lexicographical_compare(angle.begin(), angle.end(), other.angle.begin(),
                                        other.angle.end(), [](const auto& a, const auto& b) {
                                          return a.first != b.first
                                                     ? SymbolOrder(a.first) < SymbolOrder(b.first)
                                                     : a.second > b.second;
                                        });
  }
};

/// Makes the first multiple positive; sin(-a) = -sin(a). Drops angles with multiple 0.
void normalise(Wave& wave, numeric& factor) {
  std::erase_if(wave.angle, [](const auto& part) { return part.second.is_zero(); });
  if (wave.angle.empty()) {
    if (wave.sine) factor = 0;
    wave.sine = false;
    return;
  }
  const auto first = std::min_element(
      wave.angle.begin(), wave.angle.end(),
      [](const auto& a, const auto& b) { return SymbolOrder(a.first) < SymbolOrder(b.first); });
  if (!first->second.is_negative()) return;
  for (auto& part : wave.angle) part.second = -part.second;
  if (wave.sine) factor = -factor;
}

using Waves = std::map<Wave, numeric>;

/// 2 sin a cos b = sin(a+b) + sin(a-b), 2 cos a cos b = cos(a+b) + cos(a-b),
/// 2 cos a sin b = sin(a+b) - sin(a-b), 2 sin a sin b = cos(a-b) - cos(a+b).
Waves times(const Waves& waves, const Wave& factor) {
  Waves result;
  for (const auto& [wave, coefficient] : waves) {
    for (const bool plus : {true, false}) {
      Wave combined = wave;
      combined.sine = wave.sine != factor.sine;
      for (const auto& [angle, multiple] : factor.angle)
        combined.angle[angle] = combined.angle[angle] + (plus ? multiple : numeric(-1) * multiple);
      numeric value = coefficient / 2;
      if (factor.sine && plus == wave.sine) value = -value;
      normalise(combined, value);
      result[combined] = result[combined] + value;
    }
  }
  std::erase_if(result, [](const auto& part) { return part.second.is_zero(); });
  return result;
}

std::string power_text(const std::string& base, int exponent) {
  return exponent == 1 ? base : base + "^" + std::to_string(exponent);
}

/// numerator factors * ... / denominator factors, without the sign of the number.
std::string product_text(const numeric& number, std::vector<std::string> over,
                         std::vector<std::string> under) {
  const numeric size = GiNaC::abs(number);
  if (size.numer() != 1 || over.empty()) over.insert(over.begin(), text_of(size.numer()));
  if (size.denom() != 1) under.insert(under.begin(), text_of(size.denom()));
  std::string result;
  for (const std::string& factor : over) result += (result.empty() ? "" : "*") + factor;
  for (const std::string& factor : under) result += "/" + factor;
  return result;
}

void append(const Monomial& monomial, std::vector<std::string>& over,
            std::vector<std::string>& under) {
  for (const auto& [symbol, exponent] : monomial)
    (exponent > 0 ? over : under).push_back(power_text(symbol.name, std::abs(exponent)));
}

std::string signed_text(bool negative, const std::string& text) {
  return (negative ? "-" : "") + text;
}

/// e.g. theta_1 - theta_2/2
std::string angle_text(const Wave& wave) {
  std::vector<std::pair<SymbolOrder, numeric>> parts;
  for (const auto& [name, multiple] : wave.angle) parts.emplace_back(SymbolOrder(name), multiple);
  std::sort(parts.begin(), parts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> terms;
  for (const auto& [name, multiple] : parts)
    terms.push_back(signed_text(multiple.is_negative(), product_text(multiple, {name.name}, {})));
  return joined_by_signs(terms);
}

std::string wave_text(const Wave& wave) {
  return (wave.sine ? "sin(" : "cos(") + angle_text(wave) + ")";
}

/// The Laurent monomial `base` of an angle or exponential, times a number.
std::string base_text(const ex& base) {
  std::vector<std::string> over, under;
  Monomial monomial;
  const auto add = [&](const ex& factor) {
    const bool power = GiNaC::is_a<GiNaC::power>(factor);
    const ex symbol = power ? factor.op(0) : factor;
    std::ostringstream name;
    name << symbol;
    monomial[SymbolOrder(name.str())] += integer_exponent(factor);
  };
  if (GiNaC::is_a<GiNaC::mul>(base)) {
    for (const ex& factor : base) add(factor);
  } else {
    add(base);
  }
  append(monomial, over, under);
  return product_text(1, over, under);
}

/// A polynomial in parameters: numbers times Laurent monomials.
using ParameterSum = std::map<Monomial, numeric>;

/// The part common to all terms: least exponents and the greatest common number, with the sign of
/// the first term.
std::pair<numeric, Monomial> content(const ParameterSum& sum) {
  Monomial common = sum.begin()->first;
  numeric over = 0, under = 1;
  for (const auto& [monomial, number] : sum) {
    for (auto& [symbol, exponent] : common) {
      const auto found = monomial.find(symbol);
      exponent = std::min(exponent, found == monomial.end() ? 0 : found->second);
    }
    for (const auto& [symbol, exponent] : monomial)
      if (exponent < 0) common.try_emplace(symbol, exponent);
    over = GiNaC::gcd(over, number.numer());
    under = GiNaC::lcm(under, number.denom());
  }
  // A symbol seen with a negative exponent only later may be absent, hence 0, before.
  for (auto& [symbol, exponent] : common)
    for (const auto& term : sum) {
      const auto found = term.first.find(symbol);
      exponent = std::min(exponent, found == term.first.end() ? 0 : found->second);
    }
  std::erase_if(common, [](const auto& part) { return part.second == 0; });
  numeric number = GiNaC::abs(over) / under;
  if (sum.begin()->second.is_negative()) number = -number;
  return {number, common};
}

Monomial quotient(const Monomial& monomial, const Monomial& divisor) {
  Monomial result = monomial;
  for (const auto& [symbol, exponent] : divisor) result[symbol] -= exponent;
  std::erase_if(result, [](const auto& part) { return part.second == 0; });
  return result;
}

struct Part {
  Wave wave;
  Monomial state;
  bool operator<(const Part& other) const {
    return std::tie(state, wave) < std::tie(other.state, other.wave);
  }
};

class Reader {
 public:
  explicit Reader(const NormalForm& form) : form_(form) {}

  void add(const ex& expanded) {
    if (GiNaC::is_a<GiNaC::add>(expanded)) {
      for (const ex& term : expanded) add_term(term);
    } else if (!expanded.is_zero()) {
      add_term(expanded);
    }
  }

  std::vector<std::string> parts() const {
    std::vector<std::string> result;
    for (const auto& [part, sum] : parts_)
      if (!sum.empty()) result.push_back(text(part, sum));
    return result;
  }

 private:
  void add_term(const ex& term) {
    numeric number = 1;
    Monomial parameters, state;
    std::vector<std::pair<Wave, int>> factors;
    int trigonometric = 0;
    const auto add_factor = [&](const ex& factor) {
      if (GiNaC::is_a<numeric>(factor)) {
        number = number * GiNaC::ex_to<numeric>(factor);
        return;
      }
      const bool power =
          GiNaC::is_a<GiNaC::power>(factor) && factor.op(1).info(GiNaC::info_flags::integer);
      const ex symbol = power ? factor.op(0) : factor;
      const int exponent = integer_exponent(factor);
      const NormalForm::Generator generator = form_.generator(symbol);
      if (generator.role == NormalForm::Role::kSine ||
          generator.role == NormalForm::Role::kCosine) {
        Wave wave{generator.role == NormalForm::Role::kSine, {}};
        wave.angle[base_text(generator.base)] = numeric(1) / generator.divisor;
        factors.emplace_back(wave, exponent);
        trigonometric += std::abs(exponent);
        return;
      }
      SymbolOrder name = name_of(symbol, generator, exponent);
      const int shown = generator.role == NormalForm::Role::kExponential ? 1 : exponent;
      (name.is_state() ? state : parameters)[name] += shown;
    };
    if (GiNaC::is_a<GiNaC::mul>(term)) {
      for (const ex& factor : term) add_factor(factor);
    } else {
      add_factor(term);
    }

    Waves waves{{Wave{}, numeric(1)}};
    for (const auto& [wave, exponent] : factors) {
      if (trigonometric > kMostTrigonometricFactors || exponent < 0) {
        state[SymbolOrder(wave_text(wave))] += exponent;
      } else {
        for (int i = 0; i < exponent; ++i) waves = times(waves, wave);
      }
    }
    for (const auto& [wave, coefficient] : waves) {
      ParameterSum& sum = parts_[Part{wave, state}];
      numeric& entry = sum[parameters];
      entry = entry + coefficient * number;
      if (entry.is_zero()) sum.erase(parameters);
    }
  }

  static SymbolOrder name_of(const ex& symbol, const NormalForm::Generator& generator,
                             int exponent) {
    if (generator.role == NormalForm::Role::kExponential)
      return SymbolOrder("exp(" + exponent_text(generator, exponent) + ")");
    if (generator.role == NormalForm::Role::kOther) return SymbolOrder(generator.text);
    std::ostringstream name;
    name << symbol;
    return SymbolOrder(name.str());
  }

  static std::string exponent_text(const NormalForm::Generator& generator, int exponent) {
    const numeric multiple = numeric(exponent) / generator.divisor;
    return signed_text(multiple.is_negative(),
                       product_text(multiple, {base_text(generator.base)}, {}));
  }

  static std::string text(const Part& part, const ParameterSum& sum) {
    const auto [number, common] = content(sum);
    std::vector<std::string> over, under;
    append(common, over, under);
    if (sum.size() > 1) {
      std::vector<std::string> terms;
      for (const auto& [monomial, coefficient] : sum) {
        std::vector<std::string> inner_over, inner_under;
        append(quotient(monomial, common), inner_over, inner_under);
        const numeric relative = coefficient / number;
        terms.push_back(
            signed_text(relative.is_negative(), product_text(relative, inner_over, inner_under)));
      }
      over.push_back("(" + joined_by_signs(terms) + ")");
    }
    append(part.state, over, under);
    if (!part.wave.angle.empty()) over.push_back(wave_text(part.wave));
    return signed_text(number.is_negative(), product_text(number, over, under));
  }

  const NormalForm& form_;
  std::map<Part, ParameterSum> parts_;
};

}  // namespace

SymbolOrder::SymbolOrder(const std::string& the_name)
    : family(static_cast<int>(kFamilies.size())), name(the_name) {
  std::string base = name;
  const std::size_t split = name.rfind('_');
  const bool indexed = split != std::string::npos && split + 1 < name.size() &&
                       name.find_first_not_of("0123456789", split + 1) == std::string::npos &&
                       name.size() - split < 8;
  if (indexed) {
    base = name.substr(0, split);
    index = std::stoi(name.substr(split + 1));
  }
  for (std::size_t i = 0; i < kFamilies.size(); ++i)
    if (base == kFamilies[i]) family = static_cast<int>(i);
}

bool SymbolOrder::is_state() const { return family >= kFirstState; }

std::vector<std::string> readable_parts(const ex& numerator, const NormalForm& form) {
  Reader reader(form);
  reader.add(numerator);
  return reader.parts();
}

// Whether the bracket that opens the text closes at its end.
static bool is_in_brackets(const std::string& text) {
  if (text[0] != '(') return false;
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && --depth == 0) return i + 1 == text.size();
  }
  return false;
}

std::string text_of(const Fraction& fraction, const NormalForm& form) {
  const std::vector<std::string> numerator = readable_parts(fraction.numerator, form);
  if (numerator.empty()) return "0";
  const std::string over = joined_by_signs(numerator);
  if (fraction.denominator == 1) return over;
  const std::string under = joined_by_signs(readable_parts(fraction.denominator, form));
  return (numerator.size() == 1 ? over : "(" + over + ")") + "/" +
         (is_in_brackets(under) ? under : "(" + under + ")");
}

std::string text_of(const numeric& number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

std::string joined_by_signs(const std::vector<std::string>& parts) {
  std::string result;
  for (const std::string& part : parts) {
    if (result.empty()) {
      result = part;
    } else if (part[0] == '-') {
      result += " - " + part.substr(1);
    } else {
      result += " + " + part;
    }
  }
  return result;
}

}  // namespace catena::checking
