// SPDX-License-Identifier: BSD-3-Clause
//
// Chains whose far end or joints are held: against closed forms, separate cables, balances of momentum, and their
// own derivatives.
#include "runtime/held_end.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "common/impossible_value.hpp"
#include "linear_algebra/decompositions.hpp"
#include "runtime/adjoint.hpp"
#include "runtime/internal_forces.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/held_cable.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::closed;
using testing::gap;
using testing::kGravity;
using testing::kHeldJoint;
using testing::run;
using testing::set;
using testing::swung;
using testing::tight;
using testing::vector_of;

VectorXd accelerations(const Model& model, const VectorXd& p, const State& state, double t) {
  VectorXd a = VectorXd::Zero(model.coordinates());
  REQUIRE(
      model.acceleration({t, state.q.data(), state.v.data(), a.data(), nullptr, nullptr, p.data()},
                         a.data()) == 0);
  return a;
}

/// What all that holds the cable exerts on it, the support too, N.
Eigen::Matrix3Xd holding(const catena::InternalForces& forces) {
  Eigen::Matrix3Xd sum = forces.support.force;
  for (const auto& held : forces.held) sum += held.reaction.force;
  return sum;
}

/// Of all links and the load, kg m/s.
Vector3d momentum(const Model& model, const VectorXd& p, const VectorXd& v) {
  const Eigen::Index n = model.links();
  Vector3d sum = Vector3d::Zero(), joint = Vector3d::Zero();
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3d span = p[i] * vector_of(v, n, i);
    sum += p[n + i] * (joint + span / 2);
    joint += span;
  }
  return sum + p[model.parameter_index("load_mass")] * joint;
}

double whole_mass(const Model& model, const VectorXd& p) {
  return p.segment(model.links(), model.links()).sum() + p[model.parameter_index("load_mass")];
}

catena::InternalForces forces_at_rest(const Model& model, const VectorXd& p, const State& state) {
  return internal_forces(model, p, {{0.0}, state.q, state.v, state.z, {}});
}

State equilibrium(const Model& model, const VectorXd& p) {
  catena::Equilibrium found = hanging_equilibrium(model, p);
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  return found.state;
}

/// Where the direction of each link is that of the force at its middle, hinged links balance. Returns the
/// forces.
catena::InternalForces check_force_polygon(const Model& model, const VectorXd& p,
                                           const State& state) {
  catena::InternalForces forces = forces_at_rest(model, p, state);
  const Eigen::Index n = model.links();
  Vector3d force = -forces.support.force.col(0);  // on what is above
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3d weight(0, p[n + i] * kGravity, 0);
    const Vector3d middle = force - weight / 2;
    CHECK((middle.normalized() - vector_of(state.q, n, i)).norm() < 1e-9);
    force -= weight;
  }
  CHECK((force - forces.held.back().reaction.force.col(0)).norm() < 1e-9);
  return forces;
}

void check_solutions(const Model& model) {
  const VectorXd p = swung(model);
  const State state = closed(model, p, askew(model));
  const int n = model.coordinates();
  VectorXd a = accelerations(model, p, state, 0.3), r(n);
  const catena_point at{0.3, state.q.data(), state.v.data(), a.data(), nullptr, nullptr, p.data()};
  model.residual(at, r.data());
  CHECK(r.cwiseAbs().maxCoeff() < 1e-11);

  Eigen::MatrixXd newton(n, n), mass(n, n), by_a(n, n);
  const VectorXd zero = VectorXd::Zero(std::max(n, model.parameters()));
  const double ca = 1.0, cv = 0.02, cq = 0.0004;
  for (int j = 0; j < n; ++j) {
    const VectorXd da = ca * VectorXd::Unit(n, j), dv = cv * VectorXd::Unit(n, j),
                   dq = cq * VectorXd::Unit(n, j);
    model.residual_tangent(
        at, {0, dq.data(), dv.data(), da.data(), zero.data(), zero.data(), zero.data()},
        newton.col(j).data());
    model.residual_tangent(
        at, {0, zero.data(), zero.data(), da.data(), zero.data(), zero.data(), zero.data()},
        by_a.col(j).data());
  }
  Eigen::MatrixXd rows(n, n);
  model.table().mass_matrix(model.table().context, &at, rows.data());
  mass = rows.transpose();
  CHECK((mass - by_a).cwiseAbs().maxCoeff() < 1e-14);
  CHECK((mass - mass.transpose()).cwiseAbs().maxCoeff() < 1e-14);

  std::vector<double> work(static_cast<std::size_t>(model.table().newton_work));
  REQUIRE(model.newton_factor(at, ca, cv, cq, work.data()) == 0);
  const VectorXd right = VectorXd::LinSpaced(n, -1, 2);
  VectorXd x = right;
  model.newton_solve(work.data(), x.data());
  CHECK((newton * x - right).cwiseAbs().maxCoeff() <
        1e-14 * newton.cwiseAbs().maxCoeff() * x.cwiseAbs().maxCoeff());
  VectorXd y = right;
  model.newton_solve_transposed(work.data(), y.data());
  CHECK((newton.transpose() * y - right).cwiseAbs().maxCoeff() < 1e-11);
}

