// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "identify/diagnosis/candidate.hpp"
#include "runtime/model.hpp"

namespace catena {

/// Candidates that are the same model of this chain: on one link, dry friction of the pivot and of
/// all joints, or drag of the load and a moment by the squared rate. Two are, if changes of the
/// residual r by their amplitudes span the same space at random states (seeded). No data can tell
/// them apart, so they are one candidate, under the name of one of them: not another form of an
/// effect (`form_of`), then of the fewest amplitudes that do anything, then of the first place in
/// the order load, links, pivot, joints (the surroundings before a law of the joints, one joint
/// before all), then by name. `all`: a model with every candidate that can share one.
///
/// Returns the name for each candidate that goes by another one's.
std::map<std::string, std::string> names_of_same_models(const std::vector<Candidate>& library,
                                                        const Model& all);

}  // namespace catena
