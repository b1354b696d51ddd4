// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"

namespace catena::testing {

/// Parameters of the plain chain: the cable of table 6.1 (3.39 m, 0.1424 kg/m, load 1.47 kg), cut
/// into equal uniform links, every joint with the given stiffness (N m/rad) and damping (N m
/// s/rad).
inline Eigen::VectorXd cable_parameters(const Model& model, double stiffness, double damping) {
  const int n = model.links();
  const double length = 3.39 / n, mass = 0.1424 * length;
  Eigen::VectorXd p = model.default_parameters();
  p.segment(0, n).setConstant(length);
  p.segment(n, n).setConstant(mass);
  p.segment(2 * n, n).setConstant(mass * length * length / 12);
  p.segment(3 * n, n).setConstant(stiffness);
  p.segment(4 * n, n).setConstant(damping);
  p[6 * n] = 1.47;
  return p;
}

}  // namespace catena::testing
