// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/diagnose.hpp"

namespace catena {

inline constexpr double kClosed = 1.2;          ///< a gap is, below this many times the noise
inline constexpr double kClosedHeldOut = 1.35;  ///< the same where it was not fitted
inline constexpr double kVisible = 1.07;        ///< times the noise: more than noise is left

/// A gap where it was fitted, or in what the fit has not seen.
bool gap_left(const Stage& stage);
/// Too little for an effect to be sought, but not there by chance.
bool trace_left(const Stage& stage);

/// Whether a model that leaves `held_out` of what no fit has seen predicts it as well as one that
/// leaves `other`: an effect must, beside the model without it. True where nothing is held out.
bool predicts_as_well(const GapTest& held_out, const GapTest& other);

/// Misfit of the last stage that had no effect; 0 if none had.
double misfit_without_effects(const std::vector<Stage>& stages);

/// Effects that only imitate what is missing leave a visible part of the gap that they were added
/// for (7 % above the noise, 2 % of the squared misfit before the first of them); the right ones
/// leave a trace of it, from what their laws get slightly wrong. `last`: with them, fitted again.
bool only_imitated(const std::vector<Stage>& stages, const GapTest& last);

/// Fits the final model as `asked` says and tells what the stages amount to.
void conclude(Diagnosis& d, const Case& asked, Workshop& workshop);

}  // namespace catena
