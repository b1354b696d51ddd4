// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/shares.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "identify/diagnosis/redrawn_errors.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

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

DrawnResiduals drawn_once(const SubsetResiduals& residuals) {
  DrawnResiduals drawn(1);
  drawn.with_noise[0] = drawn.without_noise[0] = residuals;
  return drawn;
}

/// Of recordings whose noise is 1.
std::vector<ShareInterval> shares_of_one(const SubsetResiduals& residuals) {
  return share_intervals(residuals, drawn_once(residuals), {1.0});
}

}  // namespace

TEST_CASE("the shares of effects that do not overlap are those of their squares") {
  std::mt19937 random(3);
  MatrixXd first = MatrixXd::Zero(kChannels, kFrames), second = first;
  first.topRows(4).setConstant(3);      // 9 on half of the channels
  second.bottomRows(4).setConstant(1);  // 1 on the other half
  const auto shares = shares_of_one(two_effects(first, second, white(random)));
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].share == catena::near(0.9, 0.05));
  CHECK(shares[1].share == catena::near(0.1, 0.3));
  CHECK(std::abs(shares[2].share) < 0.05);
  CHECK(shares[0].share + shares[1].share + shares[2].share == doctest::Approx(1));
}

TEST_CASE("effects that explain the same share it, whichever was found first") {
  std::mt19937 random(4);
  const MatrixXd both = smooth(random, 3), rest = white(random);
  const SubsetResiduals either = {{both + rest}, {rest}, {rest}, {rest}};
  const auto shares = shares_of_one(either);
  REQUIRE(shares.size() == 3);
  CHECK(shares[0].share == doctest::Approx(shares[1].share));
  CHECK(shares[0].share == catena::near(0.5, 0.05));
}

TEST_CASE("the noise of each recording is its own, and what was not measured counts for nothing") {
  std::mt19937 random(5);
  const MatrixXd first = smooth(random, 3), second = smooth(random, 2), rest = white(random);
  SubsetResiduals residuals = two_effects(first, second, rest);
  const auto alone = shares_of_one(residuals);
  for (auto& subset : residuals) {
    subset.front() *= 0.002;
    subset.push_back(MatrixXd::Constant(2, 30, std::nan("")));
  }
  const auto scaled = share_intervals(residuals, drawn_once(residuals), {0.002, 1.0});
  for (std::size_t i = 0; i < alone.size(); ++i)
    CHECK(scaled[i].share == doctest::Approx(alone[i].share));
}

TEST_CASE("nothing is shared where there is no misfit") {
  const MatrixXd none = MatrixXd::Zero(kChannels, kFrames);
  CHECK(shares_of_one(two_effects(none, none, none)).empty());
}

// 97.5 % of 900 are 878; fewer than 864 or more than 891 have a chance of 1 in 500 where they are independent.
TEST_CASE("the shares of an endless motion are no smaller than said in 96 to 99 of 100") {
  std::mt19937 random(6);
  constexpr int kTrials = 300;
  const double truth[] = {9 / 12.25, 2.25 / 12.25, 1 / 12.25};
  int covered = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const MatrixXd first = smooth(random, 3), second = smooth(random, 1.5);
    const MatrixXd rest = smooth(random, 1) + white(random);
    const auto shares = shares_of_one(two_effects(first, second, rest));
    for (std::size_t i = 0; i < 3; ++i) covered += shares[i].least <= truth[i];
  }
  CHECK(covered > 0.96 * 3 * kTrials);
  CHECK(covered < 0.99 * 3 * kTrials);
}

namespace {

/// What the damping explains of a film of two links, where it was fitted and later. Without it, it is twice as large.
/// The stiffness is taken for a little larger than it is, which neither explains. `noisy`: the errors are no misfit
/// alone, but noise as well.
std::vector<ShareInterval> shares_of_damping(const MatrixXd& errors, bool noisy) {
  constexpr double kStep = 0.05, kSize = 2e-3;
  constexpr int kFitted = 60;
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  Recording recording =
      testing::with_truth(the_case, model, testing::empty_markers({0.5, 1.0}, kFrames, kStep));
  recording.measured += kSize * errors;
  recording.fit_frames = kFitted;
  the_case.initial.free = true;
  the_case.parameters[0].value *= 1.03;
  the_case.parameters[0].free = false;
  Case without = the_case;
  without.parameters[1].value *= 2;
  without.parameters[1].free = false;
  const std::vector<NoiseModel> level{{.level = kSize}};
  std::vector<FittedModel> fits;
  SubsetResiduals fitted, held_out;
  for (const Case& each : {without, the_case}) {
    const auto problem =
        std::make_shared<const Problem>(each, model, std::vector<Recording>{recording});
    fits.push_back(fit_model(problem, problem->start(), level, fit_least_squares, nullptr));
    fitted.push_back(fits.back().fit_residual);
    held_out.push_back(fits.back().held_out_residual);
  }
  if (!noisy) {
    std::vector<ShareInterval> exact;
    for (const SubsetResiduals& part : {fitted, held_out})
      exact.push_back({1 - part[1][0].squaredNorm() / part[0][0].squaredNorm()});
    return exact;
  }
  const RedrawnErrors redrawn(fits, level);
  constexpr std::size_t kDraws = 200;
  DrawnResiduals fitted_again(kDraws), held_out_again(kDraws);
  for (std::size_t draw = 0; draw < kDraws; ++draw) {
    const RedrawnErrors::Draw drawn = redrawn.draw(draw);
    fitted_again.with_noise[draw] = drawn.with_noise.fitted;
    fitted_again.without_noise[draw] = drawn.without_noise.fitted;
    held_out_again.with_noise[draw] = drawn.with_noise.held_out;
    held_out_again.without_noise[draw] = drawn.without_noise.held_out;
  }
  const auto of_fitted = share_intervals(fitted, fitted_again, {kSize});
  const auto of_held_out = share_intervals(held_out, held_out_again, {kSize});
  REQUIRE_FALSE(of_fitted.empty());
  REQUIRE_FALSE(of_held_out.empty());
  return {of_fitted.front(), of_held_out.front()};
}

}  // namespace

// 95 % of 100 are 95; fewer than 88 have a chance of 1 in 200.
TEST_CASE(
    "the intervals hold the shares that the same motion has without noise and with other misfits") {
  constexpr int kFilms = 100;
  for (const double misfit : {0.0, 1.0}) {
    std::mt19937 random(7);
    const auto misfits = [&] { return MatrixXd(smooth(random, misfit).topRows(4)); };
    double exact[] = {0, 0};
    for (int film = 0; film < kFilms; ++film) {
      const auto shares = shares_of_damping(misfits(), false);
      for (std::size_t part = 0; part < 2; ++part) exact[part] += shares[part].share / kFilms;
    }
    int held[] = {0, 0};
    double width[] = {0, 0};
    for (int film = 0; film < kFilms; ++film) {
      const auto shares = shares_of_damping(misfits() + white(random).topRows(4), true);
      for (std::size_t part = 0; part < 2; ++part) {
        const ShareInterval& share = shares[part];
        held[part] += share.lower <= exact[part] && exact[part] <= share.upper;
        width[part] += (share.upper - share.lower) / kFilms;
      }
    }
    for (std::size_t part = 0; part < 2; ++part) {
      MESSAGE("share " << exact[part] << ", width of the intervals " << width[part] << ", held "
                       << held[part]);
      CHECK(held[part] >= 88);
      CHECK(width[part] < 0.5);
    }
  }
}

}  // namespace shares_test
