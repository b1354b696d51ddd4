// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace truth {

/// What makes a camera's noise other than white, normal and alike for all marks.
struct NoiseKind {
  double autocorrelation = 0;  // of neighbouring frames, first order
  double shaking = 0;          // standard deviation that all marks share, over that of one mark
  double noisy_marker = 1;     // how much noisier one of the marks is
  int tails = 0;               // degrees of freedom of Student's t, above 2; 0: normal
  bool smoothed = false;       // tracks smoothed over five frames, Savitzky-Golay
  double outliers = 0;         // share of coordinates that are 20 standard deviations off
};

/// [frame][mark]: side and down, in units of the noise.
using NoiseTable = std::vector<std::vector<std::array<double, 2>>>;

/// Noise of this kind from white normal noise of deviation 1.
NoiseTable noise_of_kind(NoiseTable white, const NoiseKind& kind, std::uint64_t seed);

}  // namespace truth
