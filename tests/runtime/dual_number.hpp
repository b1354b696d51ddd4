// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace catena::testing {

/// value + derivative * e with e^2 = 0: running a template on it gives the exact directional
/// derivative.
struct Dual {
  double value = 0.0;
  double derivative = 0.0;

  Dual() = default;
  Dual(double v, double d = 0.0) : value(v), derivative(d) {}  // NOLINT: a constant is a Dual
};

inline Dual operator+(Dual a, Dual b) { return {a.value + b.value, a.derivative + b.derivative}; }
inline Dual operator-(Dual a, Dual b) { return {a.value - b.value, a.derivative - b.derivative}; }
inline Dual operator-(Dual a) { return {-a.value, -a.derivative}; }
inline Dual operator*(Dual a, Dual b) {
  return {a.value * b.value, a.derivative * b.value + a.value * b.derivative};
}
inline Dual operator/(Dual a, Dual b) {
  const double quotient = a.value / b.value;
  return {quotient, (a.derivative - quotient * b.derivative) / b.value};
}
inline Dual sin(Dual a) { return {std::sin(a.value), std::cos(a.value) * a.derivative}; }
inline Dual cos(Dual a) { return {std::cos(a.value), -std::sin(a.value) * a.derivative}; }

}  // namespace catena::testing
