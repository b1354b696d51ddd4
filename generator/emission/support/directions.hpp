// SPDX-License-Identifier: BSD-3-Clause
//
// The differentials of several directions at once, one a lane: a type D for tangents, which are linear
// in it. What does not depend on the direction is computed once, in T = double; every lane gets the bits
// that its direction gets alone.
#pragma once

#include "catena_model.h"
#include "scalar.hpp"

namespace catena {

class Directions {
 public:
  typedef double Vector __attribute__((vector_size(CATENA_DIRECTIONS * sizeof(double))));

  Directions() = default;
  // Written out so that a copy is a copy of vectors, not of the bytes of a class.
  Directions(const Directions& other) : lanes_(other.lanes_) {}
  Directions& operator=(const Directions& other) {
    lanes_ = other.lanes_;
    return *this;
  }
  explicit Directions(double value) : lanes_(value - Vector{}) {}
  explicit Directions(int value) : Directions(static_cast<double>(value)) {}

  Directions operator-() const { return Directions(-lanes_); }
  Directions& operator+=(const Directions& b) { return *this = *this + b; }
  Directions& operator-=(const Directions& b) { return *this = *this - b; }
  friend Directions operator+(const Directions& a, const Directions& b) {
    return Directions(a.lanes_ + b.lanes_);
  }
  friend Directions operator-(const Directions& a, const Directions& b) {
    return Directions(a.lanes_ - b.lanes_);
  }
  friend Directions operator*(double a, const Directions& b) { return Directions(a * b.lanes_); }
  friend Directions operator*(const Directions& a, double b) { return Directions(a.lanes_ * b); }
  friend Directions operator/(const Directions& a, double b) { return Directions(a.lanes_ / b); }

 private:
  explicit Directions(const Vector& lanes) : lanes_(lanes) {}

  Vector lanes_;
};

inline const Directions* directions(const double* values) {
  return reinterpret_cast<const Directions*>(values);
}
inline Directions* directions(double* values) { return reinterpret_cast<Directions*>(values); }

/// The arrays of `along` hold CATENA_DIRECTIONS numbers for each entry.
inline Point<Directions> directions(const catena_point* along) {
  return {Directions(along->t),  directions(along->q), directions(along->v), directions(along->a),
          directions(along->z), directions(along->u), directions(along->p)};
}

}  // namespace catena
