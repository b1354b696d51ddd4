// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/emission/latex_polynomial.hpp"

#include <algorithm>
#include <cctype>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "generator/emission/latex_monomials.hpp"

namespace catena {

using GiNaC::ex;
using GiNaC::numeric;

namespace {

constexpr std::size_t kLongestInside = 20;  // letters under a root or in a function

std::string with_power(const std::string& base, int power) {
  return power == 1 ? base : base + "^{" + std::to_string(power) + "}";
}

std::string indexed(const std::string& letter, int index, int power) {
  return with_power(letter + "_{" + std::to_string(index) + "}", power);
}

// A positive rational as LaTeX; whole powers of ten below one thousandth as such.
std::string number_text(const numeric& value) {
  const auto digits = [](const numeric& n) {
    std::ostringstream text;
    text << n;
    return text.str();
  };
  if (value.denom().is_equal(1)) return digits(value);
  const std::string below = digits(value.denom());
  if (value.numer().is_equal(1) && below.size() > 4 && below[0] == '1' &&
      below.find_first_not_of('0', 1) == std::string::npos) {
    return "10^{-" + std::to_string(below.size() - 1) + "}";
  }
  return "\\frac{" + digits(value.numer()) + "}{" + below + "}";
}

std::string in_parentheses(const std::string& text) { return "\\left(" + text + "\\right)"; }

std::string function_name(const ex& function) {
  static const std::map<std::string, std::string> names = {
      {"asinh", "\\operatorname{asinh}"}, {"atan", "\\arctan"}, {"log", "\\ln"}};
  const std::string name = GiNaC::ex_to<GiNaC::function>(function).get_name();
  const auto special = names.find(name);
  return special == names.end() ? "\\" + name : special->second;
}

std::string spaced(const std::string& a, const std::string& b) {
  return a.empty() || b.empty() ? a + b : a + " " + b;
}

}  // namespace

// One polynomial on its way to LaTeX.
class LatexTerms {
 public:
  LatexTerms(const LatexPolynomial& writer, const LatexStyle& style)
      : writer_(writer), style_(style) {}

  std::vector<LatexTerm> of(const ex& expanded) {
    read(expanded);
    combine_trigonometry(sum_);
    return style_.by_coefficient ? by_coefficient() : by_factor();
  }

 private:
  MonomialFactor factor_of(int number) const {
    static const std::map<std::string, Role> roles = {{"gravity", Role::kGravity},
                                                      {"length", Role::kLength},
                                                      {"cosine", Role::kCosine},
                                                      {"sine", Role::kSine},
                                                      {"theta", Role::kAngle},
                                                      {"theta_dot", Role::kRate},
                                                      {"theta_ddot", Role::kAcceleration},
                                                      {"mass", Role::kMass},
                                                      {"load_mass", Role::kLoadMass},
                                                      {"inertia", Role::kInertia},
                                                      {"stiffness", Role::kStiffness},
                                                      {"damping", Role::kDamping},
                                                      {"torque", Role::kTorque}};
    const Symbol& symbol = writer_.definitions_[number];
    const auto role = roles.find(symbol.family);
    const int index = symbol.index == kNoIndex ? 0 : symbol.index;
    if (role == roles.end()) return {Role::kOther, symbol.family_rank, index, number};
    return {role->second, index, 0, number};
  }

  void read(const ex& e) {
    if (GiNaC::is_a<GiNaC::add>(e)) {
      for (std::size_t i = 0; i < e.nops(); ++i) read_product(e.op(i));
    } else if (!e.is_zero()) {
      read_product(e);
    }
  }

