// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/refit_limits.hpp"

#include <algorithm>

#include "identify/diagnosis/thresholds.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {
namespace {

/// Of the integrator, for the fitted part at the values found.
long steps_of(const FittedModel& model) {
  long steps = 0;
  evaluate(*model.problem, model.x, false, false, [&steps](double) { return ++steps > 0; });
  return steps;
}

}  // namespace

RefitLimits::RefitLimits(const FittedModel& base, const std::vector<NoiseModel>& noise)
    : enough(kThresholds.worth_a_step /
             static_cast<double>(std::max(1L, fit_gap(base, noise).count))),
      most_steps(kThresholds.steps_of_refits * steps_of(base)) {}

LeastSquares RefitLimits::within(const LeastSquares& solver) const {
  return [solver, limits = *this](const Problem& problem, FitOptions options) {
    options.enough = limits.enough;
    options.most_steps = limits.most_steps;
    return solver(problem, options);
  };
}

}  // namespace catena
