// SPDX-License-Identifier: BSD-3-Clause
#include "identify/ceres/distance_block.hpp"

#include <cmath>

namespace catena {
namespace {

using Eigen::RowVectorXd;
using Eigen::VectorXd;

constexpr double kStillFar = 0.5;    // the error fell by more than this share of itself
constexpr double kNear = 1e-3;       // the error fell by less
constexpr double kNarrower = 0.3;    // the width is, then

VectorXd direction(const VectorXd& r, double distance) {
  return distance > 0 ? VectorXd(r / distance) : VectorXd::Unit(r.size(), 0);
}

}  // namespace

Distances::Distances(const SimulatedResiduals& simulated, std::vector<Term> terms, double offset)
    : simulated_(simulated),
      terms_(std::move(terms)),
      offset_(offset),
      secant_row_(RowVectorXd::Zero(simulated.residuals().jacobian.cols())) {}

std::pair<double, double> Distances::curvature(double distance) const {
  const double width = width_ * simulated_.error();
  const double a = 1 / std::hypot(distance, width);
  const bool far = simulated_.error() < (1 - kStillFar) * simulated_.error_before();
  return {a, far ? a : width * width * a * a * a};
}

void Distances::step_to(const VectorXd& y) {
  const Residuals& all = simulated_.residuals();
  const VectorXd step = y_.size() ? VectorXd(y - y_) : VectorXd::Zero(y.size());
  VectorXd gradient = VectorXd::Zero(y.size());
  double curvature_along = 0;  // s'Hs
  for (const Term& term : terms_) {
    const VectorXd r = all.value.segment(term.first, term.count);
    const auto jacobian = all.jacobian.middleRows(term.first, term.count);
    const double distance = r.norm();
    const VectorXd u = direction(r, distance), moved = jacobian * step;
    if (distance > 0) gradient += term.weight * (jacobian.transpose() * u);
    const auto [a, b] = curvature(distance);
    const double along = u.dot(moved);
    curvature_along +=
        term.weight * (a * (moved.squaredNorm() - along * along) + b * along * along);
  }
  secant_row_.setZero();
  if (y_.size()) {
    const VectorXd change = gradient - gradient_;
    const double found = change.dot(step);
    if (found > curvature_along)
      secant_row_ = std::sqrt(1 / found - curvature_along / (found * found)) * change.transpose();
  }
  if (simulated_.error() > (1 - kNear) * simulated_.error_before()) width_ *= kNarrower;
  y_ = y;
  gradient_ = gradient;
}

DistanceBlock::DistanceBlock(const Distances& distances, const Distances::Term& term, int unknowns)
    : distances_(distances), term_(term) {
  set_num_residuals(1 + static_cast<int>(term.count));
  mutable_parameter_block_sizes()->push_back(unknowns);
}

bool DistanceBlock::Evaluate(double const* const*, double* residuals, double** jacobians) const {
  if (!distances_.simulated().ok()) return false;
  const Residuals& all = distances_.simulated().residuals();
  const VectorXd r = all.value.segment(term_.first, term_.count);
  const double distance = r.norm();
  residuals[0] = std::sqrt(2 * term_.weight * (distance + distances_.offset()));
  for (int i = 1; i <= term_.count; ++i) residuals[i] = 0;
  if (!jacobians || !jacobians[0]) return true;

  const Eigen::Index unknowns = all.jacobian.cols();
  const auto row = [&](int i) {
    return Eigen::Map<RowVectorXd>(jacobians[0] + i * unknowns, unknowns);
  };
  const auto by_unknown = all.jacobian.middleRows(term_.first, term_.count);
  const VectorXd u = direction(r, distance);
  const RowVectorXd along = u.transpose() * by_unknown;
  const auto [a, b] = distances_.curvature(distance);
  row(0) = (distance > 0 ? term_.weight / residuals[0] : 0) * along;
  row(1) = std::sqrt(term_.weight * b) * along;
  if (term_.count == 2)
    row(2) = std::sqrt(term_.weight * a) * (u[0] * by_unknown.row(1) - u[1] * by_unknown.row(0));
  return true;
}

SecantBlock::SecantBlock(const Distances& distances, int unknowns) : distances_(distances) {
  set_num_residuals(1);
  mutable_parameter_block_sizes()->push_back(unknowns);
}

bool SecantBlock::Evaluate(double const* const*, double* residuals, double** jacobians) const {
  residuals[0] = 0;
  const RowVectorXd& row = distances_.secant_row();
  if (jacobians && jacobians[0]) Eigen::Map<RowVectorXd>(jacobians[0], row.size()) = row;
  return true;
}

}  // namespace catena
