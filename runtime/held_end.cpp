// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/held_end.hpp"

#include <Eigen/LU>
#include <cmath>
#include <map>
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

/// The change of across(unit) w, w fixed, where the unit vector turns.
Vector3d along_turn(const Vector3d& unit, const Vector3d& turn, const Vector3d& w) {
  return -turn * unit.dot(w) - unit * turn.dot(w);
}

struct Gap {
  VectorXd apart, rate;
};

Gap gap_of(const Model& model, const VectorXd& parameters, const State& state, double t,
           const Signals& signals) {
  std::vector<double> u(static_cast<std::size_t>(3 * model.signals()));
  signals.evaluate(t, u.data());
  Gap gap{VectorXd(model.constraints()), VectorXd(model.constraints())};
  model.gap(
      {t, state.q.data(), state.v.data(), nullptr, state.z.data(), u.data(), parameters.data()},
      gap.apart.data(), gap.rate.data());
  return gap;
}

/// Links between two neighbouring places where the cable is held, or the support and the first of them.
struct Span {
  Index first, count;   ///< of its links, from 0
  Index place, before;  ///< where it ends, and where it begins, in the gaps; before the first: -1

  /// What belongs to its links, of q or v.
  VectorXd of(const VectorXd& all, Index links) const {
    VectorXd own(3 * count);
    for (Index i = 0; i < count; ++i) put(own, count, i, vector_of(all, links, first + i));
    return own;
  }
  /// From its beginning to its end, of vectors of each place.
  Vector3d across_it(const VectorXd& places) const {
    const Vector3d end = places.segment<3>(3 * place);
    return before < 0 ? end : Vector3d(end - places.segment<3>(3 * before));
  }
};

/// Throws ImpossibleValue where the links of `span`, of a chain of so many, cannot reach a place so far
/// away (m) as theirs is.
void check_reach(const Span& span, Index links, const VectorXd& lengths, double distance) {
  const double whole = lengths.sum(), longest = lengths.maxCoeff();
  const Index last = span.first + span.count;
  const std::string held =
      (last == links ? "the end" : "link " + std::to_string(last)) + " is held " +
      number_text(distance) + " m from " +
      (span.first == 0 ? "the support" : "where link " + std::to_string(span.first) + " is held") +
      ", and ";
  const std::string between = last == links && span.first == 0 ? "" : " between them";
  if (!(distance < whole))
    throw ImpossibleValue(held + "the cable" + between + " is " + number_text(whole) +
                          " m long; it must be longer than its ends are apart");
  if (!(distance > 2 * longest - whole))
    throw ImpossibleValue(held + "the longest link" + between + " is " + number_text(longest) +
                          " m long; the other links, " + number_text(whole - longest) +
                          " m, must be long enough to reach back");
}

/// Along the cable.
std::vector<Span> spans_of(const Model& model) {
  std::map<Index, Index> places;  // by link
  for (const int link : model.held_links()) places.emplace(link, static_cast<Index>(places.size()));
  std::vector<Span> spans;
  Index first = 0, before = -1;
  for (const auto& [link, place] : places) {
    spans.push_back({first, link - first, place, before});
    first = link;
    before = place;
  }
  return spans;
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
  State closed = open;
  for (Index i = 0; i < n; ++i) {
    const Vector3d unit = vector_of(open.q, n, i).normalized();
    put(closed.q, n, i, unit);
  }
  const VectorXd apart = gap_of(model, parameters, closed, t, signals).apart;
  const std::vector<Span> spans = spans_of(model);
  std::vector<Matrix3d> mobilities;
  for (const Span& span : spans) {
    const VectorXd lengths = parameters.segment(span.first, span.count);
    Vector3d target = -span.across_it(apart);
    for (Index i = 0; i < span.count; ++i)
      target += lengths[i] * vector_of(closed.q, n, span.first + i);
    check_reach(span, n, lengths, target.norm());
    const OpenShape shape(span.of(open.q, n), lengths, target);
    const Vector3d nu = shift(shape.vectors, lengths, target);
    Matrix3d mobility = Matrix3d::Zero();
    for (Index i = 0; i < span.count; ++i) {
      const Vector3d unit = (vector_of(shape.vectors, span.count, i) + nu).normalized();
      put(closed.q, n, span.first + i, unit);
      mobility += lengths[i] * across(unit);
    }
    mobilities.push_back(mobility);
  }
  for (Index i = 0; i < n; ++i)
    put(closed.v, n, i, across(vector_of(closed.q, n, i)) * vector_of(open.v, n, i));
  const Gap left = gap_of(model, parameters, closed, t, signals);
  for (std::size_t k = 0; k < spans.size(); ++k) {
    const Span& span = spans[k];
    const double whole = parameters.segment(span.first, span.count).sum();
    if (!(span.across_it(left.apart).norm() <= kClosed * whole))
      throw ImpossibleValue(
          "this start cannot be closed: no vector added to the directions of all links takes the "
          "end "
          "to "
          "where it is held; give angles that differ from link to link, or shape = \"hanging\"");
    const Vector3d eta = -mobilities[k].partialPivLu().solve(span.across_it(left.rate));
    for (Index i = span.first; i < span.first + span.count; ++i)
      put(closed.v, n, i, vector_of(closed.v, n, i) + across(vector_of(closed.q, n, i)) * eta);
  }
  return closed;
}

