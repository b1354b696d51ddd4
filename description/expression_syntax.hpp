// SPDX-License-Identifier: BSD-3-Clause
//
// The whole grammar of expressions in effect files:
//
//     sum      = product { ("+" | "-") product }
//     product  = factor { ("*" | "/") factor }
//     factor   = ("-" | "+") factor | power
//     power    = primary [ "^" factor ]            right-associative; -x^2 = -(x^2)
//     primary  = number | name | function "(" sum ")" | "(" sum ")"
//     number   = 12, 0.5, 1e-6
//     function = sin cos tan exp log sqrt tanh sinh cosh atan asinh
//
// The text becomes a tree here. generator/derivation/effect_expression.hpp gives it values and
// units, formula.hpp prints it.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "description/effect.hpp"

namespace catena {

struct SyntaxNode {
  enum Kind { kNumber, kName, kCall, kNegate, kAdd, kSubtract, kMultiply, kDivide, kPower };
  Kind kind = kNumber;
  std::string text;  ///< as written, parentheses around it included
  std::string name;  ///< of the number (its digits), the symbol or the function
  std::vector<SyntaxNode> operands;
};

/// What expressions at joints call the force along the link below, N, that weight and turning at constant rates
/// make. It depends on the whole motion, so it stands in forces, torques and rates of states only.
inline constexpr const char* kSteadyTension = "steady_tension";

/// The tree of an expression. Throws InputError "file:line: key: in "text": problem".
SyntaxNode parse_syntax(const Expression& expression);

/// The names in an expression, without those of functions. Empty if the expression is not given.
std::set<std::string> names_in(const Expression& expression);

/// Throws InputError "file:line: key: in "text": problem".
[[noreturn]] void fail_at(const Expression& expression, const std::string& problem);

}  // namespace catena
