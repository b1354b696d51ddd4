// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/spectrum.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/results/result.hpp"
#include "tests/support/near.hpp"

namespace catena::report {
namespace {

using results::kAbsent;
using results::Row;

TEST_CASE("a sine's amplitude and frequency are seen, at any offset, across a gap") {
  Row time;
  Row value;
  for (int k = 0; k < 400; ++k) {
    time.push_back(10 + 0.01 * k);
    const bool lost = k > 100 && k < 104;
    value.push_back(lost ? kAbsent : 7 + 3 * std::sin(2 * std::numbers::pi * 2.5 * time.back()));
  }
  const Spectrum spectrum = amplitude_spectrum(time, value);
  const auto largest = std::max_element(spectrum.amplitude.begin(), spectrum.amplitude.end());
  CHECK(*largest == catena::near(3, 0.01));
  CHECK(spectrum.frequency[static_cast<std::size_t>(largest - spectrum.amplitude.begin())] ==
        doctest::Approx(2.5));
  CHECK(spectrum.frequency.back() == doctest::Approx(50));
  CHECK(amplitude_spectrum({0, 1, 2}, {1, 2, 3}).frequency.empty());
  CHECK(amplitude_spectrum(time, Row(400, kAbsent)).frequency.empty());
}

}  // namespace
}  // namespace catena::report
