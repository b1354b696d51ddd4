// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/rest_states.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "common/impossible_value.hpp"
#include "common/number_text.hpp"
#include "linear_algebra/decompositions.hpp"
#include "runtime/link_frame.hpp"
#include "runtime/link_vectors.hpp"
#include "runtime/space_equilibrium.hpp"

namespace catena {
namespace {

/// The catenary of given length from the origin to (side, down), by arc length.
///
/// With x to the side, y up and x_0 the lowest point, (2.53) reads y = a [cosh((x - x_0) / a) - 1]
/// and the arc length from x_0 is a sinh((x - x_0) / a). (The a here is the k of (2.53).)
class Catenary {
 public:
  /// Needs hypot(side, down) < length.
  Catenary(double side, double down, double length) : direction_(side < 0.0 ? -1.0 : 1.0) {
    const double span = std::abs(side);
    // 2 a sinh(span / (2 a)) = sqrt(length^2 - down^2)
    const double ratio = std::sqrt((length - down) * (length + down)) / span;
    if (!(ratio < 1e100)) {  // no span to speak of: straight down, and up again
      folded_ = true;
      lowest_ = (length + down) / 2;
      return;
    }
    a_ = span / (2.0 * solve_sinh(ratio));
    // tanh of (span / 2 - x_0) / a is the rise over the length
    x_lowest_ = span / 2 + a_ * std::atanh(down / length);
    lowest_ = a_ * std::sinh(x_lowest_ / a_);
  }

  CablePoint at(double arc) const {
    if (folded_) return {0.0, lowest_ - std::abs(arc - lowest_)};
    const double slope = (arc - lowest_) / a_, start = -lowest_ / a_;
    return {direction_ * (x_lowest_ + a_ * std::asinh(slope)),
            a_ * (std::hypot(1.0, start) - std::hypot(1.0, slope))};
  }

 private:
  /// xi > 0 with sinh(xi) = ratio xi, ratio > 1, by Newton's method from above, where it descends
  /// monotonically since sinh(xi) - ratio xi is convex.
  static double solve_sinh(double ratio) {
    // sinh(xi) / xi > 1 + xi^2 / 6 and sinh(xi) / xi > exp(xi / 2) / 2 for xi > 1.3 bound it.
    double xi = std::min(std::sqrt(6.0 * (ratio - 1.0)), 1.3 + 2.0 * std::log(2.0 * ratio));
    for (int iteration = 0; iteration < 200; ++iteration) {
      const double step = (std::sinh(xi) - ratio * xi) / (std::cosh(xi) - ratio);
      xi -= step;
      if (!(std::abs(step) > 1e-15 * xi)) break;
    }
    return xi;
  }

