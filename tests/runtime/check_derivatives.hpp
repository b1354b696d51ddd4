// SPDX-License-Identifier: BSD-3-Clause
//
// The derivatives of a motion by one parameter, for tests.
#pragma once

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "runtime/adjoint.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/support/near.hpp"

namespace testing {

struct Slope {
  std::string parameter;
  double step;
  Eigen::Index row;  // of q, which differs
};

// Forward sensitivities, the adjoint and both linear solvers against differences.
inline void check_derivatives(const Model& model, const VectorXd& p, const State& initial,
                              const catena::Signals& signals, const Slope& slope) {
  CHECK(model.table().structured == 1);
  catena::SimulationOptions dense = tight();
  dense.linear_solver = catena::LinearSolver::kDense;
  const int parameter = model.parameter_index(slope.parameter);
  const auto direction = catena::SensitivityDirection::parameter(model, parameter);
  const std::vector<double> times{0, 0.4};
  const auto blocks =
      simulate_with_sensitivities(model, p, initial, {direction}, times, tight(), signals);
  const auto whole =
      simulate_with_sensitivities(model, p, initial, {direction}, times, dense, signals);
  REQUIRE_MESSAGE(blocks.status == catena::Status::kSuccess, blocks.message);
  REQUIRE_MESSAGE(whole.status == catena::Status::kSuccess, whole.message);
  CHECK(blocks.statistics.used == catena::LinearSolver::kStructured);
  CHECK((blocks.trajectory.q.col(1) - whole.trajectory.q.col(1)).norm() < 1e-8);
  const VectorXd change = blocks.sensitivity[0].q.col(1);
  CHECK((whole.sensitivity[0].q.col(1) - change).norm() < 1e-6 * change.norm());
  VectorXd more = p, less = p;
  more[parameter] += slope.step, less[parameter] -= slope.step;
  const auto at = [&](const VectorXd& values) -> VectorXd {
    return simulate(model, values, initial, times, tight(), signals).trajectory.q.col(1);
  };
  const VectorXd difference = (at(more) - at(less)) / (2 * slope.step);
  CHECK(std::abs(difference[slope.row]) > 1e-4);
  CHECK((change - difference).norm() < 1e-5 * change.norm());
  const auto objective = [&](const catena::Trajectory& motion, catena::Trajectory& by) {
    by.q(slope.row, motion.q.cols() - 1) = 1.0;
  };
  const auto gradient =
      simulate_with_gradient(model, p, initial, times, objective, tight(), signals);
  REQUIRE_MESSAGE(gradient.status == catena::Status::kSuccess, gradient.message);
  CHECK(gradient.gradient.parameters[parameter] == catena::near(change[slope.row], 1e-5));
}

}  // namespace testing
