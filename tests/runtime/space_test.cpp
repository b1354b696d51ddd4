// SPDX-License-Identifier: BSD-3-Clause
//
// Chains in space against what is known: the chain of the plane, pendulums, a hanging chain's modes.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "linear_algebra/decompositions.hpp"
#include "runtime/adjoint.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/positions.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/runtime/vertical_plane.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::check_motion_in_plane;
using testing::hand;
using testing::kGravity;
using testing::planar_start;
using testing::run;
using testing::tight;

/// One link as a pendulum: angle'' = -strength sin(angle) in a plane.
double strength(const Model& model, const VectorXd& p) {
  const double length = p[0], mass = p[1], load = p[model.parameter_index("load_mass")];
  return kGravity * length * (load + mass / 2) / (length * length * (load + mass / 4) + p[2]);
}

}  // namespace

TEST_CASE("in any vertical plane the chain in space moves as the chain of the plane") {
  const Model space = Model::load(SPATIAL_12), plane = Model::built_in(12);
  const auto [expected, found] = check_motion_in_plane(
      plane, cable(plane, 0.2, 2e-3), space, cable(space, 0.2, 2e-3), planar_start(plane, space));
  for (Eigen::Index k = 0; k < expected.energy.cols(); ++k)
    for (int item = 0; item < 4; ++item)  // kinetic, gravity, elastic, damping
      CHECK(found.energy(item, k) == catena::near(expected.energy(item, k), 1e-7));
}

TEST_CASE("energies balance in space, over 3 s, to 1e-9 of their size") {
  const Model model = Model::load(SPATIAL_12);
  const VectorXd p = cable(model, 0.2, 2e-3);
  const catena::Simulation result = run(model, p, askew(model), {0, 1, 2, 3});
  const double size = result.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(size > 1.0);  // J
  CHECK(result.energy_imbalance < 1e-9 * size);
  CHECK(result.trajectory.energy(3, 3) > 0.01 * size);  // damped
  // nothing pulls the vectors along the links
  for (int i = 0; i < 12; ++i)
    CHECK(result.trajectory.q.col(3)(Eigen::seqN(i, 3, 12)).norm() == catena::near(1, 1e-7));
}

