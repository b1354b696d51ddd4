// SPDX-License-Identifier: BSD-3-Clause
#include "identify/noise/frame_grid.hpp"

#include <algorithm>
#include <cmath>

#include "common/median.hpp"
#include "common/special_values.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Robust standard deviations from what the neighbours say: 1 of 10^9 values of normal noise.
constexpr double kOutlier = 6;

/// What the two values seen before and the two seen after a frame say of it: the cubic through them.
/// `weight` is the root of one and the sum of the squared weights. NaN where there are not as many
/// close by.
double interpolated(const VectorXd& values, Index at, double* weight) {
  constexpr Index kReach = 4;
  Index places[4] = {-1, -1, -1, -1};
  int before = 0, after = 0;
  for (Index k = at - 1; k >= std::max<Index>(0, at - kReach) && before < 2; --k)
    if (!std::isnan(values[k])) places[before++] = k;
  for (Index k = at + 1; k < std::min(values.size(), at + kReach + 1) && after < 2; ++k)
    if (!std::isnan(values[k])) places[2 + after++] = k;
  if (before < 2 || after < 2) return kNaN;
  double sum = 0, squares = 1;
  for (const Index i : places) {
    double w = 1;
    for (const Index j : places)
      if (j != i) w *= static_cast<double>(at - j) / static_cast<double>(i - j);
    sum += w * values[i];
    squares += w * w;
  }
  if (weight) *weight = std::sqrt(squares);
  return sum;
}

}  // namespace

std::vector<int> frame_numbers(const std::vector<double>& time) {
  std::vector<int> numbers(time.size());
  std::vector<double> gaps;
  for (std::size_t k = 1; k < time.size(); ++k) gaps.push_back(time[k] - time[k - 1]);
  const double step = gaps.empty() ? 1 : median(gaps);
  bool regular = true;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double steps = std::round((time[k] - time[k - 1]) / step);
    regular = regular && steps >= 1 && steps < 1000;
    numbers[k] = numbers[k - 1] + (regular ? static_cast<int>(steps) : 0);
  }
  if (!regular)
    for (std::size_t k = 0; k < time.size(); ++k) numbers[k] = static_cast<int>(k);
  return numbers;
}

MatrixXd on_grid(const MatrixXd& matrix, const std::vector<int>& frame) {
  if (matrix.cols() == 0) return matrix;
  const int last = frame[static_cast<std::size_t>(matrix.cols() - 1)];
  MatrixXd grid = MatrixXd::Constant(matrix.rows(), last + 1, kNaN);
  for (Index k = 0; k < matrix.cols(); ++k)
    grid.col(frame[static_cast<std::size_t>(k)]) = matrix.col(k);
  return grid;
}

double roughness(const VectorXd& values, Index at) {
  double weight = 1;
  return (values[at] - interpolated(values, at, &weight)) / weight;
}

long take_out_outliers(MatrixXd& grid) {
  long count = 0;
  for (Index c = 0; c < grid.rows(); ++c) {
    VectorXd values = grid.row(c);
    VectorXd rough(values.size());
    std::vector<double> sizes;
    for (Index k = 0; k < values.size(); ++k) {
      rough[k] = std::abs(roughness(values, k));
      if (std::isnan(rough[k]))
        rough[k] = 0;
      else
        sizes.push_back(rough[k]);
    }
    if (sizes.size() < 20) continue;
    const double limit = kOutlier * median(sizes) / 0.6745;
    if (!(limit > 0)) continue;
    Index worst = 0;
    while (rough.maxCoeff(&worst) > limit) {
      values[worst] = kNaN;
      rough[worst] = 0;
      ++count;
      for (Index k = std::max<Index>(0, worst - 5); k < std::min(values.size(), worst + 6); ++k)
        if (const double r = std::abs(roughness(values, k)); rough[k] > 0)
          rough[k] = std::isnan(r) ? 0 : r;
    }
    grid.row(c) = values;
  }
  return count;
}

}  // namespace catena
