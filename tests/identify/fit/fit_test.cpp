// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/fit.hpp"

#include <doctest/doctest.h>

#include "common/input_error.hpp"
#include "identify/fit/easier_problems.hpp"
#include "identify/fit/error.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"

using namespace catena;

namespace {

Problem twin(FitMethod method, Measure measure, double k, double c, double noise = 0,
             unsigned seed = 1) {
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  Case truth = the_case;
  truth.parameters[0].value = k;
  truth.parameters[1].value = c;
  the_case.optimiser.method = method;
  the_case.error.measure = measure;
  const Model model = Model::built_in(2);
  return Problem(
      the_case, model,
      {testing::with_truth(truth, model, testing::empty_markers({0.3, 0.7, 1.0}, 60, 0.05), noise,
                           seed)});
}

}  // namespace

TEST_CASE("every method finds the truth behind perfect data, in every measure") {
  struct Row {
    FitMethod method;
    double tolerance;  // relative; the kinks of the L1-like measures slow the smooth methods
  };
  const Row rows[] = {{FitMethod::kNelderMead, 1e-4},
                      {FitMethod::kLeastSquares, 1e-3},
                      {FitMethod::kLbfgs, 0.05},
                      {FitMethod::kSlsqp, 0.05},
                      {FitMethod::kMma, 0.05}};
  for (const Row& row : rows)
    for (const Measure measure :
         {Measure::kLeastSquares, Measure::kMeanDistance, Measure::kMeanAbsolute}) {
      CAPTURE(static_cast<int>(row.method));
      CAPTURE(static_cast<int>(measure));
      const Problem problem = twin(row.method, measure, 0.1, 0.005);
      const FitResult result = fit(problem, {}, fit_least_squares);
      CHECK(result.error < 0.02 * result.start_error);
      CHECK(result.x[0] == catena::near(0.1, row.tolerance));
      CHECK(result.x[1] == catena::near(0.005, 10 * row.tolerance));
      CHECK(result.failures == 0);
    }
}

TEST_CASE("a simulation that takes more steps than it may has failed") {
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005);
  long steps = 0;
  REQUIRE(evaluate(problem, problem.start(), false, false, [&](double) { return ++steps > 0; }).ok);
  REQUIRE(steps > 100);
  FitOptions options;
  options.most_steps = 4 * steps;
  const FitResult free = fit(problem, {}, fit_least_squares);
  const FitResult enough = fit(problem, options, fit_least_squares);
  CHECK(enough.x == free.x);
  CHECK(enough.failures == 0);
  options.most_steps = steps / 2;
  const FitResult less = fit(problem, options, fit_least_squares);
  CHECK(less.status == FitStatus::kFailed);
  CHECK(less.evaluations == 1);
}

TEST_CASE("a simulation that takes the steps of many first ones between two frames has failed") {
  // The truth is stiffer than the start, and takes more steps.
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.4, 0.002);
  FitOptions options;
  options.stall = 1;
  const FitResult free = fit(problem, {}, fit_least_squares);
  const FitResult enough = fit(problem, options, fit_least_squares);
  CHECK(enough.x == free.x);
  CHECK(enough.failures == 0);
  options.stall = 0.02;
  const FitResult less = fit(problem, options, fit_least_squares);
  CHECK(less.failures > 0);
  CHECK(less.x[0] < free.x[0]);
}

TEST_CASE("a fit ends where no step promises as much as was asked") {
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005, 2e-3);
  FitOptions options;
  options.enough = 1e-3;  // of the sum of squares
  const FitResult close = fit(problem, {}, fit_least_squares);
  const FitResult enough = fit(problem, options, fit_least_squares);
  CHECK(enough.status == FitStatus::kConverged);
  CHECK(enough.evaluations < close.evaluations);
  CHECK(enough.error > close.error);
  CHECK(enough.error < (1 + options.enough) * close.error);
}

