// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/drawn_noise.hpp"

#include "identify/noise/cosine_spectrum.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr Index kMemory = 100;  // frames: an autoregression has forgotten how it began

/// A series through the autoregression, then through the smoothing.
VectorXd coloured(VectorXd series, const NoiseShape& shape) {
  const VectorXd a = shape.autoregression(), weights = shape.smoothing().weights;
  for (Index k = 0; k < series.size(); ++k)
    for (Index lag = 1; lag <= std::min(k, a.size()); ++lag)
      series[k] += a[lag - 1] * series[k - lag];
  VectorXd smoothed(series.size() - weights.size() + 1);
  for (Index k = 0; k < smoothed.size(); ++k)
    smoothed[k] = weights.dot(series.segment(k, weights.size()));
  return smoothed;
}

}  // namespace

MatrixXd drawn_noise(const NoiseModel& noise, Index channels, Index frames,
                     std::mt19937_64& random) {
  const Index reach = noise.shape.smoothing().frames() - 1;
  VectorXd impulse = VectorXd::Zero(kMemory + 2 * reach);
  impulse[reach] = 1;
  const double size = coloured(impulse, noise.shape).norm();
  const auto series = [&] {
    VectorXd white(kMemory + frames + reach);
    for (double& value : white) value = normal_number(random);
    return VectorXd(coloured(white, noise.shape).tail(frames) / size);
  };
  MatrixXd drawn(channels, frames);
  for (Index c = 0; c < channels; ++c)
    drawn.row(c) = (noise.sigma.size() > 0 ? noise.sigma[c] : noise.level) * series();
  if (noise.common.size() == 0) return drawn;
  for (const int d : {0, 1}) {
    const VectorXd shared = series();
    for (Index c = 0; c < channels; ++c)
      if (noise.direction[static_cast<std::size_t>(c)] == d)
        drawn.row(c) += noise.common[c] * shared;
  }
  return drawn;
}

}  // namespace catena
