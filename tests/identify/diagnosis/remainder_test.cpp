// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/remainder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "identify/diagnosis/thresholds.hpp"
#include "identify/noise/cosine_spectrum.hpp"
#include "linear_algebra/decompositions.hpp"

using namespace catena;

namespace remainder_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kChannels = 4, kFitted = 120, kHeldOut = 40, kFrames = kFitted + kHeldOut;

MatrixXd white(std::mt19937_64& random) {
  return MatrixXd::NullaryExpr(kChannels, kFrames, [&] { return normal_number(random); });
}

/// A smooth error of mean square 1 that no unknown imitates: of some frequencies, with random phases.
MatrixXd smooth(std::mt19937_64& random) {
  MatrixXd x = MatrixXd::Zero(kChannels, kFrames);
  for (const double periods : {11.0, 13.3, 17.9, 23.1}) {
    const double a = normal_number(random), b = normal_number(random);
    for (Index c = 0; c < kChannels; ++c)
      for (Index k = 0; k < kFrames; ++k) {
        const double phase = 2 * std::numbers::pi * periods * static_cast<double>(k) / kFrames +
                             0.7 * static_cast<double>(c);
        x(c, k) += a * std::cos(phase) + b * std::sin(phase);
      }
  }
  return x / std::sqrt(x.squaredNorm() / static_cast<double>(x.size()));
}

/// Derivatives by three unknowns whose errors grow after the fitted part, with powers of time.
MatrixXd along(double power) {
  MatrixXd columns(kChannels * kFrames, 3);
  for (Index j = 0; j < 3; ++j)
    for (Index k = 0; k < kFrames; ++k)
      for (Index c = 0; c < kChannels; ++c) {
        const double t = static_cast<double>(k) / kFitted;
        columns(k * kChannels + c, j) = std::pow(t, power * static_cast<double>(j)) *
                                        std::sin(20 * t + static_cast<double>(c + j));
      }
  return columns;
}

/// What a linear model leaves of this, fitted to the first part. `with_derivatives`: of the test.
Remainder left_of(const MatrixXd& error, double power, bool with_derivatives = true) {
  const MatrixXd columns = along(power);
  const Index rows = kChannels * kFitted;
  const VectorXd stacked = error.reshaped();
  const VectorXd x = least_squares(MatrixXd(columns.topRows(rows)), VectorXd(stacked.head(rows)));
  const MatrixXd left = (stacked - columns * x).reshaped(kChannels, kFrames);
  Remainder remainder{{left.leftCols(kFitted)},
                      {left.rightCols(kHeldOut)},
                      columns.topRows(rows),
                      columns.bottomRows(kChannels * kHeldOut)};
  if (!with_derivatives) {
    remainder.fitted_along.resize(rows, 0);
    remainder.held_out_along.resize(kChannels * kHeldOut, 0);
  }
  return remainder;
}

struct Counts {
  int fitted = 0, held_out = 0;
};

/// In how many recordings more is said to be left, at a level of 5 %, than noise and a smooth error of
/// the mean square `tolerated`, where there is noise and one of mean square `error`.
Counts gaps(int recordings, double error, double tolerated, double power = 2,
            bool with_derivatives = true) {
  std::mt19937_64 random(11);
  Counts counts;
  for (int recording = 0; recording < recordings; ++recording) {
    const MatrixXd noise = white(random);
    const OfParts chance = chance_of_remainder(
        left_of(noise + std::sqrt(error) * smooth(random), power, with_derivatives),
        {tolerated, tolerated});
    counts.fitted += chance.fitted <= 0.05;
    counts.held_out += chance.held_out <= 0.05;
  }
  return counts;
}

}  // namespace

// The level of the noise is as doubtful as an estimate, so fewer than 10 are expected where it is
// known; 1 in 1000 tests has 21 or more by chance if 10 are expected.
TEST_CASE("a right model is said to leave a gap as often as the level says") {
  const Counts counts = gaps(200, 0, 0);
  MESSAGE("false gaps of 200: fitted " << counts.fitted << ", held out " << counts.held_out);
  CHECK(counts.fitted <= 20);
  CHECK(counts.held_out <= 20);
  CHECK(counts.held_out >= 1);
}

TEST_CASE("without the errors of the unknowns what is held out is said to have a gap") {
  const Counts counts = gaps(50, 0, 0, 4, false);
  MESSAGE("false gaps of 50 held out: " << counts.held_out);
  CHECK(counts.held_out >= 10);
}

TEST_CASE("errors of laws that are tolerated are said to be a gap as often as the level says") {
  for (const double error : {0.16, 1.0}) {
    const Counts counts = gaps(200, error, error);
    MESSAGE("false gaps of 200 with errors of laws of mean square "
            << error << ": fitted " << counts.fitted << ", held out " << counts.held_out);
    CHECK(counts.fitted <= 20);
    CHECK(counts.held_out <= 20);
  }
}

TEST_CASE("more than what is tolerated is a gap: false closings") {
  for (const double error : {0.5, 2.0}) {
    const Counts counts = gaps(50, 4 * error, error);
    MESSAGE("gaps found of 50, with four times the mean square tolerated, "
            << error << ": fitted " << counts.fitted << ", held out " << counts.held_out);
    CHECK(counts.fitted >= 48);
    CHECK(counts.held_out >= 45);
  }
}

// What an effect of physics explained may be wrong by a tenth, so a hundredth of its mean square is
// left. What errors of knowns and sensors explained has no such errors.
TEST_CASE("beside laws an error of a tenth is no gap, beside what is exact it is") {
  std::mt19937_64 random(5);
  for (int recording = 0; recording < 5; ++recording) {
    const MatrixXd noise = white(random), error = smooth(random);
    const Remainder left = left_of(noise + 3 * error, 2), bare = left_of(noise + 30 * error, 2);
    CHECK(only_errors_of_laws(left, bare, {true, true}));
    CHECK_FALSE(only_errors_of_laws(left, left, {true, false}));
    CHECK_FALSE(only_errors_of_laws(left, left, {false, true}));
    CHECK(only_errors_of_laws(left, left, {false, false}));
  }
}

TEST_CASE("nothing seen is no gap; derivatives of another size are refused") {
  const MatrixXd none(kChannels, 0);
  const OfParts chance = chance_of_remainder(
      {{MatrixXd::Constant(kChannels, 9, std::numeric_limits<double>::quiet_NaN())},
       {none},
       {},
       {}},
      {0, 0});
  CHECK(chance.fitted == 1);
  CHECK(chance.held_out == 1);
  std::mt19937_64 random(3);
  Remainder remainder = left_of(white(random), 2);
  remainder.held_out_along.conservativeResize(Eigen::NoChange, 2);
  CHECK_THROWS_AS(chance_of_remainder(remainder, {0, 0}), std::invalid_argument);
}

TEST_CASE("at a glance a gap is closed where a tenth of the misfit is left, or none") {
  GapTest before, left;
  before.misfit = 10e-3;
  left.present = true;
  left.misfit = 0.9e-3;
  CHECK(nearly_closes(left, before));
  left.misfit = 1.2e-3;
  CHECK_FALSE(nearly_closes(left, before));
  left.present = false;
  CHECK(nearly_closes(left, before));
}

}  // namespace remainder_test
