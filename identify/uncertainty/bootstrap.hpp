// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>

#include "identify/uncertainty/uncertainty.hpp"

namespace catena {

/// Bootstrap over blocks of time: the residuals are drawn again in blocks of frames (all channels
/// of a frame together), put on the prediction, and the fit repeated. Row: one refit; column: one
/// unknown. The same seed gives the same rows for any number of threads. Once `stop` is true,
/// it ends without rows: fewer than asked would give other intervals; nullptr: never.
Eigen::MatrixXd bootstrap(const Problem& problem, const FitResult& fit,
                          const Uncertainty& uncertainty, const LeastSquares& least_squares,
                          int count, unsigned seed, int threads,
                          const std::atomic<bool>* stop = nullptr);

}  // namespace catena
