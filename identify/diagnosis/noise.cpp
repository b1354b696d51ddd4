// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/noise.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "identify/diagnosis/thresholds.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Variance of white noise from differences of one order; NaN if there are too few.
double difference_variance(const MatrixXd& residual, const std::vector<double>& time, int order) {
  std::vector<double> weights(static_cast<std::size_t>(order) + 1);
  for (int j = 0; j <= order; ++j)
    weights[static_cast<std::size_t>(j)] = (j % 2 ? -1 : 1) * binomial(order, j);
  const double gain = binomial(2 * order, order);
  std::vector<double> gaps;
  for (std::size_t i = 1; i < time.size(); ++i) gaps.push_back(time[i] - time[i - 1]);
  if (gaps.empty()) return kNaN;
  const double step = median(gaps);

  constexpr std::size_t kBlock = 40;
  std::vector<double> blocks;
  double all = 0, count = 0;
  for (Index c = 0; c < residual.rows(); ++c) {
    double sum = 0;
    std::size_t in_block = 0;
    for (Index k = 0; k + order < residual.cols(); ++k) {
      const double span =
          time[static_cast<std::size_t>(k + order)] - time[static_cast<std::size_t>(k)];
      if (std::abs(span - order * step) > 0.05 * step) continue;  // a frame is missing in between
      double difference = 0;
      for (int j = 0; j <= order; ++j)
        difference += weights[static_cast<std::size_t>(j)] * residual(c, k + j);
      if (std::isnan(difference)) continue;
      sum += difference * difference / gain;
      if (++in_block == kBlock) {
        blocks.push_back(sum / kBlock);
        all += sum;
        count += kBlock;
        sum = 0;
        in_block = 0;
      }
    }
    all += sum;
    count += static_cast<double>(in_block);
  }
  if (count < 20) return kNaN;
  if (blocks.size() < 5) return all / count;
  // Squared differences overlap: a block counts for kBlock / (sum of squared correlations) of
  // them; the median of chi-square(nu)/nu is (1 - 2/(9 nu))^3.
  const double nu = kBlock / (binomial(4 * order, 2 * order) / (gain * gain));
  return median(blocks) / std::pow(1 - 2 / (9 * nu), 3);
}

}  // namespace

NoiseLevel noise_level(const MatrixXd& residual, const std::vector<double>& time) {
  NoiseLevel level;
  double smallest = kNaN;
  for (int order = 2; order <= 6; ++order) {
    const double variance = difference_variance(residual, time, order);
    if (order == 2) level.sigma_of_second = std::sqrt(variance);
    if (!std::isnan(variance) && !(smallest <= variance)) smallest = variance;
  }
  level.sigma = std::sqrt(smallest);
  level.autocorrelated = level.sigma < kThresholds.white_noise_orders * level.sigma_of_second;
  return level;
}

GapTest test_gap(const std::vector<MatrixXd>& residuals, const std::vector<double>& sigmas) {
  GapTest test;
  double noise2 = 0, rms2 = 0, lag1 = 0, lag1_count = 0;
  double products = 0, pairs = 0, size = 0, count = 0;
  for (std::size_t e = 0; e < residuals.size(); ++e) {
    const MatrixXd& r = residuals[e];
    const double scale = 1 / (sigmas[e] * sigmas[e]);
    const auto product = [&](Index c, Index k, Index d, Index l) {
      const double value = r(c, k) * r(d, l);
      return std::isnan(value) ? 0.0 : (pairs += 1, value * scale);
    };
    const Index lags = std::min<Index>(6, r.cols() / 10 + 1);
    for (Index c = 0; c < r.rows(); ++c)
      for (Index k = 0; k < r.cols(); ++k) {
        const double value = r(c, k);
        if (std::isnan(value)) continue;
        count += 1;
        noise2 += sigmas[e] * sigmas[e];
        rms2 += value * value;
        size += value * value * scale - 1;
        for (Index l = 1; l <= lags && k + l < r.cols(); ++l) products += product(c, k, c, k + l);
        if (c + 2 < r.rows())
          products += product(c, k, c + 2, k);  // side with side, down with down
        if (k + 1 < r.cols() && !std::isnan(r(c, k + 1))) {
          lag1 += value * r(c, k + 1);
          lag1_count += 1;
        }
      }
  }
  test.count = static_cast<long>(count);
  if (count == 0) return test;
  test.noise = std::sqrt(noise2 / count);
  test.rms = std::sqrt(rms2 / count);
  test.misfit = lag1_count > 0 ? std::sqrt(std::max(0.0, lag1 / lag1_count)) : 0;
  test.autocorrelation = pairs > 0 ? products / std::sqrt(pairs) : 0;
  // The noise is an estimate from the same residuals, about three times less sure than their
  // number.
  test.size = size / std::sqrt(2 * 4 * count);
  const bool smooth = test.autocorrelation > kThresholds.gap_significance &&
                      test.misfit > kThresholds.gap_misfit * test.noise;
  const bool large =
      test.size > kThresholds.gap_significance && test.rms > kThresholds.gap_size * test.noise;
  test.present = smooth || large;
  return test;
}

