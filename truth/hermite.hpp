// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace truth {

/// Cubic Hermite interpolation of vectors over an interval of length `size`: the value where `share`
/// of it, 0 to 1, has gone by, from the values and derivatives at its two ends.
template <class Vector>
Vector hermite(const Vector& begin, const Vector& begin_rate, const Vector& end,
               const Vector& end_rate, double size, double share) {
  const double s = share;
  const double h00 = (1 + 2 * s) * (1 - s) * (1 - s), h10 = s * (1 - s) * (1 - s);
  const double h01 = s * s * (3 - 2 * s), h11 = s * s * (s - 1);
  return h00 * begin + h01 * end + size * (h10 * begin_rate + h11 * end_rate);
}

}  // namespace truth
