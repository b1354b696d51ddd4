// SPDX-License-Identifier: BSD-3-Clause
//
// Initial shapes, positions and points along the cable.
#include "runtime/rest_states.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "runtime/positions.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/reference_model.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::CablePoint;
using catena::CatenaryFit;
using catena::Model;
using catena::Positions;
using catena::State;
using catena::testing::cable_parameters;
using catena::testing::reference_model;

Model cable(int links) { return Model::built_in(links); }

CablePoint end_of(const Model& model, const Eigen::VectorXd& p, const State& state) {
  const Positions at = catena::positions(model, p, 0.0, state.q);
  return {at.side[model.links()], at.down[model.links()]};
}

TEST_CASE("straight and listed angles are at rest") {
  const Model model = cable(4);
  const State tilted = catena::straight(model, 0.3);
  CHECK(tilted.q == Eigen::VectorXd::Constant(4, 0.3));
  CHECK(tilted.v == Eigen::VectorXd::Zero(4));
  const Eigen::VectorXd angles = Eigen::Vector4d(0.1, 0.2, -0.3, 4.0);
  CHECK(catena::from_angles(model, angles).q == angles);
  CHECK_THROWS_AS(catena::from_angles(model, angles.head(3)), std::invalid_argument);
  CHECK_THROWS_AS(catena::straight(model, std::nan("")), std::invalid_argument);
}

TEST_CASE("the end of the catenary is on the held point, or converges to it") {
  const CablePoint held_points[] = {{1.5, 2.5}, {-1.5, 2.5}, {2.0, -1.0}, {0.3, 3.0},
                                    {0.5, 0.5}, {3.3, 0.1},  {0.0, 3.39}, {-2.0, -2.7}};
  for (const CablePoint& held : held_points) {
    CAPTURE(held.side);
    CAPTURE(held.down);
    for (const int links : {12, 60}) {
      CAPTURE(links);
      const Model model = cable(links);
      const auto p = cable_parameters(model, 1.0, 0.0);
      const CablePoint end = end_of(model, p, catena::catenary(model, p, held));
      // Moved there until rounding stops it.
      CHECK(std::hypot(end.side - held.side, end.down - held.down) < 1e-11);
    }
  }
  double before = 0.0;
  for (const int links : {12, 60}) {
    const Model model = cable(links);
    const auto p = cable_parameters(model, 1.0, 0.0);
    const CablePoint end =
        end_of(model, p, catena::catenary(model, p, {1.5, 2.5}, CatenaryFit::kChords));
    const double missed = std::hypot(end.side - 1.5, end.down - 2.5);
    CHECK(missed > 1e-5);
    CHECK(missed < 0.02);
    if (before > 0.0) CHECK(before / missed == catena::near(25.0, 0.2));  // l^2
    before = missed;
  }
}

TEST_CASE("right below the support the catenary goes down and up again") {
  const Model model = cable(60);
  const auto p = cable_parameters(model, 1.0, 0.0);
  const State state = catena::catenary(model, p, {0.0, 1.0}, CatenaryFit::kChords);
  // (3.39 + 1) / 2 = 2.195 m down, then 1.195 m up: the fold is in link 39
  CHECK(state.q.head(38).cwiseAbs().maxCoeff() == 0.0);
  CHECK((state.q.tail(21).array() - std::acos(-1.0)).abs().maxCoeff() == 0.0);
  // A rigid link cannot fold: no chords of a catenary end there.
  CHECK_THROWS_AS(catena::catenary(model, p, {0.0, 1.0}), std::invalid_argument);
}

TEST_CASE("the chords lie on (2.53)") {
  // A symmetric catenary: parameter k = 1 m, from x = -1 to x = 1, so that it is 2 sinh(1) long.
  const Model model = cable(60);
  auto p = cable_parameters(model, 1.0, 0.0);
  const double length = 2.0 * std::sinh(1.0);
  p.head(60).setConstant(length / 60);
  const State state = catena::catenary(model, p, {2.0, 0.0}, CatenaryFit::kChords);
  for (int i = 0; i < 60; ++i) {
    // Joints at arc lengths s from the lowest point: x = asinh(s), y = cosh(x) - 1.
    const auto x = [&](int joint) { return std::asinh(length * (joint / 60.0 - 0.5)); };
    const double rise = std::cosh(x(i + 1)) - std::cosh(x(i));
    CHECK(state.q[i] == catena::near(std::atan2(x(i + 1) - x(i), -rise), 1e-12));
  }
}

TEST_CASE("a catenary is near the equilibrium of a limp cable held at both ends") {
  // With the end force H = w a to the side, and the cable's own tension, the torque on every link
  // vanishes: l [(weight below the middle) sin - (held force) ...] = 0. Checked by the shape: the
  // slope grows in proportion to the arc length, (2.33).
  const Model model = cable(60);
  const auto p = cable_parameters(model, 1.0, 0.0);
  const State state = catena::catenary(model, p, {1.5, 2.5}, CatenaryFit::kChords);
  const auto slope = [&](int i) { return 1.0 / std::tan(state.q[i]); };  // d down / d side
  const double step = slope(1) - slope(0);
  for (int i = 1; i + 1 < 60; ++i)
    CHECK(slope(i + 1) - slope(i) == catena::near(step, 2e-3));  // chords for tangents: step^2 / 12
}

