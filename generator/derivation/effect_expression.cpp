// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/effect_expression.hpp"

#include <cctype>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "generator/description/input_error.hpp"
#include "generator/description/nearest_name.hpp"

namespace catena {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr int kDeepest = 200;          // nesting; far beyond what anyone writes
constexpr int kLargestExponent = 100;  // of a power, above and below the line
constexpr int kLargestDecimal = 400;   // powers of ten in a number

struct Function {
  const char* name;
  ex (*apply)(const ex&);
};

const std::vector<Function>& functions() {
  static const std::vector<Function> all = {
      {"sin", [](const ex& x) -> ex { return GiNaC::sin(x); }},
      {"cos", [](const ex& x) -> ex { return GiNaC::cos(x); }},
      {"tan", [](const ex& x) -> ex { return GiNaC::tan(x); }},
      {"exp", [](const ex& x) -> ex { return GiNaC::exp(x); }},
      {"log", [](const ex& x) -> ex { return GiNaC::log(x); }},
      {"sqrt", [](const ex& x) -> ex { return GiNaC::sqrt(x); }},
      {"tanh", [](const ex& x) -> ex { return GiNaC::tanh(x); }},
      {"sinh", [](const ex& x) -> ex { return GiNaC::sinh(x); }},
      {"cosh", [](const ex& x) -> ex { return GiNaC::cosh(x); }},
      {"atan", [](const ex& x) -> ex { return GiNaC::atan(x); }},
      {"asinh", [](const ex& x) -> ex { return GiNaC::asinh(x); }},
  };
  return all;
}

// What people reach for that has no derivative everywhere, and what to write instead.
const std::map<std::string, std::string>& smooth_substitutes() {
  static const std::map<std::string, std::string> substitutes = {
      {"abs", "sqrt(x^2 + floor^2)"},
      {"sign", "x/sqrt(x^2 + floor^2)"},
      {"sgn", "x/sqrt(x^2 + floor^2)"},
      {"max", "(a + b + sqrt((a - b)^2 + floor^2))/2"},
      {"min", "(a + b - sqrt((a - b)^2 + floor^2))/2"},
  };
  return substitutes;
}

std::string in_quotes(std::string_view text) { return "\"" + std::string(text) + "\""; }

// A value with its unit and the text it was read from.
struct Term {
  ex value;
  Unit unit;
  std::string_view text;
  bool any_unit = false;  // written as zero

  bool fits(const Unit& wanted) const { return any_unit || unit == wanted; }
};

class Parser {
 public:
  Parser(const Expression& expression, const ExpressionContext& context)
      : expression_(expression), context_(context), text_(expression.text) {}

  Term parse() {
    const Term term = sum();
    if (!at_end()) fail(in_quotes(text_.substr(at_, 1)) + " cannot stand here" + here());
    return term;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw InputError(expression_.file + ":" + std::to_string(expression_.line) + ": " +
                     expression_.key + ": in " + in_quotes(text_) + ": " + problem);
  }

 private:
  std::string here() const { return ", at its character " + std::to_string(at_ + 1); }

  bool at_end() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
    return at_ == text_.size();
  }

  bool take(char wanted) {
    if (at_end() || text_[at_] != wanted) return false;
    ++at_;
    return true;
  }

