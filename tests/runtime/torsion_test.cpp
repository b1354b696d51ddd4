// SPDX-License-Identifier: BSD-3-Clause
//
// Twisted cables between two clamps: against geometry, balances, Michell's ring, and their own derivatives.
#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "linear_algebra/decompositions.hpp"
#include "runtime/adjoint.hpp"
#include "runtime/held_end.hpp"
#include "runtime/internal_forces.hpp"
#include "runtime/rest_states.hpp"
#include "runtime/sensitivity.hpp"
#include "runtime/simulation.hpp"
#include "tests/runtime/space_cable.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::Model;
using catena::State;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::carried;
using testing::kGravity;
using testing::run;
using testing::set;
using testing::tight;
using testing::vector_of;

constexpr double kPi = std::numbers::pi;

/// Both ends are clamped; the far one swings, both turn, and it rolls.
VectorXd moved(const Model& model) {
  VectorXd p = cable(model, 0.3, 5e-3);
  set(model, p, "twists.to_side", 0.5);
  set(model, p, "twists.to_down", 0.4);
  set(model, p, "twists.turn", 0.8);
  set(model, p, "twists.end_turn", 2.0);
  set(model, p, "twists.amplitude", 0.1);
  set(model, p, "twists.turn_across", 0.5);
  set(model, p, "twists.torsion", 0.4);
  set(model, p, "twists.roll", 1.5);
  set(model, p, "twists.roll_rate", 3.0);
  return p;
}

State start_of(const Model& model, const VectorXd& p) {
  return closed_end(model, p, askew(model), 0, {});
}

/// The direction of a clamp of twists.toml.
Vector3d clamp(const Model& model, const VectorXd& p, const char* turn, double times, double t) {
  const double angle = p[model.parameter_index(turn)];
  const double across = p[model.parameter_index("twists.turn_across")] *
                        std::sin(times * kPi * p[model.parameter_index("twists.frequency")] * t);
  return Vector3d(std::sin(angle), std::cos(angle), across).normalized();
}

}  // namespace

TEST_CASE("the path of the twist is what a frame turns that is carried along the cable") {
  const Model model = Model::load(TWISTED_8);
  const VectorXd p = moved(model);
  const Index n = model.links();
  std::vector<double> times;
  for (int k = 0; k <= 1000; ++k) times.push_back(1e-3 * k);
  const catena::Trajectory path = run(model, p, start_of(model, p), times).trajectory;
  // Frames of the clamps that turn with them but do not spin about them, in steps of a millisecond.
  Vector3d first = clamp(model, p, "twists.turn", 2, 0),
           last = clamp(model, p, "twists.end_turn", 6, 0);
  Vector3d of_first = first.unitOrthogonal(), of_last = last.unitOrthogonal();
  double start = 0, before = 0, widest = 0, farthest = 0;
  for (Index k = 0; k < path.q.cols(); ++k) {
    const double t = times[static_cast<std::size_t>(k)];
    const Vector3d now = clamp(model, p, "twists.turn", 2, t),
                   now_last = clamp(model, p, "twists.end_turn", 6, t);
    of_first = carried(first, now, of_first);
    of_last = carried(last, now_last, of_last);
    first = now, last = now_last;
    Vector3d direction = first, frame = of_first;
    for (Index i = 0; i <= n; ++i) {
      const Vector3d next = i < n ? vector_of(path.q.col(k), n, i) : last;
      frame = carried(direction, next, frame);
      direction = next;
    }
    // From the carried frame to that of the end, about the end's direction: the twist without roll.
    double twist = std::atan2(frame.cross(of_last).dot(last), frame.dot(of_last));
    if (k == 0) start = before = twist;
    twist += 2 * kPi * std::round((before - twist) / (2 * kPi));
    before = twist;
    widest = std::max(widest, std::abs(path.z(0, k) - (twist - start)));
    farthest = std::max(farthest, std::abs(twist - start));
  }
  CHECK(farthest > 1);
  CHECK(widest < 1e-5);  // of the steps of the clamps' frames
}

