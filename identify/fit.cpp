// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit.hpp"

#include <cmath>
#include <limits>
#include <nlopt.hpp>

#include "generator/description/input_error.hpp"
#include "identify/error.hpp"
#include "identify/fit_journal.hpp"

namespace catena {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// A failed simulation counts as infinitely bad; the simplex needs a number it can compare and average.
constexpr double kWorst = 1e100;

nlopt::algorithm algorithm_of(FitMethod method) {
  switch (method) {
    case FitMethod::kNelderMead:
      return nlopt::LN_NELDERMEAD;
    case FitMethod::kLbfgs:
      return nlopt::LD_LBFGS;
    case FitMethod::kSlsqp:
      return nlopt::LD_SLSQP;
    case FitMethod::kMma:
      return nlopt::LD_MMA;
    case FitMethod::kLeastSquares:
      break;
  }
  throw std::invalid_argument("least squares is not among NLopt's methods");
}

std::vector<double> plain(const Eigen::VectorXd& x) { return {x.begin(), x.end()}; }

Eigen::VectorXd vector(const std::vector<double>& x) {
  return Eigen::Map<const Eigen::VectorXd>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// d(unknown)/d(scaled unknown): the unknown itself where the scale is logarithmic.
Eigen::VectorXd scale_slopes(const Problem& problem, const Eigen::VectorXd& x) {
  Eigen::VectorXd slopes = Eigen::VectorXd::Ones(x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j)
    if (problem.unknowns()[static_cast<std::size_t>(j)].scale == Scale::kLogarithmic)
      slopes[j] = x[j];
  return slopes;
}

std::vector<double> first_steps(const Problem& problem, const Eigen::VectorXd& start) {
  const double step = problem.study().optimiser.initial_step;
  std::vector<double> steps;
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    double size = step;  // of a logarithm: a relative step
    if (unknown.scale == Scale::kLinear) {
      size = step * std::abs(start[j]);
      if (size == 0 && std::isfinite(unknown.upper - unknown.lower))
        size = step * (unknown.upper - unknown.lower);
      if (size == 0) size = step * (unknown.group == Unknown::Group::kInitial ? 0.1 : 1);
    }
    steps.push_back(size);
  }
  return steps;
}

FitResult fit_by_nlopt(const Problem& problem, const FitOptions& options) {
  const OptimiserSpec& spec = problem.study().optimiser;
  FitJournal journal(problem, options, spec.max_evaluations);
  const Eigen::VectorXd start = options.start.size() ? options.start : problem.start();
  const bool gradient_wanted = spec.method != FitMethod::kNelderMead;

  nlopt::opt solver(algorithm_of(spec.method), static_cast<unsigned>(start.size()));
  Eigen::VectorXd lower(start.size()), upper(start.size());
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    lower[j] = problem.unknowns()[static_cast<std::size_t>(j)].lower;
    upper[j] = problem.unknowns()[static_cast<std::size_t>(j)].upper;
  }
  solver.set_lower_bounds(plain(to_scaled(problem, lower)));
  solver.set_upper_bounds(plain(to_scaled(problem, upper)));
  if (!gradient_wanted) solver.set_initial_step(first_steps(problem, start));
  solver.set_xtol_rel(spec.tolerance);
  solver.set_ftol_rel(gradient_wanted ? 1e-2 * spec.tolerance : spec.tolerance);
  nlopt::vfunc objective = [](const std::vector<double>& y, std::vector<double>& slope,
                              void* data) -> double {
    auto& [journal, problem, solver] =
        *static_cast<std::tuple<FitJournal*, const Problem*, nlopt::opt*>*>(data);
    const Eigen::VectorXd x = from_scaled(*problem, vector(y));
    Eigen::VectorXd gradient;
    const double error = journal->evaluate(x, slope.empty() ? nullptr : &gradient);
    if (journal->must_stop()) solver->force_stop();
    if (!slope.empty()) {
      gradient.array() *= scale_slopes(*problem, x).array();
      std::copy(gradient.begin(), gradient.end(), slope.begin());
    }
    return std::isfinite(error) ? error : kWorst;
  };
  std::tuple<FitJournal*, const Problem*, nlopt::opt*> data(&journal, &problem, &solver);
  solver.set_min_objective(objective, &data);

  std::vector<double> y = plain(to_scaled(problem, start));
  double error = kInfinite;
  FitStatus status = FitStatus::kConverged;
  std::string message;
  try {
    solver.optimize(y, error);
  } catch (const nlopt::forced_stop&) {
    status = journal.why_stopped();
  } catch (const nlopt::roundoff_limited&) {
    message = "stopped at the limit of rounding";
  } catch (const std::runtime_error& problem_found) {  // NLopt: generic failure of a line search
    message = std::string("stopped by NLopt: ") + problem_found.what();
  }
  return journal.result(status, message);
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
  Eigen::VectorXd y = x;
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
      x[j] = std::clamp(std::exp(y[j]), unknown.lower, unknown.upper);
  }
  return x;
}

namespace {

FitResult fit_once(const Problem& problem, const FitOptions& options,
                   const LeastSquares& least_squares) {
  return problem.study().optimiser.method == FitMethod::kLeastSquares
             ? least_squares(problem, options)
             : fit_by_nlopt(problem, options);
}

/// What came before counts too; errors of shorter windows are no errors of the whole.
void add_effort(FitResult& total, const FitResult& before) {
  total.evaluations += before.evaluations;
  total.iterations += before.iterations;
  total.work += before.work;
  total.seconds += before.seconds;
  total.failures += before.failures;
  total.failed.insert(total.failed.begin(), before.failed.begin(), before.failed.end());
}

}  // namespace

void check_fittable(const Problem& problem) {
  if (problem.unknowns().empty())
    throw InputError(problem.study().file.string() +
                     ": nothing to identify; mark a [[parameter]] with free = true");
  bool data = false;
  for (const Experiment& experiment : problem.experiments()) data |= experiment.fitted();
  if (!data)
    throw InputError(problem.study().file.string() +
                     ": free parameters without data; add an [[experiment]] with use = \"fit\"");
}

FitResult fit(const Problem& problem, const FitOptions& options, const LeastSquares& least_squares) {
  check_fittable(problem);
  const OptimiserSpec& spec = problem.study().optimiser;
  if (spec.method == FitMethod::kLeastSquares && !least_squares)
    throw InputError(problem.study().file.string() +
                     ": optimiser.method: least_squares is not built in here; use another method");
  FitOptions next = options;
  next.recall = nullptr;  // errors of a part are not those of the whole
  next.record = nullptr;
  FitResult before;
  for (const double seconds : spec.growing_windows) {
    FitResult shorter = fit_once(problem.shortened(seconds), next, least_squares);
    add_effort(shorter, before);
    if (shorter.status == FitStatus::kInterrupted || shorter.status == FitStatus::kTimeLimit ||
        shorter.status == FitStatus::kFailed)
      return shorter;
    next.start = shorter.x;
    before = std::move(shorter);
  }
  next.recall = options.recall;
  next.record = options.record;
  FitResult result = fit_once(problem, next, least_squares);
  add_effort(result, before);
  if (!spec.growing_windows.empty()) {
    const Eigen::VectorXd start = options.start.size() ? options.start : problem.start();
    result.start_error = error_of(problem, evaluate(problem, start, false, false), Part::kFit);
  }
  return result;
}

}  // namespace catena
