// SPDX-License-Identifier: GPL-3.0-or-later
//
// Small motions of a model with effects about its equilibrium. The effects are not at their neutral
// values.
//
// From the emitted code: the eigenvalues of its mass matrix and of dr/dq at the point where its
// residual vanishes with v = a = 0 (Newton's method from the straight chain). The comparison uses
// neither Euler-Lagrange nor a derivative by the generator. It takes the energies E and the power P
// that leaves the chain (dissipated minus supplied) at the same point, in 70 digits:
//
//     M_ij = E(e_i + e_j) - E(e_i) - E(e_j) + E(0)        E at velocities, quadratic in them
//     K_ij = d2E/dq_i dq_j + d2P/dv_i dq_j at v = 0       central differences, step 1e-18
//
// The second term comes from forces without a potential: P = -Q.v. Extra states and signals are
// zero and constant. A chain with a moving support has no equilibrium, so effects that move the
// support stay at their neutral values.
#pragma once

#include <string>

#include "description/description.hpp"
#include "generated/catena_model.h"

namespace catena {

struct RestFrequencies {
  std::string why_not;             ///< why there is nothing to compare; else empty
  double lowest = 0, highest = 0;  ///< rad/s; square roots of the eigenvalues' sizes
  double largest_difference = 0;   ///< of an eigenvalue, relative
};

/// `table` is the compiled model of `description` with `links` links. Parameters of effects have
/// their defaults or, where these are neutral, seeded random values. The chain is that of
/// natural_frequencies (twin.hpp).
RestFrequencies rest_frequencies(const Description& description, int links,
                                 const catena_model& table, unsigned seed);

}  // namespace catena
