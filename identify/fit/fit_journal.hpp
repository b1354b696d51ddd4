// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"

namespace catena {

/// What every method of fitting shares: it evaluates the error, keeps the best, counts and reports
/// failures, and knows when to stop (limits, interruption).
class FitJournal {
 public:
  /// `problem` and `options` must outlive it.
  FitJournal(const Problem& problem, const FitOptions& options, int max_evaluations);

  /// The error at x and, if wanted, its gradient (gradient methods). Infinite where the simulation
  /// failed.
  double evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient);
  /// The residuals at x (least squares); the error is recorded.
  Misfit evaluate_residuals(const Eigen::VectorXd& x, bool jacobian);

  /// The residuals of the same problem roughly simulated (rough() of easier_problems.hpp): they count as an
  /// evaluation, but are the result only where there is no other.
  Misfit evaluate_roughly(const Problem& rough, const Eigen::VectorXd& x, bool jacobian);

  /// How much the error at x changes if simulated as `finer` (finer() of easier_problems.hpp): its
  /// noise. The largest so far goes to the result. Counts as an evaluation. 0 if it fails.
  double measure_noise(const Problem& finer, const Eigen::VectorXd& x, double error);

  /// `reserved`: so many evaluations are to be left.
  bool must_stop(int reserved = 0);
  /// Why must_stop() said so.
  FitStatus why_stopped() const { return why_; }
  void count_iteration() { ++result_.iterations; }
  const FitOptions& options() const { return options_; }

  /// The best so far, with what was counted; kFailed where no evaluation succeeded, unless it was stopped.
  FitResult result(FitStatus status, const std::string& message);

 private:
  Misfit misfit_at(const Problem& problem, const Eigen::VectorXd& x, bool jacobian,
                   std::string& message);
  bool was_stopped(double error);
  void note_failure(const Eigen::VectorXd& x, const std::string& message);
  void count_evaluation(const Eigen::VectorXd& x, bool jacobian);
  void note(const Eigen::VectorXd& x, double error, const std::string& message, bool jacobian);
  double seconds() const;

  const Problem& problem_;
  const FitOptions& options_;
  int limit_;
  FitResult result_;
  HistoryEntry roughly_best_;
  double frame_interval_;  ///< s, mean
  long first_steps_ = 0;   ///< of the integrator, by the first simulation that succeeded
  FitStatus why_ = FitStatus::kConverged;
  double cpu_begin_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace catena
