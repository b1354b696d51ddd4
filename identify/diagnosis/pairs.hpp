// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// Two effects at once: each of those that left least when no effect was there yet, and what is
/// best beside it. Enters the best such pair if it leaves less than what there is (as the data
/// decide, where that closes the gap), predicts what no fit has seen as well and opens no gap.
/// Whether it entered one. Throws Interrupted.
bool add_pair(DiagnosisState& state);

}  // namespace catena