TEST_CASE("the motion does not depend on the lengths of the vectors along the links") {
  const Model model = Model::load(SPATIAL_12);
  const VectorXd p = cable(model, 0.2, 2e-3);
  const State initial = askew(model);
  State longer = initial;
  longer.q *= 1.5;
  longer.v = 1.5 * initial.v + 0.1 * initial.q;  // and they grow
  const catena::Simulation one = run(model, p, initial, {0, 0.5});
  const catena::Simulation other = run(model, p, longer, {0, 0.5});
  const catena::Positions here = positions(model, p, 0.5, one.trajectory.q.col(1));
  const catena::Positions there = positions(model, p, 0.5, other.trajectory.q.col(1));
  CHECK((here.side - there.side).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((here.across - there.across).cwiseAbs().maxCoeff() < 1e-8);
  CHECK(other.trajectory.q.col(1).norm() > 1.5 * one.trajectory.q.col(1).norm());
  catena::Trajectory normal = other.trajectory;
  normalise_directions(normal, model.links());
  CHECK(normal.q.col(1).norm() == catena::near(std::sqrt(12.0), 1e-14));
  CHECK(normal.q.col(1)(Eigen::seqN(3, 3, 12)).dot(normal.v.col(1)(Eigen::seqN(3, 3, 12))) ==
        doctest::Approx(0).epsilon(1e-12));
}

TEST_CASE("a conical pendulum keeps its angle: omega^2 cos(angle) = g / l") {
  const Model model = Model::load(SPATIAL_1);
  const VectorXd p = cable(model, 0, 0);
  const double angle = 0.6, omega = std::sqrt(strength(model, p) / std::cos(angle));
  const auto one = [](double value) { return VectorXd::Constant(1, value); };
  const State initial = from_directions(model, {one(angle), one(0.3), one(0), one(omega)});
  const catena::Simulation result = run(model, p, initial, {0, 1.5, 3});
  for (Eigen::Index k = 0; k < 3; ++k) {
    const double azimuth = 0.3 + omega * result.trajectory.time[static_cast<std::size_t>(k)];
    CHECK(result.trajectory.q(0, k) == catena::near(std::sin(angle) * std::cos(azimuth), 1e-8));
    CHECK(result.trajectory.q(1, k) == catena::near(std::cos(angle), 1e-8));
    CHECK(result.trajectory.q(2, k) == catena::near(std::sin(angle) * std::sin(azimuth), 1e-8));
  }
}

// With z = cos(angle), h = (1 - z^2) azimuth': z'^2 = 2 k (z - z1) (z2 - z) (z - z3), whose three roots
// follow from the start; azimuth and time from one turning point to the other are integrals.
TEST_CASE("a spherical pendulum precesses as its integrals say") {
  const Model model = Model::load(SPATIAL_1);
  const VectorXd p = cable(model, 0, 0);
  const double k = strength(model, p), angle = 1.2, rate = 0.9;
  const double z1 = std::cos(angle), h = std::sin(angle) * std::sin(angle) * rate;
  const double energy = 0.5 * rate * h - k * z1;
  const double sum = -energy / k - z1, product = -1 - z1 * sum;
  const double root = std::sqrt(sum * sum - 4 * product);
  const double z2 = (sum + root) / 2, z3 = (sum - root) / 2;
  REQUIRE((z1 < z2 && z2 < 1 && z3 < -1));
  double time = 0, azimuth = 0;
  constexpr int kPoints = 64;  // of a smooth periodic integrand: exact
  for (int i = 0; i < kPoints; ++i) {
    const double u = std::numbers::pi * ((i + 0.5) / kPoints - 0.5);
    const double z = (z1 + z2) / 2 + (z2 - z1) / 2 * std::sin(u);
    const double step = std::numbers::pi / kPoints / std::sqrt(2 * k * (z - z3));
    time += step;
    azimuth += step * h / (1 - z * z);
  }
  const auto one = [](double value) { return VectorXd::Constant(1, value); };
  const State initial = from_directions(model, {one(angle), one(0), one(0), one(rate)});
  const catena::Simulation result = run(model, p, initial, {0, time, 2 * time});
  const auto q = result.trajectory.q;
  CHECK(q(1, 1) == catena::near(z2, 1e-8));
  CHECK(q(1, 2) == catena::near(z1, 1e-8));
  CHECK(std::abs(std::remainder(std::atan2(q(2, 2), q(0, 2)) - 2 * azimuth, 2 * std::numbers::pi)) <
        1e-8);
  CHECK(std::abs(2 * azimuth - std::numbers::pi) > 0.02);  // it does precess
}

TEST_CASE("a hanging chain swings with Bessel's frequencies, in two planes alike") {
  const Model model = Model::load(SPATIAL_24);
  const int n = model.coordinates();
  VectorXd p = cable(model, 0, 0);
  p[model.parameter_index("load_mass")] = 0;
  const State rest = State::zero(model);
  const VectorXd zero = VectorXd::Zero(std::max<Eigen::Index>(n, p.size()));
  VectorXd along_q = VectorXd::Zero(n);
  const catena_point at{0, rest.q.data(), zero.data(), zero.data(), nullptr, nullptr, p.data()};
  const catena_point along{0,       along_q.data(), zero.data(), zero.data(),
                           nullptr, nullptr,        zero.data()};
  Eigen::MatrixXd mass(n, n), stiffness(n, n);
  model.table().mass_matrix(model.table().context, &at, mass.data());
  for (int j = 0; j < n; ++j) {
    along_q[j] = 1;
    model.residual_tangent(at, along, stiffness.col(j).data());
    along_q[j] = 0;
  }
  // Lengths have no frequency: the first links are zero.
  const auto squares = catena::generalised_eigenvalues(stiffness, mass);
  const double zeros_of_bessel[] = {2.404825557695773, 5.520078110286311, 8.653727912911012};
  for (int mode = 0; mode < 3; ++mode) {
    const double expected = zeros_of_bessel[mode] / 2 * std::sqrt(kGravity / 1.2);
    for (int plane = 0; plane < 2; ++plane) {
      const auto found = static_cast<double>(squares[model.links() + 2 * mode + plane]);
      CHECK(std::sqrt(found) == catena::near(expected, 0.01));
    }
  }
}

TEST_CASE("sensitivities in space are differences of motions") {
  const Model model = Model::load(SPATIAL_12);
  const VectorXd p = cable(model, 0.2, 2e-3);
  const int stiffness = model.parameter_index("stiffness_3");
  const auto direction = catena::SensitivityDirection::parameter(model, stiffness);
  const auto sensitive =
      simulate_with_sensitivities(model, p, askew(model), {direction}, {0, 0.4}, tight());
  REQUIRE_MESSAGE(sensitive.status == catena::Status::kSuccess, sensitive.message);
  const double step = 1e-4;
  VectorXd more = p, less = p;
  more[stiffness] += step;
  less[stiffness] -= step;
  const VectorXd difference = (run(model, more, askew(model), {0, 0.4}).trajectory.q.col(1) -
                               run(model, less, askew(model), {0, 0.4}).trajectory.q.col(1)) /
                              (2 * step);
  CHECK(difference.norm() > 1e-3);
  CHECK((sensitive.sensitivity[0].q.col(1) - difference).norm() < 1e-5 * (1 + difference.norm()));
}

// Blocks of 3 x 3 against the whole matrices, for one link, even and odd numbers of links.
TEST_CASE("what is solved in O(n) in space is what whole matrices give") {
  for (const char* file : {SPATIAL_1, SPATIAL_12, SPATIAL_15}) {
    const Model model = Model::load(file);
    CAPTURE(model.links());
    const int n = model.coordinates();
    const VectorXd p = cable(model, 0.2, 2e-3);
    State initial = askew(model);
    initial.q *= 1.1;  // no unit vectors
    initial.v += 0.2 * initial.q;
    VectorXd a = VectorXd::LinSpaced(n, -3, 5), bias(n), found(n);
    const catena::Signals none;
    catena::Dynamics dynamics(model, p, none);
    const catena_point at = dynamics.at(0, initial.q.data(), initial.v.data(), a.data(), nullptr);
    Eigen::MatrixXd mass(n, n);
    const catena_model& table = model.table();
    table.mass_matrix(table.context, &at, mass.data());
    CHECK((mass - mass.transpose()).cwiseAbs().maxCoeff() == 0);
    table.bias(table.context, &at, bias.data());
    REQUIRE(model.acceleration(at, found.data()) == 0);
    // Residuals of solutions do not depend on how well the matrix is conditioned.
    const double size = bias.norm() + mass.norm() * found.norm();
    CHECK((mass * found + bias).norm() < 1e-14 * size);

    catena::LinearSolver used{};
    const auto blocks = make_newton_matrix(model, catena::LinearSolver::kAutomatic, used);
    CHECK(used == catena::LinearSolver::kStructured);
    const auto whole = make_newton_matrix(model, catena::LinearSolver::kDense, used);
    const double gamma = 2e-3;  // s, of a step
    REQUIRE(blocks->factor(dynamics, at, gamma) == 0);
    REQUIRE(whole->factor(dynamics, at, gamma) == 0);
    const VectorXd right = VectorXd::LinSpaced(n, 1, -2);
    const auto compare = [&](auto solve) {
      VectorXd x = right, y = right;
      solve(*blocks, x.data());
      solve(*whole, y.data());
      CHECK((x - y).norm() < 1e-11 * y.norm());
    };
    compare([](const catena::NewtonMatrix& matrix, double* x) { matrix.solve(x); });
    compare([](const catena::NewtonMatrix& matrix, double* x) { matrix.solve_transposed(x); });
  }
}

TEST_CASE("motions, sensitivities and gradients in space do not depend on the solver") {
  const Model model = Model::load(SPATIAL_12);
  const VectorXd p = cable(model, 0.2, 2e-3);
  const State initial = askew(model);
  const auto objective = [](const catena::Trajectory& motion, catena::Trajectory& slope) {
    slope.q(motion.q.rows() - 1, motion.q.cols() - 1) = 1.0;
  };
  catena::SimulationOptions dense = tight();
  dense.linear_solver = catena::LinearSolver::kDense;
  const int stiffness = model.parameter_index("stiffness_3");
  const auto direction = catena::SensitivityDirection::parameter(model, stiffness);
  const std::vector<double> times{0, 0.3};
  const auto structured_run =
      simulate_with_sensitivities(model, p, initial, {direction}, times, tight());
  const auto dense_run = simulate_with_sensitivities(model, p, initial, {direction}, times, dense);
  CHECK(structured_run.statistics.used == catena::LinearSolver::kStructured);
  CHECK(dense_run.statistics.used == catena::LinearSolver::kDense);
  const auto differs = [](const VectorXd& x, const VectorXd& y) { return (x - y).norm(); };
  CHECK(differs(structured_run.trajectory.q.col(1), dense_run.trajectory.q.col(1)) < 1e-8);
  const VectorXd change = dense_run.sensitivity[0].q.col(1);
  CHECK(change.norm() > 1e-3);
  CHECK(differs(structured_run.sensitivity[0].q.col(1), change) < 1e-6 * change.norm());
  // The gradient by the adjoint equations is the sensitivity of the one coordinate.
  for (const catena::SimulationOptions& options : {tight(), dense}) {
    const auto gradient = simulate_with_gradient(model, p, initial, times, objective, options);
    REQUIRE_MESSAGE(gradient.status == catena::Status::kSuccess, gradient.message);
    CHECK(gradient.gradient.parameters[stiffness] ==
          catena::near(change[model.coordinates() - 1], 1e-6));
  }
}

namespace {

/// The vectors along the links, turned.
VectorXd turned(const VectorXd& q, const Eigen::Matrix3d& rotation) {
  VectorXd result(q.size());
  const Eigen::Index n = q.size() / 3;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d vector(q[i], q[n + i], q[2 * n + i]);
    const Eigen::Vector3d other = rotation * vector;
    for (int axis = 0; axis < 3; ++axis) result[axis * n + i] = other[axis];
  }
  return result;
}

constexpr double kHandTolerance = 1e-7;  // signals are splines through samples every millisecond

}  // namespace

