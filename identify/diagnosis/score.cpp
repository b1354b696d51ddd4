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

/// Without what lies along orthonormal columns; twice, for roundings.
template <typename Columns>
Columns without_span(const MatrixXd& orthogonal, Columns rest) {
  for (int twice = 0; twice < 2; ++twice) rest -= orthogonal * (orthogonal.transpose() * rest);
  return rest;
}

}  // namespace

ScoreTest::ScoreTest(VectorXd residual, const MatrixXd& jacobian)
    : residual_(std::move(residual)), orthogonal_(residual_.size(), 0) {
  if (jacobian.cols() > 0) orthogonal_ = basis_of(jacobian);
  residual_ = project(residual_);
  squares_ = residual_.squaredNorm();
}

VectorXd ScoreTest::project(const VectorXd& column) const {
  return without_span(orthogonal_, column);
}

MatrixXd ScoreTest::project_all(const MatrixXd& columns) const {
  return without_span(orthogonal_, columns);
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

MatrixXd ScoreTest::products_of(const std::vector<int>& columns) const {
  const auto count = static_cast<Index>(columns.size());
  MatrixXd result = MatrixXd::Zero(count, count);
  for (Index i = 0; i < count; ++i)
    for (Index j = 0; j <= i; ++j) {
      const Kept& a = kept(columns[static_cast<std::size_t>(i)]);
      const Kept& b = kept(columns[static_cast<std::size_t>(j)]);
      if (a.size > 0 && b.size > 0) result(i, j) = result(j, i) = a.projected.dot(b.projected);
    }
  return result;
}

ScoreTest::Step ScoreTest::best_step(const std::vector<int>& columns, const MatrixXd& products,
                                     const VectorXd& residual) const {
  const std::size_t count = columns.size();
  Step best;
  best.along = VectorXd::Zero(static_cast<Index>(count));
  // Columns without bounds are in every subset; there may be many of them.
  std::vector<std::size_t> bounded;
  for (std::size_t i = 0; i < count; ++i)
    if (!std::isinf(kept(columns[i]).lowest) || !std::isinf(kept(columns[i]).highest))
      bounded.push_back(i);
  if (bounded.size() > kMostBoundedColumns)
    throw std::invalid_argument("score: " + std::to_string(bounded.size()) +
                                " columns with bounds; at most " +
                                std::to_string(kMostBoundedColumns) + " can be scored together");
  const std::size_t subsets = std::size_t{1} << bounded.size();
  for (std::size_t subset = subsets; subset-- > 0;) {
    std::vector<bool> left_out(count);
    for (std::size_t b = 0; b < bounded.size(); ++b) left_out[bounded[b]] = !(subset >> b & 1u);
    std::vector<Index> used;
    for (std::size_t i = 0; i < count; ++i)
      if (!left_out[i]) used.push_back(static_cast<Index>(i));
    if (used.empty()) break;
    const MatrixXd matrix = products(used, used);
    const VectorXd right = -residual(used);
    if (matrix.diagonal().minCoeff() == 0) continue;  // the fit can imitate a column
    const SymmetricFactors factors(matrix);
    if (factors.reciprocal_condition() < 1e-10) continue;  // two columns that say the same
    VectorXd step = factors.solve(right);
    bool allowed = true, beyond = false;
    for (std::size_t a = 0; a < used.size() && allowed; ++a) {
      const Kept& column = kept(columns[static_cast<std::size_t>(used[a])]);
      double& size = step[static_cast<Index>(a)];
      const double value = size / column.size;
      if ((value < 0 && column.lowest >= 0) || (value > 0 && column.highest <= 0)) allowed = false;
      const double cut = std::clamp(value, column.lowest, column.highest);
      beyond = beyond || cut != value;
      size = cut * column.size;
    }
    if (!allowed) continue;
    const double removed = 2 * step.dot(right) - step.dot(matrix * step);
    if (removed <= best.removed) continue;
    best.removed = removed;
    best.beyond = beyond;
    best.along.setZero();
    best.along(used) = step;
    if (used.size() == count && !beyond) break;  // no subset can remove more
  }
  return best;
}

Score ScoreTest::score(const std::vector<int>& columns) const {
  VectorXd residual(static_cast<Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    residual[static_cast<Index>(i)] = kept(columns[i]).along;
  const Step best = best_step(columns, products_of(columns), residual);
  Score score;
  score.estimate = VectorXd::Zero(best.along.size());
  score.removed = best.removed;
  score.share = squares_ > 0 ? best.removed / squares_ : 0;
  score.admissible = best.removed > 0;
  score.beyond = best.beyond;
  VectorXd whole = VectorXd::Zero(residual_.size());
  double sum_whole = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const double step = best.along[static_cast<Index>(i)];
    if (step == 0) continue;
    const Kept& column = kept(columns[i]);
    score.estimate[static_cast<Index>(i)] = step / column.size;
    whole += step * column.projected;
    sum_whole += std::pow(step / column.size * column.whole, 2);
  }
  if (sum_whole > 0) score.survives = std::min(1.0, whole.norm() / std::sqrt(sum_whole));
  return score;
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
