// SPDX-License-Identifier: BSD-3-Clause
//
// Cables on the sea floor against the closed form of a mooring line, and their balance of energy.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/internal_forces.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::set;

constexpr double kLength = 760, kDepth = 200, kDensity = 390, kDisplaced = 51;  // m, kg/m
constexpr double kWeight = (kDensity - kDisplaced) * testing::kGravity;         // N/m, in water
constexpr double kFirmness = 2.5e4, kRounding = 0.05;                           // N/m^2, m

/// How deep a cable lies in the floor: where the floor pushes with its weight; m.
double sunk() {
  double up = -1, down = 10;
  for (int halving = 0; halving < 100; ++halving) {
    const double d = (up + down) / 2, size = std::hypot(d, kRounding), p = (d + size) / 2;
    (kFirmness * p * p / size < kWeight ? up : down) = d;
  }
  return up;
}

/// A chain from a ship to an anchor at this distance (m), whose lying part is as deep as the anchor. The anchor is
/// the far end, or the ship.
VectorXd moored(const Model& model, double distance, bool anchor_first) {
  const Eigen::Index n = model.links();
  const double length = kLength / static_cast<double>(n);
  VectorXd p = model.default_parameters();
  p.segment(0, n).setConstant(length);
  p.segment(n, n).setConstant(kDensity * length);
  p.segment(2 * n, n).setConstant(kDensity * length * length * length / 12);
  p.segment(3 * n, 2 * n).setZero();
  set(model, p, "load_mass", 0);
  set(model, p, "gravity", testing::kGravity);
  set(model, p, "buoyancy.displaced", kDisplaced);
  set(model, p, "holds_end.to_side", 0.6 * distance);
  set(model, p, "holds_end.to_across", 0.8 * distance);
  set(model, p, "holds_end.to_down", anchor_first ? -kDepth : kDepth);
  set(model, p, "sea_floor.firmness", kFirmness);
  set(model, p, "sea_floor.rounding", kRounding);
  set(model, p, "sea_floor.bed", (anchor_first ? 0 : kDepth) - sunk());
  return p;
}

/// The horizontal force of a chain that lies on the floor from its anchor on, without friction: with a = H / w, s =
/// sqrt(depth^2 + 2 depth a) hangs, and the ends are length - s + a asinh(s / a) apart.
double horizontal_force(double distance) {
  double low = 1e-3, high = 1e5;
  for (int halving = 0; halving < 200; ++halving) {
    const double a = std::sqrt(low * high), s = std::sqrt(kDepth * (kDepth + 2 * a));
    (kLength - s + a * std::asinh(s / a) < distance ? low : high) = a;
  }
  return kWeight * low;
}

/// A cable that falls on a floor.
VectorXd falling(const Model& model) {
  VectorXd p = testing::cable(model, 0.05, 1e-3);
  set(model, p, "sea_floor.bed", 0.95);
  set(model, p, "sea_floor.firmness", 2000);
  set(model, p, "sea_floor.load_firmness", 2000);
  set(model, p, "sea_floor.resistance", 20);
  set(model, p, "sea_floor.friction", 0.4);
  return p;
}

/// The floor multiplies errors by some 20.
catena::SimulationOptions tighter() {
  catena::SimulationOptions options = testing::tight();
  options.relative_tolerance /= 10;
  options.absolute_tolerance_position /= 10;
  options.absolute_tolerance_velocity /= 10;
  return options;
}

/// From 0 to 1.5 s.
std::vector<double> times_of_fall(int steps) {
  std::vector<double> times;
  for (int k = 0; k <= steps; ++k) times.push_back(1.5 * k / steps);
  return times;
}

/// The event values of a cable at one time of a motion.
VectorXd event_values(const Model& model, const VectorXd& p, const catena::Trajectory& path,
                      Eigen::Index column) {
  const VectorXd q = path.q.col(column), v = path.v.col(column);
  VectorXd values(model.events());
  model.event_values({path.time[static_cast<std::size_t>(column)], q.data(), v.data(), nullptr,
                      nullptr, nullptr, p.data()},
                     values.data());
  return values;
}

}  // namespace

TEST_CASE("a chain that lies partly on the floor pulls at its ends as the catenary with a floor") {
  const Model model = Model::load(ON_FLOOR_40);
  for (const double distance : {640.0, 680.0, 700.0, 720.0})
    for (const bool anchor_first : {false, true}) {
      CAPTURE(distance);
      CAPTURE(anchor_first);
      const VectorXd p = moored(model, distance, anchor_first);
      const catena::Equilibrium found = hanging_equilibrium(model, p);
      REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
      const catena::InternalForces forces =
          internal_forces(model, p, {{0.0}, found.state.q, found.state.v, found.state.z, {}});
      Vector3d ship = forces.support.force.col(0),
               anchor = forces.held.back().reaction.force.col(0);
      if (anchor_first) std::swap(ship, anchor);
      const double horizontal = horizontal_force(distance);
      CHECK(ship.norm() == catena::near(horizontal + kWeight * kDepth, 0.01));
      CHECK(anchor.norm() == catena::near(horizontal, 0.01));
      const double azimuth = std::atan2(ship[2], ship[0]);
      CHECK(std::abs(std::sin(azimuth - std::atan2(0.8, 0.6))) < 1e-9);
    }
}

