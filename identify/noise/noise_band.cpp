// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/noise_band.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// Largest power of a misfit, over its noise, at a frequency that shows the noise.
constexpr double kMisfitInBand = 0.1;
/// A misfit has the spectrum of the motion, up to so many times more at some frequencies.
constexpr double kMisfitElsewhere = 10;
/// Smallest share of the frequencies from which the others are extrapolated.
constexpr double kFewestFrequencies = 0.25;
/// Squared coherence of channels, beyond chance: a third of their power is misfit.
constexpr double kCoherent = 0.1;
/// Or by so many standard deviations of what few channels and frames have by chance.
constexpr double kCoherentBeyondChance = 3;
/// Channels of a direction, from which on their coherence tells.
constexpr Index kFewestCompared = 4;

/// The frequencies at which a misfit has little power beside the noise. A misfit has the spectrum of
/// the motion, and no more power than the residuals.
std::vector<bool> free_of_motion(const VectorXd& power, const VectorXd& motion) {
  const Index bins = power.size();
  const double part =
      motion.sum() > 0 ? std::min(1.0, kMisfitElsewhere * power.sum() / motion.sum()) : 0;
  std::vector<bool> use(static_cast<std::size_t>(bins), true);
  use[0] = use[1] = use[2] = use.back() = false;  // what the taper leaks of a drift
  double sum = 0;
  for (Index j = 0; j < bins; ++j) {
    const bool main = sum < 0.99 * motion.sum();
    sum += motion[j];
    const double level =
        power.segment(std::max<Index>(0, j - 1), std::min<Index>(3, bins - j)).mean();
    if (!main && part * motion[j] < kMisfitInBand * level) continue;
    for (Index i = std::max<Index>(0, j - 1); i <= std::min(bins - 1, j + 1); ++i)
      use[static_cast<std::size_t>(i)] = false;
  }
  return use;
}

/// Noise of different channels has nothing in common but a common mode. Where they do have, there is
/// misfit: what is below such a frequency is no noise to learn from. False where no direction has
/// enough channels to compare.
bool leave_out_coherent(const Segments& segments, const VectorXd& sigma,
                        const std::vector<int>& direction, std::vector<bool>& use) {
  bool compared = false;
  Index first = 0;
  for (const int d : {-1, 0, 1}) {
    std::vector<Index> group;
    for (Index c = 0; c < sigma.size(); ++c)
      if (direction[static_cast<std::size_t>(c)] == d) group.push_back(c);
    const auto n = static_cast<Index>(group.size());
    if (n < kFewestCompared) continue;
    compared = true;
    const auto bins = static_cast<Index>(use.size());
    std::vector<MatrixXcd> products(use.size(), MatrixXcd::Zero(n, n));
    for (const MatrixXcd& x : segments.residual)
      for (Index j = 0; j < bins; ++j) {
        VectorXcd y = x.col(j)(group).cwiseQuotient(sigma(group));
        y.array() -= y.mean();
        products[static_cast<std::size_t>(j)] += y * y.adjoint();
      }
    // Independent values in five neighbouring frequencies.
    const double count = 5 * segments.values / static_cast<double>(sigma.size()) /
                         (2 * static_cast<double>(bins - 1));
    const auto pairs = static_cast<double>(n * (n - 1) / 2);
    // By chance, and as the mean was taken out of so many.
    const double without_mean = std::pow(static_cast<double>(n - 1), -2);
    const double most = 1 / count + without_mean +
                        std::max(kCoherent, kCoherentBeyondChance / (count * std::sqrt(pairs)));
    // From below: there is misfit beside the motion, and between the lobes of a smoothing what leaks.
    for (Index j = 2; j + 2 < bins; ++j) {
      if (!use[static_cast<std::size_t>(j)]) continue;
      MatrixXcd sum = MatrixXcd::Zero(n, n);
      for (Index i = j - 2; i <= j + 2; ++i) sum += products[static_cast<std::size_t>(i)];
      double coherence = 0;
      for (Index a = 0; a < n; ++a)
        for (Index b = 0; b < a; ++b)
          coherence += std::norm(sum(a, b)) / (sum(a, a).real() * sum(b, b).real());
      if (coherence / pairs < most) break;
      first = std::max(first, j + 1);
    }
  }
  for (Index j = 0; j < first; ++j) use[static_cast<std::size_t>(j)] = false;
  return compared;
}

}  // namespace

NoiseBand noise_band(const Segments& segments, const std::vector<int>& direction) {
  NoiseBand band;
  const MatrixXd power = segments.power();
  const Index channels = power.rows(), bins = power.cols();
  const VectorXd variance = power.rightCols(bins / 2).rowwise().mean();
  if (!(variance.minCoeff() > 0)) return band;
  band.sigma = variance.cwiseSqrt();
  const VectorXd per_channel = variance.cwiseInverse() / static_cast<double>(channels);
  band.use = free_of_motion(power.transpose() * per_channel,
                            segments.motion_power.transpose() * per_channel);
  band.compared = leave_out_coherent(segments, band.sigma, direction, band.use);
  double used = 0;
  for (const bool u : band.use) used += u;
  if (used >= kFewestFrequencies * static_cast<double>(bins))
    band.share = used / static_cast<double>(bins);
  return band;
}

}  // namespace catena