  double direction_;  // +1: the held point is to the positive side
  bool folded_ = false;
  double a_ = 0.0;         // m
  double x_lowest_ = 0.0;  // m, x_0
  double lowest_ = 0.0;    // m, arc length of the lowest point
};

State at_rest(const Model& model, Eigen::VectorXd angles) {
  if (model.in_space()) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(model.links());
    return from_directions(model, {std::move(angles), zero, zero, zero});
  }
  State state = State::zero(model);
  state.q.head(model.links()) = angles;
  return state;
}

/// Directions of the chords between the points at the ends of the links.
Eigen::VectorXd chord_angles(const Catenary& curve, const Eigen::VectorXd& lengths) {
  Eigen::VectorXd angles(lengths.size());
  double arc = 0.0;
  CablePoint upper;
  for (Eigen::Index i = 0; i < lengths.size(); ++i) {
    arc += lengths[i];
    const CablePoint lower = curve.at(arc);
    angles[i] = std::atan2(lower.side - upper.side, lower.down - upper.down);
    upper = lower;
  }
  return angles;
}

/// Angles of the chords of the catenary that ends at `end`.
Eigen::VectorXd catenary_angles(const Eigen::Vector2d& end, const Eigen::VectorXd& lengths) {
  const double whole = lengths.sum();
  if (end.norm() >= whole * (1.0 - 1e-12))  // taut
    return Eigen::VectorXd::Constant(lengths.size(), std::atan2(end[0], end[1]));
  return chord_angles(Catenary(end[0], end[1], whole), lengths);
}

Eigen::Vector2d free_end(const Eigen::VectorXd& angles, const Eigen::VectorXd& lengths) {
  return {lengths.dot(angles.array().sin().matrix()), lengths.dot(angles.array().cos().matrix())};
}

/// Angles of the neighbouring catenary whose polygon ends at `held`: the end of the curve is moved
/// until nothing is missed, by Newton's method with differences, each step shortened until it
/// helps.
Eigen::VectorXd held_angles(const Eigen::Vector2d& held, const Eigen::VectorXd& lengths) {
  const double whole = lengths.sum(), difference = 1e-7 * whole;
  const auto missed_by = [&](const Eigen::Vector2d& end) -> Eigen::Vector2d {
    return held - free_end(catenary_angles(end, lengths), lengths);
  };
  Eigen::Vector2d end = held, missed = missed_by(end);
  for (int iteration = 0; iteration < 100 && missed.norm() > 1e-15 * whole; ++iteration) {
    Eigen::Matrix2d slope;
    for (int k = 0; k < 2; ++k) {
      // inwards, where there is a catenary
      const double h = end[k] > 0.0 ? -difference : difference;
      slope.col(k) = (missed_by(end + h * Eigen::Vector2d::Unit(k)) - missed) / h;
    }
    Eigen::Vector2d step = -slope.partialPivLu().solve(missed);
    Eigen::Vector2d still_missed = missed_by(end + step);
    for (int halving = 0; halving < 40 && !(still_missed.norm() < missed.norm()); ++halving) {
      step /= 2;
      still_missed = missed_by(end + step);
    }
    if (!(still_missed.norm() < missed.norm())) break;
    end += step;
    missed = still_missed;
  }
  if (missed.norm() > 1e-12 * whole)
    throw ImpossibleValue("no catenary was found whose " + std::to_string(lengths.size()) +
                          " chords end on the held point (side " + number_text(held[0]) +
                          " m, down " + number_text(held[1]) +
                          " m); take more links, or the chords of the curve as they are");
  return catenary_angles(end, lengths);
}

}  // namespace

State straight(const Model& model, double angle) {
  return from_angles(model, Eigen::VectorXd::Constant(model.links(), angle));
}

State from_angles(const Model& model, const Eigen::VectorXd& angles) {
  if (angles.size() != model.links())
    throw std::invalid_argument("initial angles: " + std::to_string(angles.size()) +
                                " given, the model has " + std::to_string(model.links()) +
                                " links");
  for (Eigen::Index i = 0; i < angles.size(); ++i)
    if (!std::isfinite(angles[i]))
      throw ImpossibleValue("initial angle " + std::to_string(i + 1) + " = " +
                            number_text(angles[i]) + " must be finite");
  return at_rest(model, angles);
}

namespace {

double value_or_zero(const Eigen::VectorXd& values, Eigen::Index i) {
  return values.size() ? values[i] : 0.0;
}

LinkFrame frame_of(const LinkDirections& links, Eigen::Index i) {
  return {links.angle[i], value_or_zero(links.out_of_plane, i), links.azimuth[i]};
}

}  // namespace

State from_directions(const Model& model, const LinkDirections& links) {
  State state = State::zero(model);
  const Eigen::Index n = model.links();
  for (Eigen::Index i = 0; i < n; ++i) {
    const LinkFrame link = frame_of(links, i);
    put(state.q, n, i, link.direction());
    put(state.v, n, i,
        links.angle_rate[i] * link.by_angle() +
            value_or_zero(links.out_of_plane_rate, i) * link.by_out_of_plane() +
            links.azimuth_rate[i] * LinkFrame::by_azimuth(link.direction()));
  }
  return state;
}

