// SPDX-License-Identifier: BSD-3-Clause
//
// A load with coordinates of its own: against closed forms, against a further link of the plain chain, in
// space against the plane, and against other solvers.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "runtime/internal_forces.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/check_derivatives.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/runtime/vertical_plane.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Index;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::check_derivatives;
using testing::check_motion_in_plane;
using testing::kGravity;
using testing::planar_start;
using testing::run;
using testing::set;
using testing::tight;

VectorXd accelerations(const Model& model, const VectorXd& p, const State& state) {
  VectorXd a = VectorXd::Zero(model.coordinates());
  const catena_point at{0,       state.q.data(), state.v.data(), a.data(), state.z.data(),
                        nullptr, p.data()};
  REQUIRE(model.acceleration(at, a.data()) == 0);
  return a;
}

State random_state(const Model& model, unsigned seed) {
  std::mt19937_64 random(seed);
  State state = State::zero(model);
  for (VectorXd* values : {&state.q, &state.v})
    for (double& value : *values) value = 4 * static_cast<double>(random() >> 11) * 0x1p-53 - 2;
  return state;
}

double energy_item(const Model& model, const VectorXd& p, const State& state,
                   const std::string& name) {
  VectorXd energies(model.energies()), a = VectorXd::Zero(model.coordinates());
  const catena_point at{0,       state.q.data(), state.v.data(), a.data(), state.z.data(),
                        nullptr, p.data()};
  model.energy(at, energies.data());
  double sum = 0;
  for (int k = 0; k < model.energies(); ++k)
    if (model.table().energy_item[k].name == name) sum += energies[k];
  return sum;
}

constexpr double kReach = 0.35, kInertia = 0.02, kHinge = 0.004;

VectorXd swinging(const Model& model) {
  VectorXd p = cable(model, 0.05, 1e-3);
  set(model, p, "swinging_load.reach", kReach);
  set(model, p, "swinging_load.about_centre", kInertia);
  set(model, p, "swinging_load.hinge_damping", kHinge);
  return p;
}

// The plain chain with one link more, which is the body.
VectorXd with_link(const Model& longer, const VectorXd& p, Index links) {
  VectorXd q = longer.default_parameters();
  const double body[] = {2 * kReach, 0.3, kInertia, 0, kHinge, 0};
  for (Index family = 0; family < 6; ++family) {
    q.segment(family * (links + 1), links) = p.segment(family * links, links);
    q[family * (links + 1) + links] = body[family];
  }
  set(longer, q, "load_mass", 0);
  set(longer, q, "gravity", kGravity);
  return q;
}

void compare_with_link(const Model& model, double tolerance) {
  const int n = model.links();
  CHECK(model.table().structured == 1);
  CHECK(model.coordinates() == n + 1);
  CHECK(std::string(model.table().coordinate[n].name) == "swinging_load.swing");
  const Model longer = Model::built_in(n + 1);
  const VectorXd p = swinging(model), q = with_link(longer, p, n);
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const State state = random_state(model, seed);
    const VectorXd expected = accelerations(longer, q, state),
                   found = accelerations(model, p, state);
    CHECK((found - expected).norm() < tolerance * expected.norm());
    // The other energies are the same in sum; that of the body's turning has its own name.
    const double kinetic = energy_item(model, p, state, "kinetic"),
                 turning = kInertia * state.v[n] * state.v[n] / 2;
    CHECK(kinetic + turning == doctest::Approx(energy_item(longer, q, state, "kinetic")));
  }
}

TEST_CASE("a load that swings is the plain chain with one link more") {
  compare_with_link(Model::load(SWINGING_3), 1e-12);
  compare_with_link(Model::load(SWINGING_59), 1e-8);  // 59 stiff links at random angles
}

