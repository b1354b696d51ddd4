// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/filling.hpp"

#include <cmath>
#include <vector>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kReach = 7;  // frames on each side

}  // namespace

Filler::Filler(const NoiseShape& shape) : correlation_(shape.autocorrelation(2 * kReach)) {}

VectorXd Filler::operator()(const VectorXd& values) {
  VectorXd full = values;
  Index before = -1;
  for (Index k = 0; k < values.size(); ++k) {
    if (!std::isnan(values[k])) {
      before = k;
      continue;
    }
    unsigned seen = 0;
    for (int i = 0; i <= 2 * kReach; ++i)
      if (const Index at = k + i - kReach; at >= 0 && at < values.size() && !std::isnan(values[at]))
        seen |= 1u << i;
    if (const VectorXd& weights = weights_for(seen); weights.size() > 0) {
      full[k] = 0;
      for (int i = 0; i <= 2 * kReach; ++i)
        if (seen >> i & 1u) full[k] += weights[i] * values[k + i - kReach];
      continue;
    }
    Index after = k;
    while (after < values.size() && std::isnan(values[after])) ++after;
    const bool first = before < 0, last = after == values.size();
    if (first && last) return VectorXd::Zero(values.size());
    const double share =
        first || last ? 0 : static_cast<double>(k - before) / static_cast<double>(after - before);
    full[k] = first  ? values[after]
              : last ? values[before]
                     : (1 - share) * values[before] + share * values[after];
  }
  return full;
}

const VectorXd& Filler::weights_for(unsigned seen) {
  const auto [place, added] = weights_.try_emplace(seen);
  std::vector<int> at;
  for (int i = 0; i <= 2 * kReach; ++i)
    if (seen >> i & 1u) at.push_back(i);
  if (!added || at.size() < 8 || at.front() >= kReach || at.back() <= kReach) return place->second;
  const auto n = static_cast<Index>(at.size());
  MatrixXd matrix = MatrixXd::Zero(n + 4, n + 4);
  VectorXd right = VectorXd::Zero(n + 4);
  right[n] = 1;
  for (Index a = 0; a < n; ++a) {
    const int i = at[static_cast<std::size_t>(a)];
    right[a] = correlation_[std::abs(i - kReach)];
    for (Index b = 0; b < n; ++b)
      matrix(a, b) = correlation_[std::abs(i - at[static_cast<std::size_t>(b)])];
    for (int power = 0; power < 4; ++power)
      matrix(a, n + power) = matrix(n + power, a) =
          std::pow(static_cast<double>(i - kReach) / kReach, power);
  }
  const VectorXd solved = solve_nearly_singular(matrix, right);
  place->second = VectorXd::Zero(2 * kReach + 1);
  for (Index a = 0; a < n; ++a) place->second[at[static_cast<std::size_t>(a)]] = solved[a];
  return place->second;
}

}  // namespace catena
