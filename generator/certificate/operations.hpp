// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "generator/derivation/definitions.hpp"

namespace catena {

/// Operations (additions, multiplications, divisions, functions) that the expressions would take if
/// every definition were written out where it is used: what the equations cost before sharing.
/// Counted in double, as it grows beyond any integer.
double operations_written_out(const Definitions& definitions, const std::vector<GiNaC::ex>& values);

}  // namespace catena