TEST_CASE("one link and a load that swings are a double pendulum") {
  const Model model = Model::load(SWINGING_1);
  const VectorXd p = swinging(model);
  const double l = 1.2, m = 0.15 * l, body = 0.3, about = m * l * l / 12;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const State state = random_state(model, seed);
    const double a = state.q[0], b = state.q[1], u = state.v[0], w = state.v[1];
    Eigen::Matrix2d mass;
    const double coupling = body * l * kReach;
    mass << about + m * l * l / 4 + body * l * l, coupling * std::cos(a - b),
        coupling * std::cos(a - b), kInertia + body * kReach * kReach;
    const Eigen::Vector2d force(-coupling * std::sin(a - b) * w * w -
                                    (m / 2 + body) * kGravity * l * std::sin(a) - 0.05 * a -
                                    1e-3 * u + kHinge * (w - u),
                                coupling * std::sin(a - b) * u * u -
                                    body * kGravity * kReach * std::sin(b) - kHinge * (w - u));
    CHECK((accelerations(model, p, state) - mass.inverse() * force).norm() <
          1e-13 * force.norm() / mass.determinant());
  }
}

// ---- thrust, and a state of the load -----------------------------------------------------------

catena::Signals command(double thrust) {
  catena::Signals signals;
  const std::vector<double> times{0, 50, 100}, values(3, thrust);
  signals.add("tug.command", times, values);
  return signals;
}

VectorXd tugged(const Model& model) {
  VectorXd p = cable(model, 0, 0.05);
  set(model, p, "tug.reach", kReach);
  set(model, p, "tug.about_centre", kInertia);
  set(model, p, "tug.hinge_damping", 0.1);
  set(model, p, "tug.share", 0.8);
  set(model, p, "tug.slip", 0.3);
  set(model, p, "air_drag_quadratic.normal", 0.05);
  return p;
}

TEST_CASE("thrust across a load that swings ends where moments about the hinge balance") {
  // m g reach sin(swing) = thrust reach; a link without mass is then in line with the load.
  const Model model = Model::load(TUGGED_1);
  VectorXd p = tugged(model);
  p[1] = 1e-9, p[2] = 1e-9;
  set(model, p, "tug.hinge_damping", 0.5);
  set(model, p, "damping_1", 0.5);
  const auto motion = simulate(model, p, State::zero(model), {0, 80}, tight(), command(1.5));
  REQUIRE_MESSAGE(motion.status == catena::Status::kSuccess, motion.message);
  const double expected = std::asin(0.8 * 1.5 / (0.3 * kGravity));
  CHECK(motion.trajectory.z(0, 1) == catena::near(1.5, 1e-9));
  CHECK(motion.trajectory.q(1, 1) == catena::near(expected, 1e-8));
  CHECK(motion.trajectory.q(0, 1) == catena::near(expected, 1e-8));
}

TEST_CASE("derivatives of a load with a coordinate and a state agree with differences") {
  const Model model = Model::load(TUGGED_5);
  CHECK(model.states() == 1);
  CHECK(std::string(model.table().state[0].name) == "tug.thrust");
  State initial = from_angles(model, VectorXd::LinSpaced(5, 0.2, 0.8));
  initial.q[5] = -0.6, initial.v[5] = 1.5, initial.z[0] = 0.4;
  check_derivatives(model, tugged(model), initial, command(1.5), {"tug.lag", 1e-3, 5});
  check_derivatives(model, tugged(model), initial, command(1.5), {"tug.reach", 1e-4, 5});
  check_derivatives(model, tugged(model), initial, command(1.5), {"mass_2", 1e-4, 0});
}

TEST_CASE("energies of a load that swings and is tugged balance to 1e-9 of their size") {
  const Model model = Model::load(TUGGED_5);
  State initial = from_angles(model, VectorXd::LinSpaced(5, 0.2, 0.8));
  initial.q[5] = -0.6, initial.v[5] = 1.5, initial.z[0] = 0.4;
  const auto motion = simulate(model, tugged(model), initial, {0, 3}, tight(), command(1.5));
  REQUIRE_MESSAGE(motion.status == catena::Status::kSuccess, motion.message);
  CHECK(motion.energy_imbalance < 1e-9 * motion.trajectory.energy.col(0).cwiseAbs().sum());
  CHECK(motion.trajectory.energy.col(0).cwiseAbs().sum() > 0.3);
}

// ---- a body in space ---------------------------------------------------------------------------