TEST_CASE("the energy of a twisted cable balances, and derivatives are differences") {
  const Model model = Model::load(TWISTED_8);
  const VectorXd p = moved(model);
  const State start = start_of(model, p);
  const std::vector<double> times{0, 0.2, 0.5};
  const catena::Simulation motion = run(model, p, start, times);
  CHECK(motion.energy_imbalance < 1e-9 * motion.trajectory.energy.cwiseAbs().maxCoeff());
  const double twist = 1.5 + 3 * 0.5 + motion.trajectory.z(0, 2);
  for (int i = 0; i < model.energies(); ++i)
    if (std::string(model.table().energy_item[i].name) == "twists")
      CHECK(motion.trajectory.energy(i, 2) == catena::near(0.4 * twist * twist / 2 / 1.2, 1e-12));

  const auto directions = testing::directions_of(
      model, {"twists.torsion", "twists.roll", "twists.turn_across", "damping_3"});
  catena::SimulationOptions options = tight();
  options.sensitivities_in_error_test = true;
  const auto sensitive = simulate_with_sensitivities(model, p, start, directions, times, options);
  REQUIRE_MESSAGE(sensitive.status == catena::Status::kSuccess, sensitive.message);
  const auto adjoint = simulate_with_gradient(
      model, p, start, times,
      [](const catena::Trajectory& at, catena::Trajectory& slope) {
        slope.q(4, at.q.cols() - 1) = 1;
      },
      options);
  REQUIRE_MESSAGE(adjoint.status == catena::Status::kSuccess, adjoint.message);
  const Index links = Index{3} * model.links();
  for (const auto& [direction, found] : {std::pair(directions[0], sensitive.sensitivity[0]),
                                         {directions[1], sensitive.sensitivity[1]},
                                         {directions[2], sensitive.sensitivity[2]},
                                         {directions[3], sensitive.sensitivity[3]}}) {
    Index index = 0;
    direction.parameters.maxCoeff(&index);
    CAPTURE(index);
    const double h = 1e-5 * std::max(1e-2, p[index]);
    VectorXd more = p, less = p;
    more[index] += h, less[index] -= h;
    const catena::Trajectory above = run(model, more, start, times).trajectory,
                             below = run(model, less, start, times).trajectory;
    const VectorXd expected = (above.q.col(2) - below.q.col(2)).head(links) / (2 * h);
    CHECK((found.q.col(2).head(links) - expected).cwiseAbs().maxCoeff() <
          1e-5 * expected.cwiseAbs().maxCoeff());
    CHECK(found.z(0, 2) == catena::near((above.z(0, 2) - below.z(0, 2)) / (2 * h), 1e-4));
    CHECK(adjoint.gradient.parameters[index] == catena::near(found.q(4, 2), 1e-5));
  }
}

TEST_CASE("without torsional stiffness a twisted cable is one that is only clamped") {
  const Model twisted = Model::load(TWISTED_8), gripped = Model::load(GRIPPED_8);
  VectorXd p = moved(twisted), q = cable(gripped, 0.3, 5e-3);
  set(twisted, p, "twists.torsion", 0);
  set(twisted, p, "twists.turn_across", 0);
  for (const char* name : {"to_side", "to_down", "turn", "end_turn", "amplitude"})
    set(gripped, q, (std::string("grips.") + name).c_str(),
        p[twisted.parameter_index(std::string("twists.") + name)]);
  const std::vector<double> times{0, 0.5};
  const VectorXd a = run(twisted, p, start_of(twisted, p), times).trajectory.q.col(1),
                 b = run(gripped, q, start_of(gripped, q), times).trajectory.q.col(1);
  CHECK((a - b).head(24).cwiseAbs().maxCoeff() < 1e-8);
}

