// SPDX-License-Identifier: BSD-3-Clause
//
// Models that are extreme but legal. A simulation of one is right, or its status says what to change;
// it is never wrong with success. Right is what the closed forms of chapter 4 give with a tolerance of
// 1e-11.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "common/impossible_value.hpp"
#include "runtime/any_links.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/reference_model.hpp"

namespace {

using catena::Model;
using catena::Simulation;
using catena::SimulationOptions;
using catena::State;
using catena::Status;
using catena::testing::cable_parameters;
using catena::testing::reference_model;

constexpr int kLinks = 4;

struct Cable {
  double length = 3.39, density = 0.1424, load = 1.47, gravity = 9.81;
  double bending_stiffness = 0.1, damping = 0.01, angle = 0.3, rate = 0, duration = 1.0;
  double relative_tolerance = 1e-8;
};

Eigen::VectorXd parameters_of(const Model& model, const Cable& cable) {
  const int n = model.links();
  const double length = cable.length / n, mass = cable.density * length;
  Eigen::VectorXd p = model.default_parameters();
  p.segment(0, n).setConstant(length);
  p.segment(n, n).setConstant(mass);
  p.segment(2 * n, n).setConstant(mass * length * length / 12);
  p.segment(3 * n, n).setConstant(cable.bending_stiffness / length);
  p.segment(4 * n, n).setConstant(cable.damping);
  p[6 * n] = cable.load;
  p[6 * n + 1] = cable.gravity;
  return p;
}

Simulation simulated(const Model& model, const Cable& cable, SimulationOptions options = {}) {
  State initial = catena::straight(model, cable.angle);
  initial.v.setConstant(cable.rate);
  return catena::simulate(model, parameters_of(model, cable), initial,
                          {0.0, cable.duration / 2, cable.duration}, options);
}

/// The energies' greatest change, J.
double energy_moved(const Simulation& run) {
  const Eigen::MatrixXd& energy = run.trajectory.energy;
  return (energy.rowwise().maxCoeff() - energy.rowwise().minCoeff()).maxCoeff();
}

TEST_CASE("extreme cables move as the closed forms say, or the status says what to change") {
  struct Row {
    std::string what;
    std::function<void(Cable&)> change;
    const char* words;  // of the message where it is not simulated; empty: it must be
  };
  const std::vector<Row> rows = {
      {"bending stiffness 1e-12", [](Cable& c) { c.bending_stiffness = 1e-12; }, ""},
      {"no stiffness", [](Cable& c) { c.bending_stiffness = 0; }, ""},
      {"bending stiffness 1e6, 10 ms",
       [](Cable& c) { c.bending_stiffness = 1e6, c.duration = 0.01; }, ""},
      {"bending stiffness 1e12", [](Cable& c) { c.bending_stiffness = 1e12; }, "less stiff"},
      {"bending stiffness 1e6, damped",
       [](Cable& c) { c.bending_stiffness = 1e6, c.damping = 1e5; }, ""},
      {"bending stiffness 1e15", [](Cable& c) { c.bending_stiffness = 1e15; }, "less stiff"},
      {"bending stiffness 1e48", [](Cable& c) { c.bending_stiffness = 1e48; }, "less stiff"},
      {"no damping", [](Cable& c) { c.damping = 0; }, ""},
      {"damping 1e6", [](Cable& c) { c.damping = 1e6; }, ""},
      {"no load", [](Cable& c) { c.load = 0; }, ""},
      {"load 1e6 kg", [](Cable& c) { c.load = 1e6; }, ""},
      {"links of 1e-6 kg/m", [](Cable& c) { c.density = 1e-6, c.damping = 1e-3; }, ""},
      {"links of 1e6 kg/m", [](Cable& c) { c.density = 1e6; }, ""},
      {"no gravity", [](Cable& c) { c.gravity = 0; }, ""},
      {"gravity 1e6", [](Cable& c) { c.gravity = 1e6, c.duration = 0.01; }, ""},
      {"links of 1 mm",
       [](Cable& c) { c.length = 4e-3, c.bending_stiffness = 1e-6, c.damping = 1e-8; }, ""},
      {"links of 1 km", [](Cable& c) { c.length = 4e3; }, ""},
      {"tolerance 1e-12", [](Cable& c) { c.relative_tolerance = 1e-12; }, ""},
      {"tolerance 1e-30", [](Cable& c) { c.relative_tolerance = 1e-30; }, ""},
      {"one turn and a half", [](Cable& c) { c.angle = 9; }, ""},
      {"1e10 rad/s", [](Cable& c) { c.rate = 1e10; }, "beyond 2^30 rad"},
  };
  const Model model = Model::built_in(kLinks), reference(reference_model<kLinks>());
  for (const Row& row : rows) {
    INFO(row.what);
    Cable cable;
    row.change(cable);
    SimulationOptions options;
    options.relative_tolerance = cable.relative_tolerance;
    const Simulation run = simulated(model, cable, options);
    INFO(run.message);
    if (run.status != Status::kSuccess) {
      CHECK(*row.words != '\0');
      CHECK(run.message.find(row.words) != std::string::npos);
      CHECK(run.message.find("nan") == std::string::npos);
      CHECK(run.statistics.steps <= 100'000);
      continue;
    }
    CHECK(*row.words == '\0');
    options.relative_tolerance = 1e-11;
    options.absolute_tolerance_position = 1e-13;
    options.absolute_tolerance_velocity = 1e-12;
    const Simulation right = simulated(reference, cable, options);
    INFO(right.message);
    CHECK(right.status == Status::kSuccess);
    if (right.status != Status::kSuccess) continue;
    CHECK((run.trajectory.q - right.trajectory.q).cwiseAbs().maxCoeff() < 1e-5);
    CHECK(run.energy_imbalance <= 1e-4 * energy_moved(run));
  }
}

TEST_CASE("parameters whose products overflow are refused: such a damper moved by itself") {
  const Model model = Model::built_in(kLinks);
  for (const auto& change :
       {+[](Cable& c) { c.damping = 1e200; }, +[](Cable& c) { c.bending_stiffness = 1e300; },
        +[](Cable& c) { c.gravity = -1e60; }}) {
    Cable cable;
    change(cable);
    CHECK_THROWS_WITH_AS(simulated(model, cable), doctest::Contains("is more than 1e+50"),
                         catena::ImpossibleValue);
  }
}

TEST_CASE("a thousand links keep their energy, and a smaller tolerance changes nothing") {
  const Model model = catena::any_links_model(1000);
  Cable cable;
  cable.bending_stiffness = 1e-3;
  cable.damping = 1e-4;
  cable.duration = 0.2;
  const Simulation run = simulated(model, cable);
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.energy_imbalance <= 1e-5 * energy_moved(run));
  SimulationOptions closer;
  closer.relative_tolerance = 1e-9;
  const Simulation other = simulated(model, cable, closer);
  REQUIRE(other.status == Status::kSuccess);
  CHECK((run.trajectory.q - other.trajectory.q).cwiseAbs().maxCoeff() < 1e-4);
}

TEST_CASE("an hour later a damped cable hangs at rest") {
  const Model model = Model::built_in(2);
  Cable cable;
  cable.damping = 0.5;
  cable.duration = 3600;
  const Simulation run = simulated(model, cable);
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.trajectory.q.rightCols(1).cwiseAbs().maxCoeff() < 1e-7);
  CHECK(run.energy_imbalance <= 1e-5 * energy_moved(run));
}

TEST_CASE("an hour of undamped motion keeps its energy" * doctest::skip()) {
  const Model model = Model::built_in(kLinks);
  Cable cable;
  cable.damping = 0;
  cable.duration = 3600;
  SimulationOptions options;
  options.max_steps = 100'000'000;
  options.relative_tolerance = 1e-10;
  const Simulation run = simulated(model, cable, options);
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.energy_imbalance <= 1e-3 * energy_moved(run));
}

}  // namespace
