// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/forces/missing_force.hpp"

namespace catena {

/// Adds the words that say what was found.
void describe(MissingForce& missing);

}  // namespace catena
