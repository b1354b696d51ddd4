// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "generator/derivation/definitions.hpp"

namespace catena {

/// Number of operations (additions, multiplications, divisions, functions) of the expressions if
/// every definition were written out where it is used: the cost of the equations before sharing. A
/// double, since the number may exceed every integer type.
double operations_written_out(const Definitions& definitions, const std::vector<GiNaC::ex>& values);

}  // namespace catena
