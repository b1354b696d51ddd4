// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/multi_start.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <mutex>
#include <numeric>
#include <random>

#include "common/parallel.hpp"

namespace catena {
namespace {

/// Uniform in [0, 1), the same on every machine (the standard's distributions are not).
double uniform(std::mt19937_64& generator) {
  return static_cast<double>(generator() >> 11) * 0x1.0p-53;
}

std::vector<std::size_t> shuffled(std::size_t count, std::mt19937_64& generator) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = count; i > 1; --i)
    std::swap(order[i - 1],
              order[static_cast<std::size_t>(uniform(generator) * static_cast<double>(i))]);
  return order;
}

}  // namespace

std::vector<Eigen::VectorXd> start_points(const Problem& problem, int count, unsigned seed) {
  std::mt19937_64 generator(seed);
  const auto drawn = static_cast<std::size_t>(count - 1);
  std::vector<Eigen::VectorXd> points(static_cast<std::size_t>(count),
                                      to_scaled(problem, problem.start()));
  const UnknownBounds bounds = scaled_bounds(problem);
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    const std::vector<std::size_t> cell = shuffled(drawn, generator);
    const double lower = bounds.lower[static_cast<Eigen::Index>(j)];
    const double upper = bounds.upper[static_cast<Eigen::Index>(j)];
    for (std::size_t i = 0; i < drawn; ++i) {
      const double place =
          (static_cast<double>(cell[i]) + uniform(generator)) / static_cast<double>(drawn);
      if (std::isfinite(unknown.lower) && std::isfinite(unknown.upper))
        points[i + 1][static_cast<Eigen::Index>(j)] = lower + place * (upper - lower);
    }
  }
  for (Eigen::VectorXd& point : points) point = from_scaled(problem, point);
  points[0] = problem.start();
  return points;
}

std::vector<FitResult> fit_from_many(const Problem& problem, const FitOptions& options,
                                     const LeastSquares& least_squares, int threads, RunLog* log,
                                     const Shard& shard) {
  check_fittable(problem);
  const OptimiserSpec& spec = problem.the_case().optimiser;
  const std::vector<Eigen::VectorXd> starts = start_points(problem, spec.starts, spec.seed);
  std::vector<FitResult> results(starts.size());
  std::mutex mutex;
  const auto begin = std::chrono::steady_clock::now();
  const long limit = static_cast<long>(spec.max_evaluations) * spec.starts;
  Progress total{0, static_cast<int>(std::min<long>(limit, std::numeric_limits<int>::max())),
                 std::numeric_limits<double>::infinity()};
  in_parallel(starts.size(), threads, [&](std::size_t i) {
    const int start = static_cast<int>(i);
    if (log)
      if (const auto known = log->finished(start)) {
        results[i] = *known;
        return;
      }
    const bool own_work = shard.has(i);
    if (!own_work && (starts.size() > 1 || shard.of == 0)) return;
    FitOptions own = options;
    own.start = starts[i];
    if (options.time_limit > 0) {
      // The limit is for all starts together; one that begins after it stops at once.
      const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
      own.time_limit = std::max(options.time_limit - elapsed.count(), 1e-9);
    }
    if (log && own_work) {
      own.recall = [log, start](const Eigen::VectorXd& x) { return log->recall(start, x); };
      own.record = [log, start](const HistoryEntry& entry) { log->record(start, entry); };
    }
    if (options.progress)
      own.progress = [&](const Progress& progress) {
        const std::scoped_lock lock(mutex);
        ++total.evaluations;
        total.error = std::min(total.error, progress.error);
        options.progress(total);
      };
    results[i] = fit(problem, own, least_squares);
    const FitStatus status = results[i].status;
    const bool cut_short = status == FitStatus::kInterrupted || status == FitStatus::kTimeLimit;
    if (log && own_work && !cut_short) log->finish(start, results[i]);
  });
  return results;
}

std::size_t best_of(const std::vector<FitResult>& results) {
  // one that could not leave its start is no fit, however good the start
  const auto rank = [](const FitResult& result) {
    return std::pair(result.status == FitStatus::kFailed, result.error);
  };
  const auto less = [&](const FitResult& a, const FitResult& b) { return rank(a) < rank(b); };
  return static_cast<std::size_t>(std::min_element(results.begin(), results.end(), less) -
                                  results.begin());
}

}  // namespace catena
