// SPDX-License-Identifier: BSD-3-Clause
//
// Effects in space against closed forms, against the plane, and against other solvers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "runtime/adjoint.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/runtime/vertical_plane.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::check_motion_in_plane;
using testing::hand;
using testing::kGravity;
using testing::planar_start;
using testing::run;
using testing::tight;

/// The cable in water: drag and added mass of a rope of 12 mm, friction in its joints.
VectorXd in_water(const Model& model) {
  VectorXd p = cable(model, 0.05, 1e-3);
  const auto set = [&](const char* name, double value) { p[model.parameter_index(name)] = value; };
  set("air_drag_quadratic.normal", 6.6);
  set("air_drag_quadratic.tangential", 0.2);
  set("added_mass.normal", 0.113);
  set("added_mass.load", 0.05);
  set("buoyancy.displaced", 0.06);
  set("buoyancy.load_displaced", 0.1);
  set("joint_dry_friction.moment", 5e-3);
  set("load_drag.coefficient", 0.4);
  return p;
}

VectorXd constant(double value) { return VectorXd::Constant(1, value); }

catena::Signals held_still() {
  return hand([](double) { return Vector3d(0, 0, 0); }, [](double) { return Vector3d(0, 1, 0); });
}

constexpr double kSpeed = 1.3;    // m/s, of the tow
constexpr double kAzimuth = 0.8;  // of the current

/// Hinged, without a load, of 0.06 kg/m in water; drag of a thin rope.
VectorXd towed(const Model& model, double speed) {
  VectorXd p = cable(model, 0, 0);
  const auto set = [&](const char* name, double value) { p[model.parameter_index(name)] = value; };
  set("load_mass", 0);
  set("hand.follow", 1);
  set("buoyancy.displaced", 0.09);
  set("current.side_speed", speed * std::cos(kAzimuth));
  set("current.across_speed", speed * std::sin(kAzimuth));
  set("current.normal", 0.7);
  set("current.tangential", 0.02);
  return p;
}

/// Angle from the vertical at which weight and drag balance normal to a straight cable: with w the weight in
/// water and c U^2 the drag of a length across the flow, w sin(angle) = c U^2 cos(angle)^2.
double tow_angle() {
  const double weight = (0.15 - 0.09) * kGravity, drag = 0.7 * kSpeed * kSpeed;
  return std::asin((-weight + std::sqrt(weight * weight + 4 * drag * drag)) / (2 * drag));
}

}  // namespace

// Drag c v per length at the middle of a rod of length l has the moment -c l (l/2)^2 times its angular
// velocity; J is its moment of inertia.
TEST_CASE(
    "linear drag takes energy and angular momentum from a spherical pendulum at the rates of the "
    "closed form") {
  const Model model = Model::load(LINEAR_DRAG_1);
  VectorXd p = cable(model, 0, 0);
  const double drag = 0.35, length = p[0];
  p[model.parameter_index("air_drag_linear.normal")] = drag;
  p[model.parameter_index("air_drag_linear.tangential")] = 5;  // a rod that turns has none
  const double inertia =
      length * length * (p[model.parameter_index("load_mass")] + p[1] / 4) + p[2];
  const double damping = drag * length * length * length / 4;
  const State initial =
      from_directions(model, {constant(1.1), constant(0.2), constant(0.4), constant(1.7)});
  const auto motion = run(model, p, initial, {0, 0.4, 0.8, 1.6}).trajectory;
  const auto turning = [&](Eigen::Index k) {
    return motion.q(2, k) * motion.v(0, k) - motion.q(0, k) * motion.v(2, k);
  };
  Eigen::Index kinetic = -1, dissipated = -1;
  for (Eigen::Index item = 0; item < motion.energy.rows(); ++item) {
    const std::string name = model.table().energy_item[item].name;
    if (name == "kinetic") kinetic = item;
    if (name == "air_drag_linear") dissipated = item;
  }
  REQUIRE((kinetic >= 0 && dissipated >= 0));
  for (Eigen::Index k = 1; k < 4; ++k) {
    const double t = motion.time[static_cast<std::size_t>(k)];
    CHECK(turning(k) == catena::near(turning(0) * std::exp(-damping / inertia * t), 1e-8));
  }
  // Power over kinetic energy, from what is dissipated in a short time.
  const double step = 1e-4;
  const auto shortly = run(model, p, initial, {0, step}).trajectory;
  const double power = (shortly.energy(dissipated, 1) - shortly.energy(dissipated, 0)) / step;
  const double mean = (shortly.energy(kinetic, 0) + shortly.energy(kinetic, 1)) / 2;
  CHECK(power == catena::near(2 * damping / inertia * mean, 1e-6));
  CHECK(turning(0) != catena::near(turning(3), 0.01));
}

