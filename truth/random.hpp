// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace truth {

/// Random numbers that are the same on every machine (splitmix64, Box-Muller).
class Random {
 public:
  /// The same seed gives the same numbers.
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double uniform();  // in (0, 1)
  double normal();   // mean 0, deviation 1

 private:
  std::uint64_t state_;
};

}  // namespace truth
