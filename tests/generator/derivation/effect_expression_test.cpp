// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/derivation/effect_expression.hpp"

#include <doctest/doctest.h>

#include <string>
#include <utility>

#include "common/toml_reader.hpp"
#include "description/effect_reader.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using GiNaC::ex;
using GiNaC::numeric;

namespace {

const GiNaC::realsymbol kC("c"), kV("v"), kM("m"), kAngle("a"), kTime("t");

ExpressionContext context() {
  ExpressionContext known;
  known.add("c", kC, Unit::parse("N s/m"));
  known.add("velocity", kV, Unit::parse("m/s"));
  known.add("mass", kM, Unit::parse("kg"));
  known.add("angle", kAngle, Unit::parse("rad"));
  known.add("time", kTime, Unit::parse("s"));
  return known;
}

Expression written(const std::string& text) { return {text, "drag.toml", 7, "force.side"}; }

std::string said_of(const std::string& text, const char* unit = "N") {
  return failure([&] { parse_expression(written(text), context(), Unit::parse(unit)); });
}

}  // namespace

TEST_CASE("expressions mean what they say") {
  struct Row {
    const char *text, *unit;
    ex value;
  };
  const Row rows[] = {
      {"-c*velocity", "N", -kC * kV},
      {"c * velocity / 2", "N", kC * kV / 2},
      {"0.1*c*velocity", "N", kC * kV / 10},
      {"1e-6*velocity", "m/s", kV / 1000000},
      {"2.5e2*velocity", "m/s", 250 * kV},
      {".5*velocity", "m/s", kV / 2},
      {"-velocity^2", "m^2/s^2", -kV * kV},
      {"(-velocity)^2", "m^2/s^2", kV * kV},
      {"2^3^2", "1", 512},
      {"velocity^-1", "s/m", 1 / kV},
      {"velocity^(3/2)", "m^(3/2)/s^(3/2)", GiNaC::pow(kV, numeric(3, 2))},
      {"velocity^0.5", "m^(1/2)/s^(1/2)", GiNaC::sqrt(kV)},
      {"sqrt(velocity^2 + velocity^2)", "m/s", GiNaC::sqrt(2 * kV * kV)},
      {"velocity - -velocity", "m/s", 2 * kV},
      {"8/4/2", "1", 1},
      {"8 - 4 - 2", "1", 2},
      {"2*pi", "rad", 2 * GiNaC::Pi},
      {"sin(angle) + tanh(2*angle)", "1", GiNaC::sin(kAngle) + GiNaC::tanh(2 * kAngle)},
      {"mass*velocity/time", "N", kM * kV / kTime},
      {"angle/time", "1/s", kAngle / kTime},
      {"0", "N m", 0},
      {"0 + mass", "kg", kM},
      {"mass + 0", "kg", kM},
      {"-(0) + mass", "kg", kM},
      {"cos(0)*mass", "kg", kM},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const ex value = parse_expression(written(row.text), context(), Unit::parse(row.unit));
    CHECK((value - row.value).expand().is_zero());
  }
}

TEST_CASE("every function is the one it is called") {
  const std::pair<const char*, double> rows[] = {
      {"sin", 0.29552020666133957},  {"cos", 0.9553364891256060},   {"tan", 0.30933624960962325},
      {"exp", 1.3498588075760032},   {"log", -1.2039728043259360},  {"sqrt", 0.5477225575051661},
      {"tanh", 0.29131261245159090}, {"sinh", 0.30452029344714261}, {"cosh", 1.0453385141288605},
      {"atan", 0.29145679447786710}, {"asinh", 0.29567304756342244}};
  for (const auto& row : rows) {
    CAPTURE(row.first);
    const ex value =
        parse_expression(written(std::string(row.first) + "(angle)"), context(), Unit());
    const ex number = value.subs(kAngle == numeric(3, 10)).evalf();
    CHECK(GiNaC::ex_to<numeric>(number).to_double() == catena::near(row.second, 1e-14));
  }
}

