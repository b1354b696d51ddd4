// SPDX-License-Identifier: BSD-3-Clause
//
// The differentials of several directions at once, one an element: a type D for tangents, which are
// linear in it. What does not depend on the direction is computed once, in T = double; every element
// gets the bits that its direction gets alone.
#pragma once

#include "batch.hpp"
#include "catena_model.h"
#include "scalar.hpp"

namespace catena {

using Directions = Batch<CATENA_DIRECTIONS>;

inline const Directions* directions(const double* values) {
  return reinterpret_cast<const Directions*>(values);
}
inline Directions* directions(double* values) { return reinterpret_cast<Directions*>(values); }

/// The arrays of `along` hold CATENA_DIRECTIONS numbers for each entry.
inline Point<Directions> directions(const catena_point* along) {
  return {Directions(along->t), directions(along->q), directions(along->v), directions(along->a),
          directions(along->z), directions(along->u), directions(along->p)};
}

}  // namespace catena
