// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/score.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// A column of which less than this share survives is numerically one the fit can imitate.
constexpr double kNothingSurvives = 1e-6;

/// Q: orthonormal columns that span those of the Jacobian, each taken with size one.
MatrixXd basis_of(const MatrixXd& jacobian) {
  MatrixXd scaled = jacobian;
  for (Index j = 0; j < scaled.cols(); ++j) {
    const double size = scaled.col(j).norm();
    if (size > 0) scaled.col(j) /= size;
  }
  return orthonormal_basis(scaled, 1e-10);
}

}  // namespace

ScoreTest::ScoreTest(VectorXd residual, const MatrixXd& jacobian)
    : residual_(std::move(residual)), orthogonal_(residual_.size(), 0) {
  if (jacobian.cols() > 0) orthogonal_ = basis_of(jacobian);
  residual_ = project(residual_);
  squares_ = residual_.squaredNorm();
}

VectorXd ScoreTest::project(const VectorXd& column) const {
  VectorXd rest = column;
  for (int twice = 0; twice < 2; ++twice) rest -= orthogonal_ * (orthogonal_.transpose() * rest);
  return rest;
}

int ScoreTest::add(const ScoreColumn& column) {
  Kept kept;
  kept.whole = column.derivative.norm();
  kept.projected = project(column.derivative);
  kept.size = kept.projected.norm();
  if (kept.size > kNothingSurvives * kept.whole && kept.size > 0)
    kept.projected /= kept.size;
  else
    kept.size = 0;
  kept.lowest = column.lowest;
  kept.highest = column.highest;
  kept.along = kept.projected.dot(residual_);
  columns_.push_back(std::move(kept));
  return static_cast<int>(columns_.size()) - 1;
}

Score ScoreTest::score(const std::vector<int>& columns) const {
  const std::size_t count = columns.size();
  const auto column = [&](std::size_t i) -> const Kept& {
    return columns_[static_cast<std::size_t>(columns[i])];
  };
  MatrixXd gram(count, count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j <= i; ++j)
      gram(static_cast<Index>(i), static_cast<Index>(j)) =
          gram(static_cast<Index>(j), static_cast<Index>(i)) =
              column(i).size > 0 && column(j).size > 0
                  ? column(i).projected.dot(column(j).projected)
                  : 0.0;

  Score best;
  best.estimate = VectorXd::Zero(static_cast<Index>(count));
  // Columns without bounds are in every subset; there may be many of them.
  std::vector<std::size_t> bounded;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isinf(column(i).lowest) || !std::isinf(column(i).highest)) bounded.push_back(i);
  if (bounded.size() > kMostBoundedColumns)
    throw std::invalid_argument("score: " + std::to_string(bounded.size()) +
                                " columns with bounds; at most " +
                                std::to_string(kMostBoundedColumns) + " can be scored together");
  const std::size_t subsets = std::size_t{1} << bounded.size();
  for (std::size_t subset = subsets; subset-- > 0;) {
    std::vector<bool> left_out(count);
    for (std::size_t b = 0; b < bounded.size(); ++b) left_out[bounded[b]] = !(subset >> b & 1u);
    std::vector<std::size_t> used;
    for (std::size_t i = 0; i < count; ++i)
      if (!left_out[i]) used.push_back(i);
    if (used.empty()) break;
    const auto k = static_cast<Index>(used.size());
    MatrixXd matrix(k, k);
    VectorXd right(k);
    bool usable = true;
    for (Index a = 0; a < k; ++a) {
      const std::size_t i = used[static_cast<std::size_t>(a)];
      usable = usable && column(i).size > 0;
      right[a] = -column(i).along;
      for (Index b = 0; b < k; ++b)
        matrix(a, b) =
            gram(static_cast<Index>(i), static_cast<Index>(used[static_cast<std::size_t>(b)]));
    }
    if (!usable) continue;
    const SymmetricFactors factors(matrix);
    if (factors.reciprocal_condition() < 1e-10) continue;  // two columns that say the same
    VectorXd step = factors.solve(right);
    bool allowed = true, beyond = false;
    for (Index a = 0; a < k && allowed; ++a) {
      const Kept& kept = column(used[static_cast<std::size_t>(a)]);
      double value = step[a] / kept.size;
      if ((value < 0 && kept.lowest >= 0) || (value > 0 && kept.highest <= 0)) allowed = false;
      const double cut = std::clamp(value, kept.lowest, kept.highest);
      beyond = beyond || cut != value;
      step[a] = cut * kept.size;
    }
    if (!allowed) continue;
    const double removed = 2 * step.dot(right) - step.dot(matrix * step);
    if (removed <= best.removed) continue;
    best.removed = removed;
    best.admissible = true;
    best.beyond = beyond;
    best.estimate.setZero();
    VectorXd whole = VectorXd::Zero(residual_.size());
    double sum_whole = 0;
    for (Index a = 0; a < k; ++a) {
      const std::size_t i = used[static_cast<std::size_t>(a)];
      best.estimate[static_cast<Index>(i)] = step[a] / column(i).size;
      whole += step[a] * column(i).projected;
      sum_whole += std::pow(best.estimate[static_cast<Index>(i)] * column(i).whole, 2);
    }
    best.survives = sum_whole > 0 ? std::min(1.0, whole.norm() / std::sqrt(sum_whole)) : 0;
    if (used.size() == count && !beyond) break;  // no subset can remove more
  }
  best.share = squares_ > 0 ? best.removed / squares_ : 0;
  return best;
}

VectorXd ScoreTest::residual_after(const std::vector<int>& columns,
                                   const VectorXd& estimate) const {
  VectorXd rest = residual_;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Kept& kept = columns_[static_cast<std::size_t>(columns[i])];
    rest += estimate[static_cast<Index>(i)] * kept.size * kept.projected;
  }
  return rest;
}

}  // namespace catena
