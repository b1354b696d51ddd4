// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cvodes/cvodes.h>

#include <functional>
#include <utility>

#include "benchmarks/peer.hpp"

namespace catena::benchmark {

/// ydot = f(y) with y = (q, v), and what solves CVODE's linear equations.
struct BdfEquations {
  CVRhsFn rates;
  CVLsJacFn jacobian;  ///< null: CVODE takes difference quotients
  void* user;
  std::function<std::pair<SUNMatrix, SUNLinearSolver>(N_Vector, SUNContext)> make_solver;
};

/// CVODE's BDF from the cable's start at rest; its absolute tolerance is a hundredth of the relative.
Solution simulate_cvode_bdf(const Cable& cable, const std::vector<double>& times,
                            double relative_tolerance, const BdfEquations& equations);

}  // namespace catena::benchmark
