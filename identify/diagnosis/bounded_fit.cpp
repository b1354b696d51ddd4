// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/bounded_fit.hpp"

#include <algorithm>
#include <numeric>

#include "linear_algebra/decompositions.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

BoundedFit::BoundedFit(const Problem& problem, const VectorXd& x, const MatrixXd& along)
    : scale_(along.colwise().norm().transpose()), low_(x.size()), high_(x.size()) {
  for (double& size : scale_)
    if (size == 0) size = 1;
  const MatrixXd scaled = along * scale_.cwiseInverse().asDiagonal();
  constexpr double kAccuracyOfDerivatives = 1e-6;
  range_ = orthonormal_basis(scaled, kAccuracyOfDerivatives);
  triangle_ = range_.transpose() * scaled;
  for (Index j = 0; j < x.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    low_[j] = std::min(0.0, unknown.least - x[j]) * scale_[j];
    high_[j] = std::max(0.0, unknown.most - x[j]) * scale_[j];
  }
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
  return change.cwiseQuotient(scale_);
}

double BoundedFit::left(const VectorXd& error) const {
  return error.squaredNorm() - (range_.transpose() * error).squaredNorm();
}

}  // namespace catena
