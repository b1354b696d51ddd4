// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace truth {

/// A vector in the plane.
struct Vector {
  double side = 0, down = 0;
};

inline Vector operator+(Vector a, Vector b) { return {a.side + b.side, a.down + b.down}; }
inline Vector operator-(Vector a, Vector b) { return {a.side - b.side, a.down - b.down}; }
inline Vector operator*(double s, Vector a) { return {s * a.side, s * a.down}; }
inline double dot(Vector a, Vector b) { return a.side * b.side + a.down * b.down; }
inline double norm(Vector a) { return std::sqrt(dot(a, a)); }

/// The unit vector at an angle from the downward vertical, and the one across it.
inline Vector along(double angle) { return {std::sin(angle), std::cos(angle)}; }
inline Vector across(double angle) { return {std::cos(angle), -std::sin(angle)}; }

}  // namespace truth