void check_motion(const Model& model) {
  const VectorXd p = swung(model);
  const State start = closed(model, p, askew(model));
  CHECK(gap(model, p, start.q, start.v, 0).norm() < 1e-15);
  std::vector<double> times;
  for (int k = 0; k <= 3000; ++k) times.push_back(1e-3 * k);
  const catena::Simulation motion = run(model, p, start, times);
  const catena::Trajectory& path = motion.trajectory;
  double widest = 0;
  for (Eigen::Index k = 0; k < path.q.cols(); ++k)
    widest = std::max(
        widest,
        gap(model, p, path.q.col(k), path.v.col(k), times[static_cast<std::size_t>(k)]).norm());
  CHECK(widest < 1e-8);  // m; 1e-6 are asked
  CHECK(motion.energy_imbalance < 1e-9 * path.energy.cwiseAbs().maxCoeff());

  const catena::InternalForces forces = internal_forces(model, p, path);
  const Vector3d weight(0, whole_mass(model, p) * kGravity, 0);
  const Eigen::Matrix3Xd reactions = holding(forces);
  // Simpson's rule over the times
  Vector3d impulse = Vector3d::Zero();
  for (Eigen::Index k = 0; k < path.q.cols(); ++k) {
    const double share = k == 0 || k + 1 == path.q.cols() ? 1 : k % 2 == 1 ? 4 : 2;
    impulse += share * 1e-3 / 3 * (reactions.col(k) + weight);
  }
  const Vector3d change =
      momentum(model, p, path.v.col(path.v.cols() - 1)) - momentum(model, p, path.v.col(0));
  CHECK((impulse - change).norm() < 1e-5 * change.norm());
  CHECK(forces.held.back().reaction.moment.cwiseAbs().maxCoeff() == 0.0);

  // At usual tolerances the errors of steps do not add up either: without its closing the gap would be 8e-6 m.
  std::vector<double> long_times;
  for (int k = 0; k <= 1000; ++k) long_times.push_back(1e-2 * k);
  const catena::Simulation usual = simulate(model, p, start, long_times);
  REQUIRE(usual.status == catena::Status::kSuccess);
  widest = 0;
  for (Eigen::Index k = 0; k < usual.trajectory.q.cols(); ++k)
    widest = std::max(widest, gap(model, p, usual.trajectory.q.col(k), usual.trajectory.v.col(k),
                                  long_times[static_cast<std::size_t>(k)])
                                  .norm());
  CHECK(widest < 1e-6);
}

