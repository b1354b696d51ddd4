// SPDX-License-Identifier: BSD-3-Clause
//
// What an emitted model asks before it computes an effect: whether a parameter, or its differential,
// is not zero.
#pragma once

#include "batch.hpp"

namespace catena {

inline bool is_zero(double number) { return number == 0; }
template <int count>
inline bool is_zero(const Batch<count>& numbers) {
  bool zero = true;
  for (int k = 0; k < count; ++k) zero = zero && numbers[k] == 0;
  return zero;
}

/// Whether one of the numbers is not zero; true for NaN.
template <class... Numbers>
inline bool any_nonzero(const Numbers&... numbers) {
  return (!is_zero(numbers) || ...);
}

}  // namespace catena
