// SPDX-License-Identifier: BSD-3-Clause
//
// Sine and cosine of one angle together, without branches, tables or library calls: loops over
// angles vectorise, and every number of lanes gives the same bits (no fused multiply-add: compile
// with -ffp-contract=off).
//
// x = k pi/2 + r, |r| <= pi/4, with pi/2 in three parts and the rounding of r carried along in
// `rest` (Cody and Waite); the polynomials in r^2 interpolate (sin r / r - 1) / r^2 and (cos r - 1
// + r^2/2) / r^4 at Chebyshev nodes, and are summed in pairs so that few steps wait for one
// another. The error is below 0.8 units in the last place up to |x| = 1.6e6; beyond that it grows
// as if x had been rounded. From 2^31 rad the result is NaN, as it is for infinities and NaN.
#pragma once

#include <cstdint>
#include <cstring>

namespace catena {

/// Real: double or a vector of doubles; Bits: std::uint64_t or a vector of as many. (std::bit_cast
/// would return a vector from a function, of which compilers warn.)
template <class Real, class Bits>
inline void sine_cosine_of(const Real& x, Real& sine, Real& cosine) {
  constexpr double two_over_pi = 0x1.45f306dc9c883p-1;
  constexpr double half_pi_1 = 0x1.921fb544p0;  // 33 bits: exact times any k below 2^20
  constexpr double half_pi_2 = 0x1.0b4611a6p-34;
  constexpr double half_pi_3 = 0x1.3198a2e037073p-69;
  constexpr double round_to_integer = 0x1.8p52;  // leaves k in the low bits

  const Real shifted = x * two_over_pi + round_to_integer;
  const Real k = shifted - round_to_integer;
  const Real too_large = x * 0x1p993;  // infinite from 2^31
  const Real part_1 = (x - k * half_pi_1) - (too_large - too_large);
  const Real product_2 = k * half_pi_2;
  const Real part_2 = part_1 - product_2;
  const Real product_3 = k * half_pi_3;
  const Real r = part_2 - product_3;
  const Real rest = ((part_1 - part_2) - product_2) + ((part_2 - r) - product_3);

  const Real z = r * r, z2 = z * z, z4 = z2 * z2;
  const Real half_z = 0.5 * z;
  const Real one_less = 1.0 - half_z;
  const Real sine_tail = (z * 0.008333333333330936 - 0.16666666666666666) +
                         z2 * ((z * 2.7557316093198404e-06 - 0.00019841269836740532) +
                               z2 * (z * 1.5917988979397432e-10 - 2.5051129896450185e-08));
  const Real sine_r = r + ((z * r) * sine_tail + rest * one_less);
  const Real cosine_tail = z * ((0.041666666666666664 - z * 0.0013888888888887389) +
                                z2 * (2.48015872987544e-05 - z * 2.755731726587808e-07) +
                                z4 * (2.087614504941318e-09 - z * 1.138254464534925e-11));
  const Real cosine_r = one_less + (((1.0 - one_less) - half_z) + (z * cosine_tail - r * rest));

  // k mod 4 turns (sine, cosine) by quarters.
  const Bits quarter = __builtin_bit_cast(Bits, shifted);
  const Bits swap = -(quarter & 1);
  const Bits s = __builtin_bit_cast(Bits, sine_r), c = __builtin_bit_cast(Bits, cosine_r);
  const Bits exchanged = (s ^ c) & swap;
  sine = __builtin_bit_cast(Real, (s ^ exchanged) ^ ((quarter & 2) << 62));
  cosine = __builtin_bit_cast(Real, (c ^ exchanged) ^ (((quarter + 1) & 2) << 62));
}

inline void sine_cosine(const double& x, double& sine, double& cosine) {
  sine_cosine_of<double, std::uint64_t>(x, sine, cosine);
}

#ifdef __GNUC__
/// Sines and cosines of n angles, four at a time: vectors of the compiler's, not of one processor.
[[gnu::always_inline]] inline void sines_and_cosines(int n, const double* angle, double* sine,
                                                     double* cosine) {
  typedef double Four __attribute__((vector_size(32)));
  typedef std::uint64_t FourBits __attribute__((vector_size(32)));
  typedef double Two __attribute__((vector_size(16)));
  typedef std::uint64_t TwoBits __attribute__((vector_size(16)));
  const int whole = n - n % 4, rest = n % 4;
  for (int i = 0; i < whole; i += 4) {
    Four x, s, c;
    std::memcpy(&x, angle + i, sizeof x);
    sine_cosine_of<Four, FourBits>(x, s, c);
    std::memcpy(sine + i, &s, sizeof s);
    std::memcpy(cosine + i, &c, sizeof c);
  }
  if (rest == 3) {
    const Four x{angle[whole], angle[whole + 1], angle[whole + 2], angle[whole + 2]};
    Four s, c;
    sine_cosine_of<Four, FourBits>(x, s, c);
    for (int k = 0; k < 3; ++k) {
      sine[whole + k] = s[k];
      cosine[whole + k] = c[k];
    }
  } else if (rest == 2) {
    Two x, s, c;
    std::memcpy(&x, angle + whole, sizeof x);
    sine_cosine_of<Two, TwoBits>(x, s, c);
    std::memcpy(sine + whole, &s, sizeof s);
    std::memcpy(cosine + whole, &c, sizeof c);
  } else if (rest == 1) {
    sine_cosine(angle[whole], sine[whole], cosine[whole]);
  }
}
template <int n>
inline void sines_and_cosines(const double* angle, double* sine, double* cosine) {
  sines_and_cosines(n, angle, sine, cosine);
}
#endif

}  // namespace catena
