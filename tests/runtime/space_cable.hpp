// SPDX-License-Identifier: BSD-3-Clause
//
// A cable in space, and a hand that holds it, for tests.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"

namespace testing {

using catena::Model;
using catena::State;
using Eigen::VectorXd;

inline constexpr double kGravity = 9.81;

/// A cable of 1.2 m with a load of 0.3 kg; per joint: stiffness (N m/rad), damping (N m s/rad).
inline VectorXd cable(const Model& model, double stiffness, double damping) {
  const Eigen::Index n = model.links();
  const double length = 1.2 / model.links(), mass = 0.15 * length;
  VectorXd p = model.default_parameters();
  p.segment(0, n).setConstant(length);
  p.segment(n, n).setConstant(mass);
  p.segment(2 * n, n).setConstant(mass * length * length / 12);
  p.segment(3 * n, n).setConstant(stiffness);
  p.segment(4 * n, n).setConstant(damping);
  p[model.parameter_index("load_mass")] = 0.3;
  p[model.parameter_index("gravity")] = kGravity;
  return p;
}

inline void set(const Model& model, VectorXd& parameters, const char* name, double value) {
  parameters[model.parameter_index(name)] = value;
}

/// The vector turned as the shortest turn of the unit vector `from` to `to` turns it. (Reading Eigen's
/// Quaterniond::FromTwoVectors takes ten seconds: it has a singular value decomposition.)
inline Eigen::Vector3d carried(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                               const Eigen::Vector3d& vector) {
  const Eigen::Vector3d axis = from.cross(to), first = axis.cross(vector);
  return vector + first + axis.cross(first) / (1 + from.dot(to));
}

/// Vector i of `links` vectors that are stored by axis, as q and v are.
inline Eigen::Vector3d vector_of(const VectorXd& all, Eigen::Index links, Eigen::Index i) {
  return {all[i], all[links + i], all[2 * links + i]};
}

inline catena::SimulationOptions tight() {
  catena::SimulationOptions options;
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance_position = 1e-12;
  options.absolute_tolerance_velocity = 1e-11;
  return options;
}

/// Angles and azimuths that differ from link to link, and rates: nothing stays in a plane.
inline State askew(const Model& model) {
  const int n = model.links();
  return from_directions(model, {VectorXd::LinSpaced(n, 0.3, 1.1), VectorXd::LinSpaced(n, 0.2, 1.5),
                                 VectorXd::LinSpaced(n, 1.0, -1.0), VectorXd::Constant(n, 0.8)});
}

inline std::vector<catena::SensitivityDirection> directions_of(
    const Model& model, const std::vector<const char*>& names) {
  std::vector<catena::SensitivityDirection> directions;
  directions.reserve(names.size());
  for (const char* name : names)
    directions.push_back(
        catena::SensitivityDirection::parameter(model, model.parameter_index(name)));
  return directions;
}

inline catena::Simulation run(const Model& model, const VectorXd& parameters, const State& initial,
                              const std::vector<double>& times) {
  catena::Simulation result = simulate(model, parameters, initial, times, tight());
  REQUIRE_MESSAGE(result.status == catena::Status::kSuccess, result.message);
  return result;
}

/// The six signals of hand.toml over 4 s: position (m) and direction of the clamp as functions of time.
inline catena::Signals hand(auto position, auto direction) {
  catena::Signals signals;
  std::vector<double> times(4001);
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = 1e-3 * static_cast<double>(k);
  const char* axes[] = {"side", "down", "across"};
  const auto add = [&](const std::string& what, int axis, auto vector) {
    std::vector<double> values;
    values.reserve(times.size());
    for (const double t : times) values.push_back(vector(t)[axis]);
    signals.add(what + axes[axis], times, values);
  };
  for (int axis = 0; axis < 3; ++axis) add("hand.hand_", axis, position);
  for (int axis = 0; axis < 3; ++axis) add("hand.grip_", axis, direction);
  return signals;
}

}  // namespace testing
