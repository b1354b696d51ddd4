// SPDX-License-Identifier: BSD-3-Clause
#include "identify/ceres/distance_cost.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStillFar = 0.5;       // the error fell by more than this share of itself
constexpr double kNear = 1e-3;          // the error fell by less
constexpr double kNarrower = 0.3;       // the width is, then
constexpr double kNoCurvature = 1e-14;  // of the largest, unknowns scaled alike: rounding

}  // namespace

DistanceCost::DistanceCost(const SimulatedResiduals& simulated, std::vector<Term> terms,
                           double offset, const VectorXd& reach)
    : simulated_(simulated), terms_(std::move(terms)), offset_(offset), reach_(reach) {
  const int unknowns = static_cast<int>(reach.size());
  set_num_residuals(unknowns + 1);
  mutable_parameter_block_sizes()->push_back(unknowns);
}

double DistanceCost::all_offsets() const {
  double sum = 0;
  for (const Term& term : terms_) sum += term.weight * offset_;
  return sum;
}

void DistanceCost::step_to(const VectorXd& y) {
  const Residuals& all = simulated_.residuals();
  const bool far = simulated_.error() < (1 - kStillFar) * simulated_.error_before();
  if (simulated_.error() > (1 - kNear) * simulated_.error_before()) width_ *= kNarrower;
  const double width = width_ * simulated_.error();

  // Rows u'J and t'J of every term, as columns.
  const Index unknowns = y.size();
  const auto count = static_cast<Index>(terms_.size());
  MatrixXd along(unknowns, count), across = MatrixXd::Zero(unknowns, count);
  VectorXd weight(count), own(count), along_weight(count), across_weight(count);
  for (Index i = 0; i < count; ++i) {
    const Term& term = terms_[static_cast<std::size_t>(i)];
    const auto r = all.value.segment(term.first, term.count);
    const auto jacobian = all.jacobian.middleRows(term.first, term.count);
    const double distance = r.norm();
    const double side = distance > 0 ? r[0] / distance : 1;
    const double down = term.count == 2 && distance > 0 ? r[1] / distance : 0;
    along.col(i) = side * jacobian.row(0);
    if (term.count == 2) {
      along.col(i) += down * jacobian.row(1);
      across.col(i) = side * jacobian.row(1) - down * jacobian.row(0);
    }
    const double a = 1 / std::hypot(distance, width), b = far ? a : width * width * a * a * a;
    weight[i] = distance > 0 ? term.weight : 0;
    own[i] = weight[i] / (2 * (distance + offset_));
    along_weight[i] = term.weight * b;
    across_weight[i] = term.weight * a;
  }
  const VectorXd gradient = along * weight;
  MatrixXd curvature = along * along_weight.asDiagonal() * along.transpose();
  curvature.noalias() += across * across_weight.asDiagonal() * across.transpose();
  curvature_ = curvature;
  curvature_.noalias() += along * own.asDiagonal() * along.transpose();
  if (y_.size()) {
    const VectorXd step = y - y_, change = gradient - gradient_;
    const double found = change.dot(step), expected = step.dot(curvature * step);
    if (found > expected)
      curvature_ += (1 / found - expected / (found * found)) * change * change.transpose();
  }
  curvature_.diagonal() += gradient.cwiseAbs().cwiseQuotient(reach_);
  y_ = y;
  gradient_ = gradient;
}

bool DistanceCost::Evaluate(double const* const*, double* residuals, double** jacobians) const {
  if (!simulated_.ok()) return false;
  const VectorXd& values = simulated_.residuals().value;
  double squares = 0;
  for (const Term& term : terms_)
    squares += 2 * term.weight * (values.segment(term.first, term.count).norm() + offset_);
  const Index unknowns = gradient_.size();
  Eigen::Map<VectorXd> r(residuals, unknowns + 1);
  r.setZero();
  if (jacobians && jacobians[0]) {
    // With A = S V L V' S (S a scale) and R = sqrt(L) V' S: R'R = A, and R'r = g by r = R'^-1 g.
    const VectorXd scale = curvature_.diagonal().cwiseSqrt().unaryExpr(
        [](double size) { return size > 0 ? size : 1.0; });
    const VectorXd inverse = scale.cwiseInverse();
    const Eigen::SelfAdjointEigenSolver<MatrixXd> scaled(inverse.asDiagonal() * curvature_ *
                                                         inverse.asDiagonal());
    const double least = kNoCurvature * scaled.eigenvalues().maxCoeff();
    const VectorXd root = scaled.eigenvalues().unaryExpr(
        [&](double value) { return value > least ? std::sqrt(value) : 0.0; });
    const VectorXd turned = scaled.eigenvectors().transpose() * inverse.asDiagonal() * gradient_;
    for (Index j = 0; j < unknowns; ++j) r[j] = root[j] > 0 ? turned[j] / root[j] : 0;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
        jacobians[0], unknowns + 1, unknowns);
    rows.topRows(unknowns) =
        root.asDiagonal() * scaled.eigenvectors().transpose() * scale.asDiagonal();
    rows.row(unknowns).setZero();
  }
  r[unknowns] = std::sqrt(std::max(0.0, squares - r.squaredNorm()));
  return true;
}

}  // namespace catena
