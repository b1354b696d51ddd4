// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "identify/cases/case_reader.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/diagnosis/gap_test.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/score.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/noise/noise_level.hpp"
#include "tests/support/near.hpp"

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd white(int channels, int frames, double sigma, unsigned seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> gauss(0, sigma);
  return MatrixXd::NullaryExpr(channels, frames, [&] { return gauss(random); });
}

std::vector<double> times(int frames, double rate) {
  std::vector<double> t;
  for (int k = 0; k < frames; ++k) t.push_back(k / rate);
  return t;
}

/// A smooth misfit of so much rms, the same shape along the channels.
MatrixXd smooth(int channels, int frames, double rms, double frequency, double rate) {
  MatrixXd m(channels, frames);
  for (int c = 0; c < channels; ++c)
    for (int k = 0; k < frames; ++k)
      m(c, k) = rms * std::numbers::sqrt2 *
                std::sin(2 * std::numbers::pi * frequency * k / rate + c / 24.0);
  return m;
}

TEST_CASE("the noise level is found under a smooth misfit of ten times its size") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const MatrixXd noise = white(24, 240, 1e-3, seed);
    CHECK(catena::noise_level(noise, times(240, 60)) == catena::near(1e-3, 0.05));
    const MatrixXd both = noise + smooth(24, 240, 1e-2, 1.5, 60);
    CHECK(catena::noise_level(both, times(240, 60)) == catena::near(1e-3, 0.05));
  }
}

TEST_CASE("lost markers do not disturb the noise level") {
  MatrixXd noise = white(24, 240, 1e-3, 6);
  for (int k = 0; k < 240; k += 13)
    for (int c = 0; c < 24; c += 5) noise(c, k) = std::nan("");
  CHECK(catena::noise_level(noise, times(240, 60)) == catena::near(1e-3, 0.06));
}

TEST_CASE("white noise is no gap in 200 recordings; a smooth misfit of half the noise is one") {
  int alarms = 0, found = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const MatrixXd noise = white(24, 120, 1e-3, seed);
    alarms += catena::test_gap({noise}, {{.level = 1e-3}}).present;
    found += catena::test_gap({noise + smooth(24, 120, 5e-4, 1, 30)}, {{.level = 1e-3}}).present;
  }
  CHECK(alarms == 0);
  CHECK(found == 200);
}

TEST_CASE("the misfit is the part that neighbouring frames share") {
  const MatrixXd both = white(24, 600, 1e-3, 3) + smooth(24, 600, 2e-3, 1, 60);
  const catena::GapTest gap = catena::test_gap({both}, {{.level = 1e-3}});
  CHECK(gap.misfit == catena::near(2e-3, 0.03));
  CHECK(gap.ratio() == catena::near(std::sqrt(5.0), 0.03));
}

TEST_CASE("an effect predicts as well as the model without it up to a twentieth") {
  catena::GapTest with, without;
  CHECK(catena::predicts_as_well(with, without));  // nothing held out
  with.count = without.count = 100;
  without.rms = 4e-3;
  with.rms = 4.1e-3;
  CHECK(catena::predicts_as_well(with, without));
  with.rms = 4.3e-3;
  CHECK_FALSE(catena::predicts_as_well(with, without));
  CHECK(catena::predicts_as_well(without, with));
}

TEST_CASE("the autocorrelation factor is one for white noise and grows with correlation") {
  CHECK(catena::autocorrelation_factor({white(24, 400, 1, 1)}) < 1.3);
  CHECK(catena::autocorrelation_factor({smooth(24, 400, 1, 1, 60)}) > 5);
}

TEST_CASE("chi-square tails") {
  // values of the survival function: P(3.841 | 1) = P(5.991 | 2) = P(7.815 | 3) = 0.05
  CHECK(catena::log10_chi_square_tail(3.841, 1) == catena::near(std::log10(0.05), 1e-3));
  CHECK(catena::log10_chi_square_tail(5.991, 2) == catena::near(std::log10(0.05), 1e-3));
  CHECK(catena::log10_chi_square_tail(7.815, 3) == catena::near(std::log10(0.05), 1e-3));
  // exp(-x/2) for two degrees, far out
  CHECK(catena::log10_chi_square_tail(2000, 2) == doctest::Approx(-1000 / std::numbers::ln10));
  CHECK(catena::log10_chi_square_tail(2000, 1) < -430);
}

TEST_CASE("the score finds the size of what is missing and what is left of it") {
  const MatrixXd jacobian = white(500, 3, 1, 1);
  const VectorXd other = white(500, 1, 1, 2), noise = white(500, 1, 0.1, 3);
  const VectorXd column = 5 * jacobian.col(0) + other;  // the fit can imitate most of it
  // residual = -0.7 column + noise: the parameter ought to be 0.7 larger
  catena::ScoreTest test(noise - 0.7 * column, jacobian);
  const int c = test.add({column, 0, 10});
  const catena::Score score = test.score({c});
  CHECK(score.admissible);
  CHECK(score.estimate[0] == catena::near(0.7, 0.02));
  CHECK(score.share > 0.9);
  CHECK(score.survives == catena::near(1 / std::sqrt(26.0), 0.15));
  CHECK(test.residual_after({c}, score.estimate).norm() < 3);
}

