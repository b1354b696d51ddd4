// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/noise_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Correlation of neighbouring frames from which on noise remembers ten frames, as motion does.
constexpr double kAsMotion = 0.9;

}  // namespace

double NoiseModel::degrees_of_freedom() const {
  return excess_kurtosis > 0 ? 4 + 6 / excess_kurtosis : std::numeric_limits<double>::infinity();
}

std::vector<std::string> NoiseModel::words() const {
  std::vector<std::string> words;
  if (!told)
    words.emplace_back(
        "fewer than 4 markers, motion at all frequencies that were recorded, or residuals that are "
        "alike in neighbouring markers: noise cannot be told from what the model misses");
  const SmoothingKernel& smoothing = shape.smoothing();
  if (smoothing.frames() > 1)
    words.push_back(fmt::format("the tracks look smoothed over {} frames ({})", smoothing.frames(),
                                smoothing.name));
  const double correlation = shape.autocorrelation(1)[1];
  if (smoothing.frames() == 1 && std::abs(correlation) > 0.1)
    words.push_back(fmt::format(
        "the noise of neighbouring frames is correlated by {:.2g}{}", correlation,
        correlation > kAsMotion ? ": what is left may as well be a motion that the model lacks"
        : correlation > 0       ? "; a misfit that looks like it is not found"
                                : ""));
  if (sigma.size() > 0 && sigma.maxCoeff() > 1.5 * sigma.minCoeff())
    words.push_back(fmt::format("the noisiest channel has {:.2g} times the noise of the quietest",
                                sigma.maxCoeff() / sigma.minCoeff()));
  if (common.size() > 0 && common.maxCoeff() > 0)
    words.push_back(fmt::format("all channels of a direction move together by {:.2g} of the noise",
                                common.maxCoeff() / level));
  if (excess_kurtosis > 0)
    words.push_back(fmt::format("heavy tails, like Student's t with {:.2g} degrees of freedom",
                                degrees_of_freedom()));
  if (outliers > 0)
    words.push_back(fmt::format("{} value{} far off", outliers, outliers == 1 ? " is" : "s are"));
  return words;
}

MatrixXd NoiseModel::whitened(const MatrixXd& matrix, Index first) const {
  if (sigma.size() == 0) return matrix / level;
  MatrixXd white =
      MatrixXd::Constant(matrix.rows(), matrix.cols(), std::numeric_limits<double>::quiet_NaN());
  const auto number = [&](Index k) { return frame[static_cast<std::size_t>(first + k)]; };
  for (Index c = 0; c < matrix.rows(); ++c)
    for (Index k = 0; k < matrix.cols(); ++k) {
      if (pattern(c, first + k) < 0) continue;
      const PredictionFilter& filter = filters[static_cast<std::size_t>(pattern(c, first + k))];
      double value = matrix(c, k);
      for (Index l = k - 1; l >= 0; --l) {
        const int lag = number(k) - number(l);
        if (lag > filter.coefficients.size()) break;
        if (const double b = filter.coefficients[lag - 1]; b != 0) value -= b * matrix(c, l);
      }
      white(c, k) = value / (sigma[c] * filter.deviation);
    }
  if (common.maxCoeff() == 0) return white;
  for (Index k = 0; k < white.cols(); ++k) {
    const VectorXd seen = white.col(k);
    for (const int d : {0, 1}) {
      VectorXd x = VectorXd::Zero(seen.size()), a = x;
      for (Index c = 0; c < x.size(); ++c)
        if (direction[static_cast<std::size_t>(c)] == d && !std::isnan(seen[c]))
          x[c] = seen[c], a[c] = common[c] / sigma[c];
      VectorXd rest = x;
      take_out_common(rest, a);
      white.col(k) += rest - x;
    }
  }
  return white;
}

std::vector<double> levels(const std::vector<NoiseModel>& noise) {
  std::vector<double> levels;
  levels.reserve(noise.size());
  for (const NoiseModel& each : noise) levels.push_back(each.level);
  return levels;
}

void take_out_common(VectorXd& x, const VectorXd& a) {
  const double square = a.squaredNorm();
  if (square > 0) x -= (1 - 1 / std::sqrt(1 + square)) / square * a.dot(x) * a;
}

}  // namespace catena