/// Sensitivities against differences, and the adjoint against sensitivities.
void check_derivatives(const Model& model, const VectorXd& p, const State& start,
                       const std::vector<const char*>& names, double last) {
  const std::vector<double> times{0, last / 2, last};
  const auto directions = testing::directions_of(model, names);
  catena::SimulationOptions options = tight();
  options.sensitivities_in_error_test = true;
  const auto sensitive = simulate_with_sensitivities(model, p, start, directions, times, options);
  REQUIRE_MESSAGE(sensitive.status == catena::Status::kSuccess, sensitive.message);
  const Eigen::Index links = Eigen::Index{3} * model.links();
  for (std::size_t j = 0; j < directions.size(); ++j) {
    CAPTURE(j);
    Eigen::Index index = 0;
    directions[j].parameters.maxCoeff(&index);
    // The path has errors of 1e-10: a smaller step would show them.
    const double h = 1e-4 * std::max(1e-2, p[index]);
    VectorXd more = p, less = p;
    more[index] += h, less[index] -= h;
    const VectorXd expected = (run(model, more, start, times).trajectory.q.col(2) -
                               run(model, less, start, times).trajectory.q.col(2)) /
                              (2 * h);
    const VectorXd found = sensitive.sensitivity[j].q.col(2);
    CHECK((found - expected).head(links).cwiseAbs().maxCoeff() <
          1e-5 * expected.head(links).cwiseAbs().maxCoeff());
  }
  const auto objective = [&](const catena::Trajectory& at, catena::Trajectory& slope) {
    slope.q(4, at.q.cols() - 1) = 1;
  };
  const auto adjoint = simulate_with_gradient(model, p, start, times, objective, options);
  REQUIRE_MESSAGE(adjoint.status == catena::Status::kSuccess, adjoint.message);
  for (std::size_t j = 0; j < directions.size(); ++j) {
    Eigen::Index index = 0;
    directions[j].parameters.maxCoeff(&index);
    CHECK(adjoint.gradient.parameters[index] ==
          catena::near(sensitive.sensitivity[j].q(4, 2), 1e-5));
  }
}

}  // namespace

TEST_CASE("accelerations and Newton's steps solve the equations with the constraints") {
  for (const char* file : {HELD_END_5, HELD_JOINT_9, HELD_TWICE_12}) {
    CAPTURE(file);
    check_solutions(Model::load(file));
  }
}

TEST_CASE("gaps stay closed, the energy balances, and reactions change the momentum") {
  for (const char* file : {HELD_END_12, HELD_JOINT_9, HELD_TWICE_12}) {
    CAPTURE(file);
    check_motion(Model::load(file));
  }
}

// Two links between two points are a rigid body that swings about the line between them.
TEST_CASE("two links between two points swing as a pendulum") {
  const Model model = Model::load(HELD_END_2);
  VectorXd p = cable(model, 0, 0);
  const double apart = 0.9, length = p[0], mass = p[2],
               load = p[model.parameter_index("load_mass")];
  set(model, p, "holds_end.to_side", apart);
  const double amplitude = 1.2, down = std::sqrt(length * length - apart * apart / 4);
  // Moments about the line; the load sits on it. Of a link: m h^2 / 3 with a uniform inertia.
  const double turning = 2 * mass * down * down / 3, leaning = 2 * mass * down / 2;
  const double frequency = std::sqrt(kGravity * leaning / turning);
  const double period = 4 / frequency * std::comp_ellint_1(std::sin(amplitude / 2));
  CHECK(load > 0);
  State start = State::zero(model);
  start.q << apart / 2 / length, apart / 2 / length,  // side
      std::cos(amplitude) * down / length, -std::cos(amplitude) * down / length,
      std::sin(amplitude) * down / length, -std::sin(amplitude) * down / length, 0, 0, 0;
  const auto motion = run(model, p, start, {0, period / 2, period}).trajectory;
  CHECK(motion.q(4, 1) == catena::near(-start.q[4], 1e-8));
  CHECK(motion.q(4, 2) == catena::near(start.q[4], 1e-8));
  CHECK(std::abs(motion.v(4, 1)) < 1e-7);
}

