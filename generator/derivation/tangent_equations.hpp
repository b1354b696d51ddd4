// SPDX-License-Identifier: GPL-3.0-or-later
//
// The equations of motion in space by two tangents of each link. With e = q / |q|, E (3 x 2) two vectors of
// length one that are perpendicular to each other and to e, f the generalised force of e and g that of |q|^2,
//
//     r = (1 - e e') f / |q| + 2 g' q,      e'' = E x - (e'.e') e,
//     q'' = |q| E x + 2 (e.q') e' - e (q'.q') / |q|,
//
// where g' is g less what f gives it, and is zero where d^2|q|^2/dt^2 is. So r = 0 says of x
//
//     E' f = 0,     f = F e'' + ...
//
// Its matrix is E' F E: blocks of 2 x 2 in the place of blocks of 3 x 3 whose product with q is known. F is found
// and proved by structure.hpp; what is said here of r is proved link by link.
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
  /// [i][k][axis]: component of tangent k of link i. Other lists have one entry where a place is not named.
  Quasiseparable::Entries tangent;
  Quasiseparable::Entries size;   ///< [i][0][0]: |q|
  Quasiseparable::Entries along;  ///< [i][0][0]: e' M e, the inertia of q along itself
  /// Whether F_ij = (a number of i) (a number of j) 1 for j < i, and F_ii = (a number) 1. These are in [i][0][0].
  bool isotropic = false;
  Quasiseparable::Entries number_of_row, number_of_column, number_of_diagonal;
  Quasiseparable::Entries force;         ///< [i][k][0]: E' f where x = 0
  Quasiseparable::Entries acceleration;  ///< [i][axis][0]: q'' where x = 0
};

/// Of a chain in space without coordinates beyond those of the links. `prefix` starts the names of the families
/// it defines.
TangentEquations find_tangent_equations(Chain& chain, const std::string& prefix);

}  // namespace catena
