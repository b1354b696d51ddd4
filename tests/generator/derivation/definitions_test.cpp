// SPDX-License-Identifier: GPL-3.0-or-later
//
// What an expression is worth after its functions, roots and powers have been named.
#include "generator/derivation/definitions.hpp"

#include <doctest/doctest.h>

#include "generator/certificate/exact_evaluation.hpp"

using namespace catena;
using GiNaC::ex;
using GiNaC::numeric;

TEST_CASE("naming keeps the value, whatever rational exponent and function of a number there is") {
  Definitions definitions;
  const ex x = definitions.input("x"), y = definitions.input("y");
  const ex value_of_x(numeric(17, 10)), value_of_y(numeric(3, 10));
  const ex expressions[] = {
      GiNaC::pow(x * x + y, numeric(4, 3)),
      x * GiNaC::pow(x * y, numeric(-2, 5)) + GiNaC::pow(x, 3),
      GiNaC::pow(ex(2), numeric(1, 3)) * GiNaC::sqrt(ex(3)) * GiNaC::sqrt(x),
      GiNaC::pow(GiNaC::pow(x + y, numeric(1, 3)) + 1, numeric(7, 2)),
      GiNaC::log(ex(3)) * GiNaC::sin(ex(1)) * x + GiNaC::exp(ex(2)) / GiNaC::pow(y, numeric(3, 2)),
  };
  for (const ex& expression : expressions) {
    CAPTURE(definitions.canonical_key(expression));
    const ex named = definitions.named(expression, "value", kNoIndex);
    ExactEvaluation evaluation(definitions, [&](const std::string& name) {
      return name == "x" ? value_of_x : value_of_y;
    });
    const ex expected = expression.subs(GiNaC::lst{x == value_of_x, y == value_of_y}).evalf();
    CHECK(GiNaC::abs(evaluation.of(named) - GiNaC::ex_to<numeric>(expected)).to_double() < 1e-14);
  }
}
