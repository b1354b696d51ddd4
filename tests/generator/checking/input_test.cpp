// SPDX-License-Identifier: GPL-3.0-or-later
//
// Wrong input is answered with its place and what was expected.
#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "common/input_error.hpp"
#include "tests/generator/checking/checked.hpp"

using namespace catena;
using namespace catena::checking;
using namespace catena::tests;

namespace {

std::string repeated(int times, const std::string& part) {
  std::string result;
  for (int k = 0; k < times; ++k) result += part;
  return result;
}

}  // namespace

TEST_CASE("wrong derivations are refused with line, column and what was expected") {
  struct Row {
    std::string text;
    std::string place;
    std::string message;
  };
  const std::vector<Row> rows = {
      {"links 2\nL = (m_1 + 2", "2:13", "to close the bracket opened at line 2, column 5"},
      {"links 2\nL = l_1 l_2", "2:9", "expected an operator or the end of the statement"},
      {"links 2\nL = 2l_1", "2:6", "write products with *"},
      {"links 2\nL = m_1 *", "2:10", "expected a number, a name or a bracket"},
      {"links 2\nL = m_1 ? 2", "2:9", "unexpected character '?'"},
      {"links 2\nL = \xCE\xB8_1", "2:5", "unexpected character '\xCE\xB8'"},
      {"links 2\nL = k_[1]", "2:6", "subscript that is an expression goes into brackets"},
      {"links 2\nfor i = 1..n\nG[i] = 0", "3:9", "'end' of the loop begun at line 2"},
      {"links 2\nfor i = 1\nend", "2:10", "expected '..'"},
      {"links 2\nif 1 = 2\nend", "2:6", "'==' to compare"},
      {"links 2\nend", "2:1", "expected a statement"},
      {"links 2\nequation 1 theta_1 = 0", "2:12", "expected ':'"},
      {"links 2\nL = sum(k, 1, n)", "2:10", "expected '=' and a range"},
      {"links 2\nL = if 1 < 2 then 3", "2:20", "expected 'else'"},
      {"links 2\nidentity \"x: 1 = 1", "2:10", "no closing quote"},
      {"L = 1", "1:1", "expected first 'links N'"},
      {"links 0\nL = 1", "1:1", "must be from 1 to 10000"},
      {"links 1.5\nL = 1", "1:7", "must be an integer"},
      {"links 2\nlinks 3", "2:1", "already set"},
      {"links 2\nL = m_3", "2:5", "m[3]: the index 3 is not in 1..2"},
      {"links 2\nL = theta[-1]", "2:5", "not in 0..2"},
      {"links 2\nL = mass", "2:5", "unknown name 'mass'"},
      {"links 2\nL = m", "2:5", "'m' needs an index"},
      {"links 2\nx[1] = 1\nL = x[2]", "3:5", "x[2] is not set (but x[1] is)"},
      {"links 2\nL = foo(3)", "2:5", "unknown function 'foo'"},
      {"links 2\nL = sin(1, 2)", "2:5", "sin has 2 arguments; expected 1"},
      {"links 2\nL = 1/(m_1 - m_1)", "2:8", "division by zero"},
      {"links 2\nL = 0^(-1)", "2:6", "0 raised to"},
      {"links 2\nL = m_1^100000", "2:8", "an exponent beyond 100"},
      {"links 2\nm_1 = 3", "2:1", "cannot be assigned"},
      {"links 2\nI(1,2) = 3", "2:1", "the mass matrix is called M"},
      {"links 2\nM[1,1] = I[1,2]", "2:10", "the mass matrix is called M"},
      {"links 2\nM[1] = 3", "2:1", "M needs 2 indices"},
      {"links 2\nM[1,3] = 3", "2:1", "the index 3 is not in 1..2"},
      {"links 2\nK = [1, 2, 3]", "2:5", "expected 2 rows"},
      {"links 2\nG = [1, 2, 3]", "2:5", "expected 2 entries"},
      {"links 2\nL = m_1 < m_2", "2:9", "a condition is no value"},
      {"links 2\nif m_1 < m_2\nend", "2:4", "expected a number"},
      {"links 2\nif m_1\nend", "2:4", "expected a condition"},
      {"links 2\nfor i = 1..n\ni = 3\nend", "3:1", "index of a loop"},
      {"links 2\nL = diff(m_1^2, 2*m_1)", "2:17", "expected a symbol"},
      {"links 2\nL = ddt(thetaddot_1)", "2:5", "derivative of an acceleration"},
      {"links 2\nequation 3: theta_1 = 0", "2:1", "there are 2 links"},
      {"links 2\nsymmetric G", "2:1", "no matrix"},
      {"links 2\ngiven theta_1 = 2", "2:7", "'given' expects a parameter"},
      {"links 2\ngiven m_1 = theta_1", "2:13", "contains an angle"},
      {"symbols x, x", "1:1", "declared twice"},
      {"symbols sin", "1:1", "already has a meaning"},
      {"symbols x\nx = 2", "2:1", "cannot be assigned"},
      {"symbols x\nidentity ddt(x) = 0", "2:10", "belongs to a chain"},
      {"symbols x\nidentity log(0) = 0", "2:10", "log cannot be evaluated"},
      {"symbols x\ny[1] = " + std::string(600, '(') + "x" + std::string(600, ')'), "2:", "nested"},
      {"symbols x\ny[1] = x for i = 1..1" + repeated(40000, ", i = 1..1"), "2:", "nested"},
      {"symbols x\ny[1] = x\ny[i] = sin(y[i-1]) for i = 2..40000", "3:1", "200 deep"},
      {"symbols x\ny[1] = x\ny[i] = 1/(x + y[i-1]) for i = 2..40000", "3:1", "200 deep"},
      {"symbols x\ny[1] = x\ny[i] = y[i-1]*(y[i-1] + 1) for i = 2..60", "3:1", "operations"},
      {"symbols x\ny = sum(i = 1..1000000, sum(j = 1..1000000, i))", "2:1", "operations"},
      {"symbols x\ny = ((2^100)^100)^100", "2:1", "30 000 digits"},
      {"symbols x\ny = (((2*x)^100)^100)^100", "2:1", "30 000 digits"},
      {"symbols x\ny = 1e999999999", "2:1", "30 000 digits"},
  };
  for (const Row& row : rows) {
    INFO(row.text);
    try {
      (void)checked(row.text);
      FAIL_CHECK("no error");
    } catch (const InputError& error) {
      const std::string message = error.what();
      INFO(message);
      CHECK(message.rfind("test:" + row.place, 0) == 0);
      CHECK(message.find(row.message) != std::string::npos);
    }
  }
  CHECK_THROWS_WITH_AS((void)checked("links 2\nx = 3"), doctest::Contains("nothing to check"),
                       InputError);
}