TEST_CASE("a support that is accelerated in space is gravity in another direction") {
  const Model plain = Model::load(SPATIAL_5), held = Model::load(HELD_BY_HAND_5);
  const Eigen::Vector3d acceleration(1.5, -2.0, 3.0);  // m/s^2: side, down, across
  const catena::Signals signals =
      hand([&](double t) { return Eigen::Vector3d(acceleration * (t * t / 2)); },
           [](double) { return Eigen::Vector3d(0, 1, 0); });
  VectorXd p = cable(plain, 0.2, 2e-3), of_held(held.parameters());
  const int first_joint = plain.parameter_index("stiffness_1");
  p[first_joint] = p[plain.parameter_index("damping_1")] = 0;  // the clamp would keep its direction
  of_held << p, 1.0;
  const Eigen::Vector3d weight = Eigen::Vector3d(0, kGravity, 0) - acceleration;
  Eigen::Matrix3d to_down;
  for (int axis = 0; axis < 3; ++axis)
    to_down.col(axis) = testing::carried(weight.normalized(), Eigen::Vector3d(0, 1, 0),
                                         Eigen::Vector3d::Unit(axis));
  const State initial = askew(held);
  State other = initial;
  other.q = turned(initial.q, to_down);
  other.v = turned(initial.v, to_down);
  p[plain.parameter_index("gravity")] = weight.norm();
  const auto found = simulate(held, of_held, initial, {0, 0.5, 1}, tight(), signals);
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  const auto expected = run(plain, p, other, {0, 0.5, 1});
  for (Eigen::Index k = 0; k < 3; ++k) {
    const VectorXd difference =
        turned(found.trajectory.q.col(k), to_down) - expected.trajectory.q.col(k);
    CHECK(difference.norm() < kHandTolerance);
  }
  // and the support is where the hand is
  const catena::Positions there = positions(held, of_held, 1, found.trajectory.q.col(2), signals);
  CHECK(there.across[0] == catena::near(1.5, 1e-9));
}