TEST_CASE("the noise of every channel is found with the physics and kept apart from it") {
  // marker 1 is seen ten times worse than the others
  Recording recording = twin(FitMethod::kLeastSquares, Measure::kLikelihood, 0.1, 0.005, 1e-3, 2)
                            .experiments()[0]
                            .recording;
  std::mt19937_64 generator(5);
  std::normal_distribution<double> normal(0, 1e-2);
  for (Eigen::Index k = 0; k < recording.measured.cols(); ++k)
    for (Eigen::Index c = 0; c < 2; ++c) recording.measured(c, k) += normal(generator);
  const auto with = [&](FitMethod method, Measure measure) {
    const Problem problem = twin(method, measure, 0.1, 0.005);
    return Problem(problem.the_case(), problem.model(), {recording});
  };
  const Problem weighed = with(FitMethod::kLeastSquares, Measure::kLikelihood);
  const FitResult found = fit(weighed, {}, fit_least_squares);
  const FitResult simplex =
      fit(with(FitMethod::kNelderMead, Measure::kLikelihood), {}, fit_least_squares);
  CHECK(found.error <= simplex.error * (1 + 1e-6));
  CHECK(found.x[0] == catena::near(simplex.x[0], 1e-3));
  const Uncertainty uncertainty = uncertainty_of(weighed, found.x);
  const Residuals residuals =
      residuals_of(weighed, evaluate(weighed, found.x, false, false), Part::kFit);
  const std::vector<ChannelNoise> channels = channels_of(weighed, residuals);
  REQUIRE(channels.size() == 6);
  for (std::size_t c = 0; c < channels.size(); ++c) {
    CAPTURE(channels[c].name);
    const double truth = c < 2 ? std::hypot(1e-2, 1e-3) : 1e-3;
    const Estimate estimate = noise_estimate(channels[c], uncertainty);
    CHECK(std::abs(channels[c].deviation - truth) < 3.5 * estimate.standard_error);
    CHECK(estimate.lower < channels[c].deviation);
    CHECK(channels[c].deviation < estimate.upper);
  }
  CHECK(uncertainty.estimates.size() == 2);  // nothing but physics
  // plain least squares lets the bad marker speak as loudly as the good ones
  const Problem plain = with(FitMethod::kLeastSquares, Measure::kLeastSquares);
  const FitResult rough = fit(plain, {}, fit_least_squares);
  CHECK(uncertainty_of(plain, rough.x).estimates[0].standard_error >
        2 * uncertainty.estimates[0].standard_error);
}

TEST_CASE("least squares ends no higher than Nelder-Mead, and is there in a few evaluations") {
  for (const Measure measure : {Measure::kMeanDistance, Measure::kMeanAbsolute}) {
    CAPTURE(static_cast<int>(measure));
    const FitResult simplex =
        fit(twin(FitMethod::kNelderMead, measure, 0.1, 0.005, 5e-3, 7), {}, fit_least_squares);
    const FitResult squares =
        fit(twin(FitMethod::kLeastSquares, measure, 0.1, 0.005, 5e-3, 7), {}, fit_least_squares);
    const double there = simplex.error * (1 + 1e-4);  // a minimum on kinks
    CHECK(squares.error <= there);
    const auto reached =
        std::find_if(squares.history.begin(), squares.history.end(),
                     [&](const HistoryEntry& entry) { return entry.error <= there; });
    const auto rough = squares.evaluations - static_cast<std::ptrdiff_t>(squares.history.size());
    const auto evaluations = rough + (reached - squares.history.begin()) + 1;
    MESSAGE(simplex.evaluations << " and " << evaluations << " evaluations");
    CHECK(evaluations <= 10);
    CHECK(squares.evaluations <= 20);  // and ends soon after
  }
}

