// SPDX-License-Identifier: BSD-3-Clause
#include "identify/uncertainty/bootstrap.hpp"

#include <atomic>
#include <cmath>
#include <random>

#include "common/parallel.hpp"
#include "identify/fit/error.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// Residuals (simulated minus measured) of the fitted frames in new order: blocks of neighbouring
/// frames, drawn with replacement.
MatrixXd drawn_again(const MatrixXd& residuals, Index block, std::mt19937_64& generator) {
  const Index frames = residuals.cols();
  MatrixXd out(residuals.rows(), frames);
  for (Index begin = 0; begin < frames; begin += block) {
    const Index length = std::min(block, frames - begin);
    const auto from =
        static_cast<Index>(generator() % static_cast<std::uint64_t>(frames - length + 1));
    out.middleCols(begin, length) = residuals.middleCols(from, length);
  }
  return out;
}

}  // namespace

MatrixXd bootstrap(const Problem& problem, const FitResult& fit, const Uncertainty& uncertainty,
                   const LeastSquares& least_squares, int count, unsigned seed, int threads,
                   const std::atomic<bool>* stop, RunLog* log, const Shard& shard) {
  const Evaluation best = evaluate(problem, fit.x, false, false);
  const double rho = std::clamp(uncertainty.autocorrelation, 0.0, 0.97);
  MatrixXd rows(count, fit.x.size());
  std::atomic<bool> complete = true;
  const std::string name = name_of(fit);
  in_parallel(static_cast<std::size_t>(count), threads, [&](std::size_t row) {
    if (stop && *stop) return;
    const Refit refit{kBootstrapRefit, static_cast<int>(row), name};
    if (log)
      if (const auto known = log->refitted(refit)) {
        rows.row(static_cast<Index>(row)) = known->transpose();
        return;
      }
    if (!shard.has(row)) {
      complete = false;
      return;
    }
    std::mt19937_64 generator(seed + 1'000'003ULL * (row + 1));
    std::vector<Experiment> experiments = problem.experiments();
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      if (!experiments[e].fitted()) continue;
      Recording& recording = experiments[e].recording;
      const Index frames = recording.fit_frames;
      const MatrixXd& simulated = best.predictions[e].simulated;
      const MatrixXd residuals = simulated - recording.measured.leftCols(frames);
      // long enough that what is correlated stays together
      const Index block = std::min<Index>(
          frames, static_cast<Index>(std::ceil(std::max(std::cbrt(static_cast<double>(frames)),
                                                        2 * (1 + rho) / (1 - rho)))));
      recording.measured.leftCols(frames) = simulated - drawn_again(residuals, block, generator);
    }
    FitOptions options;
    options.start = fit.x;
    options.stop = stop;
    const Problem again(problem.the_case(), problem.model(), std::move(experiments));
    const Eigen::VectorXd x = least_squares(again, options).x;
    if (stop && *stop) return;
    rows.row(static_cast<Index>(row)) = x.transpose();
    if (log) log->finish(refit, x);
  });
  if (!complete || (stop && *stop)) rows.resize(0, rows.cols());
  return rows;
}

}  // namespace catena
