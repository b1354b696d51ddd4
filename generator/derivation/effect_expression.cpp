// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/effect_expression.hpp"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <vector>

#include "common/in_quotes.hpp"
#include "common/nearest_name.hpp"
#include "description/expression_syntax.hpp"

namespace catena {
namespace {

using GiNaC::ex;
using GiNaC::numeric;

constexpr int kLargestExponent = 100;  // numerator and denominator of the power
constexpr int kLargestDecimal = 400;   // powers of ten in a number

ex apply_function(const std::string& name, const ex& x) {
  if (name == "sin") return GiNaC::sin(x);
  if (name == "cos") return GiNaC::cos(x);
  if (name == "tan") return GiNaC::tan(x);
  if (name == "exp") return GiNaC::exp(x);
  if (name == "log") return GiNaC::log(x);
  if (name == "sqrt") return GiNaC::sqrt(x);
  if (name == "tanh") return GiNaC::tanh(x);
  if (name == "sinh") return GiNaC::sinh(x);
  if (name == "cosh") return GiNaC::cosh(x);
  if (name == "atan") return GiNaC::atan(x);
  if (name == "asinh") return GiNaC::asinh(x);
  throw std::logic_error("apply_function: the grammar has no " + name);
}

struct Value {
  ex value;
  Unit unit;
  bool any_unit = false;  // written as zero

  bool fits(const Unit& wanted) const { return any_unit || unit == wanted; }
};

class Evaluation {
 public:
  Evaluation(const Expression& expression, const ExpressionContext& context)
      : expression_(expression), context_(context) {}

  Value of(const SyntaxNode& node) const {
    switch (node.kind) {
      case SyntaxNode::kNumber:
        return number(node);
      case SyntaxNode::kName:
        return symbol(node);
      case SyntaxNode::kCall:
        return call(node);
      case SyntaxNode::kNegate: {
        const Value operand = of(node.operands[0]);
        return {-operand.value, operand.unit, operand.any_unit};
      }
      case SyntaxNode::kAdd:
      case SyntaxNode::kSubtract:
        return sum(node);
      case SyntaxNode::kMultiply:
      case SyntaxNode::kDivide:
        return product(node);
      case SyntaxNode::kPower:
        return power(node);
    }
    throw std::logic_error("Evaluation: unknown kind of node");
  }

 private:
  [[noreturn]] void fail(const std::string& problem) const { fail_at(expression_, problem); }

  Value number(const SyntaxNode& node) const {
    try {
      const ex value = exact_number(node.name);
      return {value, Unit(), value.is_zero()};
    } catch (const std::out_of_range&) {
      fail(in_quotes(node.text) + " is too large or too small");
    }
  }

  Value symbol(const SyntaxNode& node) const {
    if (node.name == "pi") return {GiNaC::Pi, Unit()};
    const auto found = context_.symbols.find(node.name);
    if (found != context_.symbols.end()) return {found->second.first, found->second.second};
    std::vector<std::string> names = {"pi"};
    for (const auto& [known, value] : context_.symbols) names.push_back(known);
    fail(in_quotes(node.name) + " has no meaning here" + suggestion(node.name, names));
  }

  Value call(const SyntaxNode& node) const {
    const Value argument = of(node.operands[0]);
    if (node.name == "sqrt") {
      return {apply_function(node.name, argument.value), argument.unit.power({1, 2})};
    }
    if (!argument.fits(Unit())) {
      fail("the argument of " + node.name + ", " + in_quotes(node.operands[0].text) + ", is in " +
           argument.unit.text() + "; it must have no unit");
    }
    return {apply_function(node.name, argument.value), Unit()};
  }

  Value sum(const SyntaxNode& node) const {
    const Value left = of(node.operands[0]), right = of(node.operands[1]);
    if (!left.any_unit && !right.fits(left.unit)) {
      fail(in_quotes(node.operands[0].text) + " is in " + left.unit.text() + ", but " +
           in_quotes(node.operands[1].text) + " is in " + right.unit.text() +
           "; terms of a sum need one unit");
    }
    return {node.kind == SyntaxNode::kAdd ? left.value + right.value : left.value - right.value,
            left.any_unit ? right.unit : left.unit, left.any_unit && right.any_unit};
  }

  Value product(const SyntaxNode& node) const {
    const Value left = of(node.operands[0]), right = of(node.operands[1]);
    if (node.kind == SyntaxNode::kMultiply) {
      return {left.value * right.value, left.unit * right.unit, left.any_unit || right.any_unit};
    }
    if (right.value.is_zero()) {
      fail(in_quotes(node.operands[1].text) + " is zero; nothing divides by it");
    }
    return {left.value / right.value, left.unit / right.unit, left.any_unit};
  }

  Value power(const SyntaxNode& node) const {
    const Value base = of(node.operands[0]), exponent = of(node.operands[1]);
    const std::string what = "the exponent " + in_quotes(node.operands[1].text);
    if (!exponent.unit.dimensionless()) {
      fail(what + " is in " + exponent.unit.text() + "; exponents have no unit");
    }
    if (!exponent.value.info(GiNaC::info_flags::rational)) {
      fail(what + " is no rational number; write one such as 2, (3/2) or 0.6, or exp(b*log(a))");
    }
    const numeric p = GiNaC::ex_to<numeric>(exponent.value).numer();
    const numeric q = GiNaC::ex_to<numeric>(exponent.value).denom();
    if (GiNaC::abs(p) > kLargestExponent || q > kLargestExponent) {
      fail(what + " is too large; its numerator and denominator go up to " +
           std::to_string(kLargestExponent));
    }
    if (base.value.is_zero() && p <= 0) {
      fail(in_quotes(node.operands[0].text) + " is zero; it has no power " + node.operands[1].text);
    }
    return {GiNaC::pow(base.value, exponent.value), base.unit.power({p.to_int(), q.to_int()})};
  }

  const Expression& expression_;
  const ExpressionContext& context_;
};

Value evaluated(const Expression& expression, const ExpressionContext& context) {
  const SyntaxNode tree = parse_syntax(expression);
  try {
    return Evaluation(expression, context).of(tree);
  } catch (const GiNaC::pole_error& error) {
    fail_at(expression, std::string("it is infinite (") + error.what() + ")");
  }
}

}  // namespace

bool has_meaning(const Expression& expression, const ExpressionContext& known) {
  const std::set<std::string> names = names_in(expression);
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return name == "pi" || known.symbols.contains(name);
  });
}

ex parse_expression(const Expression& expression, const ExpressionContext& context,
                    const Unit& expected) {
  const Value result = evaluated(expression, context);
  if (!result.fits(expected)) {
    fail_at(expression,
            "it is in " + result.unit.text() + " where " + expected.text() + " is wanted");
  }
  return result.value;
}

std::pair<ex, Unit> parse_expression(const Expression& expression,
                                     const ExpressionContext& context) {
  const Value result = evaluated(expression, context);
  return {result.value, result.unit};
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