TEST_CASE("units that do not fit are refused, naming the sub-term and both units") {
  struct Row {
    const char *text, *unit, *said;
  };
  const Row rows[] = {
      {"c", "N", "it is in N s/m where N is wanted"},
      {"c*velocity", "N/m", "it is in N where N/m is wanted"},
      {"c*velocity + mass", "N", "\"c*velocity\" is in N, but \"mass\" is in kg; terms of a sum"},
      {"2*(mass - velocity*time)", "kg", "\"mass\" is in kg, but \"velocity*time\" is in m"},
      {"c*velocity*(1 + velocity)", "N", "\"1\" is in 1, but \"velocity\" is in m/s"},
      {"c*velocity*sin(time)", "N", "the argument of sin, \"time\", is in s; it must have no unit"},
      {"c*velocity*exp(mass*velocity)", "N", "the argument of exp, \"mass*velocity\", is in N s"},
      {"c*velocity^time", "N", "the exponent \"time\" is in s; exponents have no unit"},
      {"mass - mass + velocity", "kg", "\"mass - mass\" is in kg, but \"velocity\" is in m/s"},
      {"0*velocity + mass - velocity", "kg", "but \"velocity\" is in m/s"},
      {"sqrt(velocity)", "m/s", "it is in m^(1/2)/s^(1/2) where m/s is wanted"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const std::string said = said_of(row.text, row.unit);
    CAPTURE(said);
    CHECK(said.find("drag.toml:7: force.side: in \"" + std::string(row.text) + "\": ") == 0);
    CHECK(said.find(row.said) != std::string::npos);
  }
}

TEST_CASE("nothing but the grammar is accepted") {
  struct Row {
    const char *text, *said;
  };
  const Row rows[] = {
      {"velocty", "\"velocty\" has no meaning here; did you mean \"velocity\"?"},
      {"zzzzzzzzz", "\"zzzzzzzzz\" has no meaning here; known are angle, c, mass, pi, time and"},
      {"sine(angle)", "\"sine\" is no known function; did you mean \"sin\"?"},
      {"mass(2)", "\"mass\" is no known function"},
      {"abs(velocity)", "abs has no derivative everywhere; write sqrt(x^2 + floor^2)"},
      {"sign(velocity)", "sign has no derivative everywhere; write x/sqrt(x^2 + floor^2)"},
      {"2 c", "\"c\" cannot stand here, at its character 3"},
      {"c**2", "\"*\" cannot stand here, at its character 3"},
      {"c + ", "it ends where a number, a name or a parenthesis is wanted"},
      {"(c", "the parenthesis at its character 1 is not closed"},
      {"c)", "\")\" cannot stand here, at its character 2"},
      {"sin(angle, 2)", "sin(...) takes one argument and ends with a parenthesis"},
      {"c; c", "\";\" cannot stand here, at its character 2"},
      {"c == c", "\"=\" cannot stand here, at its character 3"},
      {"I", "\"I\" has no meaning here"},
      {"Pi", "\"Pi\" has no meaning here; did you mean \"pi\"?"},
      {"c^angle", "the exponent \"angle\" is no rational number"},
      {"2^pi", "the exponent \"pi\" is no rational number"},
      {"2^1000", "the exponent \"1000\" is too large"},
      {"2^(1/101)", "the exponent \"(1/101)\" is too large"},
      {"1e", "\"1e\" is not a number; write 12, 0.5 or 1e-6"},
      {"1e999", "\"1e999\" is too large or too small"},
      {"1e99999999999999999999", "\"1e99999999999999999999\" is too large or too small"},
      {".", "\".\" is not a number"},
      {"c/0", "\"0\" is zero; nothing divides by it"},
      {"c/(1 - 1)", "\"(1 - 1)\" is zero; nothing divides by it"},
      {"0^-1", "\"0\" is zero; it has no power -1"},
      {"log(0)", "it is infinite"},
      {"c\xC2\xB2", "cannot stand here"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const std::string said = said_of(row.text);
    CAPTURE(said);
    CHECK(said.find(row.said) != std::string::npos);
  }
  CHECK(said_of(std::string(3000, '(')).find("it is nested too deeply") != std::string::npos);
  CHECK(said_of(std::string(3000, '-')).find("it is nested too deeply") != std::string::npos);
  CHECK(said_of(std::string(5000, '1')).find("5000 characters is too long") != std::string::npos);
  std::string sum = "1";  // as deep a tree as can be
  while (sum.size() < 3990) sum += "+1";
  CHECK(said_of(sum, "1").empty());
}

TEST_CASE("a definition carries its value and its unit") {
  ExpressionContext known = context();
  add_definition({"momentum", Place::kLoad, written("mass*velocity")}, known);
  const ex value = parse_expression(written("momentum/time"), known, Unit::parse("N"));
  CHECK((value - kM * kV / kTime).is_zero());
  CHECK(failure([&] {
          parse_expression(written("momentum"), known, Unit::parse("N"));
        }).find("it is in N s where N is wanted") != std::string::npos);
}

TEST_CASE("a table is a broken line with rounded corners, constant beyond its ends") {
  const Effect effect = read_effect(TomlTable::parse(
      "format = 1\nkind = \"effect\"\nid = \"shear\"\ntitle = \"t\"\ndescription = \"d\"\n"
      "[[table]]\nname = \"speed\"\nof = \"2*depth\"\nof_unit = \"m\"\nunit = \"m/s\"\n"
      "points = [-2, 3, 10, 11]\nvalues = [0.5, 2, -1.5, -1.5]\nrounding = 1e-4\n"
      "[flow]\nside = \"speed\"\n[[force]]\nat = \"load\"\nside = "
      "\"load_mass*gravity/9*relative_side/relative_down\"\n",
      "shear.toml", "effect"));
  struct Row {
    double at, value;  // of 2 depth
  };
  for (const Row& row : {Row{-2000, 0.5},
                         {-2.5, 0.5},
                         {0, 1.1},
                         {2.5, 1.85},
                         {3.5, 1.75},
                         {8, -0.5},
                         {10.5, -1.5},
                         {12, -1.5},
                         {4000, -1.5}}) {
    CAPTURE(row.at);
    ExpressionContext known;
    known.add("depth", ex(row.at / 2), Unit::parse("m"));
    for (const Constant& constant : effect.constants)
      known.add(constant.name, exact_number(constant.text), Unit::parse(constant.unit));
    add_definition(effect.definitions.at(0), known);
    const ex value = parse_expression(written("speed"), known, Unit::parse("m/s")).evalf();
    CHECK(GiNaC::ex_to<numeric>(value).to_double() == catena::near(row.value, 1e-7));
  }
}

TEST_CASE("decimal numbers are exact") {
  CHECK(exact_number("0.1").is_equal(numeric(1, 10)));
  CHECK(exact_number("-12.50").is_equal(numeric(-25, 2)));
  CHECK(exact_number("1e-06").is_equal(numeric(1, 1000000)));
  CHECK(exact_number("1.5e+3").is_equal(numeric(1500)));
  CHECK(exact_number("007").is_equal(numeric(7)));
}