// Sets attitude and angular velocity, rad/s, in the axes of the body; `stretch`: of the quaternion.
void set_attitude(State& state, const Quaterniond& attitude, const Vector3d& turning,
                  double stretch = 1) {
  const Quaterniond half(0, turning[0] / 2, turning[1] / 2, turning[2] / 2);
  const Quaterniond rate = attitude * half;
  state.q.tail(4) =
      stretch * Eigen::Vector4d(attitude.w(), attitude.x(), attitude.y(), attitude.z());
  state.q[state.q.size() - 4] -= 1;
  state.v.tail(4) = stretch * Eigen::Vector4d(rate.w(), rate.x(), rate.y(), rate.z());
}

Quaterniond attitude(const VectorXd& q) {
  const auto c = q.tail(4);
  return Quaterniond(1 + c[0], c[1], c[2], c[3]).normalized();
}

Vector3d turning(const VectorXd& q, const VectorXd& v) {
  const auto c = q.tail(4), d = v.tail(4);
  const Quaterniond p(1 + c[0], c[1], c[2], c[3]), rate(d[0], d[1], d[2], d[3]);
  return 2 * (p.conjugate() * rate).vec() / p.squaredNorm();
}

const Vector3d kInertias(0.01, 0.03, 0.02);  // roll, yaw, pitch

VectorXd hung(const Model& model) {
  VectorXd p = cable(model, 0.05, 1e-3);
  set(model, p, "load_body.centre_vertical", kReach);
  set(model, p, "load_body.inertia_roll", kInertias[0]);
  set(model, p, "load_body.inertia_yaw", kInertias[1]);
  set(model, p, "load_body.inertia_pitch", kInertias[2]);
  return p;
}

VectorXd submerged(const Model& model) {
  VectorXd p = hung(model);
  const std::pair<const char*, double> values[] = {
      {"centre_longitudinal", -0.1}, {"added_longitudinal", 0.05},
      {"added_vertical", 0.3},       {"added_lateral", 0.2},
      {"drag_longitudinal", 0.4},    {"drag_vertical", 1.5},
      {"drag_lateral", 1.0},         {"pressure", -0.2},
      {"turning_damping", 0.002},    {"displaced", 0.1},
      {"buoyancy_above", 0.05},      {"current_side", 0.5},
      {"current_across", -0.3}};
  for (const auto& [name, value] : values)
    set(model, p, (std::string("load_body.") + name).c_str(), value);
  return p;
}

State tumbling(const Model& model) {
  State state = askew(model);
  set_attitude(state, Quaterniond(0.5, 0.1, -0.7, 0.4).normalized(), Vector3d(2, -1, 3));
  return state;
}

TEST_CASE("in any vertical plane a body swings as in the plane") {
  const Model space = Model::load(BODY_5), plane = Model::load(SWINGING_5);
  const double swing = 0.9, swing_rate = -3;
  testing::PlanarStart start = planar_start(plane, space);
  start.plane.q[5] = swing, start.plane.v[5] = swing_rate;
  // About `down` from side to across, then about the lateral axis; side x down = across. The length of the
  // quaternion moves nothing.
  set_attitude(start.space,
               Eigen::AngleAxisd(-testing::kPlaneAzimuth, Vector3d::UnitY()) *
                   Quaterniond(Eigen::AngleAxisd(-swing, Vector3d::UnitZ())),
               Vector3d(0, 0, -swing_rate), 1.4);
  VectorXd of_plane = swinging(plane);
  set(plane, of_plane, "swinging_load.about_centre", kInertias[2]);
  set(plane, of_plane, "swinging_load.hinge_damping", 0);
  check_motion_in_plane(plane, of_plane, space, hung(space), start);
}