TEST_CASE("in any vertical plane a cable in water moves as in the plane") {
  const Model space = Model::load(IN_WATER_5), plane = Model::load(IN_WATER_PLANE_5);
  check_motion_in_plane(plane, in_water(plane), space, in_water(space), planar_start(plane, space));
}

TEST_CASE("energies of a cable in water balance, over 3 s, to 1e-9 of their size") {
  const Model model = Model::load(IN_WATER_5);
  CHECK(model.table().structured == 1);
  const auto result = run(model, in_water(model), askew(model), {0, 1, 2, 3});
  const double size = result.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(size > 1.0);  // J
  CHECK(result.energy_imbalance < 1e-9 * size);
}

TEST_CASE("a towed cable hangs at the angle at which drag and weight balance") {
  const Model model = Model::load(IN_CURRENT_8);
  const VectorXd p = towed(model, kSpeed);
  const auto at_angle = [&](double angle) {
    return from_directions(model, {VectorXd::Constant(8, angle), VectorXd::Constant(8, kAzimuth),
                                   VectorXd::Zero(8), VectorXd::Zero(8)});
  };
  // It stays where the closed form says, and comes there from elsewhere.
  const auto stays = simulate(model, p, at_angle(tow_angle()), {0, 2}, tight(), held_still());
  REQUIRE_MESSAGE(stays.status == catena::Status::kSuccess, stays.message);
  CHECK((stays.trajectory.q.col(1) - stays.trajectory.q.col(0)).norm() < 1e-9);
  const auto comes = simulate(model, p, at_angle(tow_angle() - 0.1), {0, 4}, tight(), held_still());
  REQUIRE_MESSAGE(comes.status == catena::Status::kSuccess, comes.message);
  CHECK((comes.trajectory.q.col(1) - stays.trajectory.q.col(0)).norm() < 1e-3);
  CHECK((comes.trajectory.q.col(0) - stays.trajectory.q.col(0)).norm() > 0.2);
}

TEST_CASE("the equilibrium in a current is found from the plumb line") {
  const Model model = Model::load(IN_CURRENT_8);
  const catena::Equilibrium found =
      hanging_equilibrium(model, towed(model, kSpeed), 0, held_still());
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  const State expected =
      from_directions(model, {VectorXd::Constant(8, tow_angle()), VectorXd::Constant(8, kAzimuth),
                              VectorXd::Zero(8), VectorXd::Zero(8)});
  CHECK((found.state.q - expected.q).norm() < 1e-9);
}

TEST_CASE("a cable towed through still water moves as one held in a current") {
  const Model model = Model::load(IN_CURRENT_8);
  const State initial = askew(model);
  const auto held = simulate(model, towed(model, kSpeed), initial, {0, 1}, tight(), held_still());
  const catena::Signals away = hand(
      [](double t) {
        return Vector3d(-kSpeed * t * std::cos(kAzimuth), 0, -kSpeed * t * std::sin(kAzimuth));
      },
      [](double) { return Vector3d(0, 1, 0); });
  const auto pulled = simulate(model, towed(model, 0), initial, {0, 1}, tight(), away);
  REQUIRE_MESSAGE(held.status == catena::Status::kSuccess, held.message);
  REQUIRE_MESSAGE(pulled.status == catena::Status::kSuccess, pulled.message);
  CHECK((held.trajectory.q.col(1) - pulled.trajectory.q.col(1)).norm() < 1e-7);
  CHECK((held.trajectory.q.col(1) - held.trajectory.q.col(0)).norm() > 0.5);
}