  void read_product(const ex& e) {
    Powers powers;
    numeric coefficient = 1;
    const auto read_factor = [&](const ex& f) {
      if (GiNaC::is_a<numeric>(f)) {
        coefficient = coefficient * GiNaC::ex_to<numeric>(f);
      } else if (GiNaC::is_a<GiNaC::symbol>(f)) {
        powers[factor_of(writer_.definitions_.number_of(f))] += 1;
      } else if (GiNaC::is_a<GiNaC::power>(f) && GiNaC::is_a<GiNaC::symbol>(f.op(0)) &&
                 f.op(1).info(GiNaC::info_flags::integer)) {
        powers[factor_of(writer_.definitions_.number_of(f.op(0)))] +=
            GiNaC::ex_to<numeric>(f.op(1)).to_int();
      } else {
        throw std::logic_error("LatexPolynomial: not a polynomial in symbols");
      }
    };
    if (GiNaC::is_a<GiNaC::mul>(e)) {
      for (std::size_t i = 0; i < e.nops(); ++i) read_factor(e.op(i));
    } else {
      read_factor(e);
    }
    add_monomial(sum_, powers, coefficient);
  }

  static std::pair<Powers, Powers> split(const Powers& powers) {
    std::pair<Powers, Powers> parts;
    for (const auto& entry : powers) {
      (entry.first.is_coefficient() ? parts.first : parts.second).insert(entry);
    }
    return parts;
  }

  // Fewer lengths first: the links' own inertia, then squares, then products.
  auto rank(const Powers& powers) const {
    int lengths = 0;
    std::vector<int> links;
    for (const auto& [factor, power] : powers) {
      if (factor.role != Role::kLength) continue;
      lengths += links.empty() ? 1 : 2;
      links.push_back(factor.first);
    }
    return std::pair(style_.inertia_last ? -lengths : lengths, links);
  }

  std::vector<LatexTerm> by_factor() const {
    std::map<Powers, MonomialSum> groups;
    for (const auto& [powers, value] : sum_) {
      const auto [coefficients, rest] = split(powers);
      groups[rest][coefficients] = value;
    }
    std::vector<std::pair<Powers, MonomialSum>> ordered(groups.begin(), groups.end());
    std::stable_sort(ordered.begin(), ordered.end(),
                     [&](const auto& a, const auto& b) { return rank(a.first) < rank(b.first); });
    std::vector<LatexTerm> terms;
    for (const auto& [rest, coefficients] : ordered) terms.push_back(term(coefficients, rest));
    return terms;
  }

  std::vector<LatexTerm> by_coefficient() const {
    std::map<Powers, MonomialSum> groups;
    for (const auto& [powers, value] : sum_) {
      const auto [coefficients, rest] = split(powers);
      groups[coefficients][rest] = value;
    }
    std::vector<LatexTerm> terms;
    for (const auto& [coefficients, rests] : groups) {
      const Factored part = factored(rests);
      const std::string text = spaced(spaced(part.scale, factors(coefficients)), part.as_factor());
      terms.push_back({part.negative, text.empty() ? "1" : text});
    }
    return terms;
  }

  struct Factored {
    bool negative;
    std::string scale;  // "\frac{1}{2}", empty for one
    std::string sum;    // empty for one
    bool several;       // terms

    std::string as_factor() const { return several ? in_parentheses(sum) : sum; }
  };

  // A sum as sign, number and sum; the number leaves the largest coefficient at one. Leads: the
  // part with the link that the style names, or the first.
  Factored factored(const MonomialSum& sum) const {
    numeric largest = 0;
    std::vector<std::pair<Powers, numeric>> ordered(sum.begin(), sum.end());
    for (const auto& [powers, value] : sum) {
      if (GiNaC::abs(value) > largest) largest = GiNaC::abs(value);
    }
    std::stable_partition(ordered.begin(), ordered.end(), [&](const auto& part) {
      return !part.first.empty() && part.first.begin()->first.first == style_.leading_link;
    });
    const bool negative = ordered.front().second.is_negative();
    std::string text;
    for (const auto& [powers, value] : ordered) {
      const numeric part = (negative ? -value : value) / largest;
      const std::string size = with_number(GiNaC::abs(part), factors(powers));
      if (!text.empty()) text += part.is_negative() ? " - " : " + ";
      text += size;
    }
    const bool one = sum.size() == 1 && sum.begin()->first.empty();
    return {negative, largest.is_equal(1) ? "" : number_text(largest), one ? "" : text,
            sum.size() > 1};
  }