TEST_CASE("rough simulations lead to a fit of the problem itself") {
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kMeanDistance, 0.1, 0.005, 5e-3);
  REQUIRE(starts_roughly(problem));
  const FitResult result = fit(problem, {}, fit_least_squares);
  const auto error_at = [&](const Eigen::VectorXd& x) {
    return error_of(problem, evaluate(problem, x, false, false), Part::kFit);
  };
  CHECK(result.start_error == catena::near(error_at(problem.start()), 1e-12));
  CHECK(result.error == catena::near(error_at(result.x), 1e-6));
  CHECK(static_cast<int>(result.history.size()) < result.evaluations);
  for (const HistoryEntry& entry : result.history)
    CHECK(entry.error == catena::near(error_at(entry.x), 1e-6));
  CHECK(result.history.front().error < 1.1 * result.error);  // there they led

  for (int limit = 1; limit < result.evaluations; ++limit) {
    CAPTURE(limit);
    Case the_case = problem.the_case();
    the_case.optimiser.max_evaluations = limit;
    const Problem shorter(the_case, problem.model(), {problem.experiments()[0].recording});
    const FitResult limited = fit(shorter, {}, fit_least_squares);
    CHECK(limited.status == FitStatus::kEvaluationLimit);
    CHECK(limited.evaluations <= limit);
    CHECK(limited.error == catena::near(error_at(limited.x), 1e-6));
  }
}

TEST_CASE("a fit ends where the noise of its simulations hides what is left to gain") {
  Case the_case = testing::sections(R"(
[model]
links = 12
[cable]
length = 3.39
density = 0.1424
load_mass = 1.47
[[parameter]]
name = "k"
sets = "stiffness"
value = 45.0
free = true
lower = 1.0
upper = 1000.0
[[parameter]]
name = "c"
sets = "damping"
value = 0.08
free = true
lower = 1e-7
upper = 1.0
[initial]
shape = "catenary"
held = { side = 1.5, down = 2.5 }
)");
  testing::add_experiment(the_case, "run");
  the_case.optimiser.method = FitMethod::kLeastSquares;
  Case truth = the_case;  // which no values of the case can match
  truth.parameters[0].value = 50;
  truth.parameters[1].value = 0.1;
  truth.cable.load_mass *= 1.01;
  const Model model = Model::built_in(12);
  const Recording recording =
      testing::with_truth(truth, model, testing::empty_markers({0.8, 1.7, 2.5, 3.39}, 120, 0.005));
  const auto fitted = [&](double tolerance, Measure measure) {
    the_case.simulation.relative_tolerance = tolerance;
    the_case.simulation.absolute_tolerance_position = 1e-2 * tolerance;
    the_case.simulation.absolute_tolerance_velocity = 1e-1 * tolerance;
    the_case.error.measure = measure;
    const Problem problem(the_case, model, {recording});
    return std::pair{problem, fit(problem, {}, fit_least_squares)};
  };
  for (const Measure measure : {Measure::kLeastSquares, Measure::kMeanDistance}) {
    CAPTURE(static_cast<int>(measure));
    const auto& [precise, there] = fitted(1e-10, measure);
    const auto& [noisy, result] = fitted(1e-6, measure);
    MESSAGE(there.evaluations << " evaluations without noise, " << result.evaluations << " with "
                              << result.error_noise << " of " << result.error);
    REQUIRE(result.status == FitStatus::kConverged);
    CHECK(result.error_noise > 0);
    CHECK(result.error < there.error + 2 * result.error_noise);
    CHECK(result.evaluations <= there.evaluations + 2);  // the measurement is one of them
    // Nor do standard errors and verdicts depend on how exact the sensitivities are.
    const Uncertainty uncertainty = uncertainty_of(precise, there.x),
                      roughly = uncertainty_of(noisy, there.x);
    for (Eigen::Index j = 0; j < there.x.size(); ++j) {
      const Estimate &expected = uncertainty.estimates[static_cast<std::size_t>(j)],
                     &actual = roughly.estimates[static_cast<std::size_t>(j)];
      CHECK(std::abs(result.x[j] - there.x[j]) < 0.2 * expected.standard_error);
      CHECK(actual.standard_error == catena::near(expected.standard_error, 0.01));
      CHECK(actual.verdict == expected.verdict);
    }
  }
}

