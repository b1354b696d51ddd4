// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/fit.hpp"

#include <cmath>

#include "common/input_error.hpp"
#include "common/number_text.hpp"
#include "identify/fit/easier_problems.hpp"
#include "identify/fit/error.hpp"
#include "identify/fit/fit_journal.hpp"
#include "identify/fit/minimise.hpp"

namespace catena {
namespace {

Eigen::VectorXd first_steps(const Problem& problem, const Eigen::VectorXd& start) {
  const double step = problem.the_case().optimiser.initial_step;
  Eigen::VectorXd steps(start.size());
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    double size = step;  // of a logarithm: a relative step
    if (unknown.scale == Scale::kLinear) {
      size = step * std::abs(start[j]);
      if (size == 0 && std::isfinite(unknown.upper - unknown.lower))
        size = step * (unknown.upper - unknown.lower);
      if (size == 0) size = step * (unknown.group == Unknown::Group::kInitial ? 0.1 : 1);
    }
    steps[j] = size;
  }
  return steps;
}

FitResult fit_by_nlopt(const Problem& problem, const FitOptions& options) {
  const OptimiserSpec& spec = problem.the_case().optimiser;
  FitJournal journal(problem, options, spec.max_evaluations);
  const Eigen::VectorXd start = options.start.size() ? options.start : problem.start();
  const bool gradient_wanted = spec.method != FitMethod::kNelderMead;

  MinimiserOptions settings;
  settings.method = spec.method;
  const UnknownBounds bounds = scaled_bounds(problem);
  settings.lower = bounds.lower;
  settings.upper = bounds.upper;
  if (!gradient_wanted) settings.first_steps = first_steps(problem, start);
  settings.x_tolerance = spec.tolerance;
  settings.value_tolerance = gradient_wanted ? 1e-2 * spec.tolerance : spec.tolerance;
  settings.must_stop = [&] { return journal.must_stop(); };
  const Objective error = [&](const Eigen::VectorXd& y, Eigen::VectorXd* gradient) {
    const Eigen::VectorXd x = from_scaled(problem, y);
    const double value = journal.evaluate(x, gradient);
    if (gradient) {
      Eigen::MatrixXd slopes = gradient->transpose();
      scale_derivatives(problem, x, slopes);
      *gradient = slopes.transpose();
    }
    return value;
  };
  const Minimum found = minimise(error, to_scaled(problem, start), settings);
  return journal.result(found.stopped ? journal.why_stopped() : FitStatus::kConverged,
                        found.message);
}

}  // namespace

const char* name_of(FitStatus status) {
  switch (status) {
    case FitStatus::kNotRun:
      return "not_run";
    case FitStatus::kConverged:
      return "converged";
    case FitStatus::kEvaluationLimit:
      return "evaluation_limit";
    case FitStatus::kTimeLimit:
      return "time_limit";
    case FitStatus::kInterrupted:
      return "interrupted";
    case FitStatus::kFailed:
      return "failed";
  }
  return "not_run";
}

Eigen::VectorXd to_scaled(const Problem& problem, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = apart(problem.unknowns(), x);
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (problem.unknowns()[static_cast<std::size_t>(j)].scale == Scale::kLogarithmic)
      y[j] = std::log(x[j]);
  return y;
}

Eigen::VectorXd from_scaled(const Problem& problem, const Eigen::VectorXd& y) {
  Eigen::VectorXd x = y;
  for (Eigen::Index j = 0; j < y.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    // exp(log(bound)) may lie a rounding beyond the bound
    if (unknown.scale == Scale::kLogarithmic)
      x[j] = std::clamp(std::exp(y[j]), unknown.least, unknown.most);
  }
  return together(problem.unknowns(), x);
}

UnknownBounds scaled_bounds(const Problem& problem) {
  UnknownBounds bounds = bounds_apart(problem.unknowns());
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    if (problem.unknowns()[j].scale == Scale::kLinear) continue;
    for (Eigen::VectorXd* each : {&bounds.lower, &bounds.upper}) {
      double& bound = (*each)[static_cast<Eigen::Index>(j)];
      bound = std::log(bound);
    }
  }
  return bounds;
}

void scale_derivatives(const Problem& problem, const Eigen::VectorXd& x, Eigen::MatrixXd& columns) {
  differentiate_apart(problem.unknowns(), columns);
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (problem.unknowns()[static_cast<std::size_t>(j)].scale == Scale::kLogarithmic)
      columns.col(j) *= x[j];
}

