// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// A diagnosis needs data that no fit has seen: the end of every recording, where the case holds
/// nothing out. Says so in `notes`.
void hold_out(Case& the_case, DiagnosisContext& context, std::vector<std::string>& notes);

/// The case with tolerances no finer than a search needs: what is sought stands out from the noise
/// of a camera. The final model is fitted as the case asks.
Case for_the_search(Case the_case);

/// Throws InputError "the diagnosis needs more than 3 hours; ..." where the fits of the baseline alone
/// take longer than what is begun unasked, unless context.provider.large_work. `problem`: with the
/// case's own model. Every look at candidates takes longer.
void require_yes_for_diagnosis(const Problem& problem, const DiagnosisContext& context);

/// The case's own model fitted, from several starts; with growing windows where the case asks for them or
/// where the motion is lost without. Throws std::runtime_error where none of them
/// could be simulated; Interrupted.
FittedModel fit_baseline(Case the_case, DiagnosisContext& context);

}  // namespace catena
