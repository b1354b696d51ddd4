// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <vector>

#include "identify/fit/run_log.hpp"
#include "identify/uncertainty/uncertainty.hpp"

namespace catena {

/// Cost of holding one unknown of the physics at a value while the others are fitted again.
struct Profile {
  int unknown = 0;
  std::vector<double> value;
  std::vector<double>
      cost;  ///< twice the negative log likelihood above the minimum, autocorrelation allowed for
  double threshold = 3.84;  ///< the 95 % quantile of chi square with one degree of freedom
  Verdict verdict = Verdict::kIdentifiable;
};

/// Profiles of every unknown of the physics around the fit, by refits from the neighbouring point.
/// Crosses the threshold on both sides: identifiable; nowhere rises: structurally not; else
/// practically not (within the bounds). Log, shard and `stop` as in bootstrap(): without all profiles
/// it returns none.
std::vector<Profile> profiles_of(const Problem& problem, const FitResult& fit,
                                 const Uncertainty& uncertainty, const LeastSquares& least_squares,
                                 int threads, const std::atomic<bool>* stop = nullptr,
                                 RunLog* log = nullptr, const Shard& shard = {});

}  // namespace catena