TEST_CASE("a body held at its centre of mass turns as a free top") {
  const Model model = Model::load(BODY_1);
  VectorXd p = hung(model);
  set(model, p, "load_body.centre_vertical", 0);
  State initial = from_directions(
      model, {VectorXd::Constant(1, 0.4), VectorXd::Zero(1), VectorXd::Zero(1), VectorXd::Zero(1)});
  const Vector3d start(2, -1, 3);
  const Quaterniond askew_attitude = Quaterniond(0.5, 0.1, -0.7, 0.4).normalized();
  set_attitude(initial, askew_attitude, start);

  SUBCASE("any body: the angular momentum stands still") {
    const auto path = run(model, p, initial, {0, 1, 2}).trajectory;
    const auto momentum = [&](Index k) -> Vector3d {
      return attitude(path.q.col(k)) *
             kInertias.cwiseProduct(turning(path.q.col(k), path.v.col(k)));
    };
    const Vector3d before = momentum(0);
    CHECK(before.norm() > 0.05);
    for (const Index k : {1, 2}) {
      CHECK((momentum(k) - before).norm() < 1e-8 * before.norm());
      CHECK((turning(path.q.col(k), path.v.col(k)) - start).norm() > 0.3);
    }
  }
  SUBCASE(
      "a body of revolution: its angular velocity goes round at (I_yaw - I) / I times its spin") {
    set(model, p, "load_body.inertia_roll", 0.02);
    const auto path = run(model, p, initial, {0, 1.7}).trajectory;
    const double precession = (0.03 - 0.02) / 0.02 * start[1];
    // I w1' = (I_yaw - I) w2 w3, I w3' = -(I_yaw - I) w2 w1, in the axes roll, yaw, pitch
    const Vector3d expected = Eigen::AngleAxisd(precession * 1.7, Vector3d::UnitY()) * start;
    CHECK((turning(path.q.col(1), path.v.col(1)) - expected).norm() < 1e-8);
  }
}

TEST_CASE("energies of a body in a current balance to 1e-9 of their size") {
  const Model model = Model::load(BODY_5);
  CHECK(model.table().structured == 1);
  CHECK(model.coordinates() == 19);
  const auto motion = run(model, submerged(model), tumbling(model), {0, 1, 2, 3});
  const double size = motion.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(size > 1.0);
  CHECK(motion.energy_imbalance < 1e-9 * size);
}

TEST_CASE("energy and damping of a body are those of its own axes") {
  const Model model = Model::load(BODY_5);
  VectorXd p = submerged(model);
  for (const char* name : {"drag_longitudinal", "drag_vertical", "drag_lateral", "displaced"})
    set(model, p, (std::string("load_body.") + name).c_str(), 0);
  const State state = tumbling(model);
  const catena_point here{0, state.q.data(), state.v.data(), nullptr, nullptr, nullptr, p.data()};
  VectorXd energies(model.table().energies);
  model.table().energy(model.table().context, &here, energies.data());
  Eigen::MatrixX3d velocity(model.links() + 2, 3);
  model.velocities(here, velocity.col(0).data(), velocity.col(1).data());
  model.table().velocities_across(model.table().context, &here, velocity.col(2).data());
  const Vector3d of_load = velocity.row(model.links() + 1),
                 along_axes = attitude(state.q).conjugate() * of_load,
                 turns = turning(state.q, state.v);
  const Vector3d added(0.05, 0.3, 0.2);
  const double stored = (added.dot(along_axes.cwiseAbs2()) + kInertias.dot(turns.cwiseAbs2())) / 2,
               dissipated = 0.002 * turns.squaredNorm();
  CHECK(along_axes.cwiseAbs().minCoeff() > 0.05);
  int seen = 0;
  for (Index k = 0; k < energies.size(); ++k) {
    const catena_energy& item = model.table().energy_item[k];
    if (std::string(item.name) != "load_body" || item.kind == CATENA_SUPPLIED) continue;
    const double expected = item.kind == CATENA_STORED ? stored : dissipated;
    CHECK(energies[k] == catena::near(expected, 1e-12));
    ++seen;
  }
  CHECK(seen == 2);
}

