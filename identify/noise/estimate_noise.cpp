// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/estimate_noise.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>

#include "identify/noise/frame_grid.hpp"
#include "identify/noise/neighbour_differences.hpp"
#include "identify/noise/noise_band.hpp"
#include "identify/noise/noise_level.hpp"
#include "identify/noise/segments.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using Eigen::VectorXcd;
using Eigen::VectorXd;

namespace {

/// Of the power at other frequencies: there is more of what leaks than of noise.
constexpr double kFaint = 0.05;
/// Shape, sizes and what is filled in need each other.
constexpr int kRounds = 3;
/// With which frames that were not seen are filled in first: slightly smoothed. Filled in as for white
/// noise, smoothed tracks would look rough.
const NoiseShape kFirstShape = {1, {}};
/// Standard deviations, from which on a common mode is believed.
constexpr double kCommonSeen = 4;
constexpr int kSplitRounds = 30;  // of expectation and maximisation

/// Estimates of variances from `count` values each, drawn towards their mean as far as their scatter is that of
/// such estimates; and so much larger that values over them have the mean square 1.
VectorXd shrunk(const VectorXd& variances, double count) {
  const VectorXd logarithms = variances.array().log();
  const double mean = logarithms.mean(), error = 2 / count;
  const double scatter = (logarithms.array() - mean).square().sum() /
                         static_cast<double>(std::max<Index>(1, logarithms.size() - 1));
  const double real = std::max(0.0, 1 - error / scatter);
  return (mean + real * (logarithms.array() - mean) + (1 + real) / count).exp();
}

/// Of every channel: what it shares with its direction, over its own noise.
VectorXd loadings(const NoiseModel& noise, int direction) {
  VectorXd a = VectorXd::Zero(noise.sigma.size());
  for (Index c = 0; c < a.size(); ++c)
    if (noise.direction[static_cast<std::size_t>(c)] == direction)
      a[c] = noise.common[c] / noise.sigma[c];
  return a;
}

/// Over the channels, once their sizes and what they share are taken out.
VectorXd whitened_power(const Segments& segments, const NoiseModel& noise) {
  VectorXd sum = VectorXd::Zero(segments.motion_power.cols());
  for (const MatrixXcd& x : segments.residual)
    for (Index j = 0; j < x.cols(); ++j) {
      VectorXcd y = x.col(j).cwiseQuotient(noise.sigma);
      for (const int d : {0, 1}) {
        const VectorXd a = loadings(noise, d);
        const VectorXd real = y.real(), imaginary = y.imag();
        VectorXd parts[2] = {real, imaginary};
        for (VectorXd& part : parts) take_out_common(part, a);
        y.real() = parts[0];
        y.imag() = parts[1];
      }
      sum[j] += y.squaredNorm() / static_cast<double>(y.size());
    }
  return sum / static_cast<double>(segments.residual.size());
}

/// What the channels of a direction are seen to share, from their covariance by `count` values: the mean of theirs by
/// twos. 0: nothing beyond chance.
double shared_variance(const MatrixXd& covariance, double count) {
  double weights = 0, sum = 0;
  for (Index a = 0; a < covariance.rows(); ++a)
    for (Index b = 0; b < a; ++b) {
      const double weight = 1 / (covariance(a, a) * covariance(b, b));
      weights += weight;
      sum += weight * covariance(a, b);
    }
  const double shared = weights > 0 ? sum / weights : 0;
  return shared * std::sqrt(weights * count) > kCommonSeen ? shared : 0;
}

/// Per channel: variances of its own noise and of what its direction shares.
struct Variances {
  VectorXd own, shared;
};

/// The likeliest (factor analysis with one factor, by expectation and maximisation), with own variances shrunk().
Variances split_common(const MatrixXd& covariance, double count,
                       const std::vector<int>& direction) {
  const VectorXd all = covariance.diagonal();
  Variances variances{shrunk(all, count), VectorXd::Zero(all.size())};
  std::vector<std::vector<Index>> sharing;
  for (const int d : {0, 1}) {
    std::vector<Index> group;
    for (Index c = 0; c < all.size(); ++c)
      if (direction[static_cast<std::size_t>(c)] == d) group.push_back(c);
    const double shared = shared_variance(covariance(group, group), count);
    if (shared == 0) continue;
    variances.shared(group).setConstant(shared);
    sharing.push_back(std::move(group));
  }
  for (int round = 0; round < kSplitRounds && !sharing.empty(); ++round) {
    VectorXd own = all;
    for (const std::vector<Index>& group : sharing) {
      const MatrixXd among = covariance(group, group);
      VectorXd weights = variances.own(group).cwiseInverse();
      const double unknown = 1 / (1 / variances.shared[group.front()] + weights.sum());
      weights *= unknown;
      const VectorXd with_common = among * weights;
      const double shared = unknown + weights.dot(with_common);
      variances.shared(group).setConstant(shared);
      own(group) =
          among.diagonal() - 2 * with_common + VectorXd::Constant(own(group).size(), shared);
    }
    variances.own = shrunk(own, count);
  }
  return variances;
}

/// Of the shape of `noise`, by channel, and what the channels of a direction share.
void find_sizes(const Segments& segments, const NoiseBand& band, const ExpectedPower& expected,
                NoiseModel& noise) {
  const VectorXd e = expected(noise.shape);
  const Index channels = noise.sigma.size();
  MatrixXd covariance = MatrixXd::Zero(channels, channels);
  double terms = 0;
  double largest = 0;
  for (Index j = 0; j < e.size(); ++j)
    if (band.use[static_cast<std::size_t>(j)]) largest = std::max(largest, e[j]);
  for (const MatrixXcd& x : segments.residual)
    for (Index j = 0; j < e.size(); ++j)
      if (band.use[static_cast<std::size_t>(j)] && e[j] > kFaint * largest) {
        covariance += (x.col(j) * x.col(j).adjoint()).real() / e[j];
        terms += 1;
      }
  covariance /= terms;
  // Real values that stand behind each variance.
  const double count = band.share * segments.values / static_cast<double>(channels);
  const Variances variances = split_common(covariance, count, noise.direction);
  noise.sigma = variances.own.cwiseSqrt();
  noise.common = variances.shared.cwiseSqrt();
}

/// Shape, then sizes, of noise whose sizes were known roughly; the first time, not at all. False if
/// the motion fills the band, or too few channels are there to compare: a misfit is smooth as
/// smoothed noise is, but alike in neighbouring channels.
bool improve(NoiseModel& noise, const Segments& segments, const ExpectedPower& expected) {
  const NoiseBand band = noise_band(segments, noise.direction);
  if (band.share == 0 || !band.compared) return false;
  if (noise.sigma.size() == 0) {
    noise.sigma = band.sigma;
    noise.common = VectorXd::Zero(band.sigma.size());
  }
  noise.shape =
      fit_noise_shape(expected, whitened_power(segments, noise), band.use, segments.values);
  find_sizes(segments, band, expected, noise);
  return true;
}

/// Of white noise of one size: the root mean square over the windows.
double white_level(const std::vector<MatrixXd>& residuals) {
  double sum = 0, count = 0;
  for (const MatrixXd& residual : residuals) {
    std::vector<double> number(static_cast<std::size_t>(residual.cols()));
    std::iota(number.begin(), number.end(), 0.0);
    const double level = noise_level(residual, number);
    if (std::isnan(level)) continue;
    sum += level * level * static_cast<double>(residual.size());
    count += static_cast<double>(residual.size());
  }
  return std::sqrt(sum / count);
}

/// Excess kurtosis of the values behind whitened residuals, from their roughness: what is smooth has
/// none. A value, its two neighbours and the next two stand in it with 1, -2/3 and 1/6.
double tails_of(const std::vector<MatrixXd>& whitened) {
  constexpr double kOfSum = 0.369;  // sum of the 4th powers over the square of the sum of squares
  double squares = 0, fourth = 0, count = 0;
  for (const MatrixXd& z : whitened)
    for (Index c = 0; c < z.rows(); ++c) {
      const VectorXd row = z.row(c);
      for (Index k = 0; k < row.size(); ++k)
        if (const double rough = roughness(row, k); !std::isnan(rough))
          squares += rough * rough, fourth += std::pow(rough, 4), count += 1;
    }
  if (count < 100 || squares == 0) return 0;
  const double excess = fourth * count / (squares * squares) - 3;
  return excess > 4 * std::sqrt(24 / count) ? excess / kOfSum : 0;
}

}  // namespace

