// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/effect.hpp"

namespace catena {

/// Checks an effect as a whole. Throws InputError if the effect does nothing, if a name is in no
/// expression, or if an energy depends on time or states, or a potential on rates: their work would
/// be missing in the energy balance.
void check_consistency(const Effect& effect);

}  // namespace catena
