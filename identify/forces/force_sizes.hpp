// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/forces/chain_measures.hpp"
#include "identify/forces/force_pattern.hpp"

namespace catena {

/// Prior variances of forces of no known form, by groups of patterns, in the squares of their units: where
/// the search of the largest evidence begins, a hundredth of the weight, and which it does not exceed
/// (MissingForceThresholds::weights). The weight is that of cable and load together for a force at a place;
/// this over the cable's length for a density; for a moment that below its joint, times the length below:
/// what the weight does about the joint where the cable is held out level. What pushes in a laboratory does
/// not depend on gravity, so the weight is that at standard gravity where the case has less.
std::vector<double> first_variances(const std::vector<ForcePattern>& patterns,
                                    const ChainMeasures& chain);
std::vector<double> largest_variances(const std::vector<ForcePattern>& patterns,
                                      const ChainMeasures& chain);

}  // namespace catena