TEST_CASE("what the support exerts and the weight change the momentum of cable and body") {
  const Model model = Model::load(BODY_5);
  const VectorXd p = hung(model);
  const double h = 1e-4;
  const auto path = run(model, p, tumbling(model), {0, 0.5 - h, 0.5, 0.5 + h}).trajectory;
  const Index n = 5;
  const auto momentum = [&](Index k) {
    const VectorXd q = path.q.col(k), v = path.v.col(k);
    const catena_point here{0, q.data(), v.data(), nullptr, nullptr, nullptr, p.data()};
    Eigen::MatrixX3d of_points(n + 2, 3);
    model.velocities(here, of_points.col(0).data(), of_points.col(1).data());
    model.table().velocities_across(model.table().context, &here, of_points.col(2).data());
    Vector3d sum = Vector3d::Zero();
    const auto at = [&](Index i) -> Vector3d { return of_points.row(i); };
    for (Index i = 1; i <= n; ++i) sum += p[n] * (at(i - 1) + at(i)) / 2;
    return Vector3d(sum + 0.3 * at(n + 1));
  };
  const Vector3d weight(0, (n * p[n] + 0.3) * kGravity, 0);
  const auto forces = internal_forces(model, p, path);
  const Vector3d change = (momentum(3) - momentum(1)) / (2 * h);
  CHECK(change.norm() > 0.5);
  CHECK((forces.support.force.col(2) + weight - change).norm() < 1e-5 * change.norm());
}

TEST_CASE("a body towed by a cable without drag hangs where drag and wet weight balance") {
  const Model model = Model::load(BODY_5);
  VectorXd p = cable(model, 0, 0.01);
  const double drag = 0.7, speed = 1.3, displaced = 0.1;
  for (const auto& [name, value] : {std::pair{"load_body.drag_longitudinal", drag},
                                    {"load_body.displaced", displaced},
                                    {"load_body.buoyancy_above", 0.1},
                                    {"load_body.current_side", speed}})
    set(model, p, name, value);
  const auto found = hanging_equilibrium(model, p, 0, {});
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  for (Index i = 0; i < 5; ++i) {
    const double below = (0.3 - displaced + p[5] * (4.5 - static_cast<double>(i))) * kGravity;
    const double angle = std::atan2(drag * speed * speed, below);
    CHECK(found.state.q[i] == catena::near(std::sin(angle), 1e-9));
    CHECK(found.state.q[5 + i] == catena::near(std::cos(angle), 1e-9));
    CHECK(std::abs(found.state.q[10 + i]) < 1e-9);
  }
}

TEST_CASE("fins behind the centre of mass turn a towed body into the stream") {
  const Model model = Model::load(BODY_1);
  VectorXd p = cable(model, 0, 0.5);
  const double azimuth = 0.8, speed = 1.3;
  for (const auto& [name, value] : {std::pair{"load_body.drag_longitudinal", 0.1},
                                    {"load_body.drag_lateral", 1.0},
                                    {"load_body.drag_vertical", 1.0},
                                    {"load_body.pressure", -0.3},
                                    {"load_body.displaced", 0.1},
                                    {"load_body.buoyancy_above", 0.1},
                                    {"load_body.turning_damping", 0.1},
                                    {"load_body.inertia_yaw", 0.02},
                                    {"load_body.inertia_roll", 0.02},
                                    {"load_body.inertia_pitch", 0.02},
                                    {"load_body.current_side", -speed * std::cos(azimuth)},
                                    {"load_body.current_across", -speed * std::sin(azimuth)}})
    set(model, p, name, value);
  const auto motion = run(model, p, State::zero(model), {0, 60});
  const VectorXd q = motion.trajectory.q.col(1);
  const Vector3d nose = attitude(q) * Vector3d::UnitX();
  // The moment of a quadratic drag vanishes with the square of the angle: the end is reached slowly.
  CHECK(nose[0] == catena::near(std::cos(azimuth), 5e-3));
  CHECK(nose[2] == catena::near(std::sin(azimuth), 5e-3));
  // The drag is then that along the body, and the cable slants by it.
  const double below = (0.3 - 0.1 + p[1] / 2) * kGravity;
  CHECK(std::hypot(q[0], q[2]) / q[1] == catena::near(0.1 * speed * speed / below, 1e-4));
}

TEST_CASE("derivatives of a body in a current agree with differences") {
  const Model model = Model::load(BODY_5);
  const VectorXd p = submerged(model);
  const Index last = model.coordinates() - 1;
  check_derivatives(model, p, tumbling(model), {}, {"load_body.drag_lateral", 1e-3, last});
  check_derivatives(model, p, tumbling(model), {}, {"load_body.centre_vertical", 1e-4, 2});
}

}  // namespace
