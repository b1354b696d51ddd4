// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// Whether what a model removes of the misfit of `base` is more than a detail, where it was fitted
/// or, beyond chance, where it was held out: beside a large effect, what its law gets slightly wrong
/// leaves a trace that others fit a little.
bool more_than_a_detail(const DiagnosisState& state, const FittedModel& base,
                        const FittedModel& larger);
/// The same of what was held out alone, be it chance or not.
bool more_than_a_detail_held_out(const DiagnosisState& state, const GapTest& base,
                                 const GapTest& larger);

/// Whether a refitted explanation drives the chain at a frequency that is not told from that of the
/// motion of `base`, and leaves a gap. Any law that goes with the motion, or a part of it that is not
/// seen, is imitated in part like that.
bool goes_with_the_motion(const DiagnosisState& state, const FittedModel& base,
                          const Explanation& explanation);

/// Whether a refitted explanation of what `base` leaves may be taken: significant among all that
/// were tried, worthwhile, more than a detail, no drive that goes with the motion, and predicting the
/// held-out part as well as the best model so far; from the third effect on, better.
bool acceptable(const DiagnosisState& state, const FittedModel& base,
                const Explanation& explanation);

/// Whether `passive` is no function of time, `driven` is one, and what was held out is predicted no
/// better with the drive. A cable that nobody drives is the default. In what was fitted a drive with
/// its free frequency, amplitudes and phases can imitate what takes energy away; it goes on where the
/// motion dies out, and shows there. `left`: of what was held out; where nothing was, false.
bool needs_no_drive(const DiagnosisState& state, const std::string& passive, const GapTest& left,
                    const std::string& driven, const GapTest& left_driven);

/// The explanation to take; nullptr: none is acceptable. It is the one that leaves least of those
/// that no other one beats in the held-out part (predicts_better, needs_no_drive), unless
/// the data do not decide against something simpler: one of fewer unknowns (a freer start is one of
/// many), or an effect inside the other.
const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations);

}  // namespace catena
