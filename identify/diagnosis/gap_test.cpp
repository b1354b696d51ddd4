// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/gap_test.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "identify/diagnosis/thresholds.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;

GapTest test_gap(const std::vector<MatrixXd>& residuals, const std::vector<NoiseModel>& noise,
                 const std::vector<Index>& first) {
  GapTest test;
  double noise2 = 0, rms2 = 0, lag1 = 0, lag1_count = 0, along = 0, along_count = 0;
  double products = 0, pairs = 0, size = 0, count = 0;
  for (std::size_t e = 0; e < residuals.size(); ++e) {
    const MatrixXd& r = residuals[e];
    const MatrixXd z = noise[e].whitened(r, first.empty() ? 0 : first[e]);
    const double variance = noise[e].level * noise[e].level;
    const auto product = [&](Index c, Index k, Index d, Index l) {
      const double value = z(c, k) * z(d, l);
      return std::isnan(value) ? 0.0 : (pairs += 1, value);
    };
    const Index lags = std::min<Index>(6, r.cols() / 10 + 1);
    for (Index c = 0; c < r.rows(); ++c)
      for (Index k = 0; k < r.cols(); ++k) {
        if (std::isnan(z(c, k))) continue;
        count += 1;
        noise2 += variance;
        rms2 += r(c, k) * r(c, k);
        size += z(c, k) * z(c, k) - 1;
        for (Index l = 1; l <= lags && k + l < r.cols(); ++l) products += product(c, k, c, k + l);
        if (c + 2 < r.rows()) {  // side with side, down with down
          const double value = product(c, k, c + 2, k);
          products += value;
          along += variance * value;
          along_count += 1;
        }
        if (k + 1 < r.cols() && !std::isnan(z(c, k + 1))) {
          lag1 += variance * z(c, k) * z(c, k + 1);
          lag1_count += 1;
        }
      }
  }
  test.count = static_cast<long>(count);
  if (count == 0) return test;
  test.noise = std::sqrt(noise2 / count);
  test.rms = std::sqrt(rms2 / count);
  // A misfit is smooth in time, and alike in neighbouring channels.
  const double in_time = lag1_count > 0 ? lag1 / lag1_count : 0;
  const double in_neighbours = along_count > 0 ? along / along_count : 0;
  test.misfit = std::sqrt(std::max({0.0, in_time, in_neighbours}));
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
