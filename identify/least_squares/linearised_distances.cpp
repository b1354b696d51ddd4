// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/linearised_distances.hpp"

#include <algorithm>
#include <cmath>

#include "linear_algebra/decompositions.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kRoundsPerUnknown = 4;  // of looking for those at bounds
constexpr double kNarrower = 0.2;       // the scale of smoothing, from one round to the next
constexpr double kNarrowest = 1e-8;     // of the first
constexpr int kSteps = 8;               // of one round
constexpr double kSettled = 1e-3;       // share of all that was gained: no more is worth a round
constexpr int kSettledRounds = 2;       // in a row that gained no more

}  // namespace

VectorXd bounded_step(const VectorXd& gradient, const MatrixXd& curvature, const VectorXd& lower,
                      const VectorXd& upper) {
  const Index unknowns = gradient.size();
  VectorXd step = VectorXd::Zero(unknowns);
  std::vector<bool> held(static_cast<std::size_t>(unknowns));
  for (Index round = 0; round < kRoundsPerUnknown * unknowns; ++round) {
    std::vector<Index> free;
    for (Index j = 0; j < unknowns; ++j)
      if (!held[static_cast<std::size_t>(j)] && curvature(j, j) > 0) free.push_back(j);
    for (const Index j : free) step[j] = 0;
    if (!free.empty()) {
      const VectorXd left = gradient + curvature * step;
      const VectorXd moved = -solve_symmetric(curvature(free, free), left(free));
      if (!moved.allFinite()) return VectorXd::Zero(unknowns);
      bool outside = false;
      for (std::size_t i = 0; i < free.size(); ++i) {
        const Index j = free[i];
        step[j] = std::clamp(moved[static_cast<Index>(i)], lower[j], upper[j]);
        if (step[j] == moved[static_cast<Index>(i)]) continue;
        held[static_cast<std::size_t>(j)] = true;
        outside = true;
      }
      if (outside) continue;
    }
    // Lets go what would rather be between its bounds, one after the other.
    const VectorXd slope = gradient + curvature * step;
    Index freed = 0;
    while (freed < unknowns &&
           !(held[static_cast<std::size_t>(freed)] &&
             (step[freed] == lower[freed] ? slope[freed] < 0 : slope[freed] > 0)))
      ++freed;
    if (freed == unknowns) break;
    held[static_cast<std::size_t>(freed)] = false;
  }
  return step;
}

LinearisedDistances::LinearisedDistances(const VectorXd& residuals, const MatrixXd& jacobian,
                                         const std::vector<WeightedDistance>& points,
                                         const MatrixXd& bend)
    : residuals_(residuals), jacobian_(jacobian), points_(points), bend_(bend) {}

/// Calls visit(point, side, down) with what the two residuals of each point become; down is 0 where
/// there is but one.
template <class Visit>
void LinearisedDistances::for_each(const VectorXd& step, Visit visit) const {
  const VectorXd there = residuals_ + jacobian_ * step;
  for (const WeightedDistance& point : points_)
    visit(point, there[point.first], point.count == 2 ? there[point.first + 1] : 0);
}

double LinearisedDistances::value(const VectorXd& step, double width) const {
  double sum = step.dot(bend_ * step) / 2;
  for_each(step, [&](const WeightedDistance& point, double side, double down) {
    sum += point.weight * std::sqrt(side * side + down * down + width * width);
  });
  return sum;
}

VectorXd LinearisedDistances::gradient(const VectorXd& step, double width) const {
  VectorXd by_residual(residuals_.size());
  for_each(step, [&](const WeightedDistance& point, double side, double down) {
    const double size = std::sqrt(side * side + down * down + width * width);
    const double a = size > 0 ? point.weight / size : 0;
    by_residual[point.first] = a * side;
    if (point.count == 2) by_residual[point.first + 1] = a * down;
  });
  return jacobian_.transpose() * by_residual + bend_ * step;
}

MatrixXd LinearisedDistances::curvature(const VectorXd& step, double width, Curvature kind) const {
  // J' K J; K of a point is a 1 - b r r', of two rows, the second of them next to the first.
  const bool own = kind == Curvature::kOwn;
  const Index size = residuals_.size(), last = size - 1;
  VectorXd along(size), across = VectorXd::Zero(size);
  for_each(step, [&](const WeightedDistance& point, double side, double down) {
    const double square = side * side + down * down + width * width;
    const double a = square > 0 ? point.weight / std::sqrt(square) : 0;
    const double b = own && square > 0 ? a / square : 0;
    const Index i = point.first;
    along[i] = a - b * side * side;
    if (point.count != 2) return;
    along[i + 1] = a - b * down * down;
    across[i] = -b * side * down;
  });
  MatrixXd weighted = along.asDiagonal() * jacobian_;
  if (own) {
    weighted.topRows(last) += across.head(last).asDiagonal() * jacobian_.bottomRows(last);
    weighted.bottomRows(last) += across.head(last).asDiagonal() * jacobian_.topRows(last);
  }
  return bend_ + jacobian_.transpose() * weighted;
}

VectorXd LinearisedDistances::minimum(double width, const VectorXd& lower,
                                      const VectorXd& upper) const {
  const double narrowest = kNarrowest * width;
  VectorXd step = VectorXd::Zero(lower.size()), best = step;
  const double start = value(step, 0);
  double least = start;
  int settled = 0;  // rounds in a row
  for (; width > narrowest && settled < kSettledRounds; width *= kNarrower) {
    const double before = least;
    for (int round = 0; round < kSteps; ++round) {
      const double here = value(step, width);
      const VectorXd slope = gradient(step, width);
      double there = here;
      VectorXd tried;
      for (const Curvature kind : {Curvature::kOwn, Curvature::kReweighted}) {
        tried =
            step + bounded_step(slope, curvature(step, width, kind), lower - step, upper - step);
        there = value(tried, width);
        if (there < here) break;
      }
      if (!(there < here)) break;
      step = tried;
      if (here - there <= kSettled * (start - least)) break;
    }
    const double now = value(step, 0);
    if (now < least) {
      least = now;
      best = step;
    }
    settled = least < start && before - least <= kSettled * (start - least) ? settled + 1 : 0;
  }
  return best;
}

}  // namespace catena
