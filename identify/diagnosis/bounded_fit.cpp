// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/bounded_fit.hpp"

#include <algorithm>
#include <numeric>

#include "identify/problem/ordered_unknowns.hpp"
#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

BoundedFit::BoundedFit(const Problem& problem, const VectorXd& x, MatrixXd along)
    : unknowns_(problem.unknowns()) {
  differentiate_apart(unknowns_, along);
  scale_ = along.colwise().norm().transpose();
  for (double& size : scale_)
    if (size == 0) size = 1;
  const MatrixXd scaled = along * scale_.cwiseInverse().asDiagonal();
  constexpr double kAccuracyOfDerivatives = 1e-6;
  range_ = orthonormal_basis(scaled, kAccuracyOfDerivatives);
  triangle_ = range_.transpose() * scaled;
  const UnknownBounds bounds = bounds_apart(unknowns_);
  const VectorXd here = apart(unknowns_, x);
  low_ = (bounds.lower - here).cwiseMin(0).cwiseProduct(scale_);
  high_ = (bounds.upper - here).cwiseMax(0).cwiseProduct(scale_);
}

VectorXd BoundedFit::operator()(const VectorXd& error) const {
  const VectorXd right = range_.transpose() * error;
  VectorXd change = VectorXd::Zero(scale_.size());
  std::vector<Index> free(static_cast<std::size_t>(change.size()));
  std::iota(free.begin(), free.end(), Index{0});
  const auto beyond = [&](Index j) { return change[j] < low_[j] || change[j] > high_[j]; };
  while (!free.empty()) {
    change(free).setZero();
    const VectorXd rest = right - triangle_ * change;
    change(free) = least_squares(MatrixXd(triangle_(Eigen::all, free)), rest);
    if (std::erase_if(free, beyond) == 0) break;
    change = change.cwiseMax(low_).cwiseMin(high_);
  }
  return changes_together(unknowns_, change.cwiseQuotient(scale_));
}

double BoundedFit::left(const VectorXd& error) const {
  return error.squaredNorm() - (range_.transpose() * error).squaredNorm();
}

}  // namespace catena
