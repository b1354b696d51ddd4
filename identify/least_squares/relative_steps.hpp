// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ceres/manifold.h>

#include <Eigen/Core>
#include <vector>

namespace catena {

/// How Ceres steps where some unknowns are logarithms, y = log p. What is simulated goes more nearly with p than with its
/// logarithm, and the other unknowns step as if it did. So a step s takes p to p (1 + s), and not to
/// p e^s. Below p / 4, where p must stay positive, it goes on with y. Other unknowns are stepped by s.
class RelativeSteps : public ceres::Manifold {
 public:
  /// `logarithms`: of every unknown, whether it is one.
  explicit RelativeSteps(std::vector<bool> logarithms) : logarithms_(std::move(logarithms)) {}

  /// The steps from y to bounds of y, of logarithms to p / 4 at most.
  struct Box {
    Eigen::VectorXd lower, upper;
  };
  Box box(const Eigen::VectorXd& y, const Eigen::VectorXd& lower,
          const Eigen::VectorXd& upper) const;

  /// The interface of Ceres.
  int AmbientSize() const override { return static_cast<int>(logarithms_.size()); }
  int TangentSize() const override { return AmbientSize(); }
  bool Plus(const double* y, const double* step, double* sum) const override;
  bool PlusJacobian(const double* y, double* jacobian) const override;
  bool Minus(const double* sum, const double* y, double* step) const override;
  bool MinusJacobian(const double* y, double* jacobian) const override;

 private:
  std::vector<bool> logarithms_;
};

}  // namespace catena
