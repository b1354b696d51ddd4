// SPDX-License-Identifier: GPL-3.0-or-later
//
// Finds and proves the structure of the matrices of a chain, from its definitions.
//
// A perturbation of the links, delta q_j = wq u_j, delta v_j = wv u_j, delta a_j = wa u_j, changes
// the residual by N u, N = wa dr/da + wv dr/dv + wq dr/dq. Definitions that use themselves at the
// link above (positions and their rates) carry the change down the chain. Definitions that use
// themselves at the link below (cut forces) carry it up. If each of them carries it unchanged, as
// sums do,
//
//     delta X_i = delta X_{i-1} + B_i u_i + B'_i u_{i-1}
//     delta Y_i = delta Y_{i+1} + F_i delta X_{i-1} + G_i u_i + G'_i u_{i-1} + G"_i u_{i+1}
//     delta r_i = Hy_i delta Y_{i+1} + Hx_i delta X_{i-1} + D_i u_i + e_i u_{i-1} + f_i u_{i+1},
//
// then, with S_i = sum_{k >= i} F_k,
//
//     N_ij = Hy_i (G_j + G'_{j+1} + G"_{j-1} + S_{j+1} B_j + S_{j+2} B'_{j+1})           j > i + 1
//     N_ii = D_i + Hy_i (S_{i+1} B_i + S_{i+2} B'_{i+1} + G'_{i+1})
//     N_ij = (Hx_i + Hy_i S_{i+1}) (B_j + B'_{j+1})                                      j < i - 1
//
// and e_i - Hx_i B'_i, f_i - Hy_i G"_i are added to the same on the two neighbouring diagonals: N is tridiagonal plus
// semiseparable. What is carried depends on the neighbouring links only by rest angles in space.
// Whether the definitions have this form is decided exactly, coefficient by coefficient, for each
// link. In space u_i has three components, and what has the index i above are blocks.
//
// Coordinates s of no link, those of the load and of the constraint of a held end, border N by their columns
// and rows, one each. The load and the end are functions of what is carried down to the end, so rows are Hx of
// the equation of s times the B_j; nothing that is carried down depends on s, so columns are derivatives along
// s; the corner where both meet is the derivative of the equations of s along s.
//
// A force along the line between two places of the chain acts on all links between and changes with all of them:
// each of its components F adds to N the product of a column, dr_i/dF, and a row, the change of F by u_j, which
// is found as the row of a coordinate of no link is.
//
// Extra states of joints have rates f(q, v, z); the rate of a state must not depend on another state. In an
// implicit step they change by delta z = wv (df/dv delta v + df/dq delta q) / (1 - wv df/dz), wa =
// 1. They are eliminated, and N is the rest. The state of torsion is in no rate, and its own rate is a sum over
// links. Its elimination adds to N the product of a column, dr/dz, and a row, wv times the change of
// the rate. Such products are one column more in each triangle, and the diagonal.
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "generator/derivation/chain.hpp"
#include "generator/derivation/linearisation.hpp"

namespace catena {

/// N = T + (upper part of U V') + (lower part of P Q'), T tridiagonal; links are counted from 1. In space
/// each entry is a block of 3 x 3, for the components of the vectors along two links.
struct Quasiseparable {
  bool found = false;
  std::string reason;      ///< why it was not found
  bool symmetric = false;  ///< proved: P = V, Q = U, e = f
  int block = 1, upper_rank = 0, lower_rank = 0;
  /// [i][a][r] or [i][a][b]: i = 1..links (entry 0 unused), a and b = 0..block-1 are components
  using Entries = std::vector<std::vector<std::vector<GiNaC::ex>>>;
  Entries upper_row, upper_column, lower_row, lower_column;
  Entries diagonal, below, above;  ///< T_{i,i} with all of N_ii; e_i; f_i
  int border = 0;                  ///< rows and columns of coordinates of no link, beyond N
  Entries border_column,
      border_row;  ///< [i][a][k]: of residual a of link i by s_k, and of equation k by link i
  std::vector<std::vector<GiNaC::ex>> corner;  ///< [k][l]: of equation k by s_l
};

/// `prefix` starts the names of the families it defines.
Quasiseparable find_structure(Chain& chain, const Weights& weights, const std::string& prefix,
                              Moving moving = Moving::kCoordinates);

}  // namespace catena
