// SPDX-License-Identifier: GPL-3.0-or-later
//
// The stiffness matrix K, the derivative of the elastic moments by the angles, and the damping
// matrix C, that of the damping moments by the rates (4.11).
#pragma once

#include <ginac/ginac.h>

#include <vector>

#include "generator/derivation/chain.hpp"

namespace catena {

/// Whether the derivative of the residual of `chain` by `variables` (its coordinates or its rates)
/// is proved, entry by entry, to be symmetric, tridiagonal and a function of stiffnesses and
/// dampings only. `chain` must have only the elastic or only the friction term.
bool is_constant_tridiagonal(Chain& chain, const std::vector<GiNaC::ex>& variables);

}  // namespace catena
