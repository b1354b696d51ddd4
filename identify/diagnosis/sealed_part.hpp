// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

// What is held out takes part in choosing effects, so a model that was chosen leaves less there than
// it leaves elsewhere. The sealed part takes part in nothing: what is left there is printed, and no
// more.

/// Seals the last third of what each recording of the case holds out, if the rest of that is enough to
/// choose by. Recordings cut into windows have no sealed part: the start of a window that is held out is
/// found from what the window holds.
void seal_last_part(Case& the_case, DiagnosisContext& context);

/// Root mean square of what a model leaves in the sealed parts, m or rad; NaN without any.
double sealed_rms(const FittedModel& model);

/// The problem with nothing sealed, to be shown and written; its experiments still say what was.
Problem with_opened_seals(const Problem& problem);

}  // namespace catena
