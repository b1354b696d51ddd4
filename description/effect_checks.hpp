// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>

#include "description/effect.hpp"

namespace catena {

/// All names in the expressions of an effect, without those of functions.
std::set<std::string> names_in(const Effect& effect);

/// Checks an effect as a whole. Throws InputError if the effect does nothing, if a name is in no
/// expression, or if an energy depends on time or states, or a potential on rates: their work would
/// be missing in the energy balance.
void check_consistency(const Effect& effect);

}  // namespace catena
