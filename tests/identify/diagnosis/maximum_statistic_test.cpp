// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/maximum_statistic.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "identify/noise/cosine_spectrum.hpp"

namespace maximum_statistic_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kChannels = 4, kFrames = 120;

/// A process of first order in every channel: 0 is white.
MatrixXd noise(double autocorrelation, std::mt19937_64& random) {
  MatrixXd x(kChannels, kFrames);
  for (Index c = 0; c < kChannels; ++c) {
    double value = catena::normal_number(random);
    for (Index k = 0; k < kFrames; ++k) {
      x(c, k) = value;
      value = autocorrelation * value +
              std::sqrt(1 - autocorrelation * autocorrelation) * catena::normal_number(random);
    }
  }
  return x;
}

/// What a candidate does: a slow oscillation of its own frequency, growing or fading.
VectorXd oscillation(int which) {
  MatrixXd x(kChannels, kFrames);
  for (Index c = 0; c < kChannels; ++c)
    for (Index k = 0; k < kFrames; ++k) {
      const double t = static_cast<double>(k) / kFrames;
      x(c, k) = (which % 2 ? t : 1 - t) * (1.0 + static_cast<double>(c)) *
                std::sin(2 * std::numbers::pi * (1 + 0.5 * which) * t + 0.1 * which);
    }
  return x.reshaped();
}

struct Candidates {
  explicit Candidates(const MatrixXd& residual) : test(residual.reshaped(), oscillation(30)) {
    for (int i = 0; i < 12; ++i)
      tried["effect_" + std::to_string(i)] = {{test.add({oscillation(i), -1e9, 1e9})},
                                              {test.add({oscillation(i + 12), -1e9, 1e9})}};
  }
  /// The chance of the best of all.
  double chance() const {
    std::string best;
    catena::Score of_best;
    std::vector<int> columns;
    for (const auto& [name, shapes] : tried)
      for (const std::vector<int>& each : shapes)
        if (const catena::Score score = test.score(each); score.removed > of_best.removed)
          best = name, of_best = score, columns = each;
    const std::vector<MatrixXd> left = {
        test.residual_after(columns, of_best.estimate).reshaped(kChannels, kFrames)};
    return catena::MaximumStatistic(test, tried, left, 2, [] {})
        .chance(best, {test.residual().reshaped(kChannels, kFrames)}, left);
  }
  catena::ScoreTest test;
  catena::TriedColumns tried;
};

/// In how many of 200 recordings without any of the candidates chance is said to be 5 % at most.
int told(double autocorrelation) {
  std::mt19937_64 random(7);
  int count = 0;
  for (int trial = 0; trial < 200; ++trial)
    count += Candidates(noise(autocorrelation, random)).chance() <= 0.05;
  return count;
}

// 10 are expected; 1 in 1000 tests has 21 or more by chance, 1 in 1000 has 1 or none.
TEST_CASE("of residuals without a candidate as many are called certain as the level says") {
  const int count = told(0);
  CHECK(count <= 20);
  CHECK(count >= 2);
}
TEST_CASE("smooth errors are no candidate either") { CHECK(told(0.9) <= 20); }

TEST_CASE("what is there is told from chance") {
  std::mt19937_64 random(8);
  const MatrixXd there = oscillation(3).reshaped(kChannels, kFrames);  // rms 1.1
  CHECK(Candidates(there + noise(0, random)).chance() == doctest::Approx(1.0 / 200));
  CHECK(Candidates(there + noise(0.8, random)).chance() <= 0.01);
}

TEST_CASE("residuals of another size are refused") {
  std::mt19937_64 random(9);
  const Candidates candidates(noise(0, random));
  CHECK_THROWS_AS(catena::MaximumStatistic(candidates.test, candidates.tried,
                                           {MatrixXd::Zero(kChannels, kFrames - 1)}, 1, [] {}),
                  std::invalid_argument);
}

TEST_CASE("what the check throws ends the work") {
  std::mt19937_64 random(9);
  const Candidates candidates(noise(0, random));
  int calls = 0;
  const auto end_the_tenth = [&] {
    if (++calls == 10) throw std::runtime_error("ended");
  };
  CHECK_THROWS_WITH(
      catena::MaximumStatistic(candidates.test, candidates.tried,
                               {MatrixXd::Zero(kChannels, kFrames)}, 1, end_the_tenth),
      "ended");
  CHECK(calls == 10);
}

}  // namespace

}  // namespace maximum_statistic_test
