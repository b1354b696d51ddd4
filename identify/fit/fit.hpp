// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "identify/problem/ordered_unknowns.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

enum class FitStatus {
  kNotRun,
  kConverged,
  kEvaluationLimit,  ///< the best so far is returned
  kTimeLimit,        ///< the best so far is returned
  kInterrupted,      ///< the best so far is returned
  kFailed,           ///< no evaluation succeeded, or the method could not leave its start
};

/// "converged", "evaluation limit", ... as in result files.
const char* name_of(FitStatus status);

/// One evaluation of the error, as it was made.
struct HistoryEntry {
  double error = 0;  ///< infinite if the simulation failed
  Eigen::VectorXd x;
  std::string message;  ///< why it failed
};

/// Evaluations that failed, with the unknowns that caused it.
struct Failure {
  Eigen::VectorXd x;
  std::string message;
};

struct FitResult {
  FitStatus status = FitStatus::kNotRun;
  std::string message;
  Eigen::VectorXd x;  ///< the best
  double error = 0;   ///< its error, in the case's measure
  double start_error = 0;
  /// Of the error, by the tolerances of the simulation: a step that promised less ended the fit.
  /// NaN where no step came near that.
  double error_noise = std::numeric_limits<double>::quiet_NaN();
  int evaluations = 0;  ///< simulations of all experiments
  double work = 0;      ///< in simulations' worth of time: with sensitivities they cost more
  int iterations = 0;
  double seconds = 0;
  double cpu_seconds = 0;  ///< of this thread: what the fit cost, whatever else the machine does
  std::vector<HistoryEntry> history;
  int failures = 0;
  std::vector<Failure> failed;  ///< the first hundred
  /// The unknowns at whose residuals the noise was estimated; empty where it was not.
  Eigen::VectorXd noise_seen_at;
};

/// Adds the effort of an earlier fit to `total`. Its errors are not taken over: they are those of another problem.
void add_effort(FitResult& total, const FitResult& before);

struct Progress {
  int evaluations = 0, limit = 0;
  double error = 0;  ///< best so far
};

/// How a fit is run. All may be left as they are.
struct FitOptions {
  Eigen::VectorXd start;  ///< empty: the case's
  double time_limit = 0;  ///< s; 0: none
  /// Of the integrator, in one evaluation: one that takes more has failed. 0: as the case says.
  long most_steps = 0;
  /// The same, of an evaluation that takes so many times the steps of the fit's first one that succeeded from one frame
  /// to the next: it stalls. 0: no such limit.
  double stall = 0;
  /// By least squares: a step that promises to lower the cost by no more than this share of it ends the fit, where the
  /// case's tolerance does not end it before.
  double enough = 0;
  const std::atomic<bool>* stop = nullptr;
  std::function<void(const Progress&)> progress;
  /// What an interrupted run found for exactly these unknowns; null if it did not come that far.
  std::function<const HistoryEntry*(const Eigen::VectorXd&)> recall;
  std::function<void(const HistoryEntry&)> record;
};

/// A fit by least squares: fit_least_squares of identify/least_squares/least_squares.hpp. It is an
/// argument, so that a program that does not use it need not link it.
using LeastSquares = std::function<FitResult(const Problem&, const FitOptions&)>;

/// Fits the unknowns of a problem by the method that its case names.
///
/// `least_squares` may be empty if the case names another method. Nelder-Mead and the bounded
/// gradient methods are those of minimise.hpp. With growing windows, the beginning of each experiment
/// is fitted first, then longer parts, each from where the one before ended. With joined windows
/// (multiple shooting), shooting defects cost little at first, then more and more. With a robust loss,
/// the fit without it comes first. A simulation that
/// fails is infinitely bad; how the fit ended is in the status. Throws InputError if nothing is free,
/// if there are no data, and for the method least_squares without a solver.
///
///     #include "identify/cases/case_reader.hpp"
///     const Problem problem(read_case("case.toml"), Model::built_in(4));
///     const FitResult found = fit(problem, {}, {});
///     const double stiffness = found.x[0];
FitResult fit(const Problem& problem, const FitOptions& options, const LeastSquares& least_squares);

/// Whether the fit is by least squares on distances and begins with a rough problem (rough() of
/// easier_problems.hpp). The minimum of that is where the fit of the problem itself starts.
bool starts_roughly(const Problem& problem);

/// How a recording is taken: "whole", "growing windows", "separate windows", "multiple shooting".
const char* strategy_of(const Problem& problem);

/// Throws InputError unless there are unknowns and data to fit them to.
void check_fittable(const Problem& problem);

/// The unknowns as the methods move them: those of logarithmic scale as their logarithms, and of two of which
/// one does not exceed the other, the greater one less that (ordered_unknowns.hpp).
Eigen::VectorXd to_scaled(const Problem& problem, const Eigen::VectorXd& x);
/// From there back to the unknowns, within their bounds.
Eigen::VectorXd from_scaled(const Problem& problem, const Eigen::VectorXd& y);
/// The bounds between which they move.
UnknownBounds scaled_bounds(const Problem& problem);
/// Derivatives by the unknowns, one column each, as those by what the methods move.
void scale_derivatives(const Problem& problem, const Eigen::VectorXd& x, Eigen::MatrixXd& columns);

}  // namespace catena
