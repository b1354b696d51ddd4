// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>

#include "identify/fit/run_log.hpp"
#include "identify/uncertainty/uncertainty.hpp"

namespace catena {

/// Bootstrap over blocks of time: the residuals are drawn again in blocks of frames (all channels
/// of a frame together), put on the prediction, and the fit repeated. Row: one refit; column: one
/// unknown. The same seed gives the same rows for any number of threads and shards. Rows that `log`
/// (may be null) knows are taken from it; others are run if they are the shard's, and logged. Without
/// all rows it returns none, as fewer than asked would give other intervals: with work of other
/// shards missing, and once `stop` is true (nullptr: never).
Eigen::MatrixXd bootstrap(const Problem& problem, const FitResult& fit,
                          const Uncertainty& uncertainty, const LeastSquares& least_squares,
                          int count, unsigned seed, int threads,
                          const std::atomic<bool>* stop = nullptr, RunLog* log = nullptr,
                          const Shard& shard = {});

}  // namespace catena