TEST_CASE("a held point out of reach is refused") {
  const Model model = cable(12);
  const auto p = cable_parameters(model, 1.0, 0.0);
  std::string message = "nothing was thrown";
  try {
    catena::catenary(model, p, {3.0, 3.0});
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message.find("4.24264 m away, farther than the cable is long (3.39 m)") !=
        std::string::npos);
  CHECK_THROWS_AS(catena::catenary(model, p, {std::nan(""), 1.0}), std::invalid_argument);
  // One link has one length: no polygon of it ends anywhere else.
  const Model one(reference_model<1>());
  CHECK_THROWS_AS(catena::catenary(one, cable_parameters(one, 1.0, 0.0), {1.5, 2.5}),
                  std::invalid_argument);
}

TEST_CASE("hanging equilibrium: straight down, or where torques balance gravity") {
  const Model model = cable(3);
  auto p = cable_parameters(model, 2.0, 0.1);
  auto hanging = catena::hanging_equilibrium(model, p);
  REQUIRE(hanging.status == catena::Status::kSuccess);
  CHECK(hanging.state.q.cwiseAbs().maxCoeff() < 1e-12);
  p[5 * 3 + 1] = 4.0;  // torque_2
  hanging = catena::hanging_equilibrium(model, p);
  REQUIRE(hanging.status == catena::Status::kSuccess);
  CHECK(hanging.state.q.cwiseAbs().maxCoeff() > 0.05);
  Eigen::VectorXd residual(3);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(3);
  const catena_point at{0.0,     hanging.state.q.data(), zero.data(), zero.data(), nullptr, nullptr,
                        p.data()};
  model.residual(at, residual.data());
  CHECK(residual.cwiseAbs().maxCoeff() < 1e-11);  // N m, of some 10
}

TEST_CASE("no equilibrium is a status") {
  const Model model = cable(2);
  auto p = cable_parameters(model, 0.0, 0.1);
  p[5 * 2] = 1e3;  // torque_1 beyond what gravity can hold
  const auto spinning = catena::hanging_equilibrium(model, p);
  CHECK((spinning.status == catena::Status::kNoConvergence ||
         spinning.status == catena::Status::kSingular));
  CHECK_FALSE(spinning.message.empty());
}

TEST_CASE("points at arc length") {
  const Model model = cable(4);
  auto p = cable_parameters(model, 1.0, 0.0);
  p.head(4) << 0.5, 1.0, 0.25, 0.75;
  const State state = catena::from_angles(model, Eigen::Vector4d(0.1, 0.7, -0.3, 1.2));
  const Positions at = catena::positions(model, p, 0.0, state.q);
  struct Row {
    double arc;
    int link;
    double fraction;
  };
  for (const Row& row : {Row{0.0, 0, 0.0}, Row{0.5, 0, 1.0}, Row{0.9, 1, 0.4}, Row{1.5, 1, 1.0},
                         Row{1.625, 2, 0.5}, Row{2.5, 3, 1.0}, Row{2.5 + 1e-10, 3, 1.0}}) {
    CAPTURE(row.arc);
    const auto point = catena::point_at_arc_length(model, p, row.arc);
    CHECK(point.link == row.link);
    CHECK(point.fraction == catena::near(row.fraction, 1e-14));
    const CablePoint where = catena::position_of(at, point);
    const double along = row.fraction * p[row.link];
    CHECK(where.side ==
          catena::near(at.side[row.link] + along * std::sin(state.q[row.link]), 1e-14));
    CHECK(where.down ==
          catena::near(at.down[row.link] + along * std::cos(state.q[row.link]), 1e-14));
  }
  CHECK_THROWS_AS(catena::point_at_arc_length(model, p, -0.1), std::invalid_argument);
  CHECK_THROWS_AS(catena::point_at_arc_length(model, p, 2.6), std::invalid_argument);
  CHECK_THROWS_AS(catena::point_at_arc_length(model, p, std::nan("")), std::invalid_argument);
}

TEST_CASE("derivatives of points agree with central differences") {
  const Model model = cable(4);
  const auto p = cable_parameters(model, 1.0, 0.0);
  const Eigen::VectorXd q = Eigen::Vector4d(0.1, 0.7, -0.3, 1.2);
  const Eigen::VectorXd dq = Eigen::Vector4d(0.3, -0.2, 0.5, 1.0);
  Eigen::VectorXd dp = Eigen::VectorXd::Zero(p.size());
  dp.head(4) << 0.4, -0.1, 0.2, 0.3;
  const double arc = 1.9, h = 1e-6;
  const auto where = [&](double e) {
    const auto point = catena::point_at_arc_length(model, p + e * dp, arc);
    return catena::position_of(catena::positions(model, p + e * dp, 0.0, q + e * dq), point);
  };
  const auto point = catena::point_at_arc_length(model, p, arc);
  const CablePoint tangent = catena::position_tangent_of(
      catena::positions(model, p, 0.0, q), catena::positions_tangent(model, p, 0.0, q, dp, dq),
      point, catena::fraction_tangent(model, p, dp, point));
  // Central differences: h^2 from the third derivative, epsilon / h from rounding.
  CHECK(tangent.side == catena::near((where(h).side - where(-h).side) / (2 * h), 1e-8));
  CHECK(tangent.down == catena::near((where(h).down - where(-h).down) / (2 * h), 1e-8));

  const Eigen::VectorXd v = dq;
  const Positions ahead = catena::positions(model, p, 0.0, q + h * v),
                  behind = catena::positions(model, p, 0.0, q - h * v);
  Positions speed = ahead;
  model.velocities({0.0, q.data(), v.data(), v.data(), nullptr, nullptr, p.data()},
                   speed.side.data(), speed.down.data());
  CHECK((speed.side - (ahead.side - behind.side) / (2 * h)).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((speed.down - (ahead.down - behind.down) / (2 * h)).cwiseAbs().maxCoeff() < 1e-8);
}

}  // namespace