State from_directions_tangent(const Model& model, const LinkDirections& links,
                              const LinkDirections& along) {
  State state = State::zero(model);
  const Eigen::Index n = model.links();
  for (Eigen::Index i = 0; i < n; ++i) {
    const LinkFrame link = frame_of(links, i);
    const double angle = value_or_zero(along.angle, i), out = value_or_zero(along.out_of_plane, i);
    const Eigen::Vector3d moved = angle * link.by_angle() + out * link.by_out_of_plane();
    // by_angle and by_out_of_plane change, too
    const Eigen::Vector3d angle_moved =
        -angle * link.cosine * link.in_plane - out * link.sine * link.turned_in_plane;
    const Eigen::Vector3d out_moved =
        -angle * link.sine * link.turned_in_plane - out * link.direction();
    put(state.q, n, i, moved);
    put(state.v, n, i,
        value_or_zero(along.angle_rate, i) * link.by_angle() +
            value_or_zero(along.out_of_plane_rate, i) * link.by_out_of_plane() +
            links.angle_rate[i] * angle_moved +
            value_or_zero(links.out_of_plane_rate, i) * out_moved +
            links.azimuth_rate[i] * LinkFrame::by_azimuth(moved));
  }
  return state;
}

State catenary(const Model& model, const Eigen::VectorXd& parameters, const CablePoint& held,
               CatenaryFit fit) {
  model.check_parameters(parameters);
  const Eigen::VectorXd lengths = parameters.head(model.links());
  const Eigen::Vector2d end(held.side, held.down);
  if (!end.allFinite())
    throw ImpossibleValue("held point (side " + number_text(held.side) + " m, down " +
                          number_text(held.down) + " m) must be finite");
  // A relative 1e-12 allows for the rounding of lengths that add up to the distance.
  if (end.norm() > lengths.sum() * (1.0 + 1e-12))
    throw ImpossibleValue("held point (side " + number_text(held.side) + " m, down " +
                          number_text(held.down) + " m) is " + number_text(end.norm()) +
                          " m away, farther than the cable is long (" + number_text(lengths.sum()) +
                          " m)");
  return at_rest(model, fit == CatenaryFit::kEndHeld ? held_angles(end, lengths)
                                                     : catenary_angles(end, lengths));
}

namespace {

Equilibrium plane_equilibrium(const Model& model, const Eigen::VectorXd& parameters, double t,
                              const Signals& signals) {
  const int n = model.coordinates();
  std::vector<double> u(static_cast<std::size_t>(3 * model.signals()));
  signals.evaluate(t, u.data());
  const Eigen::VectorXd zero =
      Eigen::VectorXd::Zero(std::max({n, model.states(), model.parameters(), 3 * model.signals()}));
  Equilibrium result;
  result.state = State::zero(model);
  Eigen::VectorXd& q = result.state.q;
  Eigen::VectorXd residual(n), direction = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd stiffness(n, n);  // dr/dq
  const catena_point at{t,           q.data(), zero.data(),      zero.data(),
                        zero.data(), u.data(), parameters.data()};
  const catena_point along{0.0,         direction.data(), zero.data(), zero.data(),
                           zero.data(), zero.data(),      zero.data()};
  for (int iteration = 0; iteration < 100; ++iteration) {
    model.residual(at, residual.data());
    for (int j = 0; j < n; ++j) {
      direction[j] = 1.0;
      model.residual_tangent(at, along, stiffness.col(j).data());
      direction[j] = 0.0;
    }
    const Eigen::VectorXd step = -solve_square(stiffness, residual);
    if (!step.allFinite()) {
      result.status = Status::kSingular;
      result.message =
          "the stiffness of the chain at rest is singular: no isolated equilibrium; give the chain "
          "gravity or stiffness, or begin with angles instead";
      return result;
    }
    // Newton's step, shortened to half a radian: farther away the linearisation says little.
    const double longest = step.cwiseAbs().maxCoeff();
    q += step * std::min(1.0, 0.5 / longest);
    if (longest <= 1e-13 * (1.0 + q.cwiseAbs().maxCoeff())) {
      result.status = Status::kSuccess;
      return result;
    }
  }
  result.status = Status::kNoConvergence;
  result.message =
      std::string("no equilibrium was found in 100 steps of Newton's method") + kWithoutEquilibrium;
  return result;
}

}  // namespace

Equilibrium hanging_equilibrium(const Model& model, const Eigen::VectorXd& parameters, double t,
                                const Signals& signals) {
  model.check_parameters(parameters);
  return model.in_space() ? space_equilibrium(model, parameters, t, signals)
                          : plane_equilibrium(model, parameters, t, signals);
}

}  // namespace catena
