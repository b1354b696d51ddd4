// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/prediction_filter.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kLags = 30;  // a smoothed track needs more than an autoregression

}  // namespace

PredictionFilters::PredictionFilters(const NoiseShape& shape)
    : lags_(shape.white() ? 0 : kLags), correlation_(shape.autocorrelation(kLags)) {}

Eigen::MatrixXi PredictionFilters::patterns(const MatrixXd& grid, const std::vector<int>& frame,
                                            Index fitted,
                                            std::vector<PredictionFilter>& filters) const {
  std::map<unsigned, int> numbers;
  Eigen::MatrixXi pattern =
      Eigen::MatrixXi::Constant(grid.rows(), static_cast<Index>(frame.size()), -1);
  for (Index c = 0; c < pattern.rows(); ++c) {
    unsigned before = 0;  // bit i: the frame i frames before was seen
    int last = 0;
    for (Index k = 0; k < pattern.cols(); ++k) {
      const int number = frame[static_cast<std::size_t>(k)], steps = number - last;
      before = steps > kLags || k == fitted ? 0 : before << steps;
      last = number;
      if (std::isnan(grid(c, number))) continue;
      const unsigned known = before >> 1 & ((1u << lags_) - 1);
      const auto [place, added] = numbers.try_emplace(known, static_cast<int>(filters.size()));
      if (added) filters.push_back(filter_of(known));
      pattern(c, k) = place->second;
      before |= 1;
    }
  }
  return pattern;
}

/// `known`: bit i - 1 if the frame i frames before was seen.
PredictionFilter PredictionFilters::filter_of(unsigned known) const {
  std::vector<int> lags;
  for (int lag = 1; lag <= lags_; ++lag)
    if (known >> (lag - 1) & 1u) lags.push_back(lag);
  const auto n = static_cast<Index>(lags.size());
  MatrixXd matrix(n, n);
  VectorXd right(n);
  for (Index a = 0; a < n; ++a) {
    const int lag = lags[static_cast<std::size_t>(a)];
    right[a] = correlation_[lag];
    for (Index b = 0; b < n; ++b)
      matrix(a, b) = correlation_[std::abs(lag - lags[static_cast<std::size_t>(b)])];
  }
  PredictionFilter filter{VectorXd::Zero(lags_), 1};
  if (n == 0) return filter;
  const VectorXd solved = solve_symmetric(matrix, right);
  for (Index a = 0; a < n; ++a)
    filter.coefficients[lags[static_cast<std::size_t>(a)] - 1] = solved[a];
  filter.deviation = std::sqrt(std::max(1e-6, 1 - solved.dot(right)));
  return filter;
}

}  // namespace catena
