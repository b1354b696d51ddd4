// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small motions of a model with effects about its rest, effects away from their neutral values.
//
// The emitted side: where the compiled residual vanishes with v = a = 0 (Newton's method, from
// hanging straight), the eigenvalues of its mass matrix and dr/dq. The other side takes neither
// Euler-Lagrange nor a derivative of the generator's: at the same point, from the energies E and
// the power P that leaves (dissipated less supplied) alone, in 70 digits,
//
//     M_ij = E(e_i + e_j) - E(e_i) - E(e_j) + E(0)        E at velocities, quadratic in them
//     K_ij = d2E/dq_i dq_j + d2P/dv_i dq_j at v = 0       central differences, step 1e-18
//
// the second term being what forces without a potential add: P = -Q.v. Extra states and signals are
// zero and held. A moving support has no rest, so effects that move it stay at their neutral
// values.
#pragma once

#include <string>

#include "description/description.hpp"
#include "generated/catena_model.h"

namespace catena {

struct RestFrequencies {
  std::string why_not;             ///< if there is nothing to compare; else empty
  double lowest = 0, highest = 0;  ///< rad/s; square roots of the eigenvalues' sizes
  double largest_difference = 0;   ///< of an eigenvalue, relative
};

/// `table` is the compiled model of the description with so many links. Effect parameters have
/// their defaults where these are not neutral, else seeded values; the chain is that of
/// natural_frequencies (twin.hpp).
RestFrequencies rest_frequencies(const Description& description, int links,
                                 const catena_model& table, unsigned seed);

}  // namespace catena
