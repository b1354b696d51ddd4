// SPDX-License-Identifier: BSD-3-Clause
//
// What emitted models need of a scalar type T: + - * /, construction from int and double, and sin,
// cos, sqrt ... found in namespace catena or by argument-dependent look-up; multiply_add and
// negative_multiply_add of its own, if it has one operation for them. double, long double,
// automatic differentiation and SIMD types will do.
#pragma once

#include <cmath>

#include "multiply_add.hpp"
#include "sine_cosine.hpp"

/// Before a loop of a few steps: writes them out, so that small arrays become registers.
#define CATENA_UNROLLED _Pragma("GCC unroll 8")

namespace catena {

/// In the place of a number of links that is known only when the program runs.
inline constexpr int kAtRunTime = -1;

using std::acos;
using std::asin;
using std::asinh;
using std::atan;
using std::cos;
using std::cosh;
using std::exp;
using std::log;
using std::sin;
using std::sinh;
using std::sqrt;
using std::tan;
using std::tanh;

/// An array whose first entry has the index 1, as links and joints are counted.
template <class T>
class FromOne {
 public:
  explicit FromOne(const T* first) : first_(first) {}
  const T& operator[](int i) const { return first_[i - 1]; }

 private:
  const T* first_;
};

/// State, parameters and time at which a model is evaluated; see catena_model.h.
template <class T>
struct Point {
  T t;
  const T *q, *v, *a, *z, *u, *p;
};

template <class T, class Numerator, class Denominator>
constexpr T ratio(Numerator numerator, Denominator denominator) {
  return T(numerator) / T(denominator);
}

template <class T>
inline void sine_cosine(const T& angle, T& sine, T& cosine) {
  sine = sin(angle);
  cosine = cos(angle);
}

/// Sines and cosines of n angles.
template <class T>
inline void sines_and_cosines(int n, const T* angle, T* sine, T* cosine) {
  for (int i = 0; i < n; ++i) sine_cosine(angle[i], sine[i], cosine[i]);
}
template <int n, class T>
inline void sines_and_cosines(const T* angle, T* sine, T* cosine) {
  sines_and_cosines(n, angle, sine, cosine);
}

/// Whether a pivot of a positive definite matrix may be divided by; false for NaN.
template <class T>
inline bool positive_pivot(const T& pivot) {
  return pivot > T(0);
}

/// Whether a pivot of a general matrix may be divided by; false for NaN.
template <class T>
inline bool usable_pivot(const T& pivot) {
  return pivot > T(0) || pivot < T(0);
}

}  // namespace catena
