// SPDX-License-Identifier: BSD-3-Clause
//
// A product and a sum in one operation. For double, and vectors of it, the result is rounded once
// (IEEE 754's fusedMultiplyAdd), so that every processor gives the same bits; x86-64 has an
// instruction for it since 2013 (-march=x86-64-v3), and without one the C library computes it, much
// slower. Other types round as their product and sum do.
#pragma once

#include <cmath>

namespace catena {

/// a b + c
inline double multiply_add(const double& a, const double& b, const double& c) {
  return std::fma(a, b, c);
}
template <class A, class T>
inline T multiply_add(const A& a, const T& b, const T& c) {
  return a * b + c;
}

/// c - a b
inline double negative_multiply_add(const double& a, const double& b, const double& c) {
  return std::fma(-a, b, c);
}
template <class A, class T>
inline T negative_multiply_add(const A& a, const T& b, const T& c) {
  return c - a * b;
}

}  // namespace catena
