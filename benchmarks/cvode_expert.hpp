// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "benchmarks/peer.hpp"

namespace catena::benchmark {

/// What an expert would build from SUNDIALS: CVODE's BDF on ydot = (v, a) with the functions of
/// expert.hpp, and a linear solver of one's own for (I - gamma J) x = b in O(n): eliminating the
/// angles leaves (M + gamma D + gamma^2 K) x_v = M b_v - gamma K b_q.
Solution simulate_cvode_expert(const Cable& cable, double rest_angle,
                               const std::vector<double>& times, double relative_tolerance);

}  // namespace catena::benchmark
