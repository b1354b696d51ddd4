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

/// -1 of what is negative, else 1.
template <class T>
inline T sign_or_one(const T& x) {
  return x < T(0) ? T(-1) : T(1);
}

/// Below it 1 - c is small: sums of powers of it, as many as double precision has use for.
inline constexpr int kTermsOfAngle = 12, kTermsOfSlope = 16, kTermsOfCurvature = 20;
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

/// The same in double precision, without branches, so that loops over joints become vectors. asin(x)/x is
/// a quotient of polynomials in x^2 <= 1/4 (of fdlibm's e_asin.c, to 2^-58); with x the sine of half the
/// angle, the cosine, or the cosine of half the angle.
inline double angle_over_sine(const double& cosine) {
  constexpr double kPi = 3.14159265358979323846;
  const double below = 0.5 * (1.0 - cosine), above = 0.5 * (1.0 + cosine);
  const bool small = cosine >= 0.5, large = cosine <= -0.5;
  const double middle = cosine * cosine, not_small = large ? above : middle;
  const double square = small ? below : not_small;
  double p = 3.47933107596021167570e-05, q = 7.70381505559019352791e-02;
  p = multiply_add(p, square, 7.91534994289814532176e-04);
  p = multiply_add(p, square, -4.00555345006794114027e-02);
  p = multiply_add(p, square, 2.01212532134862925881e-01);
  p = multiply_add(p, square, -3.25565818622400915405e-01);
  p = multiply_add(p, square, 1.66666666666666657415e-01);
  q = multiply_add(q, square, -6.88283971605453293030e-01);
  q = multiply_add(q, square, 2.02094576023350569471e+00);
  q = multiply_add(q, square, -2.40339491173441421878e+00);
  q = multiply_add(q, square, 1.0);
  const double arcsine = 1.0 + square * p / q;  // over x
  const double root = sqrt(above), other_root = 2.0 * sqrt(below);
  const double large_angle = kPi - 2.0 * (root * arcsine),
               middle_angle = 0.5 * kPi - cosine * arcsine;
  const double angle = large ? large_angle : middle_angle;
  const double numerator = small ? arcsine : angle, factor = small ? 1.0 : other_root;
  return numerator / (root * factor);
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

/// The same in double precision, without branches.
inline double angle_over_sine_slope(const double& cosine) {
  const double rest = 1.0 - cosine;
  double sum = 1.0;
#pragma GCC unroll 16
  for (int k = kTermsOfSlope; k > 0; --k)
    sum = multiply_add(ratio<double>((k + 1) * (k + 1), k * (2 * k + 3)) * rest, sum, 1.0);
  const double far = (cosine * angle_over_sine(cosine) - 1.0) / (rest * (1.0 + cosine));
  const double near = ratio<double>(-1, 3) * sum;
  return rest < 0.125 ? near : far;
}

/// The second derivative of angle_over_sine by the cosine, (3 c slope + angle over sine) / sin^2 b.
template <class T>
inline T angle_over_sine_curvature(const T& cosine) {
  const T rest = T(1) - cosine;
  if (!(rest < ratio<T>(1, 4)))
    return (T(3) * cosine * angle_over_sine_slope(cosine) + angle_over_sine(cosine)) /
           (rest * (T(1) + cosine));
  T sum = T(1);
  CATENA_UNROLLED
  for (int k = kTermsOfCurvature; k > 0; --k)
    sum = multiply_add(ratio<T>((k + 2) * (k + 2), k * (2 * k + 5)) * rest, sum, T(1));
  return ratio<T>(4, 15) * sum;
}

#ifdef __GNUC__
// Element by element.
#define CATENA_ELEMENTWISE(function)                                  \
  template <int count>                                                \
  inline Batch<count> function(const Batch<count>& x) {               \
    Batch<count> y;                                                   \
    for (int k = 0; k < count; ++k) y.set(k, function(double(x[k]))); \
    return y;                                                         \
  }
CATENA_ELEMENTWISE(sign_or_one)
CATENA_ELEMENTWISE(squared_angle)
CATENA_ELEMENTWISE(angle_over_sine)
CATENA_ELEMENTWISE(angle_over_sine_slope)
CATENA_ELEMENTWISE(angle_over_sine_curvature)
#undef CATENA_ELEMENTWISE
#endif

}  // namespace catena
