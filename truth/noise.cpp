// SPDX-License-Identifier: BSD-3-Clause
#include "truth/noise.hpp"

#include <algorithm>
#include <cmath>

#include "truth/random.hpp"

namespace truth {
namespace {

constexpr double kOutlier = 20;  // deviations
constexpr double kSavitzkyGolay[] = {-3 / 35.0, 12 / 35.0, 17 / 35.0, 12 / 35.0, -3 / 35.0};
constexpr std::uint64_t kOtherNumbers = 0x5bd1e9955bd1e995ULL;  // than those of the white noise

/// A parabola through five neighbouring frames; at the ends the last frame is repeated.
NoiseTable smoothed(const NoiseTable& rough) {
  NoiseTable smooth = rough;
  const auto frames = static_cast<std::ptrdiff_t>(rough.size());
  for (std::ptrdiff_t i = 0; i < frames; ++i)
    for (std::size_t k = 0; k < smooth[static_cast<std::size_t>(i)].size(); ++k)
      for (const std::size_t d : {0U, 1U}) {
        double sum = 0;
        for (std::ptrdiff_t l = -2; l <= 2; ++l) {
          const std::ptrdiff_t at = std::clamp<std::ptrdiff_t>(i + l, 0, frames - 1);
          sum += kSavitzkyGolay[l + 2] * rough[static_cast<std::size_t>(at)][k][d];
        }
        smooth[static_cast<std::size_t>(i)][k][d] = sum;
      }
  return smooth;
}

void make_tails_heavy(NoiseTable& table, int degrees, Random& random) {
  for (auto& frame : table)
    for (auto& mark : frame)
      for (double& value : mark) {
        double squares = 0;
        for (int n = 0; n < degrees; ++n) squares += std::pow(random.normal(), 2);
        value *= std::sqrt((degrees - 2) / squares);
      }
}

/// Autoregression of order 1 with the variance of `table`.
void correlate(NoiseTable& table, double with_last) {
  const double fresh = std::sqrt(1 - with_last * with_last);
  for (std::size_t i = 1; i < table.size(); ++i)
    for (std::size_t k = 0; k < table[i].size(); ++k)
      for (const std::size_t d : {0U, 1U})
        table[i][k][d] = with_last * table[i - 1][k][d] + fresh * table[i][k][d];
}

}  // namespace

NoiseTable noise_of_kind(NoiseTable table, const NoiseKind& kind, std::uint64_t seed) {
  Random random(seed ^ kOtherNumbers);
  if (kind.tails > 0) make_tails_heavy(table, kind.tails, random);
  NoiseTable shaking(table.size(), {{0, 0}});
  if (kind.shaking > 0)
    for (auto& frame : shaking)
      for (double& value : frame[0]) value = kind.shaking * random.normal();
  correlate(table, kind.autocorrelation);
  correlate(shaking, kind.autocorrelation);
  for (std::size_t i = 0; i < table.size(); ++i)
    for (std::size_t k = 0; k < table[i].size(); ++k)
      for (const std::size_t d : {0U, 1U}) {
        if (k == seed % table[i].size()) table[i][k][d] *= kind.noisy_marker;
        table[i][k][d] += shaking[i][0][d];
      }
  if (kind.smoothed) table = smoothed(table);
  if (kind.outliers > 0)
    for (auto& frame : table)
      for (auto& mark : frame)
        for (double& value : mark)
          if (random.uniform() < kind.outliers) value += std::copysign(kOutlier, random.normal());
  return table;
}

}  // namespace truth