TEST_CASE("a fit that is at its end after one step has left its start") {
  // So near the truth the sensitivities hold, and after one step nothing is left to gain.
  const Problem exact = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005, 1e-6, 3);
  Case coarse = exact.the_case();
  coarse.optimiser.tolerance = 1e-4;
  const Problem problem(coarse, exact.model(), {exact.experiments()[0].recording});
  Eigen::VectorXd near(2);
  near << 0.1 * (1 + 1e-5), 0.005 * (1 + 1e-5);
  FitOptions options;
  options.start = near;
  const FitResult result = fit(problem, options, fit_least_squares);
  CHECK(result.status == FitStatus::kConverged);
  CHECK(result.message == "");
  CHECK(result.x[0] == catena::near(0.1, 3e-6));
}

TEST_CASE("rough simulations are of fewer frames, spread over all") {
  const Model model = Model::built_in(2);
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "run");
  const Problem problem(
      the_case, model,
      {testing::with_truth(the_case, model, testing::empty_markers({0.5, 1.0}, 1001, 0.002))});
  const Problem easier = rough(problem);
  const Recording &all = problem.experiments()[0].recording,
                  &few = easier.experiments()[0].recording;
  REQUIRE(few.fit_frames == 101);
  CHECK(few.time.back() == all.time.back());
  CHECK(few.time[1] == all.time[10]);
  CHECK(few.measured.col(100) == all.measured.col(1000));
  CHECK(easier.the_case().simulation.relative_tolerance == doctest::Approx(1e-4).scale(0));
  CHECK(!finer_than_rough(easier));
}

TEST_CASE("bounds hold") {
  for (const FitMethod method : {FitMethod::kNelderMead, FitMethod::kLeastSquares}) {
    Problem problem = twin(method, Measure::kLeastSquares, 0.1, 0.005);
    Case the_case = problem.the_case();
    the_case.parameters[0].upper = 0.07;
    const Problem bounded(the_case, problem.model(), {problem.experiments()[0].recording});
    const FitResult result = fit(bounded, {}, fit_least_squares);
    CHECK(result.x[0] == catena::near(0.07, 1e-6));
    CHECK(result.x[0] <= 0.07);
  }
}

TEST_CASE("few steps lead to a bound, and to where the other unknowns are right for it") {
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005);
  const auto evaluations = [&](std::size_t parameter, double lower, double start) {
    Case the_case = problem.the_case();
    the_case.initial.free = true;
    the_case.experiments[0].initial = the_case.initial;
    the_case.parameters[parameter].lower = lower;
    the_case.parameters[parameter].value = start;
    the_case.parameters[parameter].upper = 5 * start;
    const Problem bounded(the_case, problem.model(), {problem.experiments()[0].recording});
    const FitResult result = fit(bounded, {}, fit_least_squares);
    const auto j = static_cast<Eigen::Index>(parameter);
    CHECK(result.x[j] == catena::near(lower, 1e-6));
    return result.evaluations;
  };
  // 8 where the linearised problem has no bounds; 12, and 10, with steps of logarithms
  CHECK(evaluations(0, 0.2, 0.8) <= 7);
  CHECK(evaluations(1, 0.02, 0.2) <= 6);
}

TEST_CASE("a robust loss is not led astray by outliers") {
  Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005, 1e-3, 3);
  Recording recording = problem.experiments()[0].recording;
  for (Eigen::Index k = 5; k < 60; k += 10) recording.measured(4, k) += 0.2;  // a marker mistaken
  const auto found = [&](Loss loss, const Eigen::VectorXd& start = {}) {
    Case the_case = problem.the_case();
    the_case.experiments[0].noise = 1e-3;
    the_case.error.loss = loss;
    const Problem robust(the_case, problem.model(), {recording});
    FitOptions options;
    options.start = start;
    return fit(robust, options, fit_least_squares).x;
  };
  const auto off = [](const Eigen::VectorXd& x) { return std::abs(std::log(x[0] / 0.1)); };
  const double plain = off(found(Loss::kNone));
  CHECK(plain > 0.03);
  // the first two still feel an outlier's direction; the last forgets it
  CHECK(off(found(Loss::kHuber)) < 0.6 * plain);
  CHECK(off(found(Loss::kSoftL1)) < 0.6 * plain);
  CHECK(off(found(Loss::kCauchy)) < 0.2 * plain);
  CHECK(off(found(Loss::kCauchy, Eigen::Vector2d(0.9, 0.0002))) < 0.2 * plain);
}

