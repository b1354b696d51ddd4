// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/held_end.hpp"

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "common/impossible_value.hpp"
#include "common/number_text.hpp"
#include "runtime/link_vectors.hpp"

namespace catena {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

Matrix3d across(const Vector3d& unit) { return Matrix3d::Identity() - unit * unit.transpose(); }

struct Gap {
  Vector3d apart, rate;
};

Gap gap_of(const Model& model, const VectorXd& parameters, const State& state, double t,
           const Signals& signals) {
  std::vector<double> u(static_cast<std::size_t>(3 * model.signals()));
  signals.evaluate(t, u.data());
  Gap gap;
  model.gap(
      {t, state.q.data(), state.v.data(), nullptr, state.z.data(), u.data(), parameters.data()},
      gap.apart.data(), gap.rate.data());
  return gap;
}

/// The least of sum l |q + nu| - nu . target: Newton's method, each step shortened until it helps.
Vector3d shift(const VectorXd& q, const VectorXd& lengths, const Vector3d& target) {
  const Index n = lengths.size();
  const auto value = [&](const Vector3d& nu) {
    double sum = -nu.dot(target);
    for (Index i = 0; i < n; ++i) sum += lengths[i] * (vector_of(q, n, i) + nu).norm();
    return sum;
  };
  Vector3d nu = Vector3d::Zero();
  double now = value(nu);
  for (int iteration = 0; iteration < 200; ++iteration) {
    Vector3d slope = -target;
    Matrix3d curvature = Matrix3d::Zero();
    for (Index i = 0; i < n; ++i) {
      const Vector3d sum = vector_of(q, n, i) + nu;
      const double size = sum.norm();
      slope += lengths[i] * sum / size;
      curvature += lengths[i] * across(sum / size) / size;
    }
    Vector3d step = -curvature.partialPivLu().solve(slope);
    const double decrease = -slope.dot(step);
    double next = value(nu + step);
    for (int halving = 0; halving < 60 && !(next <= now - 1e-4 * decrease + 1e-15 * std::abs(now));
         ++halving) {
      step /= 2;
      next = value(nu + step);
    }
    nu += step;
    now = next;
    if (step.norm() <= 1e-15 * (1 + nu.norm()) || slope.norm() <= 1e-16 * lengths.sum()) break;
  }
  return nu;
}

}  // namespace

State closed_end(const Model& model, const VectorXd& parameters, const State& open, double t,
                 const Signals& signals) {
  const Index n = model.links();
  const VectorXd lengths = parameters.head(n);
  State closed = open;
  Vector3d reach = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(open.q, n, i).normalized();
    put(closed.q, n, i, unit);
    reach += lengths[i] * unit;
  }
  const Vector3d target = reach - gap_of(model, parameters, closed, t, signals).apart;
  if (!(target.norm() < lengths.sum()))
    throw ImpossibleValue("the end is held " + number_text(target.norm()) +
                          " m from the support, and the cable is " + number_text(lengths.sum()) +
                          " m long; it must be longer than its ends are apart");
  const Vector3d nu = shift(closed.q, lengths, target);
  Matrix3d mobility = Matrix3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = (vector_of(closed.q, n, i) + nu).normalized();
    put(closed.q, n, i, unit);
    put(closed.v, n, i, across(unit) * vector_of(open.v, n, i));
    mobility += lengths[i] * across(unit);
  }
  const Vector3d eta =
      -mobility.partialPivLu().solve(gap_of(model, parameters, closed, t, signals).rate);
  for (Index i = 0; i < n; ++i)
    put(closed.v, n, i, vector_of(closed.v, n, i) + across(vector_of(closed.q, n, i)) * eta);
  return closed;
}

void close_direction(const Model& model, const VectorXd& parameters, const State& open,
                     const State& closed, SensitivityDirection& direction) {
  const Index n = model.links();
  const VectorXd zero = VectorXd::Zero(model.coordinates());
  const VectorXd dq = direction.q.size() ? direction.q : zero;
  const VectorXd dv = direction.v.size() ? direction.v : zero;
  const VectorXd lengths = parameters.head(n);
  VectorXd units = open.q;
  Vector3d reach = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) {
    put(units, n, i, vector_of(open.q, n, i).normalized());
    reach += lengths[i] * vector_of(closed.q, n, i);
  }
  const Vector3d nu = shift(units, lengths, reach);
  direction.q = direction.v = zero;
  Matrix3d mobility = Matrix3d::Zero(), softness = Matrix3d::Zero();
  Vector3d moved = Vector3d::Zero();
  VectorXd turned = zero;
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i), before = vector_of(units, n, i);
    const double size = (before + nu).norm(), length = vector_of(open.q, n, i).norm();
    put(turned, n, i, across(unit) * across(before) * vector_of(dq, n, i) / (length * size));
    moved += lengths[i] * vector_of(turned, n, i);
    softness += lengths[i] * across(unit) / size;
    mobility += lengths[i] * across(unit);
  }
  const Vector3d dnu = -softness.partialPivLu().solve(moved);
  Vector3d drift = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i);
    const Vector3d turn =
        vector_of(turned, n, i) + across(unit) * dnu / (vector_of(units, n, i) + nu).norm();
    put(direction.q, n, i, turn);
    drift += lengths[i] * across(unit) * vector_of(dv, n, i);
  }
  // closed.v = across(unit) w with w = open.v + eta
  Vector3d eta = Vector3d::Zero();
  for (Index i = 0; i < n; ++i)
    eta += lengths[i] * (vector_of(closed.v, n, i) -
                         across(vector_of(closed.q, n, i)) * vector_of(open.v, n, i));
  eta = mobility.partialPivLu().solve(eta);
  VectorXd by_turning = zero;
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i), turn = vector_of(direction.q, n, i);
    const Vector3d w = vector_of(open.v, n, i) + eta;
    const Vector3d change = -turn * unit.dot(w) - unit * turn.dot(w);
    put(by_turning, n, i, change);
    drift += lengths[i] * change;
  }
  const Vector3d deta = -mobility.partialPivLu().solve(drift);
  for (Index i = 0; i < n; ++i)
    put(direction.v, n, i,
        vector_of(by_turning, n, i) +
            across(vector_of(closed.q, n, i)) * (vector_of(dv, n, i) + deta));
}

}  // namespace catena
