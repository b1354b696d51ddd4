// SPDX-License-Identifier: BSD-3-Clause
#include "identify/least_squares/relative_steps.hpp"

#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// The step to a quarter. The linearised problem is not believed beyond.
constexpr double kQuarter = 0.25, kLowest = kQuarter - 1;

double logarithm_changes(double step) {
  return step >= kLowest ? std::log1p(step) : (step - kLowest) / kQuarter + std::log(kQuarter);
}

double step_that_changes(double logarithm) {
  return logarithm >= std::log(kQuarter) ? std::expm1(logarithm)
                                         : (logarithm - std::log(kQuarter)) * kQuarter + kLowest;
}

}  // namespace

RelativeSteps::Box RelativeSteps::box(const VectorXd& y, const VectorXd& lower,
                                      const VectorXd& upper) const {
  Box box{lower - y, upper - y};
  for (Index j = 0; j < y.size(); ++j) {
    if (!logarithms_[static_cast<std::size_t>(j)]) continue;
    box.lower[j] = std::max(step_that_changes(box.lower[j]), kLowest);
    box.upper[j] = step_that_changes(box.upper[j]);
  }
  box.lower = box.lower.cwiseMin(0);
  box.upper = box.upper.cwiseMax(0);
  return box;
}

bool RelativeSteps::Plus(const double* y, const double* step, double* sum) const {
  for (std::size_t j = 0; j < logarithms_.size(); ++j)
    sum[j] = y[j] + (logarithms_[j] ? logarithm_changes(step[j]) : step[j]);
  return true;
}

bool RelativeSteps::Minus(const double* sum, const double* y, double* step) const {
  for (std::size_t j = 0; j < logarithms_.size(); ++j)
    step[j] = logarithms_[j] ? step_that_changes(sum[j] - y[j]) : sum[j] - y[j];
  return true;
}

bool RelativeSteps::PlusJacobian(const double*, double* jacobian) const {
  Eigen::Map<MatrixXd>(jacobian, AmbientSize(), AmbientSize()).setIdentity();
  return true;
}

bool RelativeSteps::MinusJacobian(const double* y, double* jacobian) const {
  return PlusJacobian(y, jacobian);
}

}  // namespace catena
