// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/fit_journal.hpp"

#include <cmath>

#include "common/cpu_seconds.hpp"
#include "common/special_values.hpp"

namespace catena {
namespace {

constexpr std::size_t kFailuresKept = 100;

/// Of all that is fitted, s.
double mean_frame_interval(const Problem& problem) {
  double duration = 0, intervals = 0;
  for (const Experiment& experiment : problem.experiments()) {
    if (!experiment.fitted()) continue;
    const auto last = static_cast<std::size_t>(experiment.recording.fit_frames - 1);
    duration += experiment.recording.time[last] - experiment.recording.time[0];
    intervals += static_cast<double>(last);
  }
  return intervals > 0 ? duration / intervals : kInfinite;
}

}  // namespace

FitJournal::FitJournal(const Problem& problem, const FitOptions& options, int max_evaluations)
    : problem_(problem),
      options_(options),
      limit_(max_evaluations),
      frame_interval_(mean_frame_interval(problem)) {
  result_.x = options.start.size() ? options.start : problem.start();
  result_.error = kInfinite;
  result_.start_error = kInfinite;
  roughly_best_.error = kInfinite;
  cpu_begin_ = cpu_seconds();
}

double FitJournal::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
}

bool FitJournal::must_stop(int reserved) {
  if (options_.stop && options_.stop->load())
    why_ = FitStatus::kInterrupted;
  else if (options_.time_limit > 0 && seconds() > options_.time_limit)
    why_ = FitStatus::kTimeLimit;
  else if (result_.evaluations + reserved >= limit_)
    why_ = FitStatus::kEvaluationLimit;
  else
    return false;
  return true;
}

/// A simulation that was stopped is no failure: nothing is known about these unknowns.
bool FitJournal::was_stopped(double error) {
  return !std::isfinite(error) && must_stop() && why_ != FitStatus::kEvaluationLimit;
}

void FitJournal::note_failure(const Eigen::VectorXd& x, const std::string& message) {
  ++result_.failures;
  if (result_.failed.size() < kFailuresKept) result_.failed.push_back({x, message});
}

void FitJournal::count_evaluation(const Eigen::VectorXd& x, bool jacobian) {
  ++result_.evaluations;
  result_.work += jacobian ? 1 + static_cast<double>(x.size()) : 1;
}

void FitJournal::note(const Eigen::VectorXd& x, double error, const std::string& message,
                      bool jacobian) {
  if (was_stopped(error)) return;
  count_evaluation(x, jacobian);
  if (result_.history.empty()) result_.start_error = error;
  result_.history.push_back({error, x, message});
  if (options_.record) options_.record(result_.history.back());
  if (std::isfinite(error)) {
    if (error < result_.error) {
      result_.error = error;
      result_.x = x;
    }
  } else {
    note_failure(x, message);
  }
  if (options_.progress) options_.progress({result_.evaluations, limit_, result_.error});
}

double FitJournal::evaluate(const Eigen::VectorXd& x, Eigen::VectorXd* gradient) {
  if (gradient) return error_and_gradient(problem_, evaluate_residuals(x, true), *gradient);
  if (options_.recall)
    if (const HistoryEntry* known = options_.recall(x)) {
      note(x, known->error, known->message, false);
      return known->error;
    }
  return evaluate_residuals(x, false).error;
}

Misfit FitJournal::misfit_at(const Problem& problem, const Eigen::VectorXd& x, bool jacobian,
                             std::string& message) {
  const double stalled = options_.stall * static_cast<double>(first_steps_);
  long steps = 0, since_frame = 0;
  double frame = -kInfinite;
  const auto keep_going = [&](double time) {
    if (!(std::abs(time - frame) < frame_interval_)) {
      frame = time;
      since_frame = steps;
    }
    ++steps;
    return (options_.most_steps == 0 || steps <= options_.most_steps) &&
           (stalled == 0 || static_cast<double>(steps - since_frame) <= stalled) &&
           !(options_.stop && options_.stop->load()) &&
           !(options_.time_limit > 0 && seconds() > options_.time_limit);
  };
  const Evaluation evaluation = catena::evaluate(problem, x, false, jacobian, keep_going);
  Misfit misfit = misfit_of(problem, evaluation);
  if (misfit.ok && first_steps_ == 0) first_steps_ = steps;
  message = evaluation.ok && !misfit.ok
                ? "the squares of what is left are too great for numbers of a computer; look at "
                  "noise, and at measured and standard_deviation of parameters"
                : evaluation.message;
  return misfit;
}

Misfit FitJournal::evaluate_residuals(const Eigen::VectorXd& x, bool jacobian) {
  std::string message;
  Misfit misfit = misfit_at(problem_, x, jacobian, message);
  note(x, misfit.error, message, jacobian);
  return misfit;
}

Misfit FitJournal::evaluate_roughly(const Problem& rough, const Eigen::VectorXd& x, bool jacobian) {
  std::string message;
  Misfit misfit = misfit_at(rough, x, jacobian, message);
  if (was_stopped(misfit.error)) return misfit;
  count_evaluation(x, jacobian);
  if (!misfit.ok) note_failure(x, message);
  if (misfit.error < roughly_best_.error) roughly_best_ = {misfit.error, x, ""};
  if (options_.progress) options_.progress({result_.evaluations, limit_, roughly_best_.error});
  return misfit;
}

double FitJournal::measure_noise(const Problem& finer, const Eigen::VectorXd& x, double error) {
  std::string message;
  const Misfit misfit = misfit_at(finer, x, false, message);
  if (was_stopped(misfit.error)) return 0;
  count_evaluation(x, false);
  if (!misfit.ok) return 0;
  const double noise = std::abs(misfit.error - error);
  result_.error_noise = std::fmax(result_.error_noise, noise);  // NaN before the first
  return noise;
}

FitResult FitJournal::result(FitStatus status, const std::string& message) {
  if (!std::isfinite(result_.error) && std::isfinite(roughly_best_.error)) {
    result_.error = roughly_best_.error;
    result_.x = roughly_best_.x;
  }
  result_.status = std::isfinite(result_.error) || status == FitStatus::kInterrupted ||
                           status == FitStatus::kTimeLimit
                       ? status
                       : FitStatus::kFailed;
  result_.message = message;
  if (!std::isfinite(result_.error) && !result_.failed.empty())
    result_.message = "no simulation succeeded; the first: " + result_.failed.front().message;
  result_.seconds = seconds();
  result_.cpu_seconds = cpu_seconds() - cpu_begin_;
  return result_;
}

}  // namespace catena
