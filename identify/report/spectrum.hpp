// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace catena::report {

struct Spectrum {
  std::vector<double> frequency;  ///< Hz, from the first above zero to half the sampling rate
  std::vector<double>
      amplitude;  ///< unit of the values: a sine of amplitude A at a listed frequency shows A
};

/// Amplitude spectrum of values at the given times (s, ascending; NaN values are gaps). Values are
/// interpolated linearly onto a grid of the median step, their mean taken away, a Hann window laid
/// over them: frequencies closer than 2 / duration run together, and what lies above half the
/// sampling rate appears below it. Empty with fewer than 16 values.
Spectrum amplitude_spectrum(const std::vector<double>& time, const std::vector<double>& value);

}  // namespace catena::report