double autocorrelation_factor(const std::vector<MatrixXd>& residuals) {
  double longest = 0;
  for (const MatrixXd& r : residuals) longest = std::max(longest, static_cast<double>(r.cols()));
  const auto lags = static_cast<Index>(std::min(60.0, longest / 4));
  const auto correlation = [&](Index time_lag, Index channel_lag) {
    double sum = 0, count = 0, variance = 0, total = 0;
    for (const MatrixXd& r : residuals)
      for (Index c = 0; c < r.rows(); ++c)
        for (Index k = 0; k < r.cols(); ++k) {
          if (std::isnan(r(c, k))) continue;
          variance += r(c, k) * r(c, k);
          total += 1;
          if (c + channel_lag >= r.rows() || k + time_lag >= r.cols()) continue;
          const double product = r(c, k) * r(c + channel_lag, k + time_lag);
          if (std::isnan(product)) continue;
          sum += product;
          count += 1;
        }
    return count > 0 && variance > 0 ? sum / count / (variance / total) : 0.0;
  };
  // Correlations are summed until they fade below their own uncertainty.
  double size = 0;
  for (const MatrixXd& r : residuals) size += static_cast<double>(r.size());
  const double faint = 2 / std::sqrt(std::max(size, 1.0));
  double in_time = 1, across = 1;
  for (Index l = 1; l <= lags; ++l) {
    const double rho = correlation(l, 0);
    if (rho < faint) break;
    in_time += 2 * rho;
  }
  Index rows = 0;
  for (const MatrixXd& r : residuals) rows = std::max(rows, r.rows());
  for (Index l = 2; l < rows; l += 2) {
    const double rho = correlation(0, l);
    if (rho < faint) break;
    across += 2 * rho * (1 - static_cast<double>(l) / static_cast<double>(rows));
  }
  return std::max(1.0, in_time) * std::max(1.0, across);
}

double log10_chi_square_tail(double x, int degrees) {
  // Q(a, y), a = degrees/2, y = x/2, by Q(a + 1, y) = Q(a, y) + y^a e^-y / Gamma(a + 1), in
  // logarithms.
  const double y = std::max(x, 0.0) / 2;
  if (y == 0) return 0;
  double a = degrees % 2 ? 0.5 : 1.0;
  double log_q = -y;
  if (degrees % 2)  // Q(1/2, y) = erfc(sqrt y), from its asymptotic form where it would underflow
    log_q = y < 600 ? std::log(std::erfc(std::sqrt(y)))
                    : -y - 0.5 * std::log(std::numbers::pi * y) + std::log1p(-0.5 / y);
  for (; a < degrees / 2.0 - 0.25; a += 1) {
    const double log_term = a * std::log(y) - y - std::lgamma(a + 1);
    const double high = std::max(log_q, log_term), low = std::min(log_q, log_term);
    log_q = high + std::log1p(std::exp(low - high));
  }
  return std::min(0.0, log_q / std::numbers::ln10);
}

}  // namespace catena
