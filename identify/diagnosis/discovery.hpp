// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// Where a concluded diagnosis leaves a gap (`unexplained`, `partly`): estimates the force that is
/// missing. Where it follows a law (docs/discovery.md), the law is written as an effect into the
/// context's folder, derived, compiled and fitted. It is taken if it would be acceptable as an
/// effect of the library and either closes the gap or is certain beside what is left; the verdict is
/// then `discovered`. Where effects were found, the same is tried without them first: a law that
/// predicts the held-out part better than they do, beyond chance, takes their place. Else all stays
/// as concluded, and a note says why. In the plane the same is tried with more links where these would change the motion by
/// more than the noise. With `DiagnosisOptions::discover` all this is done where no gap
/// is left, too. Formulas that the search did not tell from the law are fitted in its place. One of them
/// becomes the law where the data decide for it, or where the law is a curve and they do not decide against the
/// formula. Of the others, those that the data do not decide against become alternatives. `asked`: as for
/// conclude(). Throws as conclude(), and Interrupted.
void discover(DiagnosisState& state, const Case& asked);

/// Puts a formula that was fitted in the place of the law `found.law`, whose model is `law`, where the report looks
/// for it: among the alternatives where the data do not decide against it, which is then true, else among the
/// runners-up.
bool sort_rival(Diagnosis& found, const FittedModel& law, Explanation rival);

}  // namespace catena
