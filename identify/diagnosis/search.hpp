// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// Adds links and effects as long as there is a gap and something acceptable that explains it.
void look_for_effects(DiagnosisState& state);

/// When admissible effects are refitted, too, whose score promises less.
enum class RefitOthers { kNever, kWhereGapIsLeft, kAlways };

/// One look at a fitted model: what may be missing beside `effects`, scored, the promising ones
/// refitted; the most promising first. Throws Interrupted.
std::vector<Explanation> look(DiagnosisState& state, const FittedModel& model,
                              const std::vector<std::string>& effects,
                              RefitOthers others = RefitOthers::kWhereGapIsLeft);

}  // namespace catena