TEST_CASE("all solvers agree on a cable in water") {
  const Model model = Model::load(IN_WATER_5);
  const VectorXd p = in_water(model);
  const State initial = askew(model);
  catena::SimulationOptions dense = tight();
  dense.linear_solver = catena::LinearSolver::kDense;
  const int drag = model.parameter_index("air_drag_quadratic.normal");
  const auto direction = catena::SensitivityDirection::parameter(model, drag);
  const std::vector<double> times{0, 0.3};
  const auto blocks = simulate_with_sensitivities(model, p, initial, {direction}, times, tight());
  const auto whole = simulate_with_sensitivities(model, p, initial, {direction}, times, dense);
  REQUIRE_MESSAGE(blocks.status == catena::Status::kSuccess, blocks.message);
  CHECK(blocks.statistics.used == catena::LinearSolver::kStructured);
  CHECK((blocks.trajectory.q.col(1) - whole.trajectory.q.col(1)).norm() < 1e-8);
  const VectorXd change = whole.sensitivity[0].q.col(1);
  CHECK(change.norm() > 1e-3);
  CHECK((blocks.sensitivity[0].q.col(1) - change).norm() < 1e-6 * change.norm());
  const double step = 1e-4;
  VectorXd more = p, less = p;
  more[drag] += step, less[drag] -= step;
  const VectorXd difference = (run(model, more, initial, times).trajectory.q.col(1) -
                               run(model, less, initial, times).trajectory.q.col(1)) /
                              (2 * step);
  CHECK((change - difference).norm() < 1e-5 * change.norm());
  const auto objective = [](const catena::Trajectory& motion, catena::Trajectory& slope) {
    slope.q(motion.q.rows() - 1, motion.q.cols() - 1) = 1.0;
  };
  const auto gradient = simulate_with_gradient(model, p, initial, times, objective, tight());
  REQUIRE_MESSAGE(gradient.status == catena::Status::kSuccess, gradient.message);
  CHECK(gradient.gradient.parameters[drag] == catena::near(change[change.size() - 1], 1e-5));
}

TEST_CASE(
    "all solvers agree on a cable that is bent at rest and has hysteresis; its energy balances") {
  const Model model = Model::load(BENT_5);
  CHECK(model.table().structured == 1);
  VectorXd p = cable(model, 0.05, 1e-3);
  const int curvature = model.parameter_index("rest_curvature.curvature"),
            moment = model.parameter_index("joint_hysteresis.moment");
  p[curvature] = 1.5, p[moment] = 0.02, p[model.parameter_index("joint_hysteresis.reach")] = 0.3;
  const State initial = askew(model);
  catena::SimulationOptions dense = tight();
  dense.linear_solver = catena::LinearSolver::kDense;
  const std::vector<double> times{0, 0.3};
  for (const int parameter : {curvature, moment}) {
    CAPTURE(parameter);
    const auto direction = catena::SensitivityDirection::parameter(model, parameter);
    const auto blocks = simulate_with_sensitivities(model, p, initial, {direction}, times, tight());
    const auto whole = simulate_with_sensitivities(model, p, initial, {direction}, times, dense);
    REQUIRE_MESSAGE(blocks.status == catena::Status::kSuccess, blocks.message);
    CHECK(blocks.statistics.used == catena::LinearSolver::kStructured);
    CHECK((blocks.trajectory.q.col(1) - whole.trajectory.q.col(1)).norm() < 1e-8);
    const VectorXd change = whole.sensitivity[0].q.col(1);
    CHECK(change.norm() > 1e-3);
    CHECK((blocks.sensitivity[0].q.col(1) - change).norm() < 1e-6 * change.norm());
    const double step = 1e-4;
    VectorXd more = p, less = p;
    more[parameter] += step, less[parameter] -= step;
    const VectorXd difference = (run(model, more, initial, times).trajectory.q.col(1) -
                                 run(model, less, initial, times).trajectory.q.col(1)) /
                                (2 * step);
    CHECK((difference - change).norm() < 1e-4 * change.norm());
  }
  const auto result = run(model, p, initial, {0, 1, 2});
  const double size = result.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(result.energy_imbalance < 1e-9 * size);
}
