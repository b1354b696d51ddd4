// SPDX-License-Identifier: GPL-3.0-or-later
//
// Expressions of effect files (grammar: description/expression_syntax.hpp) as GiNaC expressions.
//
// Numbers are exact: 0.1 is one tenth. `pi` is a number. Every other name must be a symbol of the
// place of the expression. The value of an exponent must be a rational number p/q. Units are
// checked on the text as written, before GiNaC reorders or cancels terms: the terms of a sum have
// the same unit; arguments of functions other than sqrt, and exponents, are dimensionless. A term
// written as 0 has any unit. The radian is dimensionless.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <utility>

#include "description/effect.hpp"
#include "description/unit.hpp"

namespace catena {

/// The symbols at the place of an expression, with their values and units.
struct ExpressionContext {
  std::map<std::string, std::pair<GiNaC::ex, Unit>> symbols;

  void add(const std::string& name, const GiNaC::ex& value, const Unit& unit) {
    symbols[name] = {value, unit};
  }
};

/// Whether all names in an expression are known there.
bool has_meaning(const Expression& expression, const ExpressionContext& known);

/// Throws InputError "file:line: key: in "text": ..." that names the sub-term, both units or the
/// nearest symbol, and what to do.
GiNaC::ex parse_expression(const Expression& expression, const ExpressionContext& context,
                           const Unit& expected);

/// The same, but returns the unit instead of checking it.
std::pair<GiNaC::ex, Unit> parse_expression(const Expression& expression,
                                            const ExpressionContext& context);

/// Parses the definition with the symbols of the context and adds its name to them.
void add_definition(const Definition& definition, ExpressionContext& context);

/// "0.1" as 1/10. The text is a decimal number as Constant::text has it. Throws std::out_of_range
/// beyond 400 powers of ten.
GiNaC::ex exact_number(const std::string& decimal);

}  // namespace catena
