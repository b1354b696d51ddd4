// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// An effect may help only together with more links: a damped pivot holds a whole link. Tries the best
/// explanations of the last look with twice the links. Enters links and effect if that is acceptable; whether
/// it was.
bool add_with_more_links(DiagnosisState& state);

/// What was added last may have won because the right effect needs more links than there are. Tries
/// the other explanations of that look with twice the links. Enters the best if it is decidedly
/// better.
void try_others_with_more_links(DiagnosisState& state);

/// More links may have taken what an effect explains better. With the effects in place, goes back to
/// a smaller number of links that was there before, if that leaves less and opens no gap.
void go_back_to_fewer_links(DiagnosisState& state);

}  // namespace catena
