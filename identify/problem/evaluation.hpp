// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "identify/problem/problem.hpp"

namespace catena {

/// Predictions of all experiments (those to be fitted, or all) and, if asked for, their derivatives
/// by the unknowns.
struct Evaluation {
  Eigen::VectorXd x;                    ///< the unknowns
  std::vector<Prediction> predictions;  ///< one per experiment; kNotRun where not asked for
  bool with_jacobian = false;
  bool ok = false;      ///< every prediction asked for succeeded and is finite
  std::string message;  ///< of the first failure: "run 1: theta_7 at t = 1.23 s"
};

/// The frames that are fitted, or those that only validate.
enum class Part { kFit, kValidation };

/// Simulates a problem at x. `all`: validation too (longer simulations), else only what is fitted;
/// then the first failure ends it. `jacobian`: with derivatives by every unknown. `keep_going`:
/// asked at every step with its time (s); false ends the simulation. Simulations that fail say so in the result.
Evaluation evaluate(const Problem& problem, const Eigen::VectorXd& x, bool all, bool jacobian,
                    const std::function<bool(double)>& keep_going = {});

}  // namespace catena
