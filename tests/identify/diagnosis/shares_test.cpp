// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/shares.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

using namespace catena;
using Eigen::Index;
using Eigen::MatrixXd;

namespace shares_test {
namespace {

constexpr Index kChannels = 8, kFrames = 180;

/// What an effect leaves if it is missing: smooth in time, the same in all channels.
MatrixXd smooth(std::mt19937& random, double size) {
  std::normal_distribution<double> normal;
  constexpr double kMemory = 0.7;
  MatrixXd values(kChannels, kFrames);
  double now = normal(random);
  for (Index k = 0; k < kFrames; ++k) {
    now = kMemory * now + std::sqrt(1 - kMemory * kMemory) * normal(random);
    values.col(k).setConstant(size * now);
  }
  return values;
}

MatrixXd white(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return MatrixXd::NullaryExpr(kChannels, kFrames, [&] { return normal(random); });
}

/// Two effects, and something that nobody knows, over noise of 1.
SubsetResiduals two_effects(const MatrixXd& first, const MatrixXd& second, const MatrixXd& rest) {
  return {{first + second + rest}, {second + rest}, {first + rest}, {rest}};
}

}  // namespace

TEST_CASE("the shares of effects that do not overlap are those of their squares") {
  std::mt19937 random(3);
  MatrixXd first = MatrixXd::Zero(kChannels, kFrames), second = first;
  first.topRows(4).setConstant(3);      // 9 on half of the channels
  second.bottomRows(4).setConstant(1);  // 1 on the other half
  const auto shares = share_intervals(two_effects(first, second, white(random)), {1.0}, 1);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].share == doctest::Approx(0.9).epsilon(0.05));
  CHECK(shares[1].share == doctest::Approx(0.1).epsilon(0.3).scale(0));
  CHECK(std::abs(shares[2].share) < 0.05);
  CHECK(shares[0].share + shares[1].share + shares[2].share == doctest::Approx(1));
}

TEST_CASE("effects that explain the same share it, whichever was found first") {
  std::mt19937 random(4);
  const MatrixXd both = smooth(random, 3), rest = white(random);
  const SubsetResiduals either = {{both + rest}, {rest}, {rest}, {rest}};
  const auto shares = share_intervals(either, {1.0}, 1);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].share == doctest::Approx(shares[1].share));
  CHECK(shares[0].share == doctest::Approx(0.5).epsilon(0.05));
}

TEST_CASE("the noise of each recording is its own, and what was not measured counts for nothing") {
  std::mt19937 random(5);
  const MatrixXd first = smooth(random, 3), second = smooth(random, 2), rest = white(random);
  SubsetResiduals residuals = two_effects(first, second, rest);
  const auto alone = share_intervals(residuals, {1.0}, 1);
  for (auto& subset : residuals) {
    subset.front() *= 0.002;
    subset.push_back(MatrixXd::Constant(2, 30, std::nan("")));
  }
  const auto scaled = share_intervals(residuals, {0.002, 1.0}, 1);
  for (std::size_t i = 0; i < alone.size(); ++i)
    CHECK(scaled[i].share == doctest::Approx(alone[i].share));
}

TEST_CASE("nothing is shared where there is no misfit") {
  const MatrixXd none = MatrixXd::Zero(kChannels, kFrames);
  CHECK(share_intervals(two_effects(none, none, none), {1.0}, 1).empty());
}

TEST_CASE("the intervals cover the shares of an endless recording in 90 to 97 of 100") {
  std::mt19937 random(6);
  constexpr int kTrials = 300;
  const double truth[] = {9 / 12.25, 2.25 / 12.25, 1 / 12.25};
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MatrixXd first = smooth(random, 3), second = smooth(random, 1.5);
    const MatrixXd rest = smooth(random, 1) + white(random);
    const auto shares = share_intervals(two_effects(first, second, rest), {1.0}, 1);
    for (std::size_t i = 0; i < 3; ++i)
      covered += shares[i].lower <= truth[i] && truth[i] <= shares[i].upper;
  }
  CHECK(covered > 0.90 * 3 * kTrials);
  CHECK(covered < 0.97 * 3 * kTrials);
}

}  // namespace shares_test
