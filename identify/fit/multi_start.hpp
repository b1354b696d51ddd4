// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/fit/fit.hpp"
#include "identify/fit/run_log.hpp"

namespace catena {

/// Starts of a multi-start: the case's own, then a Latin hypercube within the bounds (logarithmic
/// unknowns by their logarithms); unknowns without finite bounds stay where the case starts them.
/// The same seed gives the same starts on every machine.
std::vector<Eigen::VectorXd> start_points(const Problem& problem, int count, unsigned seed);

/// One fit from every start the case asks for, on `threads` threads. Each fit is on its own, so
/// that results do not depend on the number of threads. In the order of the starts. Those that are
/// neither in the log nor the shard's are not run; where there is one alone, every shard has to.
std::vector<FitResult> fit_from_many(const Problem& problem, const FitOptions& options,
                                     const LeastSquares& least_squares, int threads, RunLog* log,
                                     const Shard& shard = {});

/// The index of the result with the least error; the first of equals.
std::size_t best_of(const std::vector<FitResult>& results);

}  // namespace catena