TEST_CASE(
    "an effect on the wrong side of its bound is no candidate; past the far bound it is cut") {
  const MatrixXd jacobian = white(300, 2, 1, 1);
  const VectorXd column = white(300, 1, 1, 2);
  catena::ScoreTest test(0.7 * column, jacobian);
  CHECK_FALSE(test.score({test.add({column, 0, 10})}).admissible);
  const catena::Score cut = test.score({test.add({column, -0.3, 10})});
  CHECK(cut.admissible);
  CHECK(cut.beyond);
  CHECK(cut.estimate[0] == doctest::Approx(-0.3));
}

TEST_CASE("what the fit can imitate entirely scores nothing") {
  const MatrixXd jacobian = white(300, 2, 1, 1);
  catena::ScoreTest test(white(300, 1, 1, 4), jacobian);
  CHECK_FALSE(
      test.score({test.add({jacobian.col(0) - 2 * jacobian.col(1), -1e9, 1e9})}).admissible);
}

TEST_CASE("any number of columns without bounds is scored together") {
  // The freer start of five experiments has 35.
  for (const int count : {31, 35, 70}) {
    CAPTURE(count);
    const MatrixXd columns = white(400, count, 1, 8);
    const VectorXd sizes = white(count, 1, 1, 9);
    catena::ScoreTest test(-columns * sizes, MatrixXd(400, 0));
    std::vector<int> numbers;
    for (Eigen::Index j = 0; j < columns.cols(); ++j)
      numbers.push_back(test.add({columns.col(j), -INFINITY, INFINITY}));
    const catena::Score score = test.score(numbers);
    CHECK(score.admissible);
    CHECK(score.share == doctest::Approx(1));
    CHECK((score.estimate - sizes).norm() < 1e-9);
    // one with a bound beside them, on its wrong side: left at zero
    numbers.push_back(test.add({columns.col(0) + white(400, 1, 1, 10), 0, 1}));
    const catena::Score bounded = test.score(numbers);
    CHECK(bounded.share == doctest::Approx(1));
  }
  catena::ScoreTest test(white(50, 1, 1, 1), MatrixXd(50, 0));
  std::vector<int> numbers;
  for (std::size_t j = 0; j <= catena::kMostBoundedColumns; ++j)
    numbers.push_back(test.add({white(50, 1, 1, static_cast<unsigned>(j)), 0, 1}));
  CHECK_THROWS_AS(test.score(numbers), std::invalid_argument);
}

/// A case of 12 links with one stiffness for the joints named.
catena::Case case_of_joints(const std::string& joints) {
  return catena::parse_case(
      "format = 1\nkind = \"case\"\ntitle = \"a cable\"\n[model]\nlinks = 12\n[cable]\n"
      "length = 1.2\ndensity = 0.1\nload_mass = 0.2\n[[parameter]]\nname = \"k\"\nsets = \"" +
          joints +
          "\"\nvalue = 2.0\nunit = \"N m/rad\"\n[initial]\nshape = \"straight\"\nangle = 0.3\n",
      "case.toml", ".");
}

TEST_CASE(
    "the same cable with other numbers of links: joints keep their places, softer ones more") {
  std::string why_not;
  const auto finer = catena::with_links(case_of_joints("stiffness_2..12"), 24, why_not);
  REQUIRE(finer);
  CHECK(finer->links == 24);
  CHECK(finer->parameters[0].sets == "stiffness_2..24");
  CHECK(finer->parameters[0].factor == 2.0);
  // joint 7, at half the length, is joint 13 of 24 and joint 31 of 60
  CHECK(catena::with_links(case_of_joints("stiffness_7..12"), 24, why_not)->parameters[0].sets ==
        "stiffness_13..24");
  CHECK(catena::with_links(case_of_joints("stiffness_7..12"), 60, why_not)->parameters[0].sets ==
        "stiffness_31..60");
  // and back
  CHECK(catena::with_links(*finer, 12, why_not)->parameters[0].sets == "stiffness_2..12");
  // three quarters of a link further there is no joint
  CHECK_FALSE(catena::with_links(case_of_joints("stiffness_6..12"), 15, why_not));
  CHECK(why_not.find("parameter k") != std::string::npos);
}

TEST_CASE("the built-in effects as candidates: amplitudes, shapes, phases, limits and forms") {
  const auto library = catena::library_of_candidates({}, catena::plain_chain(), {});
  const auto find = [&](const std::string& id) {
    const auto found =
        std::find_if(library.begin(), library.end(), [&](const auto& c) { return c.id == id; });
    REQUIRE(found != library.end());
    return *found;
  };
  using catena::ParameterRole;
  const auto motion = find("support_motion");
  CHECK(motion.with_role(ParameterRole::kAmplitude).size() == 2);
  CHECK(motion.with_role(ParameterRole::kPhase).size() == 2);
  CHECK(motion.with_role(ParameterRole::kShape).size() == 1);
  const auto grid = catena::shape_grid(motion, {0.5, 1.5});
  REQUIRE(grid.size() == 2);
  CHECK(grid[1][0] == 1.5);
  CHECK(find("axial_stretch").with_role(ParameterRole::kLimit).size() == 1);
  CHECK(find("air_drag_isotropic").effect.form_of == "air_drag_quadratic");
  CHECK(find("support_series").unavailable != "");
  // A slender body resists, and moves fluid, less along itself than across.
  for (const char* id :
       {"air_drag_quadratic", "air_drag_linear", "added_mass", "steady_wind", "current"}) {
    const catena::Candidate candidate = find(id);
    for (const catena::CandidateParameter& parameter : candidate.parameters)
      if (parameter.name.ends_with(".tangential"))
        CHECK(candidate.parameters.at(static_cast<std::size_t>(parameter.at_most)).name ==
              std::string(id) + ".normal");
  }
}

}  // namespace