TEST_CASE("Newton's steps solve the equations with torsion") {
  const Model model = Model::load(TWISTED_8);
  const VectorXd p = moved(model);
  const State state = start_of(model, p);
  const int n = model.coordinates();
  VectorXd a = VectorXd::Zero(n), z = VectorXd::Constant(1, 0.7);
  const double t = 0.3, ca = 1.0, cv = 0.02, cq = 0.0004;
  REQUIRE(
      model.acceleration({t, state.q.data(), state.v.data(), a.data(), z.data(), nullptr, p.data()},
                         a.data()) == 0);
  const catena_point at{t, state.q.data(), state.v.data(), a.data(), z.data(), nullptr, p.data()};
  const VectorXd zero = VectorXd::Zero(std::max(n, model.parameters()));
  MatrixXd newton(n, n);
  Eigen::RowVectorXd row(n);
  VectorXd column(n);
  const VectorXd one = VectorXd::Ones(1);
  for (int j = 0; j < n; ++j) {
    const VectorXd da = ca * VectorXd::Unit(n, j), dv = cv * VectorXd::Unit(n, j),
                   dq = cq * VectorXd::Unit(n, j);
    const catena_point along{0,           dq.data(),   dv.data(),  da.data(),
                             zero.data(), zero.data(), zero.data()};
    model.residual_tangent(at, along, newton.col(j).data());
    model.state_rate_tangent(at, along, &row[j]);
  }
  model.residual_tangent(
      at, {0, zero.data(), zero.data(), zero.data(), one.data(), zero.data(), zero.data()},
      column.data());
  CHECK(column.norm() > 0.01);
  CHECK(row.norm() > 0.001);
  newton += cv * column * row;
  std::vector<double> work(static_cast<std::size_t>(model.table().newton_work));
  REQUIRE(model.newton_factor(at, ca, cv, cq, work.data()) == 0);
  const VectorXd right = VectorXd::LinSpaced(n, -1, 2);
  VectorXd x = right, y = right;
  model.newton_solve(work.data(), x.data());
  CHECK((newton * x - right).cwiseAbs().maxCoeff() < 1e-10);
  model.newton_solve_transposed(work.data(), y.data());
  CHECK((newton.transpose() * y - right).cwiseAbs().maxCoeff() < 1e-10);
}

TEST_CASE("reactions of a twisted cable at rest balance the weight and its moment") {
  const Model model = Model::load(TWISTED_8);
  VectorXd p = moved(model);
  set(model, p, "twists.turn_across", 0);
  set(model, p, "twists.roll_rate", 0);
  set(model, p, "twists.amplitude", 0);
  set(model, p, "twists.torsion", 0.1);
  const catena::Equilibrium found = hanging_equilibrium(model, p);
  REQUIRE_MESSAGE(found.status == catena::Status::kSuccess, found.message);
  const State& state = found.state;
  const Index n = model.links();
  CHECK(state.q.segment(2 * n, n).norm() > 0.05);  // twist moves it out of the plane of its clamps
  const catena::InternalForces forces =
      internal_forces(model, p, {{0.0}, state.q, state.v, state.z, {}});
  Vector3d moment = forces.support.moment.col(0) + forces.held.back().reaction.moment.col(0),
           joint(0, 0, 0);
  for (Index i = 0; i < n; ++i) {
    const Vector3d span = p[i] * vector_of(state.q, n, i);
    moment += (joint + span / 2).cross(Vector3d(0, p[n + i] * kGravity, 0));
    joint += span;
  }
  const double load = p[model.parameter_index("load_mass")];
  moment += joint.cross(Vector3d(0, load * kGravity, 0) + forces.held.back().reaction.force.col(0));
  CHECK(moment.norm() < 1e-9);
  // About its axis the clamp of a straight end would exert GJ roll / L, and bending does not.
  const Vector3d axis = clamp(model, p, "twists.end_turn", 6, 0);
  CHECK(forces.held.back().reaction.moment.col(0).dot(axis) == catena::near(0.1 * 1.5 / 1.2, 1e-9));
}

namespace {

/// A closed ring of equal links with EI = GJ = 1 N m^2 and a length of 1.2 m. The clamps hold half a link each,
/// so firmly that they hardly bend.
struct Ring {
  Model model;
  VectorXd p;
  State state;
  double moment = 0;  ///< of bending, N m

  explicit Ring(const Model& of) : model(of), state(State::zero(of)) {
    constexpr double kFirm = 1e6;
    const Index n = model.links();
    const double cells = static_cast<double>(n - 1), length = 1.2 / cells, turn = 2 * kPi / cells;
    p = cable(model, 1 / length, 0);
    p.head(n).setConstant(length);
    p[0] = p[n - 1] = length / 2;
    moment = turn / length;
    for (const char* name : {"load_mass", "gravity"}) set(model, p, name, 0);
    p[3 * n] *= kFirm;
    set(model, p, "twists.firmness", kFirm / 3);  // the clamp has a third of the length of joint n
    set(model, p, "twists.torsion", 1);
    set(model, p, "twists.turn", -turn / kFirm);
    set(model, p, "twists.end_turn", 2 * kPi + turn / kFirm);
    for (Index i = 0; i < n; ++i) {
      const double angle = turn * static_cast<double>(i);
      state.q[i] = std::sin(angle), state.q[n + i] = std::cos(angle);
    }
  }