TEST_CASE("a cable between two points hangs as a catenary") {
  const Model model = Model::load(HELD_END_60);
  VectorXd p = cable(model, 0, 0);
  const double side = 0.6, down = 0.25, across = 0.3, length = 1.2;
  set(model, p, "load_mass", 0);
  set(model, p, "holds_end.to_side", side);
  set(model, p, "holds_end.to_down", down);
  set(model, p, "holds_end.to_across", across);
  const State state = equilibrium(model, p);
  const catena::InternalForces forces = check_force_polygon(model, p, state);

  // The force is horizontally that of a weight a w: 2 a sinh(span / 2a) = sqrt(length^2 - down^2).
  const double span = std::hypot(side, across), chord = std::sqrt(length * length - down * down);
  double half = std::sqrt(6 * (chord / span - 1));  // span / 2a, by Newton's method from above
  for (int k = 0; k < 100; ++k)
    half -= (std::sinh(half) - chord / span * half) / (std::cosh(half) - chord / span);
  const double horizontal = 0.15 * kGravity * span / 2 / half;
  CHECK(std::hypot(forces.support.force(0, 0), forces.support.force(2, 0)) ==
        catena::near(horizontal, 1e-3));
}

TEST_CASE("a slack cable whose end is above the support hangs in a loop") {
  const Model model = Model::load(HELD_END_60);
  VectorXd p = cable(model, 0, 0);
  set(model, p, "load_mass", 0);
  set(model, p, "holds_end.to_side", 0.04);
  set(model, p, "holds_end.to_down", -0.3);
  const State state = equilibrium(model, p);
  check_force_polygon(model, p, state);
  CHECK(p.head(60).dot(state.q.segment(60, 60)) == doctest::Approx(-0.3));
  CHECK(state.q[60] > 0.9);    // the first link points down
  CHECK(state.q[119] < -0.9);  // the last one up
}

// A weightless rod with hinged ends closer together than it is long: with the modulus k of the elliptic
// integrals K and E, apart / length = 2 E / K - 1, force = (2 K / length)^2 EI.
TEST_CASE("a rod that is pushed together bends as the elastica") {
  const Model model = Model::load(HELD_END_60);
  const double bending = 0.02, modulus = 0.7, length = 1.2;
  VectorXd p = cable(model, bending / (length / 60), 0);
  const double K = std::comp_ellint_1(modulus), E = std::comp_ellint_2(modulus);
  set(model, p, "stiffness_1", 0);
  set(model, p, "gravity", 0);
  set(model, p, "load_mass", 0);
  set(model, p, "holds_end.to_side", length * (2 * E / K - 1));
  const State state = equilibrium(model, p);
  const catena::InternalForces forces = forces_at_rest(model, p, state);
  const double expected = std::pow(2 * K / length, 2) * bending;
  CHECK(forces.held.back().reaction.force(0, 0) == catena::near(-expected, 1e-3));
  CHECK(forces.support.force(0, 0) == catena::near(expected, 1e-3));
  CHECK(std::abs(forces.support.force(1, 0)) < 1e-9 * expected);
}

TEST_CASE("reactions of clamped ends balance the weight and its moment") {
  const Model model = Model::load(GRIPPED_8);
  VectorXd p = cable(model, 0.3, 0);
  set(model, p, "grips.to_side", 0.5);
  set(model, p, "grips.to_down", 0.4);
  set(model, p, "grips.turn", 0.8);
  set(model, p, "grips.end_turn", 2.0);
  set(model, p, "grips.firmness", 1.7);
  const State state = equilibrium(model, p);
  const catena::InternalForces forces = forces_at_rest(model, p, state);
  const Eigen::Index n = model.links();
  Vector3d moment = forces.support.moment.col(0) + forces.held.back().reaction.moment.col(0),
           joint(0, 0, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vector3d span = p[i] * vector_of(state.q, n, i);
    moment += (joint + span / 2).cross(Vector3d(0, p[n + i] * kGravity, 0));
    joint += span;
  }
  const double load = p[model.parameter_index("load_mass")];
  moment += joint.cross(Vector3d(0, load * kGravity, 0) + forces.held.back().reaction.force.col(0));
  CHECK((joint - Vector3d(0.5, 0.4, 0)).norm() < 1e-12);
  CHECK(moment.norm() < 1e-9);
  // The clamp bends with 1.7 times the stiffness of half a link.
  const double angle =
      std::acos(vector_of(state.q, n, n - 1).dot(Vector3d(std::sin(2.0), std::cos(2.0), 0)));
  CHECK(forces.held.back().reaction.moment.col(0).norm() ==
        catena::near(1.7 * 2 * 0.3 * angle, 1e-9));
  CHECK(forces.support.moment.col(0).norm() == catena::near(forces.moment(0, 0), 1e-12));
}