TEST_CASE("a chain on the floor is found in a current, too") {
  const Model model = Model::load(ON_FLOOR_40);
  VectorXd p = moored(model, 700, false);
  set(model, p, "current.normal", 177);
  set(model, p, "current.tangential", 260);
  set(model, p, "current.side_speed", 0.5);
  set(model, p, "current.across_speed", -0.7);
  const catena::Equilibrium found = hanging_equilibrium(model, p);
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  VectorXd a(model.coordinates());
  REQUIRE(model.acceleration(
              {0, found.state.q.data(), found.state.v.data(), a.data(), nullptr, nullptr, p.data()},
              a.data()) == 0);
  CHECK(a.head(120).cwiseAbs().maxCoeff() < 1e-6);  // 1/s^2; a hanging link starts with about one
  const auto here = positions(model, p, 0, found.state.q);
  const double off = (0.8 * here.side - 0.6 * here.across).cwiseAbs().maxCoeff();
  CHECK(off > 1);  // m, out of the plane of its ends
}

TEST_CASE("energies balance where a cable falls on the floor, sinks in and slides") {
  const Model model = Model::load(OVER_FLOOR_5);
  const VectorXd p = falling(model);
  const catena::Simulation motion =
      simulate(model, p, testing::askew(model), times_of_fall(150), tighter());
  REQUIRE_MESSAGE(motion.status == catena::Status::kSuccess, motion.message);
  const catena::Trajectory& path = motion.trajectory;
  CHECK(motion.energy_imbalance < 1e-9 * path.energy.cwiseAbs().maxCoeff());
  double deepest = 0;
  for (Eigen::Index k = 0; k < path.q.cols(); ++k)
    deepest = std::max(deepest, positions(model, p, 0, path.q.col(k)).down[model.links() + 1]);
  CHECK(deepest > 0.95);  // the load
  CHECK(deepest < 1.0);
  double rubbed = 0;
  for (Eigen::Index item = 0; item < path.energy.rows(); ++item)
    if (std::string(model.table().energy_item[item].name) == "sea_floor" &&
        model.table().energy_item[item].kind == CATENA_DISSIPATED)
      rubbed = path.energy(item, path.energy.cols() - 1);
  CHECK(rubbed > 0.05);  // J
}

TEST_CASE("every crossing of the floor is an event at its time, and there are no others") {
  const Model model = Model::load(OVER_FLOOR_5);
  REQUIRE(model.events() == model.links() + 1);
  CHECK(model.table().event[0].name == std::string("sea_floor.load_touch_down"));
  CHECK(model.table().event[5].name == std::string("sea_floor.touch_down_5"));
  const VectorXd p = falling(model);
  catena::SimulationOptions options = tighter();
  const catena::Simulation watched =
      simulate(model, p, testing::askew(model), times_of_fall(15'000), options);
  REQUIRE_MESSAGE(watched.status == catena::Status::kSuccess, watched.message);
  CHECK(watched.events.empty());  // not asked for
  options.events = true;
  const catena::Simulation motion =
      simulate(model, p, testing::askew(model), times_of_fall(1), options);
  REQUIRE_MESSAGE(motion.status == catena::Status::kSuccess, motion.message);

  const catena::Trajectory& path = watched.trajectory;
  auto event = motion.events.begin();
  VectorXd before = event_values(model, p, path, 0);
  for (Eigen::Index k = 1; k < path.q.cols(); ++k) {
    const VectorXd after = event_values(model, p, path, k);
    for (int which = 0; which < model.events(); ++which) {
      if ((before[which] < 0) == (after[which] < 0)) continue;
      REQUIRE(event != motion.events.end());
      CHECK(event->name == model.table().event[which].name);
      CHECK(event->rising == (after[which] > 0));
      const auto column = static_cast<std::size_t>(k);
      CHECK(event->time > path.time[column - 1]);
      CHECK(event->time <= path.time[column]);
      const catena::Simulation there =
          simulate(model, p, testing::askew(model), {0, event->time}, tighter());
      CHECK(std::abs(event_values(model, p, there.trajectory, 1)[which]) < 1e-7);  // m
      ++event;
    }
    before = after;
  }
  CHECK(event == motion.events.end());
  CHECK(motion.events.size() >= 6);  // all links and the load
}

TEST_CASE("steps that begin anew at events give the same motion, energies and derivatives") {
  const Model model = Model::load(OVER_FLOOR_5);
  const VectorXd p = falling(model);
  const auto run = [&](bool events) {
    catena::SimulationOptions options = tighter();
    options.events = events;
    options.sensitivities_in_error_test = true;
    return simulate_with_sensitivities(
        model, p, testing::askew(model),
        {catena::SensitivityDirection::parameter(model, model.parameter_index("gravity")),
         catena::SensitivityDirection::parameter(model,
                                                 model.parameter_index("sea_floor.friction"))},
        times_of_fall(150), options);
  };
  const catena::SensitiveSimulation with = run(true), without = run(false);
  REQUIRE_MESSAGE(with.status == catena::Status::kSuccess, with.message);
  CHECK(with.events.size() >= 6);
  CHECK(with.statistics.steps > without.statistics.steps / 2);  // all of them are counted
  const auto off = [](const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
    return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff();
  };
  CHECK(off(with.trajectory.q, without.trajectory.q) < 1e-6);
  CHECK(off(with.trajectory.energy, without.trajectory.energy) < 1e-6);
  CHECK(with.energy_imbalance < 1e-9 * with.trajectory.energy.cwiseAbs().maxCoeff());
  for (std::size_t k = 0; k < 2; ++k)
    CHECK(off(with.sensitivity[k].q, without.sensitivity[k].q) < 1e-4);
}
