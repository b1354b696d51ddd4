// SPDX-License-Identifier: BSD-3-Clause
//
// Starts of chains that are held: closing them, and the derivative of that.
#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "common/impossible_value.hpp"
#include "tests/runtime/held_cable.hpp"
#include "tests/runtime/space_cable.hpp"

using catena::Model;
using catena::State;
using Eigen::Vector3d;
using Eigen::VectorXd;
using testing::askew;
using testing::cable;
using testing::closed;
using testing::gap;
using testing::set;
using testing::swung;
using testing::vector_of;

namespace {

/// A start that is closed at 0.2 s, and its derivative against differences of step h.
State check_closed(const Model& model, const VectorXd& p, const State& open, const VectorXd& dq,
                   const VectorXd& dv, double h) {
  const auto moved = [&](double step) {
    State state = open;
    state.q += step * dq, state.v += step * dv;
    return closed_end(model, p, state, 0.2, {});
  };
  State shut = moved(0);
  VectorXd apart(model.constraints()), rate(model.constraints());
  model.gap({0.2, shut.q.data(), shut.v.data(), nullptr, nullptr, nullptr, p.data()}, apart.data(),
            rate.data());
  CHECK(apart.norm() < 1e-14);
  CHECK(rate.norm() < 1e-13);
  catena::SensitivityDirection direction{{}, dq, dv, {}};
  close_direction(model, p, open, shut, direction);
  const State more = moved(h), less = moved(-h);
  const Eigen::Index links = Eigen::Index{3} * model.links();
  CHECK((direction.q - (more.q - less.q) / (2 * h)).head(links).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((direction.v - (more.v - less.v) / (2 * h)).head(links).cwiseAbs().maxCoeff() < 1e-8);
  return shut;
}

}  // namespace

TEST_CASE("a start is closed, and its derivative is that of closing it") {
  for (const char* file : {HELD_END_5, HELD_JOINT_9, HELD_TWICE_12}) {
    CAPTURE(file);
    const Model model = Model::load(file);
    const VectorXd dq = VectorXd::LinSpaced(model.coordinates(), -1, 2),
                   dv = VectorXd::LinSpaced(model.coordinates(), 2, -3);
    check_closed(model, swung(model), askew(model), dq, dv, 1e-6);
  }
}

TEST_CASE(
    "a straight start is closed to a cable that sags, and its derivative is that of closing it") {
  for (const char* file : {HELD_END_2, HELD_END_5, HELD_END_60}) {
    CAPTURE(file);
    const Model model = Model::load(file);
    const Eigen::Index n = model.links();
    const VectorXd p = swung(model);
    VectorXd dv = VectorXd::LinSpaced(model.coordinates(), 1, -2);
    for (const double angle : {0.0, 0.3, 0.9}) {
      CAPTURE(angle);
      const VectorXd angles = VectorXd::Constant(n, angle);
      const State open = from_angles(model, angles);
      // all links turn alike, so that they stay parallel
      VectorXd dq = VectorXd::Zero(model.coordinates());
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        dq.segment(axis * n, n).setConstant(Vector3d(1, -0.4, 0.7)[axis]);
      State shut = check_closed(model, p, open, dq, dv, 1e-6);
      // It goes down first, no joint folds, and a little more of what was given changes a little.
      CHECK(shut.q[n] > shut.q[2 * n - 1]);
      for (Eigen::Index i = 1; i < n; ++i)
        CHECK(vector_of(shut.q, n, i).dot(vector_of(shut.q, n, i - 1)) > -0.9);
      State near = open;
      near.q[0] += 1e-3;
      CHECK((closed_end(model, p, near, 0.2, {}).q - shut.q).cwiseAbs().maxCoeff() < 0.02);
    }
  }
}

TEST_CASE("a straight start is closed where the end is in line with it, or at the support") {
  const Model model = Model::load(HELD_END_5);
  VectorXd p = cable(model, 0.02, 0);
  for (const double down : {0.0, 0.6, -0.6}) {
    CAPTURE(down);
    set(model, p, "holds_end.to_down", down);
    State shut = closed(model, p, State::zero(model));
    CHECK(gap(model, p, shut.q, shut.v, 0).norm() < 1e-14);
    for (Eigen::Index i = 1; i < 5; ++i)
      CHECK(vector_of(shut.q, 5, i).dot(vector_of(shut.q, 5, i - 1)) > -0.9);
  }
}

TEST_CASE("a start that no vector closes is refused") {
  const Model model = Model::load(HELD_END_2);
  VectorXd p = cable(model, 0.02, 0);
  set(model, p, "holds_end.to_down", 0.5);
  State up_and_down = State::zero(model);
  up_and_down.q[3] = -1;
  CHECK_THROWS_WITH_AS(closed(model, p, up_and_down),
                       doctest::Contains("this start cannot be closed: no vector"),
                       catena::ImpossibleValue);
}

TEST_CASE("an end nearer than the other links reach back from the longest one") {
  const Model model = Model::load(HELD_END_2);
  VectorXd p = cable(model, 0, 0);
  p[0] = 1.0, p[1] = 0.1;
  set(model, p, "holds_end.to_side", 0.5);
  CHECK_THROWS_WITH_AS(
      closed(model, p, askew(model)),
      "the end is held 0.5 m from the support, and the longest link is 1 m long; the other links, "
      "0.1 m, must be long enough to reach back",
      catena::ImpossibleValue);
  set(model, p, "holds_end.to_side", 0.95);
  State shut = closed(model, p, State::zero(model));
  CHECK(gap(model, p, shut.q, shut.v, 0).norm() < 1e-14);
}