TEST_CASE("clamped ends that move: energy, sensitivities and the adjoint") {
  const Model model = Model::load(GRIPPED_8);
  VectorXd p = cable(model, 0.3, 5e-3);
  set(model, p, "grips.to_side", 0.5);
  set(model, p, "grips.to_down", 0.4);
  set(model, p, "grips.turn", 0.8);
  set(model, p, "grips.end_turn", 2.0);
  set(model, p, "grips.amplitude", 0.1);
  set(model, p, "grips.turn_across", 0.5);
  const State start = closed(model, p, askew(model));
  const catena::Simulation motion = run(model, p, start, {0, 0.2, 0.5});
  CHECK(motion.energy_imbalance < 1e-9 * motion.trajectory.energy.cwiseAbs().maxCoeff());
  check_derivatives(model, p, start, {"damping_3", "grips.firmness", "grips.amplitude"}, 0.5);
}

TEST_CASE("a held joint and a held end that move: sensitivities and the adjoint") {
  const Model model = Model::load(HELD_TWICE_12);
  const VectorXd p = swung(model);
  check_derivatives(model, p, closed(model, p, askew(model)),
                    {"damping_7", "holds_end.amplitude", "holds_joint.amplitude"}, 0.2);
}

TEST_CASE("a cable with bending stiffness hangs in a loop between points of one vertical line") {
  const Model model = Model::load(HELD_END_12);
  VectorXd p = cable(model, 0.02, 0);
  set(model, p, "load_mass", 0);
  for (const double down : {-0.3, 0.0}) {
    CAPTURE(down);
    set(model, p, "holds_end.to_down", down);
    const State state = equilibrium(model, p);
    CHECK(gap(model, p, state.q, state.v, 0).norm() < 1e-12);
    const catena::InternalForces forces = forces_at_rest(model, p, state);
    const Vector3d weight(0, whole_mass(model, p) * kGravity, 0);
    CHECK((forces.support.force.col(0) + forces.held.back().reaction.force.col(0) + weight).norm() <
          1e-9);
    CHECK(state.q[12] > 0.5);
    CHECK(state.q[23] < -0.5);
  }
}

TEST_CASE("ends farther apart than the cable") {
  const Model model = Model::load(HELD_END_5);
  VectorXd p = swung(model);
  set(model, p, "holds_end.to_side", 1.3);
  CHECK_THROWS_WITH_AS(
      hanging_equilibrium(model, p),
      "the end is held 1.31909 m from the support, and the cable is 1.2 m long; it must be "
      "longer than its ends are apart",
      catena::ImpossibleValue);
}