TEST_CASE("without gravity a turned clamp turns the motion, whatever its length") {
  const Model plain = Model::load(SPATIAL_5), held = Model::load(HELD_BY_HAND_5);
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Vector3d clamp = 2.5 * rotation.col(1);
  const catena::Signals signals = hand([](double) { return Eigen::Vector3d(0, 0, 0); },
                                       [&](double) { return Eigen::Vector3d(clamp); });
  VectorXd p = cable(plain, 0.2, 2e-3), of_held(held.parameters());
  p[plain.parameter_index("gravity")] = 0;
  of_held << p, 1.0;
  const State initial = askew(plain);
  State other = initial;
  other.q = turned(initial.q, rotation);
  other.v = turned(initial.v, rotation);
  const auto found = simulate(held, of_held, other, {0, 1}, tight(), signals);
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  const auto expected = run(plain, p, initial, {0, 1});
  CHECK((found.trajectory.q.col(1) - turned(expected.trajectory.q.col(1), rotation)).norm() <
        kHandTolerance);
}

TEST_CASE("a hand that moves and turns does the work that the energies say") {
  const Model model = Model::load(HELD_BY_HAND_5);
  CHECK(model.table().structured == 1);
  const catena::Signals signals = hand(
      [](double t) {
        return Eigen::Vector3d(0.2 * std::sin(3 * t), 0.05 * std::cos(5 * t),
                               0.1 * std::sin(4 * t));
      },
      [](double t) { return Eigen::Vector3d(std::sin(2 * t), 1.0, std::sin(3 * t + 1)); });
  VectorXd p(model.parameters());
  p << cable(Model::load(SPATIAL_5), 0.2, 2e-3), 1.0;
  // The imbalance is what the steps leave of it: 2.9e-9 J at the tolerance of the other tests.
  catena::SimulationOptions options = tight();
  options.relative_tolerance = options.absolute_tolerance_velocity = 1e-13;
  options.absolute_tolerance_position = 1e-14;
  const auto result = simulate(model, p, askew(model), {0, 1, 2, 3}, options, signals);
  REQUIRE_MESSAGE(result.status == catena::Status::kSuccess, result.message);
  const double size = result.trajectory.energy.col(0).cwiseAbs().sum();
  CHECK(result.energy_imbalance < 1e-9 * size);
  const Eigen::Index supplied = result.trajectory.energy.rows() - 1;
  CHECK(std::string(model.table().energy_item[supplied].name) == "support");
  CHECK(std::abs(result.trajectory.energy(supplied, 3)) > 0.01 * size);
}