  // \frac{m_1}{4}, 2 m_1, m_1, 1
  static std::string with_number(const numeric& number, const std::string& factors) {
    if (factors.empty()) return number_text(number);
    if (number.is_equal(1)) return factors;
    if (number.denom().is_equal(1)) return number_text(number) + " " + factors;
    const std::string above =
        number.numer().is_equal(1) ? factors : number_text(number.numer()) + " " + factors;
    return "\\frac{" + above + "}{" + number_text(number.denom()) + "}";
  }

  LatexTerm term(const MonomialSum& coefficients, const Powers& rest) const {
    const Factored part = factored(coefficients);
    if (rest.empty() && !part.negative && part.scale.empty() && part.several)
      return {false, part.sum};
    Powers lengths, others;
    for (const auto& entry : rest) {
      const bool first =
          style_.order == LatexStyle::kLengthsFirst && entry.first.role == Role::kLength;
      (first ? lengths : others).insert(entry);
    }
    const std::string text =
        spaced(spaced(part.scale, factors(lengths)), spaced(part.as_factor(), factors(others)));
    return {part.negative, text.empty() ? "1" : text};
  }

  std::string factors(const Powers& powers) const {
    std::string above, below;
    for (const auto& [factor, power] : powers) {
      std::string& side = power > 0 ? above : below;
      side = spaced(side, factor_text(factor, std::abs(power)));
    }
    if (below.empty()) return above;
    return "\\frac{" + (above.empty() ? "1" : above) + "}{" + below + "}";
  }

  std::string factor_text(const MonomialFactor& factor, int power) const {
    const auto difference = [&] {
      return "(\\theta_{" + std::to_string(factor.first) + "} - \\theta_{" +
             std::to_string(factor.second) + "})";
    };
    const auto function = [&](const std::string& name) {
      if (factor.second == 0) return with_power(name, power) + indexed(" \\theta", factor.first, 1);
      return with_power(name, power) + difference();
    };
    switch (factor.role) {
      case Role::kGravity:
        return with_power("g", power);
      case Role::kLength:
        return indexed("l", factor.first, power);
      case Role::kCosine:
        return function("\\cos");
      case Role::kSine:
        return function("\\sin");
      case Role::kVersine:
        return with_power("(1 - \\cos " + indexed("\\theta", factor.first, 1) + ")", power);
      case Role::kAngle:
        return indexed("\\theta", factor.first, power);
      case Role::kRate:
        return indexed("\\dot{\\theta}", factor.first, power);
      case Role::kAcceleration:
        return indexed("\\ddot{\\theta}", factor.first, power);
      case Role::kMass:
        return indexed("m", factor.first, power);
      case Role::kLoadMass:
        return with_power("m_c", power);
      case Role::kInertia:
        return with_power("I_{R_" + std::to_string(factor.first) + "}", power);
      case Role::kStiffness:
        return indexed("k", factor.first, power);
      case Role::kDamping:
        return indexed("c", factor.first, power);
      case Role::kTorque:
        return with_power("T_{\\theta_" + std::to_string(factor.first) + "}", power);
      case Role::kOther:
        return writer_.symbol(factor.number, power);
    }
    return "";
  }

