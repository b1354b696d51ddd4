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

/// Whether a refitted explanation of what `base` leaves may be taken: significant among all that
/// were tried, worthwhile, more than a detail, and predicting the held-out part as well as the best
/// model so far; from the third effect on, better.
bool acceptable(const DiagnosisState& state, const FittedModel& base,
                const Explanation& explanation);

/// The explanation to take; nullptr: none is acceptable. It is the one that leaves least of those
/// that no other one beats in the held-out part (predicts_better), unless
/// the data do not decide against something simpler: one of fewer unknowns (a freer start is one of
/// many), or an effect inside the other.
const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations);

}  // namespace catena