void close_direction(const Model& model, const VectorXd& parameters, const State& open,
                     const State& closed, SensitivityDirection& direction) {
  const Index n = model.links();
  const VectorXd zero = VectorXd::Zero(model.coordinates());
  const VectorXd dq = direction.q.size() ? direction.q : zero;
  const VectorXd dv = direction.v.size() ? direction.v : zero;
  direction.q = direction.v = zero;
  Index behind = 0;
  for (const Span& span : spans_of(model)) {
    const Index m = span.count;
    const VectorXd lengths = parameters.segment(span.first, m);
    const VectorXd q = span.of(closed.q, n), v = span.of(closed.v, n);
    const VectorXd open_q = span.of(open.q, n), open_v = span.of(open.v, n);
    const VectorXd own_dv = span.of(dv, n);
    Vector3d reach = Vector3d::Zero();
    for (Index i = 0; i < m; ++i) reach += lengths[i] * vector_of(q, m, i);
    const OpenShape shape(open_q, lengths, reach);
    const VectorXd& vectors = shape.vectors;
    const Vector3d nu = shift(vectors, lengths, reach);
    const VectorXd changes = shape.tangent(open_q, lengths, span.of(dq, n));
    Matrix3d mobility = Matrix3d::Zero(), softness = Matrix3d::Zero();
    Vector3d moved = Vector3d::Zero();
    VectorXd turned = VectorXd::Zero(3 * m);
    for (Index i = 0; i < m; ++i) {
      const Vector3d unit = vector_of(q, m, i);
      const double size = (vector_of(vectors, m, i) + nu).norm();
      put(turned, m, i, across(unit) * vector_of(changes, m, i) / size);
      moved += lengths[i] * vector_of(turned, m, i);
      softness += lengths[i] * across(unit) / size;
      mobility += lengths[i] * across(unit);
    }
    const Vector3d dnu = -softness.partialPivLu().solve(moved);
    Vector3d drift = Vector3d::Zero();
    for (Index i = 0; i < m; ++i) {
      const Vector3d unit = vector_of(q, m, i);
      put(turned, m, i,
          vector_of(turned, m, i) + across(unit) * dnu / (vector_of(vectors, m, i) + nu).norm());
      drift += lengths[i] * across(unit) * vector_of(own_dv, m, i);
    }
    // closed.v = across(unit) w with w = open.v + eta
    Vector3d eta = Vector3d::Zero();
    for (Index i = 0; i < m; ++i)
      eta +=
          lengths[i] * (vector_of(v, m, i) - across(vector_of(q, m, i)) * vector_of(open_v, m, i));
    eta = mobility.partialPivLu().solve(eta);
    VectorXd by_turning = VectorXd::Zero(3 * m);
    for (Index i = 0; i < m; ++i) {
      const Vector3d change =
          along_turn(vector_of(q, m, i), vector_of(turned, m, i), vector_of(open_v, m, i) + eta);
      put(by_turning, m, i, change);
      drift += lengths[i] * change;
    }
    const Vector3d deta = -mobility.partialPivLu().solve(drift);
    for (Index i = 0; i < m; ++i) {
      put(direction.q, n, span.first + i, vector_of(turned, m, i));
      put(direction.v, n, span.first + i,
          vector_of(by_turning, m, i) +
              across(vector_of(q, m, i)) * (vector_of(own_dv, m, i) + deta));
    }
    behind = span.first + m;
  }
  // Links behind the last held place: their directions are made vectors of length one, their rates perpendicular.
  for (Index i = behind; i < n; ++i) {
    const Vector3d unit = vector_of(closed.q, n, i);
    const Vector3d turn = across(unit) * vector_of(dq, n, i) / vector_of(open.q, n, i).norm();
    put(direction.q, n, i, turn);
    put(direction.v, n, i,
        across(unit) * vector_of(dv, n, i) + along_turn(unit, turn, vector_of(open.v, n, i)));
  }
}

}  // namespace catena