namespace {

FitResult fit_once(const Problem& problem, const FitOptions& options,
                   const LeastSquares& least_squares) {
  return problem.the_case().optimiser.method == FitMethod::kLeastSquares
             ? least_squares(problem, options)
             : fit_by_nlopt(problem, options);
}

// What a gap between joined windows costs at first: hardly anything, so that each window finds its
// own best start; then more, up to the problem's own weight, with which it closes.
constexpr double kLooseDefects[] = {0.1, 1, 10, 100, 1000};

bool finished(const FitResult& result) {
  return result.status == FitStatus::kConverged || result.status == FitStatus::kEvaluationLimit;
}

/// A beginning only gives the next a start: its minimum need not be found more closely.
constexpr double kBeginningTolerance = 1e-2, kRoughBeginningTolerance = 0.1;

FitResult fit_beginning(const Problem& problem, const FitOptions& options,
                        const LeastSquares& least_squares) {
  const double tolerance = std::max(kBeginningTolerance, problem.the_case().optimiser.tolerance);
  const Problem beginning = with_tolerance(problem, tolerance);
  if (!starts_roughly(problem)) return fit_once(beginning, options, least_squares);
  FitResult roughly =
      fit_once(with_tolerance(rough(problem), kRoughBeginningTolerance), options, least_squares);
  if (roughly.status != FitStatus::kFailed) return roughly;
  FitResult result = fit_once(beginning, options, least_squares);  // it may have failed as rough
  add_effort(result, roughly);
  return result;
}

}  // namespace

void add_effort(FitResult& total, const FitResult& before) {
  total.evaluations += before.evaluations;
  total.iterations += before.iterations;
  total.work += before.work;
  total.seconds += before.seconds;
  total.cpu_seconds += before.cpu_seconds;
  total.failures += before.failures;
  total.failed.insert(total.failed.begin(), before.failed.begin(), before.failed.end());
}

const char* strategy_of(const Problem& problem) {
  if (problem.joined()) return "multiple shooting";
  if (problem.experiments().size() > problem.the_case().experiments.size())
    return "separate windows";
  return problem.the_case().optimiser.growing_windows.empty() ? "whole" : "growing windows";
}

bool starts_roughly(const Problem& problem) {
  const Case& the_case = problem.the_case();
  const bool squares = the_case.error.measure == Measure::kLeastSquares ||
                       the_case.error.measure == Measure::kLikelihood;
  return the_case.optimiser.method == FitMethod::kLeastSquares && !squares &&
         finer_than_rough(problem);
}

void check_fittable(const Problem& problem) {
  if (problem.unknowns().empty())
    throw InputError(problem.the_case().file.string() +
                     ": nothing to identify; mark a [[parameter]] with free = true");
  const Experiment* unfitted = nullptr;  // meant to be fitted, but none of its frames is
  for (const Experiment& experiment : problem.experiments()) {
    if (experiment.fitted()) return;
    if (experiment.spec.use == Use::kFit) unfitted = &experiment;
  }
  if (unfitted)
    throw InputError(
        unfitted->spec.where + ": fit_until: " + shortest_number(unfitted->spec.fit_until) +
        " s is before the first frame, at " + number_text(unfitted->recording.time.front()) +
        " s: no frame is fitted; give a later one, or the right time_unit");
  throw InputError(problem.the_case().file.string() +
                   ": free parameters without data; add an [[experiment]] with use = \"fit\"");
}

FitResult fit(const Problem& problem, const FitOptions& options,
              const LeastSquares& least_squares) {
  check_fittable(problem);
  const OptimiserSpec& spec = problem.the_case().optimiser;
  if (spec.method == FitMethod::kLeastSquares && !least_squares)
    throw InputError(problem.the_case().file.string() +
                     ": optimiser.method: least_squares is not built in here; use another method");
  FitOptions next = options;
  next.recall = nullptr;  // errors of a part are not those of the whole
  next.record = nullptr;
  FitResult before;
  const bool robust = problem.the_case().error.loss != Loss::kNone;
  const Problem plain = robust ? without_loss(problem) : problem;
  for (const double seconds : spec.growing_windows) {
    FitResult shorter = fit_beginning(first_seconds(plain, seconds), next, least_squares);
    add_effort(shorter, before);
    if (!finished(shorter)) return shorter;
    next.start = shorter.x;
    before = std::move(shorter);
  }
  if (problem.joined())
    for (const double weight : kLooseDefects) {
      FitResult looser = fit_once(with_defect_weight(plain, weight), next, least_squares);
      add_effort(looser, before);
      if (!finished(looser)) return looser;
      next.start = looser.x;
      before = std::move(looser);
    }
  if (robust) {
    FitResult squares = fit_once(plain, next, least_squares);
    add_effort(squares, before);
    if (!finished(squares)) return squares;
    const Eigen::VectorXd start = next.start.size() ? next.start : problem.start();
    const auto error_at = [&](const Eigen::VectorXd& x) {
      return error_of(problem, evaluate(problem, x, false, false), Part::kFit);
    };
    if (error_at(squares.x) < error_at(start)) next.start = squares.x;
    before = std::move(squares);
  }
  next.recall = options.recall;
  next.record = options.record;
  FitResult result = fit_once(problem, next, least_squares);
  add_effort(result, before);
  if (!spec.growing_windows.empty() || problem.joined() || robust || starts_roughly(problem)) {
    const Eigen::VectorXd start = options.start.size() ? options.start : problem.start();
    result.start_error = error_of(problem, evaluate(problem, start, false, false), Part::kFit);
  }
  return result;
}

}  // namespace catena
