// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "identify/forces/chain_measures.hpp"
#include "identify/forces/force_path.hpp"
#include "identify/forces/missing_force.hpp"

namespace catena {

/// s. Forces along the whole chain are shown as means over so much before and after each time, with the weights of a
/// raised cosine, which halve an oscillation of 2 Hz. Of faster ones markers show next to nothing, so that a
/// deviation of the force at one instant is that of the prior.
inline constexpr double kMeanReach = 0.25;

/// The most nodes after the first one of such a mean: what their deviations need (smooth_forces).
Eigen::Index nodes_of_mean(const std::vector<double>& times);

/// Forces of the path `number` over time, with standard deviations. `densities`: the patterns are
/// forces along the whole chain, and `smoothed` has the covariances of their means; else those of a single place.
MissingForce::History force_history(const ForcePaths& paths, std::size_t number,
                                    const Problem& problem, const Smoothed& smoothed,
                                    const ChainMeasures& chain, bool densities);

}  // namespace catena
