// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/distance_cost.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kStillFar = 0.5;   // the error fell by more than this share of itself
constexpr double kWidth = 0.3;      // of the mean distance: kinks smoothed for a curvature
constexpr std::size_t kKinks = 70;  // of each unknown, at least, if they are smoothed alone

}  // namespace

DistanceCost::DistanceCost(const SimulatedResiduals& simulated,
                           std::vector<WeightedDistance> points, double offset, double tolerance,
                           Box box)
    : simulated_(simulated),
      points_(std::move(points)),
      offset_(offset),
      tolerance_(tolerance),
      box_(std::move(box)) {
  const int unknowns = static_cast<int>(box_.reach.size());
  set_num_residuals(unknowns + 1);
  mutable_parameter_block_sizes()->push_back(unknowns);
}

double DistanceCost::all_offsets() const {
  double sum = 0;
  for (const WeightedDistance& point : points_) sum += point.weight * offset_;
  return sum;
}

MatrixXd DistanceCost::bend_since(const VectorXd& y, const MatrixXd& curvature) const {
  const Index unknowns = y.size();
  const MatrixXd& jacobian = simulated_.residuals().jacobian;
  const MatrixXd none = MatrixXd::Zero(unknowns, unknowns);
  if (!y_.size()) return none;
  const MatrixXd since = jacobian - jacobian_;
  VectorXd change = LinearisedDistances(simulated_.residuals().value, since, points_, none)
                        .gradient(VectorXd::Zero(unknowns), 0);
  // An unknown that came to rest at a bound, or left it, changed its column, not the motion.
  for (Index j = 0; j < unknowns; ++j)
    if (jacobian.col(j).isZero(0) || jacobian_.col(j).isZero(0)) change[j] = 0;
  const VectorXd step = y - y_, all = curvature * step + change;
  const double bent = change.dot(step), found = all.dot(step);
  return bent > 0 ? MatrixXd(bent / (found * found) * all * all.transpose()) : none;
}

/// Over which the kinks of so many points are smoothed that their curvature is that of all. Or 0
/// if they are too few for that.
double DistanceCost::smooth_width() const {
  const VectorXd& r = simulated_.residuals().value;
  std::vector<double> distances;
  for (const WeightedDistance& point : points_)
    distances.push_back(r.segment(point.first, point.count).norm());
  const std::size_t enough = kKinks * static_cast<std::size_t>(box_.reach.size());
  if (distances.size() <= enough) return 0;
  const auto found = distances.begin() + static_cast<std::ptrdiff_t>(enough);
  std::nth_element(distances.begin(), found, distances.end());
  return *found < kWidth * simulated_.error() ? *found : 0;
}

void DistanceCost::step_to(const VectorXd& y) {
  const bool far = simulated_.error() < (1 - kStillFar) * simulated_.error_before();
  const Residuals& all = simulated_.residuals();
  const VectorXd here = VectorXd::Zero(y.size()), lower = box_.lower - y, upper = box_.upper - y;
  const MatrixXd flat = MatrixXd::Zero(y.size(), y.size());
  const double smooth = far ? 0 : smooth_width();
  const double width = smooth > 0 ? smooth : kWidth * simulated_.error();
  const LinearisedDistances straight(all.value, all.jacobian, points_, flat);
  using Curvature = LinearisedDistances::Curvature;
  model_.gradient = straight.gradient(here, 0);
  model_.curvature =
      straight.curvature(here, width, far ? Curvature::kReweighted : Curvature::kOwn);
  MatrixXd bend = bend_since(y, model_.curvature);
  bend.diagonal() += model_.gradient.cwiseAbs().cwiseQuotient(box_.reach);
  model_.curvature += bend;
  y_ = y;
  jacobian_ = all.jacobian;
  gain_ = std::numeric_limits<double>::infinity();
  if (far) return;

  VectorXd step;
  double gain = 0;
  const double now = straight.value(here, 0);
  if (smooth > 0) {
    step = bounded_step(model_.gradient, model_.curvature, lower, upper);
    gain = model_.gain(step);
  } else {
    const LinearisedDistances distances(all.value, jacobian_, points_, bend);
    step = distances.minimum(width, lower, upper);
    gain = now - distances.value(step, 0);
  }
  gain_ = gain / now;
  if (gain_ <= tolerance_)
    model_.gradient.setZero();  // there already
  else if (smooth == 0)
    model_.put_minimum(step, gain);
}

bool DistanceCost::Evaluate(double const* const*, double* residuals, double** jacobians) const {
  if (!simulated_.ok()) return false;
  const VectorXd& values = simulated_.residuals().value;
  double squares = 0;
  for (const WeightedDistance& point : points_)
    squares += 2 * point.weight * (values.segment(point.first, point.count).norm() + offset_);
  const Index unknowns = model_.gradient.size();
  Eigen::Map<VectorXd> r(residuals, unknowns + 1);
  r.setZero();
  if (jacobians && jacobians[0]) {
    const LinearRows of_model = model_.rows();
    r.head(unknowns) = of_model.value;
    Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> rows(
        jacobians[0], unknowns + 1, unknowns);
    rows.topRows(unknowns) = of_model.jacobian;
    rows.row(unknowns).setZero();
  }
  r[unknowns] = std::sqrt(std::max(0.0, squares - r.squaredNorm()));
  return true;
}

}  // namespace catena
