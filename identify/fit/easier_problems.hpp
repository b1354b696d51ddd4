// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/problem/problem.hpp"

namespace catena {

// Problems whose minimum is near that of another one and easier to find: the steps on the way of a
// fit. Each function returns a new problem with the same unknowns.

/// Only the first `seconds` (s) after the start of each experiment are fitted, two frames at least.
Problem first_seconds(const Problem& problem, double seconds);

/// The relative tolerance of the optimiser is another.
Problem with_tolerance(const Problem& problem, double tolerance);

/// Shooting defects cost `weight` times what residuals of the same number do.
Problem with_defect_weight(const Problem& problem, double weight);

/// Residuals count by their squares, outliers too. The minimum under a robust loss has this one as
/// its start: far from the data a robust loss hardly slopes.
Problem without_loss(const Problem& problem);

/// A rough version for the first steps of a fit: simulated with a relative tolerance of 1e-4
/// (absolute ones in proportion), every so many frames only, the optimiser's tolerance 1e-2.
Problem rough(const Problem& problem);

/// Simulated with a tenth of the tolerances, so that its error lacks most of the noise that the
/// problem's own has: a simulation's error changes with its steps, and they with the unknowns.
Problem finer(const Problem& problem);

/// Whether rough() costs much less.
bool finer_than_rough(const Problem& problem);

}  // namespace catena
