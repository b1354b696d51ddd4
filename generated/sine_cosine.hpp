// SPDX-License-Identifier: BSD-3-Clause
//
// Sine and cosine of one angle together, without branches, tables or library calls: every number of
// elements gives the same bits (compile with -ffp-contract=off).
//
// x = k pi/2 + r, |r| <= pi/4, with pi/2 in four parts and what r lost by rounding carried along in
// `rest` (Cody and Waite); the polynomials in r^2 interpolate (sin r / r - 1) / r^2 and (cos r - 1
// + r^2/2) / r^4 at Chebyshev nodes, and are summed in pairs so that few steps wait for one
// another. The error is below 0.9 units in the last place up to |x| = 1.6e6; beyond that it grows
// as if x had been rounded. From 2^31 rad the result is NaN, as it is for infinities and NaN.
#pragma once

#include <cstdint>

#include "multiply_add.hpp"

namespace catena {

/// sin r and cos r, and `shifted`, which has k in its low bits. T: double or several (batch.hpp).
template <class T>
inline void sine_cosine_reduced(const T& x, T& sine, T& cosine, T& shifted) {
  const T two_over_pi(0x1.45f306dc9c883p-1);
  const T half_pi_1(0x1.921fb544p0);  // 33 bits: exact times any k below 2^20
  const T half_pi_2(0x1.0b4611a6p-34);
  const T half_pi_3(0x1.3198a2e037073p-69);
  const T half_pi_4(0x1.129024e088a68p-123);
  const T round_to_integer(0x1.8p52);
  const T one(1), half(0.5);

  shifted = multiply_add(x, two_over_pi, round_to_integer);
  const T k = shifted - round_to_integer;
  const T too_large = x * T(0x1p993);  // infinite from 2^31
  const T part_1 = negative_multiply_add(k, half_pi_1, x) - (too_large - too_large);
  const T part_2 = negative_multiply_add(k, half_pi_2, part_1);
  const T product_3 = k * half_pi_3;
  const T r = part_2 - product_3;
  const T lost_2 = negative_multiply_add(k, half_pi_2, part_1 - part_2);
  const T lost_3 = ((part_2 - r) - product_3) + lost_2;
  const T rest = lost_3 - multiply_add(k, half_pi_4, multiply_add(k, half_pi_3, -product_3));

  const T z = r * r, z2 = z * z;
  const T one_less = negative_multiply_add(half, z, one);
  const T sine_low = multiply_add(z, T(0.008333333333330936), T(-0.16666666666666666));
  const T sine_middle = multiply_add(z, T(2.7557316093198404e-06), T(-0.00019841269836740532));
  const T sine_high = multiply_add(z, T(1.5917988979397432e-10), T(-2.5051129896450185e-08));
  const T sine_tail = multiply_add(z2, multiply_add(z2, sine_high, sine_middle), sine_low);
  sine = r + multiply_add(z * r, sine_tail, rest * one_less);
  const T cosine_low = multiply_add(z, T(-0.0013888888888887389), T(0.041666666666666664));
  const T cosine_middle = multiply_add(z, T(-2.755731726587808e-07), T(2.48015872987544e-05));
  const T cosine_high = multiply_add(z, T(-1.138254464534925e-11), T(2.087614504941318e-09));
  const T cosine_tail = multiply_add(z2, multiply_add(z2, cosine_high, cosine_middle), cosine_low);
  const T one_rest = negative_multiply_add(half, z, one - one_less);
  cosine = one_less + multiply_add(z2, cosine_tail, negative_multiply_add(r, rest, one_rest));
}

/// (sine, cosine) turned by k mod 4 quarters. Bits: std::uint64_t or a vector of as many. (Not
/// std::bit_cast, which would return a vector from a function, of which compilers warn.)
template <class Real, class Bits>
inline void turn_by_quarters(const Real& shifted, Real& sine, Real& cosine) {
  const Bits quarter = __builtin_bit_cast(Bits, shifted);
  const Bits swap = -(quarter & 1);
  const Bits s = __builtin_bit_cast(Bits, sine), c = __builtin_bit_cast(Bits, cosine);
  const Bits exchanged = (s ^ c) & swap;
  sine = __builtin_bit_cast(Real, (s ^ exchanged) ^ ((quarter & 2) << 62));
  cosine = __builtin_bit_cast(Real, (c ^ exchanged) ^ (((quarter + 1) & 2) << 62));
}

inline void sine_cosine(const double& x, double& sine, double& cosine) {
  double shifted;
  sine_cosine_reduced(x, sine, cosine, shifted);
  turn_by_quarters<double, std::uint64_t>(shifted, sine, cosine);
}

}  // namespace catena