std::vector<NoiseModel> estimate_noise(const std::vector<NoiseWindow>& windows,
                                       const std::vector<int>& direction, double stated) {
  NoiseModel noise;
  noise.direction = direction;
  std::vector<std::vector<int>> frames;
  std::vector<MatrixXd> grids, residuals, predictions;
  Index longest = 0;
  for (const NoiseWindow& window : windows) {
    frames.push_back(frame_numbers(window.time));
    grids.push_back(on_grid(window.residual, frames.back()));
    noise.outliers += take_out_outliers(grids.back());
    const Index shown = window.shows_noise;
    const Index last = shown > 0 ? frames.back()[static_cast<std::size_t>(shown - 1)] + 1 : 0;
    residuals.push_back(grids.back().leftCols(last));
    predictions.push_back(on_grid(window.predicted.leftCols(shown), frames.back()));
    longest = std::max(longest, last);
  }
  const int length = longest >= 512 ? 128 : longest >= 96 ? 64 : 32;
  if (longest >= length) {
    const ExpectedPower expected(length);
    noise.shape = kFirstShape;
    const auto segmented = [&] {
      return Segments(residuals, predictions, noise.shape, expected.tapers());
    };
    for (int round = 0; round < kRounds && (round == 0 || noise.told); ++round)
      noise.told = improve(noise, segmented(), expected);
    // What neighbouring channels share is a misfit that was taken for noise.
    noise.told = noise.told &&
                 !neighbours_refute(segmented(), noise.sigma, direction, expected(noise.shape));
  }
  if (!noise.told) {
    const auto channels = static_cast<Index>(direction.size());
    noise.sigma.setConstant(channels, white_level(residuals));
    noise.common.setZero(channels);
    noise.shape = {};
  }
  noise.level = std::sqrt((noise.sigma.cwiseAbs2() + noise.common.cwiseAbs2()).mean());
  if (stated > 0 && !(noise.level >= stated)) {
    const bool none = !(noise.level > 0);
    if (none)
      noise.sigma.setConstant(stated);
    else
      noise.sigma *= stated / noise.level, noise.common *= stated / noise.level;
    noise.level = stated;
  }

  const PredictionFilters filters(noise.shape);
  std::vector<NoiseModel> models(windows.size(), noise);
  std::vector<MatrixXd> whitened;
  for (std::size_t w = 0; w < windows.size(); ++w) {
    NoiseModel& model = models[w];
    model.frame = frames[w];
    model.pattern = filters.patterns(grids[w], frames[w], windows[w].fitted, model.filters);
    whitened.push_back(model.whitened(windows[w].residual.leftCols(windows[w].fitted)));
    whitened.push_back(model.whitened(
        windows[w].residual.rightCols(windows[w].residual.cols() - windows[w].fitted),
        windows[w].fitted));
  }
  const double tails = tails_of(whitened);
  for (NoiseModel& model : models) model.excess_kurtosis = tails;
  return models;
}

}  // namespace catena