TEST_CASE("a robust fit from far begins without its loss, whose slope is lost there") {
  const double noise = 2e-5;  // m: the residuals at the start are thousands of times as large
  const Problem problem =
      twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005, noise, 3);
  Recording recording = problem.experiments()[0].recording;
  for (Eigen::Index k = 5; k < 60; k += 10) recording.measured(4, k) += 0.2;
  Case the_case = problem.the_case();
  the_case.experiments[0].noise = noise;
  the_case.error.loss = Loss::kCauchy;
  const Problem robust(the_case, problem.model(), {recording});
  for (const auto& [stiffness, damping] : {std::pair(0.001, 0.001), {0.5, 0.001}, {0.9, 0.9}}) {
    FitOptions options;
    options.start = Eigen::Vector2d(stiffness, damping);
    CHECK(fit(robust, options, fit_least_squares).x[0] == catena::near(0.1, 0.01));
  }
}

TEST_CASE("fits stop when told to, with the best so far") {
  const Problem problem = twin(FitMethod::kNelderMead, Measure::kLeastSquares, 0.1, 0.005);
  std::atomic<bool> stop = false;
  FitOptions options;
  options.stop = &stop;
  options.progress = [&](const Progress& progress) { stop = progress.evaluations >= 10; };
  const FitResult interrupted = fit(problem, options, {});
  CHECK(interrupted.status == FitStatus::kInterrupted);
  CHECK(interrupted.evaluations == 10);
  CHECK(interrupted.error <= interrupted.start_error);

  Case the_case = problem.the_case();
  the_case.optimiser.max_evaluations = 7;
  const FitResult limited =
      fit(Problem(the_case, problem.model(), {problem.experiments()[0].recording}), {}, {});
  CHECK(limited.status == FitStatus::kEvaluationLimit);
  CHECK(limited.evaluations == 7);

  options.stop = nullptr;
  options.time_limit = 1e-9;
  CHECK(fit(problem, options, {}).status == FitStatus::kTimeLimit);
}

TEST_CASE("failures are counted, reported and never the best") {
  // Steps are limited so that stiff parameters fail and soft ones do not.
  Problem problem = twin(FitMethod::kNelderMead, Measure::kLeastSquares, 0.1, 0.005);
  Case the_case = problem.the_case();
  the_case.simulation.max_steps = 20;
  const Problem hopeless(the_case, problem.model(), {problem.experiments()[0].recording});
  for (const FitMethod method : {FitMethod::kNelderMead, FitMethod::kLeastSquares}) {
    Case failing = the_case;
    failing.optimiser.method = method;
    const FitResult result =
        fit(Problem(failing, problem.model(), {problem.experiments()[0].recording}), {},
            fit_least_squares);
    CHECK(result.status == FitStatus::kFailed);
    CHECK(result.failures == result.evaluations);
    CHECK(std::isinf(result.error));
    REQUIRE(!result.failed.empty());
    CHECK(result.failed[0].message.find("t = ") != std::string::npos);
    CHECK(!result.message.empty());
  }
}

TEST_CASE("what cannot be fitted is refused") {
  Case the_case = testing::sections(testing::kTwoLinks);
  const Model model = Model::built_in(2);
  CHECK_THROWS_AS(fit(Problem(the_case, model), {}, {}), InputError);  // free, but no data
  const Problem problem = twin(FitMethod::kLeastSquares, Measure::kLeastSquares, 0.1, 0.005);
  CHECK_THROWS_AS(fit(problem, {}, {}), InputError);  // no solver given
  the_case = problem.the_case();
  for (ParameterSpec& parameter : the_case.parameters) parameter.free = false;
  CHECK_THROWS_AS(fit(Problem(the_case, model, {problem.experiments()[0].recording}), {}, {}),
                  InputError);
}
