// SPDX-License-Identifier: GPL-3.0-or-later
//
// Sines and cosines of emitted models against fifty digits, in units in the last place of the
// result, and against themselves in batches, bit for bit.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "generated/batch.hpp"
#include "tests/generated/fifty_digits.hpp"

using catena::tests::FiftyDigits;

namespace {

constexpr double kMostUnits = 0.9;  // what sine_cosine.hpp promises up to 1.6e6

double units_in_last_place(double value, const FiftyDigits& exact) {
  int exponent;
  std::frexp(double(exact), &exponent);
  return std::ldexp(double(abs(FiftyDigits(value) - exact)), 53 - exponent);
}

double worst_error(const std::vector<double>& angles) {
  double worst = 0;
  for (const double x : angles) {
    double sine, cosine;
    catena::sine_cosine(x, sine, cosine);
    worst = std::max({worst, units_in_last_place(sine, sin(FiftyDigits(x))),
                      units_in_last_place(cosine, cos(FiftyDigits(x)))});
  }
  return worst;
}

std::vector<double> between(double low, double high) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(low, high);
  std::vector<double> angles(20000);
  for (double& angle : angles) angle = uniform(random);
  return angles;
}

// The doubles next to multiples of a quarter and an eighth of a turn, where what is left after the
// multiple is small, or the polynomials are at their ends.
std::vector<double> near_multiples(double most) {
  std::vector<double> angles;
  const double eighth = std::numbers::pi / 4;
  const double stride = most < 1000 ? 1 : 331;
  for (double k = 1; k * eighth < most; k += stride) {
    double x = std::nextafter(std::nextafter(k * eighth, 0), 0);
    for (int step = 0; step < 5; ++step, x = std::nextafter(x, most)) angles.push_back(x);
  }
  return angles;
}

template <int count>
void check_batch(const std::vector<double>& angles) {
  using catena::Batch;
  for (std::size_t i = 0; i + count <= angles.size(); i += count) {
    Batch<count> sine, cosine;
    sine_cosine(Batch<count>::of(&angles[i]), sine, cosine);
    for (int k = 0; k < count; ++k) {
      double one_sine, one_cosine;
      catena::sine_cosine(angles[i + static_cast<std::size_t>(k)], one_sine, one_cosine);
      const double batch_sine = sine[k], batch_cosine = cosine[k];
      REQUIRE(std::memcmp(&batch_sine, &one_sine, sizeof one_sine) == 0);
      REQUIRE(std::memcmp(&batch_cosine, &one_cosine, sizeof one_cosine) == 0);
    }
  }
}

}  // namespace

TEST_CASE("sines and cosines are right to 0.9 units in the last place") {
  double all = 0;
  // 0x1.39c6fd67805a7p+18 is as near to a multiple of pi/2 as a double of its size can be.
  for (const auto& angles : std::initializer_list<std::vector<double>>{between(-0.8, 0.8),
                                                                       between(-7, 7),
                                                                       between(-1000, 1000),
                                                                       between(-1.6e6, 1.6e6),
                                                                       between(-1e-7, 1e-7),
                                                                       near_multiples(999),
                                                                       near_multiples(1.6e6),
                                                                       {0x1.39c6fd67805a7p+18}}) {
    const double worst = worst_error(angles);
    CAPTURE(angles.back());
    CHECK(worst < kMostUnits);
    all = std::max(all, worst);
  }
  std::printf("worst error: %.3f units in the last place\n", all);
}

TEST_CASE("zero, and values without a sine") {
  double sine, cosine;
  catena::sine_cosine(0.0, sine, cosine);
  CHECK(sine == 0.0);
  CHECK(cosine == 1.0);
  for (const double x :
       {0x1p31, -0x1p31, 1e300, std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    CAPTURE(x);
    catena::sine_cosine(x, sine, cosine);
    CHECK(std::isnan(sine));
    CHECK(std::isnan(cosine));
  }
}

TEST_CASE("a batch has the bits of one angle at a time") {
  for (const auto& angles : {between(-7, 7), between(-1.6e6, 1.6e6), near_multiples(999)}) {
    check_batch<2>(angles);
    check_batch<4>(angles);
    check_batch<8>(angles);
  }
}
