// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/candidate.hpp"
#include "identify/problem/experiment.hpp"
#include "runtime/model.hpp"

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

/// The parameters of the model that the case calls doubtful (DiagnosisSpec::doubtful), each a candidate by itself whose
/// neutral value is its default. Throws InputError for one that the model lacks or that has no default, and for one
/// that the case sets.
std::vector<Candidate> doubtful_parameters(const Case& the_case, const Model& model);

}  // namespace catena
