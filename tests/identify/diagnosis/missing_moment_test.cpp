// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/missing_moment.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"

using namespace catena;

namespace {

constexpr double kNoise = 1e-4;    // m
constexpr double kSingular = 1.2;  // s, a frame far from both ends

/// Two links that move as twice the stiffness says, in this model, with the stiffness of the case.
FittedModel too_soft(const Model& model) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.parameters[0].value *= 2;
  const Recording recording = testing::with_truth(
      truth, Model::built_in(2), testing::empty_markers({0.5, 1.0}, 240, 0.01), kNoise);
  const auto problem =
      std::make_shared<const Problem>(the_case, model, std::vector<Recording>{recording});
  return assess(problem, problem->start(), fit_least_squares, nullptr);
}

/// As the built-in model, whose accelerations cannot be solved for at one time.
int32_t singular_once(const void* context, const catena_point* at, double* a) {
  if (std::abs(at->t - kSingular) < 1e-12) return 2;
  return Model::built_in(2).table().acceleration(context, at, a);
}

}  // namespace

TEST_CASE("the missing moment is largest where a joint is too soft, and goes with the motion") {
  const FittedModel model = too_soft(Model::built_in(2));
  REQUIRE(model.ok);
  const MissingMoment missing = missing_moment(model, {kNoise});
  REQUIRE(missing.moment.rows() == 2);
  CHECK(missing.moment.cols() == static_cast<Eigen::Index>(missing.time.size()));
  const double size =
      std::sqrt(missing.moment.squaredNorm() / static_cast<double>(missing.moment.size()));
  CHECK(size > 3 * missing.noise);
  REQUIRE_FALSE(missing.dependence.empty());
  CHECK(missing.dependence.front().share > 0.5);
}

TEST_CASE("accelerations that cannot be solved for leave no missing moment, and it is said why") {
  auto table = std::make_shared<catena_model>(Model::built_in(2).table());
  table->acceleration = singular_once;
  const FittedModel model = too_soft(Model(std::shared_ptr<const catena_model>(table)));
  REQUIRE(model.ok);
  const MissingMoment missing = missing_moment(model, {kNoise});
  CHECK(missing.moment.size() == 0);
  REQUIRE(missing.words.size() == 1);
  CHECK(missing.words[0].find("theta_2, t = 1.2 s") != std::string::npos);
}
