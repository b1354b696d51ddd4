// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/prediction_errors.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/diagnosis/predicted_films.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace prediction_errors_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using testing::errors_of;
using testing::Film;
using testing::fitted_to;
using testing::holds;
using testing::kSealed;

constexpr double kStep = testing::kFrameTime, kNoise = testing::kFilmNoise;

/// In how many of 40 films what is left lies in the interval, held out and sealed; the median of what is left.
struct Coverage {
  int held_out = 0, sealed = 0;
  double median = 0;
};

Coverage coverage_of(const Film& film) {
  constexpr unsigned kFilms = 40;
  Coverage coverage;
  std::vector<double> left;
  for (unsigned seed = 1; seed <= kFilms; ++seed) {
    const PredictionErrors errors = errors_of(fitted_to(film, seed));
    coverage.held_out += holds(errors.held_out);
    coverage.sealed += holds(errors.sealed);
    left.push_back(errors.sealed.observed);
  }
  std::nth_element(left.begin(), left.begin() + kFilms / 2, left.end());
  coverage.median = left[kFilms / 2];
  return coverage;
}

}  // namespace

// 95 % of 40 are 38; 33 or fewer have a chance of 1 in 300.
TEST_CASE("what a right model leaves where nothing was fitted lies in the interval") {
  Film long_ago{.fitted = 60};
  Film short_part{.fitted = 8};
  Film correlated{.fitted = 20, .correlation = 0.6};
  for (const Film& film : {long_ago, short_part, correlated}) {
    const Coverage coverage = coverage_of(film);
    MESSAGE("fitted frames " << film.fitted << ", correlation " << film.correlation
                             << ": in the interval, of 40: held out " << coverage.held_out
                             << ", sealed " << coverage.sealed << "; median error, sealed "
                             << coverage.median);
    CHECK(coverage.held_out >= 34);
    CHECK(coverage.sealed >= 34);
  }
}

TEST_CASE(
    "a short fitted part does not determine the motion, and the interval is as wide as that") {
  const FittedModel model = fitted_to({.fitted = 8}, 1);
  const PredictionErrors errors = errors_of(model);
  CHECK(errors.sealed.high > 10 * kNoise);
  const auto words = words_of({{}, {10 * kNoise, kNoise, 20 * kNoise}}, kNoise, "mm");
  REQUIRE(words.size() == 1);
  CHECK(words[0] ==
        "The sealed part is predicted 10 mm off; 1 to 20 mm are expected (95 %): the fitted part "
        "does "
        "not determine this motion.");
}

TEST_CASE("what the model lacks in a part that was not fitted lies above the interval") {
  const FittedModel model = fitted_to({.shift = 5e-3}, 1);
  const PredictionErrors errors = errors_of(model);
  CHECK(errors.held_out.observed <= errors.held_out.high);
  CHECK(errors.sealed.observed > errors.sealed.high);
  const auto words = words_of(errors, fit_gap(model, {{.level = kNoise}}).rms, "mm");
  REQUIRE(words.size() == 1);
  CHECK(words[0].starts_with("The sealed part is predicted"));
  CHECK(words[0].ends_with("the model lacks something there."));
}

TEST_CASE("a recording that only validates errs like the fitted one, with more markers, too") {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  const Model model = Model::built_in(2);
  const auto film = [&](const std::vector<double>& markers, unsigned seed) {
    return testing::with_truth(the_case, model, testing::empty_markers(markers, 100, kStep), kNoise,
                               seed);
  };
  const std::vector<NoiseModel> noise{{.level = kNoise}, {.level = kNoise}};
  for (const std::vector<double>& markers : {std::vector{0.9}, std::vector{0.3, 0.6, 0.9}}) {
    std::vector<Recording> recordings{film({0.5, 1.0}, 1), film(markers, 2)};
    Case both = the_case;
    testing::add_experiment(both, "other");
    both.experiments[1].use = Use::kValidate;
    recordings[1].fit_frames = 0;
    const auto problem = std::make_shared<const Problem>(both, model, std::move(recordings));
    const FittedModel fitted =
        fit_model(problem, problem->start(), noise, fit_least_squares, nullptr);
    const testing::TemporaryFolder folder;
    DiagnosisContext context(both, {}, folder.path(), fit_least_squares, {});
    const PredictionErrors errors = prediction_errors(fitted, fitted, noise, context);
    CHECK(errors.held_out.low < kNoise);
    CHECK(errors.held_out.high > kNoise);
    CHECK(errors.held_out.high < 2 * kNoise);
  }
}

