// SPDX-License-Identifier: GPL-3.0-or-later
#include "generator/checking/exact_form.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "generator/checking/numeric_state.hpp"

using namespace catena::checking;
using GiNaC::ex;

namespace {

const GiNaC::realsymbol x("x"), y("y");

std::optional<GiNaC::numeric> value(const ex& e, int bits) {
  ExactForm form({e});
  const std::optional<ex> rational = form(e);
  REQUIRE(rational);
  return Evaluation(form.point({*rational}, bits, 1))(*rational);
}

}  // namespace

TEST_CASE("identities are exactly zero at a random point, others exactly not") {
  const ex half = cos(x / 2), product = cos(x) * cos(y) + sin(x) * sin(y);
  CHECK(value(pow(sin(x), 2) + pow(cos(x), 2) - 1, 128)->is_zero());
  CHECK(value(1 + cos(x) - 2 * half * half, 128)->is_zero());
  CHECK(value((cos(x - y) - product) * y / (x + sin(x)), 128)->is_zero());
  CHECK(value(exp(x) * exp(-x / 2) - exp(x / 2), 128)->is_zero());
  CHECK_FALSE(value(1 + cos(x) - 2 * half, 128)->is_zero());
  CHECK_FALSE(value(sin(x) - x, 128)->is_zero());  // the angle and its sine are independent
  CHECK_FALSE(value(product - cos(x + y), 128)->is_zero());
}

TEST_CASE("variables of a point are independent, and as large as asked for") {
  CHECK_FALSE(value(x - y, 128)->is_zero());
  CHECK_FALSE(value(sin(x) - sin(y), 128)->is_zero());
  CHECK_FALSE(value(sin(x) * (1 + x * x) - 2 * x, 128)->is_zero());  // x is not tan(x/2)
  CHECK_FALSE(value(exp(x) - x, 128)->is_zero());
  for (const int bits : {128, 512}) {
    const GiNaC::numeric most = GiNaC::pow(GiNaC::numeric(2), GiNaC::numeric(bits));
    CHECK(*value(x, bits) <= most);
    CHECK(*value(x, bits) > most / GiNaC::numeric(0x100000000L));
  }
  const ExactForm form({x});
  CHECK_FALSE(form.point({x}, 128, 1).at(x).is_equal(form.point({x}, 128, 2).at(x)));
}

TEST_CASE("an expression vanishes where its exact value does") {
  CHECK(vanishes(pow(sin(x), 2) + pow(cos(x), 2) - 1, 1) == true);
  CHECK(vanishes(sin(x) - x, 1) == false);
  CHECK_FALSE(vanishes(log(x) - log(x * y) + log(y), 1));
}

TEST_CASE("points are large enough for the degree") {
  CHECK(bits_for({1, 0}) == 128);
  CHECK(bits_for({std::ldexp(1.0, 27), 0}) == 192);  // 2^27 + 1 of 2^(27 + 101): just too many
  CHECK_FALSE(bits_for({1, std::numeric_limits<double>::infinity()}));
}

TEST_CASE("degrees bound what a fraction has in all its variables") {
  const ExactForm form({x});
  const Degree sum = form.degree(pow(x + y, 3) + x / y + 1);
  CHECK(sum.numerator >= 4);  // ((x + y)^3 y + x + y)/y
  CHECK(sum.denominator == 1);
  const Degree inverse = form.degree(pow(x * x + y, -2));
  CHECK(inverse.numerator == 0);
  CHECK(inverse.denominator == 4);
  ExactForm circular({sin(x)});
  CHECK(circular.degree(*circular(pow(sin(x), 3))).numerator >= 3);  // (2 t)^3/(1 + t^2)^3
  CHECK(circular.degree(*circular(pow(sin(x), 3))).denominator == 6);
}

TEST_CASE("what is not rational has no exact value") {
  for (const ex& e : {ex(log(x * x + 1)), ex(sqrt(x * x + 1)), ex(abs(x)), ex(sqrt(ex(2)))})
    CHECK_FALSE(ExactForm({e})(e));
}
