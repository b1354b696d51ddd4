// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "description/effect.hpp"

namespace catena {

/// What can be said against an effect as a whole, before its expressions are parsed: it does
/// nothing; a name stands in no expression; an energy depends on what would make it change
/// uncounted (time, or states; rates in a potential). Throws InputError.
void check_consistency(const Effect& effect);

}  // namespace catena
