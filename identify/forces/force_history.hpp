// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "identify/forces/chain_measures.hpp"
#include "identify/forces/force_path.hpp"
#include "identify/forces/missing_force.hpp"

namespace catena {

/// Forces of the path `number` over time, with standard deviations. `densities`: the patterns are
/// forces along the whole chain, else those of a single place.
MissingForce::History force_history(const ForcePaths& paths, std::size_t number,
                                    const Problem& problem, const Smoothed& smoothed,
                                    const ChainMeasures& chain, bool densities);

}  // namespace catena