// One linearised step changes both factors by what only one of them may change, and the motion is another one.
TEST_CASE("two unknowns of which the data show only the product do not widen the interval") {
  const testing::TemporaryFolder folder;
  Case the_case = testing::two_links_with({});
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares,
                           testing::provider_of_build());
  context.add_effect("lever", R"(
format = 1
kind = "effect"
id = "lever"
title = "A damper on a lever"
description = "Made up."
[parameters.damper]
unit = "N m s/rad"
lower = 0.0
upper = 10.0
neutral = 0.0
description = "Force per rate"
[parameters.arm]
unit = "1"
default = 0.1
lower = 0.0
upper = 1.0
description = "Lever"
[[dissipation]]
at = "pivot"
value = "damper*arm*(1 + arm*cos(joint_angle)/100)*joint_rate^2/2"
)");
  for (const char* name : {"damper", "arm"}) {
    ParameterSpec& spec = the_case.parameters.emplace_back();
    spec.name = name;
    spec.sets = std::string("lever.") + name;
    spec.value = 0.1;
    spec.lower = 0.001;
    spec.upper = 1;
    spec.free = true;
    spec.scale = Scale::kLinear;
  }
  const Model with_lever = context.complete_model_with({"lever"}, 2);
  int holds = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Recording recording = testing::with_truth(
        the_case, with_lever, testing::empty_markers({1.0}, 100, kStep), kNoise, seed);
    recording.fit_frames = 40;
    const auto problem =
        std::make_shared<const Problem>(the_case, with_lever, std::vector<Recording>{recording});
    const FittedModel model =
        fit_model(problem, problem->start(), {{.level = kNoise}}, fit_least_squares, nullptr);
    const PredictionErrors errors = prediction_errors(model, model, {{.level = kNoise}}, context);
    holds += errors.held_out.observed <= errors.held_out.high;
    CHECK(errors.held_out.high < 2 * kNoise);
  }
  CHECK(holds >= 7);
}

TEST_CASE("laws a tenth off explain more, in the part where they explain something") {
  const FittedModel model = fitted_to({.shift = 5e-3}, 1);
  for (const double of_laws : {20e-3, 60e-3}) {
    FittedModel without_laws = model;
    without_laws.predicted[0].rightCols(kSealed).array() += of_laws;
    const PredictionErrors errors = errors_of(model, without_laws);
    CHECK(errors.held_out.explained == 0);
    // What is left is one shift to the side, against the other one.
    const double explained = std::sqrt(of_laws * (of_laws - 5e-3));
    CHECK(errors.sealed.explained == catena::near(explained, 0.05));
    CHECK(errors.sealed.high == errors_of(model).sealed.high);
    const bool enough = of_laws > 40e-3;
    CHECK((errors.sealed.observed <= errors.sealed.high_with_errors_of_laws()) == enough);
    const auto words = words_of(errors, errors.sealed.observed / 5, "mm");
    REQUIRE(words.size() == 1);
    CHECK(words[0].ends_with(enough ? "the fitted part does not determine this motion."
                                    : "the model lacks something there."));
    CHECK((words[0].find("% off there leave as much") != std::string::npos) == enough);
  }
}

TEST_CASE("nothing is said without a part that was not fitted, nor of what is as expected") {
  Film whole;
  whole.fitted = whole.frames;
  CHECK_FALSE(errors_of(fitted_to(whole, 1)).known());
  CHECK(words_of({}, kNoise, "mm").empty());
  CHECK(words_of({{kNoise, kNoise, kNoise}, {kNoise, kNoise, kNoise}}, kNoise, "mm").empty());
}

}  // namespace prediction_errors_test