  std::string_view text_from(std::size_t begin) const {
    std::string_view text = text_.substr(begin, at_ - begin);
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) {
      text.remove_suffix(1);
    }
    return text;
  }

  std::size_t start() {
    at_end();
    return at_;
  }

  Term sum() {
    const std::size_t begin = start();
    Term total = product();
    while (true) {
      const bool minus = !at_end() && text_[at_] == '-';
      if (!minus && (at_end() || text_[at_] != '+')) return total;
      ++at_;
      const Term next = product();
      if (total.any_unit) {
        total.unit = next.unit;
        total.any_unit = next.any_unit;
      } else if (!next.fits(total.unit)) {
        fail(in_quotes(total.text) + " is in " + total.unit.text() + ", but " +
             in_quotes(next.text) + " is in " + next.unit.text() +
             "; terms of a sum need one unit");
      }
      total.value = minus ? total.value - next.value : total.value + next.value;
      total.text = text_from(begin);
    }
  }

  Term product() {
    const std::size_t begin = start();
    Term total = factor();
    while (true) {
      const bool divide = !at_end() && text_[at_] == '/';
      if (!divide && (at_end() || text_[at_] != '*')) return total;
      ++at_;
      const Term next = factor();
      if (divide && next.value.is_zero())
        fail(in_quotes(next.text) + " is zero; nothing divides by it");
      total.value = divide ? total.value / next.value : total.value * next.value;
      total.unit = divide ? total.unit / next.unit : total.unit * next.unit;
      total.any_unit = total.any_unit || next.any_unit;
      total.text = text_from(begin);
    }
  }

  Term factor() {
    const std::size_t begin = start();
    const Nesting nesting(*this);
    if (take('-')) {
      Term term = factor();
      return {-term.value, term.unit, text_from(begin), term.any_unit};
    }
    if (take('+')) return factor();
    return power();
  }

  Term power() {
    const std::size_t begin = start();
    const Term base = primary();
    if (!take('^')) return base;
    const Term exponent = factor();
    if (!exponent.unit.dimensionless()) {
      fail("the exponent " + in_quotes(exponent.text) + " is in " + exponent.unit.text() +
           "; exponents have no unit");
    }
    if (!GiNaC::is_a<numeric>(exponent.value) ||
        !GiNaC::ex_to<numeric>(exponent.value).is_rational()) {
      fail("the exponent " + in_quotes(exponent.text) +
           " is not a rational number; write a number such as 2 or (3/2), or exp(b*log(a))");
    }
    const numeric p = GiNaC::ex_to<numeric>(exponent.value).numer();
    const numeric q = GiNaC::ex_to<numeric>(exponent.value).denom();
    if (GiNaC::abs(p) > kLargestExponent || q > kLargestExponent) {
      fail("the exponent " + in_quotes(exponent.text) +
           " is too large; numerator and denominator " + "go up to " +
           std::to_string(kLargestExponent));
    }
    if (base.value.is_zero() && p <= 0) {
      fail(in_quotes(base.text) + " is zero; it has no power " + std::string(exponent.text));
    }
    return {GiNaC::pow(base.value, exponent.value), base.unit.power({p.to_int(), q.to_int()}),
            text_from(begin)};
  }

  Term primary() {
    const std::size_t begin = start();
    if (at_end()) fail("it ends where a number, a name or a parenthesis is wanted");
    const char next = text_[at_];
    if (take('(')) {
      const Term inside = sum();
      if (!take(')'))
        fail("the parenthesis at its character " + std::to_string(begin + 1) + " is not closed");
      return {inside.value, inside.unit, text_from(begin), inside.any_unit};
    }
    if (std::isdigit(static_cast<unsigned char>(next)) || next == '.') return number();
    if (!std::isalpha(static_cast<unsigned char>(next))) {
      fail(in_quotes(text_.substr(at_, 1)) + " cannot stand here" + here());
    }
    while (at_ < text_.size() &&
           (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) {
      ++at_;
    }
    const std::string name(text_.substr(begin, at_ - begin));
    return !at_end() && text_[at_] == '(' ? call(begin, name) : symbol(begin, name);
  }

  Term number() {
    const std::size_t begin = at_;
    const auto digits = [&] {
      const std::size_t first = at_;
      while (at_ < text_.size() && std::isdigit(static_cast<unsigned char>(text_[at_]))) ++at_;
      return at_ > first;
    };
    bool any = digits();
    if (at_ < text_.size() && text_[at_] == '.') {
      ++at_;
      any = digits() || any;
    }
    if (any && at_ < text_.size() && (text_[at_] == 'e' || text_[at_] == 'E')) {
      ++at_;
      if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+')) ++at_;
      any = digits();
    }
    const std::string_view text = text_from(begin);
    if (!any) fail(in_quotes(text) + " is not a number; write 12, 0.5 or 1e-6");
    try {
      const ex value = exact_number(std::string(text));
      return {value, Unit(), text, value.is_zero()};
    } catch (const std::out_of_range&) {
      fail(in_quotes(text) + " is too large or too small");
    }
  }

  Term call(std::size_t begin, const std::string& name) {
    take('(');
    const Term argument = sum();
    if (!take(')')) fail(name + "(...) takes one argument and ends with a parenthesis" + here());
    std::vector<std::string> names;
    for (const Function& function : functions()) {
      names.emplace_back(function.name);
      if (name != function.name) continue;
      const bool root = name == "sqrt";
      if (!root && !argument.fits(Unit())) {
        fail("the argument of " + name + ", " + in_quotes(argument.text) + ", is in " +
             argument.unit.text() + "; it must have no unit");
      }
      return {function.apply(argument.value), root ? argument.unit.power({1, 2}) : Unit(),
              text_from(begin)};
    }
    if (const auto smooth = smooth_substitutes().find(name); smooth != smooth_substitutes().end()) {
      fail(name + " has no derivative everywhere; write " + smooth->second +
           " with a small constant");
    }
    if (context_.symbols.contains(name)) {
      fail(in_quotes(name) + " is no function; write " + name + "*(...) for a product");
    }
    fail(in_quotes(name) + " is no known function" + suggestion(name, names));
  }

  Term symbol(std::size_t begin, const std::string& name) const {
    if (name == "pi") return {GiNaC::Pi, Unit(), text_from(begin)};
    const auto found = context_.symbols.find(name);
    if (found != context_.symbols.end()) {
      return {found->second.first, found->second.second, text_from(begin)};
    }
    std::vector<std::string> names = {"pi"};
    for (const auto& [known, value] : context_.symbols) names.push_back(known);
    fail(in_quotes(name) + " has no meaning here" + suggestion(name, names));
  }

  // Counts how deep parentheses and signs are nested while it lives.
  struct Nesting {
    explicit Nesting(Parser& parser) : parser_(parser) {
      if (++parser_.depth_ > kDeepest) parser_.fail("it is nested too deeply; use definitions");
    }
    ~Nesting() { --parser_.depth_; }
    Parser& parser_;
  };

  const Expression& expression_;
  const ExpressionContext& context_;
  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

Term parsed(const Expression& expression, const ExpressionContext& context, const Unit* expected) {
  Parser parser(expression, context);
  try {
    const Term term = parser.parse();
    if (expected != nullptr && !term.fits(*expected)) {
      parser.fail("it is in " + term.unit.text() + " where " + expected->text() + " is wanted");
    }
    return term;
  } catch (const GiNaC::pole_error& error) {
    parser.fail(std::string("it is infinite (") + error.what() + ")");
  }
}

}  // namespace

