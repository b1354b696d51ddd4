// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/problem/experiment.hpp"

namespace catena {

/// Markers that sit elsewhere along the cable than the case says, as a candidate: one amplitude for each marker at an arc
/// length, with a prior (PlausibleErrors). Those whose place the case sets itself stay as they are. Nothing where no marker
/// is left or the case calls it impossible.
std::optional<Candidate> places_of_markers(const Case& the_case,
                                           const std::vector<Experiment>& experiments);

}  // namespace catena
