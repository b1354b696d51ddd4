// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "runtime/model.hpp"

namespace catena::benchmark {

/// The 60-link cable of table 6.1 without drag, cut into any number of equal links: 3.39 m,
/// 0.1424 kg/m, load 1.47 kg, joints with the same bending stiffness and damping per length (60
/// links: 237.2412 N m/rad and 0.0336 N m s/rad).
struct Cable {
  explicit Cable(int n)
      : links(n),
        length(3.39 / n),
        mass(0.1424 * length),
        inertia(mass * length * length / 12),
        stiffness(237.2412 * n / 60),
        damping(0.0336 * n / 60) {}

  /// For a model of the plain chain. `rest_angle` is that of joint 1 (rad): a constant torque.
  Eigen::VectorXd parameters(const Model& model, double rest_angle = 0.0) const {
    Eigen::VectorXd p = model.default_parameters();
    p.segment(0, links).setConstant(length);
    p.segment(links, links).setConstant(mass);
    p.segment(2 * links, links).setConstant(inertia);
    p.segment(3 * links, links).setConstant(stiffness);
    p.segment(4 * links, links).setConstant(damping);
    p[5 * links] = stiffness * rest_angle;
    p[6 * links] = load;
    p[6 * links + 1] = gravity;
    return p;
  }

  /// In the plane or in space, free to turn at the support: there is no torque in space.
  Eigen::VectorXd hinged(const Model& model) const {
    Eigen::VectorXd p = model.default_parameters();
    if (!model.in_space()) p.segment(5 * links, links).setZero();  // torques
    p.segment(0, links).setConstant(length);
    p.segment(links, links).setConstant(mass);
    p.segment(2 * links, links).setConstant(inertia);
    p.segment(3 * links, links).setConstant(stiffness);
    p.segment(4 * links, links).setConstant(damping);
    p[model.parameter_index("stiffness_1")] = 0.0;
    p[model.parameter_index("load_mass")] = load;
    p[model.parameter_index("gravity")] = gravity;
    return p;
  }

  /// Angles of the start: from 0.6 rad at the support to 0.9 rad at the load.
  Eigen::VectorXd start() const { return Eigen::VectorXd::LinSpaced(links, 0.6, 0.9); }

  int links;
  double length, mass, inertia, stiffness, damping;
  double load = 1.47, gravity = 9.81;
};

/// Link i, from 0, for an engine: the load is part of the last link.
struct RigidLink {
  RigidLink(const Cable& cable, int i) {
    const double load = i + 1 == cable.links ? cable.load : 0.0;
    mass = cable.mass + load;
    centre = (cable.mass / 2 + load) * cable.length / mass;
    inertia = cable.inertia +
              cable.mass * (centre - cable.length / 2) * (centre - cable.length / 2) +
              load * (cable.length - centre) * (cable.length - centre);
  }

  double mass;     ///< kg
  double centre;   ///< of mass, from the upper joint, m
  double inertia;  ///< about the centre, kg m^2
};

inline Eigen::VectorXd relative_angles(const Eigen::VectorXd& absolute) {
  Eigen::VectorXd relative = absolute;
  relative.tail(absolute.size() - 1) -= absolute.head(absolute.size() - 1);
  return relative;
}

inline Eigen::VectorXd absolute_angles(const Eigen::VectorXd& relative) {
  Eigen::VectorXd absolute = relative;
  for (Eigen::Index i = 1; i < absolute.size(); ++i) absolute[i] += absolute[i - 1];
  return absolute;
}

}  // namespace catena::benchmark
