// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/forces/chain_measures.hpp"
#include "identify/forces/force_pattern.hpp"

namespace catena {

/// Places along the cable around which forces act, and at which one alone is tried.
inline constexpr int kForcePlaces = 10;

/// Forces along the whole chain. To the side and down, and in space across: a constant density, one linear along the
/// cable, one around each of `kForcePlaces` places, and a force at the end. A torque at the support, in space about
/// each axis.
/// Each is a group of its own, so that the evidence leaves out those that the recordings do not ask
/// for. With one variance for all of them forces near the support, which positions hardly show, follow
/// the noise and spoil the lowest modes: docs/diagnosis.md. References: MacKay, Neural Computation 4
/// (1992) 415; Tipping, J. Machine Learning Research 1 (2001) 211.
std::vector<ForcePattern> forces_everywhere(const ChainMeasures& chain);

}  // namespace catena
