// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/forces/force_law.hpp"

namespace catena {

/// A law as the TOML text of an effect (docs/effects.md). It belongs to no number of links: its
/// parameter `place` is an arc length, and the link that holds it does the force. At the end of the
/// cable it acts on the load, at 0 on the pivot, and there is no `place`.
/// `law`: found. `arc_length`: of its place, m, 0 for the torque. `length`: of the cable, m.
std::string effect_of(const ForceLaw& law, const std::string& id, double arc_length, double length);

/// Name of the parameter.
inline constexpr const char* kLawPlace = "place";

}  // namespace catena
