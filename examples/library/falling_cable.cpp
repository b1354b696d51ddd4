// SPDX-License-Identifier: BSD-3-Clause
//
// catena::runtime: a cable of 12 links falls from a catenary. Then: the derivative of the position
// of the load after one second with respect to the stiffness of the joints.
#include <cstdio>

#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"

int main() {
  const catena::Model model = catena::Model::built_in(12);
  const int links = model.links();
  const double length = 3.39 / links;  // m
  const double mass = 0.1424 * length;

  Eigen::VectorXd parameters = model.default_parameters();
  auto set = [&](const std::string& family, double value) {
    for (int i = 1; i <= links; ++i)
      parameters[model.parameter_index(family + "_" + std::to_string(i))] = value;
  };
  set("length", length);
  set("mass", mass);
  set("inertia", mass * length * length / 12);
  set("stiffness", 0.5);  // N m/rad
  set("damping", 1e-3);   // N m s/rad
  parameters[model.parameter_index("load_mass")] = 1.47;

  // One direction: all joint stiffnesses together.
  catena::SensitivityDirection stiffness = catena::SensitivityDirection::zero(model);
  for (int i = 1; i <= links; ++i)
    stiffness.parameters[model.parameter_index("stiffness_" + std::to_string(i))] = 1.0;

  const catena::State start = catena::catenary(model, parameters, {1.5, 2.5});
  const catena::SensitiveSimulation simulation =
      catena::simulate_with_sensitivities(model, parameters, start, {stiffness}, {0.0, 0.5, 1.0});
  if (simulation.status != catena::Status::kSuccess) {
    std::fprintf(stderr, "%s\n", simulation.message.c_str());
    return 1;
  }

  const Eigen::VectorXd q = simulation.trajectory.q.col(2);
  const Eigen::VectorXd dq = simulation.sensitivity[0].q.col(2);
  const catena::Positions at = catena::positions(model, parameters, 1.0, q);
  const catena::Positions change =
      catena::positions_tangent(model, parameters, 1.0, q, stiffness.parameters, dq);
  std::printf("load after 1 s: side %.4f m, down %.4f m\n", at.side[links + 1], at.down[links + 1]);
  std::printf("per N m/rad:    side %+.2e m, down %+.2e m\n", change.side[links + 1],
              change.down[links + 1]);
}
