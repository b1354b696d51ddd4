// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/candidate_search.hpp"
#include "identify/diagnosis/explanation.hpp"

namespace catena {

/// Adds explanations to the base for real, and fits everything again, on several threads. An
/// explanation keeps the best of its fits: from its start and, if `far`, from a quarter of it and
/// from its other start. The best that leave a gap are tried from three times the amplitudes found,
/// and from a third of them. Where the search was stopped, some are left as they were.

/// The `count` most promising admissible ones.
void refit_best(const CandidateSearch& search, std::vector<Explanation>& explanations, int count,
                bool far);
/// All admissible ones that were not refitted yet, from their starts.
void refit_rest(const CandidateSearch& search, std::vector<Explanation>& explanations);

}  // namespace catena
