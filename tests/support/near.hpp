// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <doctest/doctest.h>

#include <limits>

namespace catena {

/// Equal to a value but for this part of it; 0 is near 0 alone. doctest::Approx::epsilon takes the part of 1 + the
/// value, by which all small values are equal.
inline doctest::Approx near(double value, double part) {
  return doctest::Approx(value).epsilon(part).scale(std::numeric_limits<double>::min());
}

}  // namespace catena
