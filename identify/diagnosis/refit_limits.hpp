// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// How far a fit goes of which a search asks no more than whether it is among the best. What is taken is fitted again,
/// as closely as the case asks (trim).
struct RefitLimits {
  double enough;    ///< share of the cost: FitOptions::enough
  long most_steps;  ///< of the integrator: FitOptions::most_steps

  /// For fits of what `base` leaves, from where it is or nearby.
  RefitLimits(const FittedModel& base, const std::vector<NoiseModel>& noise);
  /// The solver, within these limits.
  LeastSquares within(const LeastSquares& solver) const;
};

}  // namespace catena
