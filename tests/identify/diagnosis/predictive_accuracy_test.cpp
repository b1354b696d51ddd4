// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/predictive_accuracy.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace predictive_accuracy_test {
namespace {

constexpr int kChannels = 4;
const std::vector<catena::NoiseModel> kNoise = {{.level = 1e-3}};

/// A model that leaves noise, the same for all of a seed, and a motion of so much rms and of random
/// phases of its own in the held-out part.
FittedModel leaving(double misfit, int frames, unsigned seed, unsigned phases) {
  std::mt19937_64 random(seed), of_motion(phases);
  std::normal_distribution<double> gauss(0, kNoise[0].level);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
  FittedModel model;
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  model.problem = std::make_shared<const Problem>(
      the_case, Model::built_in(2),
      std::vector<Recording>{testing::empty_markers({0.5, 1.0}, frames, 0.01)});
  Eigen::MatrixXd residual(kChannels, frames);
  for (int c = 0; c < kChannels; ++c) {
    const double phase = turn(of_motion);
    for (int k = 0; k < frames; ++k)
      residual(c, k) = gauss(random) + misfit * std::numbers::sqrt2 * std::sin(0.6 * k + phase);
  }
  model.held_out_residual = {residual};
  model.fit_residual = {Eigen::MatrixXd(kChannels, 0)};
  return model;
}

}  // namespace

TEST_CASE("a model that leaves less of what was held out predicts better, and not the reverse") {
  const FittedModel good = leaving(0, 240, 1, 1), bad = leaving(1e-3, 240, 1, 1);
  CHECK(predicts_better(good, bad, kNoise));
  CHECK_FALSE(predicts_better(bad, good, kNoise));
  // 4 % more is a detail.
  CHECK_FALSE(predicts_better(good, leaving(0.28e-3, 240, 1, 1), kNoise));
  // Few frames prove nothing.
  CHECK(chance_of_lead(leaving(0, 23, 1, 1), leaving(1e-3, 23, 1, 1), kNoise) == 1);
  CHECK(chance_of_lead(good, bad, kNoise) == catena::near(1.0 / 4096, 1e-12));
}

TEST_CASE("a lead that grows is one from the beginning") {
  FittedModel growing = leaving(2e-3, 240, 1, 1);
  for (Eigen::Index k = 0; k < 240; ++k)
    growing.held_out_residual[0].col(k) *= std::exp(0.03 * static_cast<double>(k));
  CHECK(predicts_better(leaving(0, 240, 1, 1), growing, kNoise));
}

TEST_CASE("of two models that predict alike, one leads by chance as rarely as it says") {
  int one_in_20 = 0, one_in_1000 = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const double chance = chance_of_lead(leaving(0.5e-3, 240, seed, 2 * seed),
                                         leaving(0.5e-3, 240, seed + 5000, 2 * seed + 1), kNoise);
    one_in_20 += chance < 0.05;
    one_in_1000 += chance < 0.001;
  }
  CHECK(one_in_20 >= 29);  // 50 expected, standard deviation 7
  CHECK(one_in_20 <= 71);
  CHECK(one_in_1000 <= 5);  // 1 expected
}

}  // namespace predictive_accuracy_test
