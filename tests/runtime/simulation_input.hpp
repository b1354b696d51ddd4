// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "runtime/simulation.hpp"

namespace catena::testing {

/// From 0 to `last` (s), with so many intervals between.
inline std::vector<double> even_times(double last, int intervals) {
  std::vector<double> times;
  for (int i = 0; i <= intervals; ++i) times.push_back(last * i / intervals);
  return times;
}

/// Tolerances of positions (rad) and velocities (rad/s) that go with a relative one.
inline SimulationOptions with_tolerance(double relative) {
  SimulationOptions options;
  options.relative_tolerance = relative;
  options.absolute_tolerance_position = 1e-2 * relative;
  options.absolute_tolerance_velocity = 1e-1 * relative;
  return options;
}

}  // namespace catena::testing
