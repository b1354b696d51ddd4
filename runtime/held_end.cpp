// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/held_end.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>
#include <string>
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

/// Links are parallel if their directions differ so little that nu would bend them a hundred times more:
/// about the square root of what their reach, or the held end, leaves of the cable.
constexpr double kParallel = 1e-4;
/// Of a vector of length one: shorter, its direction says nothing.
constexpr double kNoDirection = 1e-3;
/// Of the length of the cable: a wider gap is not closed.
constexpr double kClosed = 1e-9;

/// The vectors to which nu is added: the directions of links, or, where these are parallel and nu would be
/// undetermined, those of half a circle: it begins on the side of the links and ends on the other one. What
/// closes it is about a catenary. `q` need not be of length one.
struct OpenShape {
  VectorXd units, vectors;
  bool bent = false;
  Vector3d along,
      sag;  ///< axes of the half circle; the second is not normalised, and zero if given

  OpenShape(const VectorXd& q, const VectorXd& lengths, const Vector3d& target)
      : units(q), along(Vector3d::Zero()), sag(Vector3d::Zero()) {
    const Index n = lengths.size();
    const double whole = lengths.sum();
    Vector3d common = Vector3d::Zero();
    for (Index i = 0; i < n; ++i) {
      const Vector3d unit = vector_of(q, n, i).normalized();
      put(units, n, i, unit);
      common += lengths[i] / whole * unit;
    }
    vectors = units;
    bent = 1 - common.norm() < kParallel * (1 - target.norm() / whole);
    if (!bent) return;
    along =
        target.norm() > kNoDirection * whole ? Vector3d(target.normalized()) : Vector3d::UnitX();
    sag = across(along) * common;
    Vector3d down = sag;
    if (sag.norm() < kNoDirection) {
      sag.setZero();
      down = across(along) * Vector3d::UnitY();
      if (down.norm() < kNoDirection) down = across(along) * Vector3d::UnitX();
    }
    down.normalize();
    for (Index i = 0; i < n; ++i)
      put(vectors, n, i,
          vector_of(units, n, i) - common + std::cos(turn(lengths, i)) * down +
              std::sin(turn(lengths, i)) * along);
  }

  /// Of `vectors`, along a change of q.
  VectorXd tangent(const VectorXd& q, const VectorXd& lengths, const VectorXd& dq) const {
    const Index n = lengths.size();
    VectorXd change = dq;
    Vector3d common = Vector3d::Zero();
    for (Index i = 0; i < n; ++i) {
      const Vector3d turned =
          across(vector_of(units, n, i)) * vector_of(dq, n, i) / vector_of(q, n, i).norm();
      put(change, n, i, turned);
      common += lengths[i] / lengths.sum() * turned;
    }
    if (!bent) return change;
    Vector3d down = Vector3d::Zero();
    if (!sag.isZero(0)) down = across(sag.normalized()) * across(along) * common / sag.norm();
    for (Index i = 0; i < n; ++i)
      put(change, n, i, vector_of(change, n, i) - common + std::cos(turn(lengths, i)) * down);
    return change;
  }

 private:
  /// The angle of a link's middle on the half circle.
  static double turn(const VectorXd& lengths, Index i) {
    return std::numbers::pi * (lengths.head(i).sum() + lengths[i] / 2) / lengths.sum();
  }
};

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
  const double whole = lengths.sum(), longest = lengths.maxCoeff();
  State closed = open;
  Vector3d reach = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(open.q, n, i).normalized();
    put(closed.q, n, i, unit);
    reach += lengths[i] * unit;
  }
  const Vector3d target = reach - gap_of(model, parameters, closed, t, signals).apart;
  const std::string held =
      "the end is held " + number_text(target.norm()) + " m from the support, and ";
  if (!(target.norm() < whole))
    throw ImpossibleValue(held + "the cable is " + number_text(whole) +
                          " m long; it must be longer than its ends are apart");
  if (!(target.norm() > 2 * longest - whole))
    throw ImpossibleValue(held + "the longest link is " + number_text(longest) +
                          " m long; the other links, " + number_text(whole - longest) +
                          " m, must be long enough to reach back");
  const OpenShape shape(open.q, lengths, target);
  const Vector3d nu = shift(shape.vectors, lengths, target);
  Matrix3d mobility = Matrix3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = (vector_of(shape.vectors, n, i) + nu).normalized();
    put(closed.q, n, i, unit);
    put(closed.v, n, i, across(unit) * vector_of(open.v, n, i));
    mobility += lengths[i] * across(unit);
  }
  const Gap left = gap_of(model, parameters, closed, t, signals);
  if (!(left.apart.norm() <= kClosed * whole))
    throw ImpossibleValue(
        "this start cannot be closed: no vector added to the directions of all links takes the end "
        "to "
        "where it is held; give angles that differ from link to link, or shape = \"hanging\"");
  const Vector3d eta = -mobility.partialPivLu().solve(left.rate);
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
  Vector3d reach = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) reach += lengths[i] * vector_of(closed.q, n, i);
  const OpenShape shape(open.q, lengths, reach);
  const VectorXd& vectors = shape.vectors;
  const Vector3d nu = shift(vectors, lengths, reach);
  const VectorXd changes = shape.tangent(open.q, lengths, dq);
  direction.q = direction.v = zero;
  Matrix3d mobility = Matrix3d::Zero(), softness = Matrix3d::Zero();
  Vector3d moved = Vector3d::Zero();
  VectorXd turned = zero;
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i);
    const double size = (vector_of(vectors, n, i) + nu).norm();
    put(turned, n, i, across(unit) * vector_of(changes, n, i) / size);
    moved += lengths[i] * vector_of(turned, n, i);
    softness += lengths[i] * across(unit) / size;
    mobility += lengths[i] * across(unit);
  }
  const Vector3d dnu = -softness.partialPivLu().solve(moved);
  Vector3d drift = Vector3d::Zero();
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i);
    const Vector3d turn =
        vector_of(turned, n, i) + across(unit) * dnu / (vector_of(vectors, n, i) + nu).norm();
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