  /// How the end of the last link moves, by axis.
  Vector3d move_of_end(const catena_point& at, const catena_point& along) const {
    const Index points = model.links() + 2;
    MatrixXd moves(points, 3);
    model.positions_tangent(at, along, moves.col(0).data(), moves.col(1).data());
    model.positions_across_tangent(at, along, moves.col(2).data());
    return moves.row(points - 2);
  }

  /// The smallest second derivative of the energy along a shape that keeps the ends, but for turning the
  /// ring about the direction of its clamps, which changes nothing.
  double stiffness(double twist) {
    set(model, p, "twists.roll", twist);
    const int n = model.coordinates(), links = 3 * model.links();
    VectorXd a = VectorXd::Zero(n);
    const catena_point still{0,       state.q.data(), state.v.data(), a.data(), state.z.data(),
                             nullptr, p.data()};
    REQUIRE(model.acceleration(still, a.data()) == 0);
    a.head(links).setZero();
    VectorXd rest(n);
    model.residual(still, rest.data());
    CHECK(rest.head(links).cwiseAbs().maxCoeff() < 1e-4 * moment);
    const VectorXd zero = VectorXd::Zero(std::max(n, model.parameters()));
    const VectorXd one = VectorXd::Ones(1);
    MatrixXd stiffness(links, links), gap(3, links);
    Eigen::RowVectorXd row(links);
    VectorXd column(n);
    for (int j = 0; j < links; ++j) {
      const VectorXd d = VectorXd::Unit(n, j);
      const catena_point moved{0,           d.data(),    zero.data(), zero.data(),
                               zero.data(), zero.data(), zero.data()};
      const catena_point going{0,           zero.data(), d.data(),   zero.data(),
                               zero.data(), zero.data(), zero.data()};
      model.residual_tangent(still, moved, column.data());
      stiffness.col(j) = column.head(links);
      model.state_rate_tangent(still, going, &row[j]);
      gap.col(j) = move_of_end(still, moved);
    }
    model.residual_tangent(
        still, {0, zero.data(), zero.data(), zero.data(), one.data(), zero.data(), zero.data()},
        column.data());
    stiffness += column.head(links) * row;
    // What moves no end, keeps lengths, and is not the turn.
    const Index count = model.links();
    MatrixXd kept = MatrixXd::Zero(count + 4, links);
    kept.topRows(3) = gap;
    for (Index i = 0; i < count; ++i) {
      const Vector3d direction = vector_of(state.q, count, i),
                     turned = Vector3d(0, 1, 0).cross(direction);
      for (Index axis = 0; axis < 3; ++axis) {
        kept(3, axis * count + i) = turned[axis];
        kept(4 + i, axis * count + i) = direction[axis];
      }
    }
    const MatrixXd rows = catena::orthonormal_basis(kept.transpose(), 1e-10);
    const MatrixXd free = catena::orthonormal_basis(
        MatrixXd::Identity(links, links) - rows * rows.transpose(), 1e-10);
    REQUIRE(free.cols() == links - kept.rows());
    const MatrixXd k = free.transpose() * stiffness * free;
    CHECK((k - k.transpose()).norm() < 1e-9 * k.norm());  // there is an energy
    return catena::symmetric_eigenpairs(k).values[0];
  }

  double critical_twist() {
    double below = 1, above = 20;
    REQUIRE(stiffness(below) > 0);
    REQUIRE(stiffness(above) < 0);
    while (above - below > 1e-5) {
      const double middle = (below + above) / 2;
      (stiffness(middle) > 0 ? below : above) = middle;
    }
    return below;
  }
};

}  // namespace

// Michell 1889: a ring leaves its plane at a twist of 2 pi sqrt(3) EI / GJ.
TEST_CASE("a twisted ring buckles at Michell's twist") {
  const double expected = 2 * kPi * std::sqrt(3.0);
  const double coarse = Ring(Model::load(TWISTED_12)).critical_twist(),
               fine = Ring(Model::load(TWISTED_24)).critical_twist();
  CHECK(fine == catena::near(expected, 0.02));
  // The error goes as the square of the length of a link, in rings of 11 and 23; then as its fourth power.
  const double ratio = 23.0 * 23.0 / (11.0 * 11.0);
  CHECK((ratio * fine - coarse) / (ratio - 1) == catena::near(expected, 0.003));
}
