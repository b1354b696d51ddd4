// SPDX-License-Identifier: GPL-3.0-or-later
//
// The equations of motion in space by two tangents of each link. With e = q / |q|, E (3 x 2) two vectors of
// length one that are perpendicular to each other and to e, f the generalised force of e and g that of |q|^2,
//
//     r = (1 - e e') f / |q| + 2 g' q,      q'' = E x - e (q'.q') / |q|,
//
// where g' is g less what f gives it, and is zero where d^2|q|^2/dt^2 is. So r = 0 says of x
//
//     E' f / |q| = 0,     f = F e'' + ...,    e'' = E x / |q| + ...
//
// Its matrix is E' F E / |q|^2 from link to link: blocks of 2 x 2 in the place of blocks of 3 x 3 whose
// product with q is known. F is found and proved by structure.hpp; what is said here of r is proved link by link.
//
// No pair of tangents is continuous on the whole sphere. This one [Duff et al. 2017, JCGT 6(1)] jumps where e is
// horizontal; x alone sees it.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/structure.hpp"

namespace catena {

struct TangentEquations {
  /// Symmetric, in blocks of 2; `reason` if not found.
  Quasiseparable mass;
  /// [i][k][axis]: component of tangent k of link i. The other lists have one entry where `axis` has none.
  Quasiseparable::Entries tangent;
  Quasiseparable::Entries along;  ///< [i][0][0]: e' M e, the inertia of q along itself
  Quasiseparable::Entries force;  ///< [i][k][0]: E' r
  Quasiseparable::Entries
      acceleration;  ///< [i][axis][0]: what is along q of q'', if that depends on no q''
};

/// Of a chain in space without coordinates beyond those of the links. `prefix` starts the names of the families
/// it defines.
TangentEquations find_tangent_equations(Chain& chain, const std::string& prefix);

}  // namespace catena
