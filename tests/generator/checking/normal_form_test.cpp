// SPDX-License-Identifier: GPL-3.0-or-later
//
// Identities that hold, near misses that do not, and what is beyond deciding.
#include "generator/checking/normal_form.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/generator/checking/checked.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

namespace normal_form_test {
namespace {

struct Row {
  std::string left;
  std::string right;
  Verdict verdict;
};

}  // namespace

TEST_CASE("identities are proved, near misses refused, the rest left undecided") {
  const std::vector<Row> rows = {
      {"sin(x)^2 + cos(x)^2", "1", Verdict::kEqual},
      {"sin(x)^2 - cos(x)^2", "1", Verdict::kDifferent},
      {"sin(x + y)", "sin(x)*cos(y) + cos(x)*sin(y)", Verdict::kEqual},
      {"sin(x + y)", "sin(x)*cos(y) - cos(x)*sin(y)", Verdict::kDifferent},
      {"1 - cos(x)", "2*sin(x/2)^2", Verdict::kEqual},
      {"cos(3*x)", "4*cos(x)^3 - 3*cos(x)", Verdict::kEqual},
      {"cos(x + pi/2)", "-sin(x)", Verdict::kEqual},
      {"cos(x - pi)", "cos(x)", Verdict::kDifferent},
      {"tan(x)", "sin(2*x)/(1 + cos(2*x))", Verdict::kEqual},
      {"1/sin(x)^2 - 1", "1/tan(x)^2", Verdict::kEqual},
      {"(x^2 - y^2)/(x - y)", "x + y", Verdict::kEqual},
      {"1/(x - y) + 1/(x + y)", "2*x/(x^2 - y^2)", Verdict::kEqual},
      {"1/(x - y) + 1/(x + y)", "2*y/(x^2 - y^2)", Verdict::kDifferent},
      {"1/(1 + 1/(1 + 1/x))", "(x + 1)/(2*x + 1)", Verdict::kEqual},
      {"0.1", "1/10", Verdict::kEqual},
      {"1.5e-3*x", "3*x/2000", Verdict::kEqual},
      {"cosh(x)^2 - sinh(x)^2", "1", Verdict::kEqual},
      {"exp(x + y)", "exp(x)*exp(y)", Verdict::kEqual},
      {"exp(x/2)^2 - exp(x)", "0", Verdict::kEqual},
      {"tanh(x)", "(exp(2*x) - 1)/(exp(2*x) + 1)", Verdict::kEqual},
      {"sqrt(a^2)", "a", Verdict::kEqual},
      {"sqrt(x^2)", "x", Verdict::kDifferent},                // x may be negative
      {"sqrt(1 - sin(x)^2)", "cos(x)", Verdict::kDifferent},  // so may the cosine
      {"sqrt(1 + sinh(x)^2)", "cosh(x)", Verdict::kEqual},
      {"sqrt(a^2*b + a^2*c)", "a*sqrt(b + c)", Verdict::kEqual},
      {"sqrt(x + 2)^2", "x + 2", Verdict::kEqual},
      {"1/(sqrt(a + b) - sqrt(a))", "(sqrt(a + b) + sqrt(a))/b", Verdict::kEqual},
      {"(a + 1)^(3/2)", "(a + 1)*sqrt(a + 1)", Verdict::kEqual},
      {"sqrt(8)", "2*sqrt(2)", Verdict::kEqual},
      {"sqrt(8)", "2.8284271247461900976033774484194*1", Verdict::kDifferent},  // to 31 digits
      {"sqrt(12*a^2/75)*x", "2*a*x/5", Verdict::kEqual},
      {"sqrt(2*a) - sqrt(a)*sqrt(8)/2", "0", Verdict::kEqual},
      {"2^(1/3)*4^(1/3)", "2", Verdict::kEqual},
      {"2^(1/2)*2^(1/3)", "2^(5/6)", Verdict::kEqual},
      {"4^(1/4)", "sqrt(2)", Verdict::kEqual},
      {"(1 + sqrt(2))*(sqrt(2) - 1)", "1", Verdict::kEqual},
      {"1/(sqrt(3) - sqrt(2))", "sqrt(3) + sqrt(2)", Verdict::kEqual},
      {"1/(sqrt(3) - sqrt(2))", "sqrt(3) - sqrt(2)", Verdict::kDifferent},
      {"sqrt(2) + sqrt(3)", "sqrt(10)", Verdict::kDifferent},
      {"cos(x + pi/4)", "(cos(x) - sin(x))/sqrt(2)", Verdict::kEqual},
      {"cos(x + pi/6)", "(sqrt(3)*cos(x) - sin(x))/2", Verdict::kEqual},
      {"sin(x + pi/3)", "(sqrt(3)*cos(x) - sin(x))/2", Verdict::kDifferent},
      {"sin(pi/12)", "(sqrt(6) - sqrt(2))/4", Verdict::kEqual},
      {"sqrt(3 + 2*sqrt(2))", "1 + sqrt(2)", Verdict::kUndecided},  // a root within a root
      {"sqrt(4/9)", "2/3", Verdict::kEqual},
      {"abs(x)^2", "x^2", Verdict::kEqual},
      {"abs(x*y)", "abs(y)*abs(x)", Verdict::kUndecided},
      {"sqrt(2)*sqrt(3)", "sqrt(6)", Verdict::kEqual},
      {"log(a*b)", "log(a) + log(b)", Verdict::kUndecided},
      {"log(a*b)", "log(a)*log(b)", Verdict::kDifferent},
      {"sin(sin(x))*2", "sin(sin(x)) + sin(sin(x)*1)", Verdict::kEqual},
      {"atan(x) + atan(1/x)", "pi/2", Verdict::kDifferent},  // wrong for negative x
      {"atan(a) + atan(1/a)", "pi/2", Verdict::kUndecided},
      {"diff(sin(x)/x, x)", "(x*cos(x) - sin(x))/x^2", Verdict::kEqual},
      {"at(diff(x^3*y, x, 2), x, 2)", "12*y", Verdict::kEqual},
  };
  for (const Row& row : rows) {
    INFO(row.left << " = " << row.right);
    const Checked result = checked("symbols x, y\npositive a, b, c\nidentity \"row\": " + row.left +
                                   " = " + row.right);
    CHECK(result.of("row").verdict == row.verdict);
  }
}

TEST_CASE("a denominator that is zero by identity is refused") {
  const Checked result = checked("symbols x\nidentity \"row\": 1/(sin(x)^2 + cos(x)^2 - 1) = 1");
  CHECK(result.of("row").verdict == Verdict::kDifferent);
  CHECK(result.of("row").remark == "a denominator is identically zero");
}

}  // namespace normal_form_test
