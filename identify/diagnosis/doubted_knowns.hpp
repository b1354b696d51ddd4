// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/problem/experiment.hpp"

namespace catena {

/// The candidate that is the length of the cable, `cable.length`.
inline constexpr const char* kCableKnowns = "cable";

/// What a case states and may have wrong, as candidates with priors (PlausibleErrors): where the markers sit
/// along the cable (marker_places.hpp), one amplitude for each marker at an arc length, and how long the
/// cable is. Excluded are: what the case sets by a parameter of its own, what it calls impossible, and the
/// length of links that are given one by one or seen by angles only. Empty where the case does not ask for
/// least squares: other measures weigh no prior against the noise.
std::vector<Candidate> doubted_knowns(const Case& the_case,
                                      const std::vector<Experiment>& experiments);

}  // namespace catena
