// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/forces/force_law.hpp"

namespace catena {

/// A law as the TOML text of an effect (docs/effects.md). It belongs to no number of links: a law of
/// one place has its arc length as the parameter `place`, and the link that holds it does the force.
/// At the end of the cable it acts on the load, without `place`. A law of a joint acts in the joint
/// nearest to the constant `place`, that of the support on the pivot.
/// `law`: found. `length`: of the cable, m.
std::string effect_of(const ForceLaw& law, const std::string& id, double length);

/// Name of the parameter.
inline constexpr const char* kLawPlace = "place";
inline constexpr const char* kLawOtherPlace = "other_place";

}  // namespace catena
