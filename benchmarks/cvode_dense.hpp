// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmarks/peer.hpp"

namespace catena::benchmark {

/// The usual way: CVODE's BDF on ydot = (v, a) with a from the dense mass matrix by Cholesky, and
/// CVODE's own dense linear solver with its difference-quotient Jacobian.
Solution simulate_cvode_dense(const Cable& cable, double rest_angle,
                              const std::vector<double>& times, double relative_tolerance);

}  // namespace catena::benchmark