// A joint without stiffness that is held parts the cable: on either side it moves as a cable of its own.
TEST_CASE("a cable that is held at a joint moves as two cables") {
  const Model whole = Model::load(HELD_TWICE_12), piece = Model::load(HELD_END_6);
  VectorXd p = swung(whole);
  set(whole, p, "holds_joint.amplitude", 0);
  set(whole, p, "stiffness_7", 0);
  set(whole, p, "damping_7", 0);
  set(whole, p, "load_mass", 0.3);
  const Vector3d joint(0.4, 0.15, -0.1), end(0.7, 0.2, 0.1);
  // The parameters of six links that begin with the given one.
  const auto part = [&](int first, const Vector3d& to, double amplitude) {
    VectorXd own = piece.default_parameters();
    for (const char* family : {"length", "mass", "inertia", "stiffness", "damping"})
      for (int i = 1; i <= 6; ++i)
        set(piece, own, (family + ("_" + std::to_string(i))).c_str(),
            p[whole.parameter_index(family + ("_" + std::to_string(first + i)))]);
    set(piece, own, "load_mass", first == 0 ? 0 : 0.3);
    set(piece, own, "holds_end.to_side", to[0]);
    set(piece, own, "holds_end.to_down", to[1]);
    set(piece, own, "holds_end.to_across", to[2]);
    set(piece, own, "holds_end.amplitude", amplitude);
    set(piece, own, "holds_end.frequency", 1.3);
    return own;
  };
  const VectorXd upper = part(0, joint, 0), lower = part(6, end - joint, 0.15);
  const State start = closed(whole, p, askew(whole));
  const auto of = [&](const VectorXd& all, Eigen::Index first) {
    VectorXd own = VectorXd::Zero(piece.coordinates());
    for (Eigen::Index axis = 0; axis < 3; ++axis)
      own.segment(6 * axis, 6) = all.segment(12 * axis + first, 6);
    return own;
  };
  const auto start_of = [&](Eigen::Index first) {
    State own = State::zero(piece);
    own.q = of(start.q, first), own.v = of(start.v, first);
    return own;
  };
  const std::vector<double> times{0, 0.3, 0.6, 1.0};
  const catena::Trajectory together = run(whole, p, start, times).trajectory,
                           above = run(piece, upper, start_of(0), times).trajectory,
                           below = run(piece, lower, start_of(6), times).trajectory;
  const catena::InternalForces forces = internal_forces(whole, p, together),
                               forces_above = internal_forces(piece, upper, above),
                               forces_below = internal_forces(piece, lower, below);
  REQUIRE(forces.held.size() == 2);
  CHECK(forces.held[0].link == 12);
  CHECK(forces.held[1].link == kHeldJoint);
  for (Eigen::Index k = 0; k < 4; ++k) {
    CAPTURE(k);
    CHECK((of(together.q.col(k), 0) - above.q.col(k)).head(18).cwiseAbs().maxCoeff() < 1e-7);
    CHECK((of(together.q.col(k), 6) - below.q.col(k)).head(18).cwiseAbs().maxCoeff() < 1e-7);
    const Vector3d expected =
        forces_above.held[0].reaction.force.col(k) + forces_below.support.force.col(k);
    CHECK((forces.held[1].reaction.force.col(k) - expected).norm() < 1e-5 * expected.norm());
    CHECK(
        (forces.held[0].reaction.force.col(k) - forces_below.held[0].reaction.force.col(k)).norm() <
        1e-5 * expected.norm());
  }
}

TEST_CASE("below a held joint the cable hangs plumb, above it as one that ends there") {
  const Model model = Model::load(HELD_JOINT_9);
  VectorXd p = swung(model);
  set(model, p, "holds_joint.amplitude", 0);
  const State state = equilibrium(model, p);
  CHECK(gap(model, p, state.q, state.v, 0).norm() < 1e-12);
  const catena::InternalForces forces = forces_at_rest(model, p, state);
  const Vector3d weight(0, whole_mass(model, p) * kGravity, 0);
  CHECK((holding(forces).col(0) + weight).norm() < 1e-9);
  // Without stiffness the rest of the cable hangs straight down.
  for (int i = 1; i <= 9; ++i) set(model, p, ("stiffness_" + std::to_string(i)).c_str(), 0);
  const State loose = equilibrium(model, p);
  for (Eigen::Index i = kHeldJoint; i < 9; ++i)
    CHECK((vector_of(loose.q, 9, i) - Vector3d::UnitY()).norm() < 1e-9);
}

TEST_CASE("two held places farther apart than the cable between them") {
  const Model model = Model::load(HELD_TWICE_12);
  VectorXd p = swung(model);
  set(model, p, "holds_joint.to_side", -0.2);
  set(model, p, "holds_joint.to_down", 0.2);
  set(model, p, "holds_joint.to_across", 0.1);
  CHECK_THROWS_WITH_AS(hanging_equilibrium(model, p),
                       "the end is held 0.9 m from where link 6 is held, and the cable between "
                       "them is 0.6 m long; it "
                       "must be longer than its ends are apart",
                       catena::ImpossibleValue);
  set(model, p, "holds_joint.to_side", 0.7);
  CHECK_THROWS_WITH_AS(hanging_equilibrium(model, p),
                       doctest::Contains("from the support, and the cable between them is 0.6 m"),
                       catena::ImpossibleValue);
}
