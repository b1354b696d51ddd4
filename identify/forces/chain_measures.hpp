// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/forces/force_pattern.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// The chain that forces act on.
struct ChainMeasures : LinkChain {
  Eigen::VectorXd masses;  ///< of the links, kg
  double load = 0;         ///< kg
  double length = 0;       ///< m
  double gravity = 0;      ///< m/s^2

  /// At the values `x` of the problem's unknowns, of one of its experiments.
  ChainMeasures(const Problem& problem, const Eigen::VectorXd& x, int experiment);
};

}  // namespace catena
