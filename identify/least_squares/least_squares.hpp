// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/fit/fit.hpp"

namespace catena {

/// Fits the unknowns by Ceres' trust region method on the residuals and their exact sensitivities,
/// within bounds, logarithmic unknowns by their logarithms. What is minimised for each measure:
///
/// - least_squares: the sum of rho(r^2), r in units of the noise; rho by the case's loss.
/// - mean_distance: the sum over frames and markers of the distance (6.5), (6.6); see DistanceCost.
/// - mean_absolute: the same on every channel, weighted as in (7.1).
/// - likelihood: the sum of r^2 over the square of the channel's noise. The noise is found again
///   from the residuals until it stays.
///
/// Distances are first fitted with rough simulations (rough() of easier_problems.hpp), which count
/// as evaluations. Their minimum is the start of the fit of the problem itself, which alone makes
/// the result and its history. A step to where the simulation fails is refused.
///
/// `options`: as for fit(). Returns how the fit ended in the status; throws nothing for it. This is
/// a target of its own, catena_least_squares, because Debian's Ceres brings libraries that are partly
/// GPL.
FitResult fit_least_squares(const Problem& problem, const FitOptions& options);

}  // namespace catena
