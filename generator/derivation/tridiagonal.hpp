// SPDX-License-Identifier: GPL-3.0-or-later
//
// The joints' own matrices: K, the derivative of the elastic forces by the angles, and C, that of
// the friction by their rates (4.12), (4.13).
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "generator/derivation/chain.hpp"

namespace catena {

/// Whether the derivative of the chain's residual by `variables` (its coordinates or its rates) is
/// proved, entry by entry, to be symmetric, tridiagonal and made of stiffnesses and dampings alone.
/// `chain`: one that has the elastic or the friction term alone.
bool is_constant_tridiagonal(Chain& chain, const std::vector<GiNaC::ex>& variables);

}  // namespace catena
