// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// The residuals of one point (two numbers, or one) and what their norm, a distance, counts.
struct WeightedDistance {
  Eigen::Index first = 0, count = 0;  // residuals
  double weight = 0;
};

/// The s with the least g's + s'As / 2 between the bounds, which hold 0 between them. All have one
/// entry per unknown. Unknowns with zero curvature stay fixed.
Eigen::VectorXd bounded_step(const Eigen::VectorXd& gradient, const Eigen::MatrixXd& curvature,
                             const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);

/// What a weighted sum of distances becomes a step s of the unknowns away, the residuals linearised
/// and all else left as it is, kinks included:
///
///     F(s) = sum over the points of w |r + J s|  +  s'Bs / 2
///
/// Smoothed on a scale h, d = |r + J s|, u along and t across it, a point has
///
///     value w sqrt(d^2 + h^2),  gradient w d a J'u,  curvature w J' (a t t' + h^2 a^3 u u') J,
///     a = 1 / sqrt(d^2 + h^2)
///
/// and w a J'J is a curvature with which a step never overshoots (reweighted least squares).
class LinearisedDistances {
 public:
  /// All are kept by reference, `bend` is B.
  LinearisedDistances(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& jacobian,
                      const std::vector<WeightedDistance>& points, const Eigen::MatrixXd& bend);

  /// F(s), smoothed on a scale of `width`.
  double value(const Eigen::VectorXd& step, double width) const;

  /// Gradient of F, smoothed.
  Eigen::VectorXd gradient(const Eigen::VectorXd& step, double width) const;
  /// Curvature of F, smoothed, or that of reweighting.
  enum class Curvature { kOwn, kReweighted };
  Eigen::MatrixXd curvature(const Eigen::VectorXd& step, double width, Curvature kind) const;

  /// The s between `lower` and `upper`, which hold 0 between them, with the least F: smoothed
  /// first on a scale of `width`, then ever less until F falls by no more than a
  /// thousandth of what was gained. 0 if nothing is lower.
  Eigen::VectorXd minimum(double width, const Eigen::VectorXd& lower,
                          const Eigen::VectorXd& upper) const;

 private:
  template <class Visit>
  void for_each(const Eigen::VectorXd& step, Visit visit) const;

  const Eigen::VectorXd& residuals_;
  const Eigen::MatrixXd& jacobian_;
  const std::vector<WeightedDistance>& points_;
  const Eigen::MatrixXd& bend_;
};

}  // namespace catena
