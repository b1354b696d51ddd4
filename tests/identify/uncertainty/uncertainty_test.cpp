// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/uncertainty.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/parallel.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/bootstrap.hpp"
#include "identify/uncertainty/profile.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/identify/uncertainty/coverage.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using testing::kCable;
using testing::noisy;
using testing::perfect;

TEST_CASE(
    "95 % intervals contain the truth in 95 % of recordings, white and autocorrelated noise") {
  // seeds are 1, 2, 3, ...; scripts/study_coverage does the same with a thousand
  constexpr int recordings = 150;
  const Problem problem = perfect();
  const Eigen::VectorXd truth = problem.start();
  for (const double autocorrelation : {0.0, 0.6}) {
    CAPTURE(autocorrelation);
    Eigen::MatrixXi inside(recordings, truth.size());
    Eigen::MatrixXd width(recordings, truth.size());
    in_parallel(recordings, 2, [&](std::size_t i) {
      const auto row = static_cast<Eigen::Index>(i);
      const testing::Covered covered =
          testing::covered(problem, autocorrelation, static_cast<unsigned>(i + 1));
      inside.row(row) = covered.inside;
      width.row(row) = covered.width;
    });
    for (Eigen::Index j = 0; j < truth.size(); ++j) {
      const double share = inside.col(j).cast<double>().mean();
      Eigen::VectorXd widths = width.col(j);
      std::sort(widths.begin(), widths.end());
      MESSAGE("autocorrelation " << autocorrelation << ", "
                                 << problem.unknowns()[static_cast<std::size_t>(j)].name
                                 << ": inside " << 100 * share << " % of " << recordings
                                 << ", median width " << widths[recordings / 2] << " around "
                                 << truth[j]);
      // three standard deviations of a binomial count about what is asked for, 93 to 97 %
      const double chance = 3 * std::sqrt(0.95 * 0.05 / recordings);
      CHECK(share > 0.94 - chance);
      CHECK(share < 0.96 + chance);
    }
  }
}

TEST_CASE(
    "with 1 % outliers, robust intervals from a far start contain the truth and stay narrow") {
  constexpr int recordings = 60;
  const Problem problem = perfect();
  const Eigen::VectorXd truth = problem.start();
  const Eigen::VectorXd far = truth.cwiseProduct(Eigen::Vector3d(3, 0.3, 1.1));
  const auto wide = [](Eigen::MatrixXd widths) {
    std::sort(widths.data(), widths.data() + widths.size());
    return widths(widths.size() / 2);
  };
  Eigen::MatrixXd clean(recordings, 1);
  for (const Loss loss : {Loss::kNone, Loss::kHuber, Loss::kSoftL1, Loss::kCauchy}) {
    CAPTURE(static_cast<int>(loss));
    Eigen::MatrixXi inside(recordings, truth.size());
    Eigen::MatrixXd width(recordings, 1);
    in_parallel(recordings, 2, [&](std::size_t i) {
      const auto row = static_cast<Eigen::Index>(i);
      const auto seed = static_cast<unsigned>(i + 1);
      Recording recording = noisy(problem, 0, seed).experiments()[0].recording;
      std::mt19937_64 generator(1000 + seed);
      if (loss != Loss::kNone)
        for (double& value : recording.measured.reshaped())
          if (generator() % 100 == 0) value += 0.1;
      Case the_case = problem.the_case();
      the_case.experiments[0].noise = 2e-3;
      the_case.error.loss = loss;
      const Problem seen(the_case, problem.model(), {recording});
      FitOptions options;
      options.start = far;
      const FitResult found = fit(seen, options, fit_least_squares);
      const Uncertainty uncertainty = uncertainty_of(seen, found.x);
      for (Eigen::Index j = 0; j < truth.size(); ++j) {
        const Estimate& estimate = uncertainty.estimates[static_cast<std::size_t>(j)];
        inside(row, j) = estimate.lower <= truth[j] && truth[j] <= estimate.upper;
      }
      width(row, 0) = uncertainty.estimates[0].upper - uncertainty.estimates[0].lower;
    });
    if (loss == Loss::kNone) clean = width;
    // three standard deviations of a binomial count below what is asked for
    for (Eigen::Index j = 0; j < truth.size(); ++j)
      CHECK(inside.col(j).cast<double>().mean() > 0.94 - 3 * std::sqrt(0.95 * 0.05 / recordings));
    MESSAGE("median width " << wide(width) << ", without outliers " << wide(clean));
    CHECK(wide(width) < 1.3 * wide(clean));
  }
}

