// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// A gap where it was fitted, or in what the fit has not seen.
bool gap_left(const GapTest& fit, const GapTest& held_out);
bool gap_left(const Stage& stage);
/// Too little for an effect to be sought, but not there by chance.
bool trace_left(const Stage& stage);

/// Whether the last stage explains the data: it leaves no gap, or so little that it is closed and
/// not only imitated.
bool explained(const std::vector<Stage>& stages);
/// Whether the last stage has one effect that closes the gap but leaves more of a trace than a law
/// slightly wrong would.
bool one_may_imitate_two(const std::vector<Stage>& stages);

/// The last stage that had no effect; the baseline has none.
const Stage& last_without_effects(const std::vector<Stage>& stages);

/// Effects that only imitate what is missing leave a visible part of the gap that they were added
/// for (7 % above the noise, 2 % of the squared misfit before the first of them); the right ones
/// leave a trace of it, from what their laws get slightly wrong. `last`: what is left with them.
bool only_imitated(const std::vector<Stage>& stages, const GapTest& last);

/// Effects that stand whatever else is missing: each takes some of the misfit away where it was
/// fitted and where it was not, a good part in one of them (which one depends on where the recording
/// was cut). Where the data do not decide against others in its place, one of them is what stands.
std::vector<std::string> standing_effects(const Diagnosis& found);

/// Divides the misfit among the effects, fits the final model as `asked` says, and tells what the
/// stages amount to. Throws
/// std::runtime_error where it cannot be simulated, ModelError where it cannot be made.
void conclude(DiagnosisState& state, const Case& asked);

}  // namespace catena
