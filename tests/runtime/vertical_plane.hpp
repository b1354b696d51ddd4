// SPDX-License-Identifier: BSD-3-Clause
//
// A motion in a vertical plane, by a model of the plane and by its counterpart in space.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "tests/runtime/space_cable.hpp"

namespace testing {

inline constexpr double kPlaneAzimuth = -2.1;  // of the vertical plane, rad

/// One start for the model of the plane and for the one in space.
struct PlanarStart {
  State plane;
  State space;
};

/// Angles and rates that differ from link to link.
inline PlanarStart planar_start(const Model& plane, const Model& space) {
  const int n = plane.links();
  const VectorXd angles = VectorXd::LinSpaced(n, 0.2, 1.3), rates = VectorXd::LinSpaced(n, 1, -2);
  PlanarStart start{from_angles(plane, angles),
                    from_directions(space, {angles, VectorXd::Constant(n, kPlaneAzimuth), rates,
                                            VectorXd::Zero(n)})};
  start.plane.v.head(n) = rates;
  return start;
}

struct PlanarMotions {
  catena::Trajectory plane;
  catena::Trajectory space;
};

/// Checks that both models move all joints alike for 1 s, and returns the motions at 0, 0.25, 0.5 and 1 s.
inline PlanarMotions check_motion_in_plane(const Model& plane, const VectorXd& of_plane,
                                           const Model& space, const VectorXd& of_space,
                                           const PlanarStart& start) {
  const double tolerance = 1e-8;  // m: errors of 1e-11 a step, some thousand steps
  const std::vector<double> times{0, 0.25, 0.5, 1};
  const PlanarMotions motions{run(plane, of_plane, start.plane, times).trajectory,
                              run(space, of_space, start.space, times).trajectory};
  for (std::size_t k = 0; k < times.size(); ++k) {
    CAPTURE(k);
    const auto column = static_cast<Eigen::Index>(k);
    const auto there = positions(plane, of_plane, times[k], motions.plane.q.col(column));
    const auto here = positions(space, of_space, times[k], motions.space.q.col(column));
    CHECK((here.side - std::cos(kPlaneAzimuth) * there.side).cwiseAbs().maxCoeff() < tolerance);
    CHECK((here.across - std::sin(kPlaneAzimuth) * there.side).cwiseAbs().maxCoeff() < tolerance);
    CHECK((here.down - there.down).cwiseAbs().maxCoeff() < tolerance);
  }
  return motions;
}

}  // namespace testing