TEST_CASE("what cannot be determined is reported so, before and after the fit") {
  // Two stiffnesses that only ever act as their sum: the torque of a spring at joint 1 and that of
  // a constant in the same place are told apart, those of two factors of one spring are not.
  std::string text = kCable;
  const std::string one = "sets = \"stiffness\"";
  text.replace(text.find(one), one.size(), "sets = \"stiffness_1\"");
  Case the_case = testing::sections(text + R"(
[[parameter]]
name = "k2"
sets = "stiffness_2"
value = 0.1
free = true
lower = 0.001
upper = 10.0
[[parameter]]
name = "inertia of nothing"
sets = "torque_2"
value = 0.0
factor = 1e-12
free = true
lower = -1.0
upper = 1.0
)");
  testing::add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  const Problem problem(
      the_case, model,
      {testing::with_truth(the_case, model, testing::empty_markers({0.3, 0.7, 1.0}, 60, 0.05))});
  const Uncertainty uncertainty = uncertainty_of(problem, problem.start(), 1e-3);
  REQUIRE(problem.unknowns()[3].name == "inertia of nothing");
  CHECK(uncertainty.estimates[3].verdict == Verdict::kStructurallyNot);
  CHECK(std::isinf(uncertainty.estimates[3].upper));
  CHECK(std::isinf(uncertainty.estimates[3].standard_error));
  for (const std::size_t j : {0u, 1u, 2u, 4u})
    CHECK(uncertainty.estimates[j].verdict == Verdict::kIdentifiable);
  REQUIRE(uncertainty.weak.size() == 1);
  CHECK(std::isinf(uncertainty.weak[0].deviation));
  CHECK(uncertainty.weak[0].text.find("inertia of nothing") != std::string::npos);
  CHECK(uncertainty.suggestions[0].find("inertia of nothing") != std::string::npos);
}

TEST_CASE("damping that a short still recording hardly shows is practically not identifiable") {
  std::string text = kCable;
  text.replace(text.find("angle = 0.6"), 11, "angle = 0.02");
  const Problem problem = noisy(perfect(text), 0, 1);
  const Uncertainty uncertainty = uncertainty_of(problem, problem.start(), 0.02);
  CHECK(uncertainty.estimates[1].verdict == Verdict::kPracticallyNot);
  CHECK(!uncertainty.weak.empty());
}

TEST_CASE("profiles and bootstrap agree with the intervals where all is well") {
  const Problem problem = noisy(perfect(), 0, 5);
  const FitResult result = fit_least_squares(problem, {});
  const Uncertainty uncertainty = uncertainty_of(problem, result.x);
  CHECK(uncertainty.noise == catena::near(2e-3, 0.1));
  CHECK(!uncertainty.autocorrelated);
  const std::vector<Profile> profiles =
      profiles_of(problem, result, uncertainty, fit_least_squares, 2);
  REQUIRE(profiles.size() == 2);
  for (const Profile& profile : profiles) {
    CHECK(profile.verdict == Verdict::kIdentifiable);
    for (std::size_t i = 0; i < profile.value.size(); ++i) {
      // near the minimum the cost is the square of the distance in standard errors
      const Estimate& estimate = uncertainty.estimates[static_cast<std::size_t>(profile.unknown)];
      const double z = std::log(profile.value[i] / result.x[profile.unknown]) /
                       (estimate.standard_error / result.x[profile.unknown]);
      CHECK(profile.cost[i] == catena::near(z * z, 0.15));
    }
  }
  const Eigen::MatrixXd rows = bootstrap(problem, result, uncertainty, fit_least_squares, 60, 7, 2);
  for (Eigen::Index j = 0; j < rows.cols(); ++j) {
    const Eigen::VectorXd off = rows.col(j).array() - rows.col(j).mean();
    const double deviation = std::sqrt(off.squaredNorm() / 59);
    CHECK(deviation / uncertainty.estimates[static_cast<std::size_t>(j)].standard_error ==
          catena::near(1, 0.35));  // 60 draws of blocks: 9 % by chance, and blocks are few
  }
  CHECK(rows == bootstrap(problem, result, uncertainty, fit_least_squares, 60, 7, 1));

  // Ctrl-C while they run: nothing half-done, and no further fit.
  std::atomic<bool> stop = false;
  std::atomic<int> fits = 0;
  const LeastSquares stopped_in_third = [&](const Problem& again, const FitOptions& options) {
    CHECK(options.stop == &stop);
    if (++fits == 3) stop = true;
    return fit_least_squares(again, options);
  };
  CHECK(bootstrap(problem, result, uncertainty, stopped_in_third, 60, 7, 1, &stop).rows() == 0);
  CHECK(fits == 3);
  fits = 0;
  stop = false;
  CHECK(profiles_of(problem, result, uncertainty, stopped_in_third, 1, &stop).empty());
  CHECK(fits == 3);
}
