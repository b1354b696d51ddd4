// SPDX-License-Identifier: GPL-3.0-or-later
//
// Accuracy of an emitted model: every function of its table, in double precision at seeded random
// points, is compared with the derivation, evaluated at the same points with 50 digits.
//
// Errors are in units of rounding: 2.2e-16 times a size that depends on the function.
//   residual, bias, residual_tangent   the largest sum of the sizes of r's terms over its rows
//   mass_matrix                        its largest entry
//   acceleration                       backward: |r(a)| over the same size, a the one returned
//   newton_solve                       backward: |N x - b| over |N| |x|; its transpose likewise;
//                                      the step so short that elimination needs no row exchanges; with a
//                                      constraint |N| is times the growth of M's entries in elimination
//   state_rate                         the largest rate, one, and the derivative by time, times time: a phase
//                                      that is rounded is time that is rounded
//   residual_adjoint                   along a direction, over the sizes of what is added up there
//   energy                             for each stored energy the sum of the sizes of its parts
//   power                              the sum of the sizes of all powers, v.r included
//   positions, velocities              the length (speed) summed along the chain
//   internal_forces, reactions         the largest force, moment and curvature; forces with what they
//                                      are sums of
//   gap                                as positions and velocities
//   event_values                       its own size and slope
//   their tangents                     the same, plus the size of the derivative
//   power balance                      d(stored)/dt + dissipated - supplied = v.r, over the powers
// Derivatives are compared with central differences of the 50-digit values, step 1e-18.
#pragma once

#include <string>
#include <vector>

#include "description/description.hpp"
#include "generated/catena_model.h"

namespace catena {

struct FunctionAccuracy {
  std::string function;  ///< as the table names it
  double worst = 0;      ///< units of rounding; NaN if a value is not finite
};

/// `table` is the compiled model of `description` with `links` links. The same seed gives the same
/// points on every machine.
std::vector<FunctionAccuracy> measure_accuracy(const Description& description, int links,
                                               const catena_model& table, int points,
                                               unsigned seed);

}  // namespace catena
