// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/fit/fit.hpp"

namespace catena {

/// Fits the unknowns by Ceres' trust region method on the residuals and their exact sensitivities,
/// within bounds, logarithmic unknowns by their logarithms:
///
///   measure            what is minimised
///   least_squares      sum of rho(r^2), r in units of the noise; rho by the case's loss
///   mean_distance      sum over frames and markers of the distance (6.5), (6.6): see DistanceCost
///   mean_absolute      the same on every channel, weighted as in (7.1)
///   likelihood         sum of r^2 over the square of the channel's noise, which is found again
///   from
///                      the residuals until it stays
///
/// Distances are first fitted to rough simulations (Problem::rough), which count as evaluations;
/// what they lead to is the start of the fit proper, which alone makes the result and its history.
///
/// A simulation that fails makes its step be refused. A target of its own (catena_least_squares): Debian's
/// Ceres brings libraries that are partly GPL.
FitResult fit_least_squares(const Problem& problem, const FitOptions& options);

}  // namespace catena