ex parse_expression(const Expression& expression, const ExpressionContext& context,
                    const Unit& expected) {
  return parsed(expression, context, &expected).value;
}

std::pair<ex, Unit> parse_expression(const Expression& expression,
                                     const ExpressionContext& context) {
  const Term term = parsed(expression, context, nullptr);
  return {term.value, term.unit};
}

void add_definition(const Definition& definition, ExpressionContext& context) {
  const auto [value, unit] = parse_expression(definition.value, context);
  context.add(definition.name, value, unit);
}

ex exact_number(const std::string& decimal) {
  std::string digits;
  long power = 0;
  std::size_t at = 0;
  const bool negative = decimal.starts_with('-');
  if (negative) ++at;
  for (bool after_point = false; at < decimal.size(); ++at) {
    if (decimal[at] == '.') {
      after_point = true;
    } else if (std::isdigit(static_cast<unsigned char>(decimal[at]))) {
      digits += decimal[at];
      if (after_point) --power;
    } else {
      power += std::stol(decimal.substr(at + 1));  // behind the e; throws std::out_of_range
      break;
    }
  }
  if (std::labs(power) > kLargestDecimal) throw std::out_of_range("exact_number: " + decimal);
  const ex value = numeric(digits.c_str()) * GiNaC::pow(ex(10), ex(numeric(power)));
  return negative ? -value : value;
}

}  // namespace catena