TEST_CASE("what is too long for algebra is evaluated, or left undecided") {
  struct Row {
    std::string identity;
    Verdict verdict;
    bool by_evaluation;
  };
  const std::string nested = "((x + y)^90 + 1)^90", fractions = [] {
    std::string sum = "1/(x + y)";
    for (int k = 2; k < 60; ++k)
      sum += " + 1/(x^" + std::to_string(k) + " + y + " + std::to_string(k) + ")";
    return sum;
  }();
  const std::vector<Row> rows = {
      {nested + " = x", Verdict::kDifferent, false},
      {nested + "*((x + y)^2 - x^2 - 2*x*y - y^2) = 0", Verdict::kEqual, true},
      {fractions + " = x", Verdict::kDifferent, false},
      {"(x + y + x*y + x^2 + y^3 + 1)^60 = x", Verdict::kDifferent, false},
      {"sin(" + fractions + ") = 2", Verdict::kDifferent, false},
      {"(((((x + 1)^90 + 1)^90 + 1)^90 + 1)^90 + 1)^90 = x", Verdict::kUndecided, false},
      {"exp(exp(exp(exp(10^9)))) = x", Verdict::kUndecided, false},
      {"sin(exp(10^9)) = 2", Verdict::kUndecided, false},
      {"exp(5812645919059520172*x) = exp(x)", Verdict::kDifferent, false},
      {"tanh(x/3333 + 5812645919059520172) = asin(tanh(x))", Verdict::kDifferent, false},
      {"(((((x*y)^100)^100)^100)^100)^100 = x", Verdict::kUndecided, false},
      {"x^(1/9973)*x^(1/9967) = x", Verdict::kDifferent, false},
  };
  for (const Row& row : rows) {
    INFO(row.identity);
    const Checked result = checked("symbols y\npositive x\nidentity \"it\": " + row.identity);
    CHECK(result.of("it").verdict == row.verdict);
    CHECK(result.of("it").by_evaluation == row.by_evaluation);
  }
}

TEST_CASE("parentheses, signs and powers are nested as deep as the limit says") {
  const auto said = [](const char* open, const char* close, int depth) {
    std::string text = "x";
    for (int i = 0; i < depth; ++i) text.insert(0, open).append(close);
    return checked("symbols x\nidentity \"it\": " + text + " = x").of("it").verdict;
  };
  CHECK(said("(", ")", 198) == Verdict::kEqual);  // beside the block and the expression around them
  CHECK(said("-", "", 198) == Verdict::kEqual);
  CHECK_THROWS_AS(said("(", ")", 200), InputError);
  CHECK_THROWS_AS(said("-", "", 200), InputError);
  CHECK_THROWS_AS(said("1^", "", 200), InputError);
}

TEST_CASE("long sums neither exhaust the stack nor take long") {
  std::string text = "symbols x\nidentity \"row\": x";
  for (int i = 0; i < 100000; ++i) text += " + x";
  CHECK(checked(text + " = 100001*x").of("row").verdict == Verdict::kEqual);
}

TEST_CASE("statements end with their line unless an operator says otherwise") {
  const Checked result = checked(
      "links 2  # comment\n"
      "G[1] = (m_1/2 + m_2\n        + m_c)*g *\n   l_1\n   *sin(theta_1); G[2] =\n"
      "  (m_2/2 + m_c)*g*l_2*sin(theta_2)\n"
      "K = [k_1 + k_2, -k_2;\n     -k_2, k_2]");
  CHECK(result.count(Verdict::kEqual) == 6);
}
