// SPDX-License-Identifier: BSD-3-Clause
//
// An array with an entry for each link, which are counted from 1. Entry 1 begins a register of 8 numbers, so that
// loops over the links do not read and write across two lines of the cache. An entry 0 may be before it.
#pragma once

#include <cstddef>

namespace catena {

template <class T, int entries>
class LinkArray {
 public:
  T& operator[](int i) { return entries_[i + kBefore]; }
  const T& operator[](int i) const { return entries_[i + kBefore]; }

 private:
  static constexpr std::size_t kRegister = 8 * sizeof(double);
  static constexpr int kBefore =
      sizeof(T) < kRegister ? static_cast<int>(kRegister / sizeof(T)) - 1 : 0;
  alignas(kRegister) T entries_[kBefore + entries];
};

}  // namespace catena
