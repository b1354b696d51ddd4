// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <unsupported/Eigen/FFT>

namespace catena::report {
namespace {

constexpr std::size_t kFewestSamples = 16;

double median_step(const std::vector<double>& time) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < time.size(); ++k) steps.push_back(time[k] - time[k - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

Spectrum amplitude_spectrum(const std::vector<double>& time, const std::vector<double>& value) {
  std::vector<double> t;
  std::vector<double> y;
  for (std::size_t k = 0; k < time.size(); ++k) {
    if (std::isnan(value[k])) continue;
    t.push_back(time[k]);
    y.push_back(value[k]);
  }
  if (t.size() < kFewestSamples) return {};
  const double step = median_step(time);
  if (!(step > 0)) return {};
  const auto count = static_cast<std::size_t>(std::floor((t.back() - t.front()) / step + 1e-6)) + 1;

  std::vector<double> grid(count);
  std::size_t after = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const double at = t.front() + static_cast<double>(k) * step;
    while (after + 1 < t.size() && t[after] < at) ++after;
    const double weight = std::clamp((at - t[after - 1]) / (t[after] - t[after - 1]), 0.0, 1.0);
    grid[k] = (1 - weight) * y[after - 1] + weight * y[after];
  }
  const double mean = std::accumulate(grid.begin(), grid.end(), 0.0) / static_cast<double>(count);
  double weights = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double phase = 2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
    const double hann = 0.5 * (1 - std::cos(phase));
    grid[k] = hann * (grid[k] - mean);
    weights += hann;
  }

  Eigen::FFT<double> transform;
  std::vector<std::complex<double>> bins;
  transform.fwd(bins, grid);
  Spectrum spectrum;
  for (std::size_t k = 1; k <= count / 2; ++k) {
    spectrum.frequency.push_back(static_cast<double>(k) / (static_cast<double>(count) * step));
    spectrum.amplitude.push_back(2 * std::abs(bins[k]) / weights);
  }
  return spectrum;
}

}  // namespace catena::report
