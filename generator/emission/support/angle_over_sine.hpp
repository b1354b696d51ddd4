// SPDX-License-Identifier: BSD-3-Clause
//
// What models in space need: unit vectors, and the angle between two of them as a function of its
// cosine c. The angle has a kink at c = 1, where the two are one; its square, the angle over its sine and
// the slope of that are smooth there. All grow without bound at c = -1 but the square.
#pragma once

#include "batch.hpp"
#include "scalar.hpp"

namespace catena {

template <class T>
inline T inverse_square_root(const T& x) {
  return T(1) / sqrt(x);
}

/// Below it 1 - c is small: sums of powers of it, as many as double precision has use for.
inline constexpr int kTermsOfAngle = 12, kTermsOfSlope = 16;
template <class T>
inline bool is_small_angle(const T& rest) {
  return rest < ratio<T>(1, 64);
}

/// The square of the angle, rad^2.
template <class T>
inline T squared_angle(const T& cosine) {
  const T rest = T(1) - cosine;
  if (!is_small_angle(rest)) {
    const T angle = acos(cosine);
    return angle * angle;
  }
  T sum = T(1);
  CATENA_UNROLLED
  for (int k = kTermsOfAngle; k > 0; --k)
    sum = multiply_add(ratio<T>(k * k, (k + 1) * (2 * k + 1)) * rest, sum, T(1));
  return T(2) * rest * sum;
}

/// The angle over its sine; minus half the derivative of squared_angle by the cosine.
template <class T>
inline T angle_over_sine(const T& cosine) {
  const T rest = T(1) - cosine;
  if (!is_small_angle(rest)) return acos(cosine) / sqrt(rest * (T(1) + cosine));
  T sum = T(1);
  CATENA_UNROLLED
  for (int k = kTermsOfAngle; k > 0; --k)
    sum = multiply_add(ratio<T>(k, 2 * k + 1) * rest, sum, T(1));
  return sum;
}

/// The derivative of angle_over_sine by the cosine, (c b / sin b - 1) / sin^2 b, which loses more digits
/// near c = 1.
template <class T>
inline T angle_over_sine_slope(const T& cosine) {
  const T rest = T(1) - cosine;
  if (!(rest < ratio<T>(1, 8)))
    return (cosine * angle_over_sine(cosine) - T(1)) / (rest * (T(1) + cosine));
  T sum = T(1);
  CATENA_UNROLLED
  for (int k = kTermsOfSlope; k > 0; --k)
    sum = multiply_add(ratio<T>((k + 1) * (k + 1), k * (2 * k + 3)) * rest, sum, T(1));
  return ratio<T>(-1, 3) * sum;
}

#ifdef __GNUC__
// Branches: element by element.
#define CATENA_ELEMENTWISE(function)                                  \
  template <int count>                                                \
  inline Batch<count> function(const Batch<count>& x) {               \
    Batch<count> y;                                                   \
    for (int k = 0; k < count; ++k) y.set(k, function(double(x[k]))); \
    return y;                                                         \
  }
CATENA_ELEMENTWISE(squared_angle)
CATENA_ELEMENTWISE(angle_over_sine)
CATENA_ELEMENTWISE(angle_over_sine_slope)
#undef CATENA_ELEMENTWISE
#endif

}  // namespace catena
