// SPDX-License-Identifier: BSD-3-Clause
//
// Extreme but legal chains in space: right, or a status that says what to change; never wrong with success.
// In a vertical plane they move as the chain of the plane, which `extremes_test` compares with the closed
// forms.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "runtime/positions.hpp"
#include "tests/runtime/space_cable.hpp"

namespace {

constexpr int kLinks = 4;

struct Chain {
  double length = 1.2, density = 0.15, load = 0.3, stiffness = 0.2, damping = 2e-3;
  double angle = 0.5, duration = 1.0, relative_tolerance = 1e-9;
};

Eigen::VectorXd parameters_of(const catena::Model& model, const Chain& chain) {
  Eigen::VectorXd p = testing::cable(model, chain.stiffness, chain.damping);
  const double length = chain.length / kLinks, mass = chain.density * length;
  p.segment(0, kLinks).setConstant(length);
  p.segment(kLinks, kLinks).setConstant(mass);
  p.segment(2 * kLinks, kLinks).setConstant(mass * length * length / 12);
  p[model.parameter_index("load_mass")] = chain.load;
  return p;
}

}  // namespace

TEST_CASE("extreme chains in space move as in the plane, or the status says what to change") {
  struct Row {
    std::string what;
    std::function<void(Chain&)> change;
    const char* words;  // of the message where it is not simulated; empty: it must be
  };
  const std::vector<Row> rows = {
      {"as it is", [](Chain&) {}, ""},
      {"stiffness 1e-12", [](Chain& c) { c.stiffness = 1e-12; }, ""},
      {"no stiffness", [](Chain& c) { c.stiffness = 0; }, ""},
      {"stiffness 1e6, 1 ms",
       [](Chain& c) { c.stiffness = 1e6, c.duration = 1e-3, c.relative_tolerance = 1e-11; }, ""},
      {"stiffness 1e6, damped", [](Chain& c) { c.stiffness = 1e6, c.damping = 1e5; }, ""},
      {"stiffness 1e12", [](Chain& c) { c.stiffness = 1e12; }, "less stiff"},
      {"stiffness 1e48", [](Chain& c) { c.stiffness = 1e48; }, "stiff"},  // of a pivot or a number
      {"no damping", [](Chain& c) { c.damping = 0; }, ""},
      {"damping 1e6", [](Chain& c) { c.damping = 1e6; }, ""},
      {"no load", [](Chain& c) { c.load = 0; }, ""},
      {"load 1e6 kg", [](Chain& c) { c.load = 1e6; }, ""},
      {"links of 1e-6 kg/m", [](Chain& c) { c.density = 1e-6; }, ""},
      {"links of 1 mm", [](Chain& c) { c.length = 4e-3, c.stiffness = 1e-6, c.damping = 1e-8; },
       ""},
      {"links of 1 km", [](Chain& c) { c.length = 4e3; }, ""},
      {"tolerance 1e-12", [](Chain& c) { c.relative_tolerance = 1e-12; }, ""},
      {"tolerance 1e-30", [](Chain& c) { c.relative_tolerance = 1e-30; }, ""},
      {"an hour", [](Chain& c) { c.damping = 0.5, c.duration = 3600; }, ""},
      {"plumb", [](Chain& c) { c.angle = 0; }, ""},
      {"horizontal", [](Chain& c) { c.angle = std::numbers::pi / 2; }, ""},
      {"folded at the support", [](Chain& c) { c.angle = std::numbers::pi; }, "half a turn"},
  };
  const catena::Model space = catena::Model::load(SPATIAL_4),
                      plane = catena::Model::built_in(kLinks);
  const double azimuth = 0.7;
  for (const Row& row : rows) {
    INFO(row.what);
    Chain chain;
    row.change(chain);
    catena::SimulationOptions options;
    options.relative_tolerance = chain.relative_tolerance;
    const Eigen::VectorXd angles = Eigen::VectorXd::Constant(kLinks, chain.angle),
                          none = Eigen::VectorXd::Zero(kLinks);
    const std::vector<double> times = {0, chain.duration / 2, chain.duration};
    const Eigen::VectorXd of_space = parameters_of(space, chain),
                          of_plane = parameters_of(plane, chain);
    const catena::Simulation found = simulate(
        space, of_space,
        from_directions(space, {angles, Eigen::VectorXd::Constant(kLinks, azimuth), none, none}),
        times, options);
    INFO(found.message);
    if (found.status != catena::Status::kSuccess) {
      CHECK(*row.words != '\0');
      CHECK(found.message.find(row.words) != std::string::npos);
      CHECK(found.message.find("nan") == std::string::npos);
      continue;
    }
    CHECK(*row.words == '\0');
    const Eigen::MatrixXd& energy = found.trajectory.energy;
    const double moved = (energy.rowwise().maxCoeff() - energy.rowwise().minCoeff()).maxCoeff();
    CHECK(found.energy_imbalance <= 1e-4 * moved);
    const catena::Simulation right =
        simulate(plane, of_plane, from_angles(plane, angles), times, testing::tight());
    INFO(right.message);
    CHECK(right.status == catena::Status::kSuccess);
    if (right.status != catena::Status::kSuccess) continue;
    for (Eigen::Index k = 0; k < 3; ++k) {
      const double t = times[static_cast<std::size_t>(k)];
      const catena::Positions there = positions(plane, of_plane, t, right.trajectory.q.col(k));
      const catena::Positions here = positions(space, of_space, t, found.trajectory.q.col(k));
      const double most = 1e-5 * chain.length;
      CHECK((here.side - std::cos(azimuth) * there.side).cwiseAbs().maxCoeff() < most);
      CHECK((here.across - std::sin(azimuth) * there.side).cwiseAbs().maxCoeff() < most);
      CHECK((here.down - there.down).cwiseAbs().maxCoeff() < most);
    }
  }
}
