// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// With all effects in place: is each still needed, and could another stand in its place? Sorts
/// those that could into undecided ones, forms and runners-up. Never ends with a gap that was closed
/// before. Whether the effects were changed. Throws Interrupted.
bool look_back(DiagnosisState& state);

/// Whether the best model so far does not need an effect; `without` is fitted without it. It does
/// not if the model without it leaves no gap, or predicts better what no fit has seen (with others
/// in place an effect may fit what is not its own), or if what the effect explains may be chance,
/// or a detail. It always needs an effect without which a closed gap would be open again, or a gap stays
/// and what no fit has seen is predicted worse by more than a detail: others may imitate it in the
/// fitted part.
bool needless(const DiagnosisState& state, const Stage& without);

}  // namespace catena
