// SPDX-License-Identifier: BSD-3-Clause
#include "description/unit.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <string>

#include "common/in_quotes.hpp"

using catena::Exponent;
using catena::Unit;

TEST_CASE("units that are the same read the same, others do not") {
  struct Row {
    const char *a, *b;
    bool same;
  };
  const Row rows[] = {
      {"N", "kg m/s^2", true},       {"N m", "J", true},           {"N*m", "N m", true},
      {"W", "N m/s", true},          {"N m s/rad", "N m s", true}, {"kg/(m s)", "kg/m/s", true},
      {"kg/(m s)", "kg/m s", false},  // the slash takes one factor: kg s/m
      {"N s^2/m^2", "kg/m", true},   {"m^0.5", "m^(1/2)", true},   {"m^-1", "1/m", true},
      {"Hz", "1/s", true},           {"Pa", "N/m^2", true},        {"rad", "1", true},
      {"N/m", "N m", false},         {"kg", "m", false},           {"m/s", "m/s^2", false},
      {"m^(1/2)", "m^(1/3)", false},
  };
  for (const Row& row : rows) {
    CAPTURE(row.a);
    CAPTURE(row.b);
    CHECK((Unit::parse(row.a) == Unit::parse(row.b)) == row.same);
  }
}

TEST_CASE("products, quotients and powers of units are exact") {
  const Unit m = Unit::parse("m"), s = Unit::parse("s");
  CHECK(m / s == Unit::parse("m/s"));
  CHECK((m * m).power({1, 2}) == m);
  CHECK(m.power({1, 3}).power({3, 1}) == m);
  CHECK((m / m).dimensionless());
  CHECK_FALSE(m.power({1, 1000}).dimensionless());
}

TEST_CASE("a unit's text reads back to the unit") {
  for (const char* text : {"1", "m", "N", "N/m", "N m", "W", "kg/m^2", "1/s", "kg/(m s)", "m^(1/2)",
                           "kg m^2", "1/m^3", "N s^3/rad", "N m s^2/rad^2"}) {
    CAPTURE(text);
    const Unit unit = Unit::parse(text);
    CHECK(Unit::parse(unit.text()) == unit);
  }
  CHECK(Unit::parse("kg m/s^2").text() == "N");
  CHECK(Unit::parse("kg/m^2").text() == "kg/m^2");
  CHECK(Unit::parse("kg/(s^2)/m").text() == "kg/(m s^2)");
}

TEST_CASE("units outside of the SI are refused with the unit to use") {
  struct Row {
    const char *text, *said;
  };
  std::string nested(40'000, '(');
  nested += 'm';
  nested.append(40'000, ')');
  const Row rows[] = {
      {"deg", "0.017453292519943295 rad"},
      {"mm", "1 mm = 0.001 m"},
      {"N mm", "1 mm = 0.001 m"},
      {"g", "1 g = 0.001 kg"},
      {"rpm", "rad/s"},
      {"newton", "not a known unit"},
      {"Nm^2", "did you mean \"N m\"?"},
      {"kgg", "did you mean \"kg\"?"},
      {"", "a unit is wanted at its character 1"},
      {"N/", "a unit is wanted at its character 3"},
      {"kg/(m s", "a parenthesis is not closed"},
      {"kg)", "cannot be read"},
      {"m^", "an exponent is"},
      {"m^(1/0)", "(p/q)"},
      {"m^99999", "an exponent is"},
      {"2", "a unit is wanted"},
      {nested.c_str(), "nested too deeply"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    std::string said;
    try {
      Unit::parse(row.text);
    } catch (const std::invalid_argument& error) {
      said = error.what();
    }
    CAPTURE(said);
    CHECK(said.find(row.said) != std::string::npos);
    CHECK(said.starts_with("unit " + catena::in_quotes(row.text)));
  }
}