  const LatexPolynomial& writer_;
  const LatexStyle& style_;
  MonomialSum sum_;
};

LatexPolynomial::LatexPolynomial(const Definitions& definitions, LatexNames effect_names,
                                 LatexAbbreviations& abbreviations)
    : definitions_(definitions),
      effect_names_(std::move(effect_names)),
      abbreviations_(abbreviations) {}

// Definitions written out, but for functions, roots and what stands below the line.
ex LatexPolynomial::written_out(const ex& expression) const {
  GiNaC::exmap values;
  for (const int number : definitions_.symbols_of(expression)) {
    const Symbol& symbol = definitions_[number];
    if (symbol.is_input || GiNaC::is_a<GiNaC::function>(symbol.value) ||
        GiNaC::is_a<GiNaC::power>(symbol.value) || expression.ldegree(symbol.symbol) < 0) {
      continue;
    }
    const auto known = known_.find(number);
    values[symbol.symbol] =
        known != known_.end() ? known->second : known_[number] = written_out(symbol.value);
  }
  if (values.empty()) return expression.expand();
  return expression.subs(values, GiNaC::subs_options::no_pattern).expand();
}

std::string LatexPolynomial::symbol(int number, int power) const {
  const Symbol& symbol = definitions_[number];
  if (symbol.is_input) {
    const auto known = effect_names_.find(symbol.family);
    const std::string name = known != effect_names_.end() ? known->second
                             : symbol.family == "time"    ? "t"
                             : symbol.family == "pi"      ? "\\pi"
                                                          : "\\mathrm{" + symbol.family + "}";
    return symbol.index == kNoIndex ? with_power(name, power) : indexed(name, symbol.index, power);
  }
  const auto known = abbreviated_.find(number);
  if (known != abbreviated_.end()) return with_power(known->second, power);
  const ex& value = symbol.value;
  const bool function = GiNaC::is_a<GiNaC::function>(value);
  const bool root = GiNaC::is_a<GiNaC::power>(value) && value.op(1).is_equal(numeric(1, 2));
  const std::string inside = of(function || root ? value.op(0) : value);
  if (latex_width(inside) > kLongestInside) {
    abbreviated_[number] = abbreviation(value);
    return with_power(abbreviated_[number], power);
  }
  if (function) return with_power(function_name(value), power) + in_parentheses(inside);
  return with_power(root ? "\\sqrt{" + inside + "}" : in_parentheses(inside), power);
}

std::string LatexPolynomial::abbreviation(const ex& value) const {
  const bool root = GiNaC::is_a<GiNaC::power>(value);
  const std::vector<LatexTerm> all =
      GiNaC::is_a<GiNaC::function>(value)
          ? std::vector{LatexTerm{false, function_name(value) + in_parentheses(of(value.op(0)))}}
          : terms(root ? value.op(0) : value);
  for (const LatexAbbreviations::Entry& entry : abbreviations_.entries)
    if (entry.terms == all && entry.squared == root) return entry.name;
  abbreviations_.entries.push_back(
      {"R_{" + std::to_string(abbreviations_.entries.size() + 1) + "}", root, all});
  return abbreviations_.entries.back().name;
}

std::vector<LatexTerm> LatexPolynomial::terms(const ex& expression, const LatexStyle& style) const {
  return LatexTerms(*this, style).of(written_out(expression));
}

std::string LatexPolynomial::of(const ex& expression, const LatexStyle& style) const {
  return joined_terms(terms(expression, style));
}

// Commands count as one letter, braces and scripts as none.
std::size_t latex_width(const std::string& latex) {
  std::size_t letters = 0;
  for (std::size_t i = 0; i < latex.size(); ++i) {
    if (latex[i] == '\\') {
      while (i + 1 < latex.size() && std::isalpha(static_cast<unsigned char>(latex[i + 1]))) ++i;
      ++letters;
    } else if (std::string_view("{}^_ ").find(latex[i]) == std::string_view::npos) {
      ++letters;
    }
  }
  return letters;
}

std::string with_sign(const LatexTerm& term) { return (term.negative ? "- " : "+ ") + term.text; }

std::string joined_terms(const std::vector<LatexTerm>& terms) {
  if (terms.empty()) return "0";
  std::string text;
  for (const LatexTerm& term : terms) {
    const bool plain = text.empty() && !term.negative;
    text += (text.empty() ? "" : " ") + (plain ? term.text : with_sign(term));
  }
  return text;
}

}  // namespace catena
