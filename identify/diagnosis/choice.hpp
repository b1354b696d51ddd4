// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/state.hpp"

namespace catena {

/// Whether what a model removes of the misfit is more than a detail: beside a large effect, what
/// its law gets slightly wrong leaves a trace that others fit a little.
bool more_than_a_detail(const DiagnosisState& state, const Comparison& comparison);

/// Whether a refitted explanation may be taken: significant among all that were tried, worthwhile,
/// more than a detail, and predicting the held-out part as well.
bool acceptable(const DiagnosisState& state, const Explanation& explanation);

/// The explanation to take; nullptr: none is acceptable. It is the one that leaves least, unless
/// the data do not decide against something simpler: one of fewer unknowns (a freer start is one of
/// many), or an effect inside the other.
const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations);

}  // namespace catena
