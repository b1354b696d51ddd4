// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/noise_level.hpp"

#include <cmath>

#include "common/median.hpp"
#include "common/special_values.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

double binomial(int n, int k) {
  double value = 1;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
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

double noise_level(const MatrixXd& residual, const std::vector<double>& time) {
  double smallest = kNaN;
  for (int order = 2; order <= 6; ++order)
    if (const double variance = difference_variance(residual, time, order); !(smallest <= variance))
      smallest = std::isnan(variance) ? smallest : variance;
  return std::sqrt(smallest);
}

}  // namespace catena
