// SPDX-License-Identifier: GPL-3.0-or-later
//
// The angle between two links as a function of its cosine, and its derivatives, against fifty digits, in units
// in the last place of the result: for joints that are nearly straight, where they are series, and for bent ones.
#include "generator/emission/support/angle_over_sine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "tests/generated/fifty_digits.hpp"

using catena::tests::FiftyDigits;

namespace {

/// Of a cosine other than 1, by the formulas that lose digits near 1: a third of the fifty at 1 - c = 1e-14.
struct ExactAngle {
  FiftyDigits over_sine, slope, curvature;

  explicit ExactAngle(double cosine) {
    const FiftyDigits c = cosine, one = 1;
    FiftyDigits angle = std::acos(cosine);
    for (int k = 0; k < 4; ++k) angle += (cos(angle) - c) / sin(angle);  // Newton's method
    const FiftyDigits square = one - c * c;
    over_sine = angle / sqrt(square);
    slope = (c * over_sine - one) / square;
    curvature = (FiftyDigits(3) * c * slope + over_sine) / square;
  }
};

double units_off(double value, const FiftyDigits& exact) {
  int exponent = 0;
  std::frexp(double(exact), &exponent);
  return std::ldexp(double(abs(FiftyDigits(value) - exact)), 53 - exponent);
}

/// Cosines whose distance from 1 is between two numbers, each a little larger than the one before.
std::vector<double> cosines(double nearest, double farthest) {
  std::vector<double> all;
  double rest = nearest;
  while (rest < farthest) {
    all.push_back(1 - rest);
    rest *= 1.01;
  }
  return all;
}

}  // namespace

TEST_CASE("series of nearly straight joints are right to 4 units in the last place") {
  for (const double c : cosines(1e-14, 0.125)) {
    CAPTURE(1 - c);
    const ExactAngle exact(c);
    CHECK(units_off(catena::angle_over_sine(c), exact.over_sine) < 4);
    CHECK(units_off(catena::angle_over_sine_slope(c), exact.slope) < 4);
    CHECK(units_off(catena::angle_over_sine_curvature(c), exact.curvature) < 4);
  }
  CHECK(catena::angle_over_sine(1.0) == 1);
  CHECK(catena::angle_over_sine_slope(1.0) == -1.0 / 3);
  CHECK(catena::angle_over_sine_curvature(1.0) == 4.0 / 15);
}

// The slope is a difference of about 2/3 (1 - c) of two numbers near 1, the curvature one of such.
TEST_CASE("bent joints lose what the differences of their formulas lose") {
  for (const double c : cosines(0.125, 1.9)) {
    CAPTURE(1 - c);
    const ExactAngle exact(c);
    CHECK(units_off(catena::angle_over_sine(c), exact.over_sine) < 4);
    CHECK(units_off(catena::angle_over_sine_slope(c), exact.slope) < 64);
    CHECK(units_off(catena::angle_over_sine_curvature(c), exact.curvature) < 256);
  }
}
