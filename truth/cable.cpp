// SPDX-License-Identifier: BSD-3-Clause
//
// Notation. Link i has the unit vectors t = (sin a, cos a) along it, away from the support, and
// n = (cos a, -sin a) across it, in (side, down) components; its length is l (1 + strain). The
// unknowns q are the link angles and, for an extensible cable, the links' extensions. Newton's
// equations are written for each link and projected on the velocities that a change of q allows:
//
//   angle i:      n_i . ( l_i sum_{k>i} R_k + b_i R_i ) + torques        = 0
//   extension i:  t_i . ( sum_{k>i} R_k + R_i b_i / l_i ) - e_i / (l_i compliance) = 0
//
// R_k = F_k - m_k acc_k is the force that a link (or the load) lacks, b_i the distance of the mass
// centre of the link from its upper end.
//
// Implicit midpoint rule: q' = v, with everything taken at the middle of the step; the unknown is
// the middle velocity. Newton's matrix is made by differences and kept while it converges.
#include "truth/cable.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "truth/hermite.hpp"
#include "truth/vector.hpp"

namespace truth {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

/// The sign of a rate (rad/s), smooth below 0.008 rad/s, which is below all rates of interest.
double rounded_sign(double rate) { return std::tanh(rate / 0.008); }

/// What of x is beyond -gap to gap.
double past(double x, double gap) { return std::max(0.0, x - gap) - std::max(0.0, -x - gap); }

/// A force that grows to a limit and falls beyond, as what slips does; without a limit (0) it stays as it is.
double slipping(double force, double limit) {
  const double share = limit > 0 ? force / (2 * limit) : 0;
  return force / (1 + share * share);
}

class Chain {
 public:
  Chain(const Cable& cable, const Hidden& hidden)
      : cable_(cable),
        hidden_(hidden),
        n_(cable.links),
        unknowns_(hidden.axial_stiffness > 0 ? 2 * n_ : n_),
        link_(cable.length / n_),
        link_mass_(cable.density * cable.length / n_) {}

  int unknowns() const { return unknowns_; }
  int links() const { return n_; }

  /// Residual of Newton's equations at (t, q, v, a). `memory`: the part of each joint angle that has not given way
  /// (hysteresis), or not relaxed. `outside`: takes what the laws outside of every library do, if it is wanted.
  void residual(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                const VectorXd& memory, VectorXd& r, OutsideForces* outside = nullptr) const;

  struct Moving {
    Vector position, velocity, acceleration;
  };
  Moving support(double t) const;

  double extension(const VectorXd& q, int i) const { return unknowns_ > n_ ? q[n_ + i] : 0.0; }

  double link() const { return link_; }

  double mechanical_energy(const VectorXd& q, const VectorXd& v) const;

 private:
  Vector cable_force(Vector velocity, Vector along, Vector across) const;
  Vector load_force(double t, Vector at, Vector velocity) const;
  double tie_force(double distance, double rate) const;
  Vector middle_force(double t, Vector at, Vector velocity, Vector acceleration) const;
  double middle_moment(double angle, double rate) const;
  double joint_moment(int i, double angle, double rate, double tension, double memory,
                      OutsideForces* outside) const;

  Cable cable_;
  Hidden hidden_;
  int n_;
  int unknowns_;
  double link_, link_mass_;
};

/// Hidden forces on one link at its centre; gravity and inertia are added by the caller.
Vector Chain::cable_force(Vector velocity, Vector along, Vector across) const {
  const Hidden& h = hidden_;
  const double vn = dot(velocity, across), vt = dot(velocity, along);
  Vector force =
      -h.drag_isotropic * norm(velocity) * velocity +
      (-h.drag_linear_normal * vn - h.drag_quadratic_normal * std::abs(vn) * vn) * across +
      (-h.drag_linear_tangential * vt - h.drag_quadratic_tangential * std::abs(vt) * vt) * along;
  const Vector relative = velocity - Vector{h.wind, 0};
  const double un = dot(relative, across), ut = dot(relative, along);
  force = force + (-h.wind_normal * std::abs(un) * un) * across +
          (-h.wind_tangential * std::abs(ut) * ut) * along;
  return link_ * (force - Vector{0, h.buoyancy * cable_.gravity});
}

Vector Chain::load_force(double t, Vector at, Vector velocity) const {
  const Hidden& h = hidden_;
  Vector force =
      -h.load_drag * norm(velocity) * velocity - Vector{0, h.load_buoyancy * cable_.gravity};
  if (h.magnet != 0) {
    const Vector away = Vector{0, cable_.length + h.magnet_depth} - at;
    const double distance2 = dot(away, away) + 1e-4;
    force = force + (h.magnet / (distance2 * std::sqrt(distance2))) * away;
  }
  if (h.carried != 0 && t < 1.0) {
    const double c = std::cos(std::numbers::pi * t / 2);  // the hand releases the load smoothly
    force = force - Vector{0, h.carried * cable_.load_mass * cable_.gravity * c * c};
  }
  return force;
}

/// Hidden forces on mid-cable.
Vector Chain::middle_force(double t, Vector at, Vector velocity, Vector acceleration) const {
  const Hidden& h = hidden_;
  Vector force = -h.place_drag * norm(velocity) * velocity +
                 h.insect * (Vector{0, cable_.gravity} - acceleration);
  const double speed = norm(velocity);
  if (speed > h.vane_speed) force = force - (h.vane * (speed - h.vane_speed) / speed) * velocity;
  force.side -= h.valve * std::max(0.0, velocity.side);
  force.side -= h.wall_spring * (at.side - h.wall_side);
  force.side -= h.stop * std::max(0.0, at.side - h.stop_side);
  const Vector to_hook = Vector{h.string_side, h.string_down} - at;
  const double length = norm(to_hook);
  if (length > h.string_slack)
    force = force + (h.string * (length - h.string_slack) / length) * to_hook;
  if (h.kick != 0) {  // a smooth push of 40 ms
    const double x = (t - h.kick_time) / 0.02;
    if (std::abs(x) < 1) force.side += h.kick / 0.02 * 0.5 * (1 + std::cos(std::numbers::pi * x));
  }
  force.side += h.push / (1 + std::exp(-2 * (t - h.push_time) / 0.2));
  constexpr double kRise = 0.05, kBegin = 1.5;  // s
  const double since = t - kBegin;
  if (h.shove != 0)
    force.side += h.shove * std::exp(-std::max(0.0, since) / h.shove_fade) /
                  (1 + std::exp(-2 * since / kRise));
  if (h.shake != 0 && since > 0 && since < h.shake_period)
    force.side += h.shake * std::sin(2 * std::numbers::pi * since / h.shake_period);
  for (int j = 0; h.gusts != 0 && j < 5; ++j)  // 0.3 to 2.3 Hz
    force.side += h.gusts * std::sin(2 * std::numbers::pi * (0.3 + 0.5 * j) * t +
                                     (j + 1) * (j + 1) * h.gusts_turn);
  return force;
}

/// Hidden force that draws mid-cable and the middle of the last link together.
double Chain::tie_force(double distance, double rate) const {
  const Hidden& h = hidden_;
  return slipping(h.tie * std::max(0.0, distance - h.tie_slack), h.tie_limit) +
         h.tie_damping * rate + h.tie_valve * std::max(0.0, rate);
}

/// Hidden moment against the angle of the joint at mid-cable.
double Chain::middle_moment(double angle, double rate) const {
  const Hidden& h = hidden_;
  const double share = rate / h.brake_rate;
  return h.brake * rate / (1 + share * share) + h.loose * past(rate, h.loose_rate) +
         h.joint_stop * past(angle, h.joint_gap);
}

/// Moment against the angle of joint i, whose links hold each other with `tension` (N). `memory`: of this joint.
double Chain::joint_moment(int i, double angle, double rate, double tension, double memory,
                           OutsideForces* outside) const {
  const Hidden& h = hidden_;
  const double share = i == 0 ? 2 : 1;  // the clamp holds the cable half a link away
  const double stiffness = cable_.bending_stiffness / link_,
               damping = cable_.bending_damping / link_;
  double moment =
      share * (stiffness * (angle - h.rest_curvature * link_ / share) + damping * rate) +
      h.joint_quadratic_damping * std::abs(rate) * rate +
      h.cubic_stiffness * angle * angle * angle + h.joint_friction * rounded_sign(rate);
  if (h.tension_friction != 0) moment += h.tension_friction * tension * rounded_sign(rate);
  if (i == n_ / 2) {
    const double against = middle_moment(angle, rate) +
                           slipping(h.maxwell * memory, h.maxwell_limit) +
                           h.eccentric_pull * tension;
    moment += against;
    if (outside) {
      outside->joint_angle = angle;
      outside->joint_rate = rate;
      outside->joint_moment = -against;
    }
  }
  if (outside)
    outside->joints[static_cast<std::size_t>(i)] = {
        angle, rate,
        h.joint_friction + h.tension_friction * tension + (i == 0 ? h.pivot_friction : 0)};
  if (h.hysteresis_moment != 0) moment += h.hysteresis_moment / h.hysteresis_reach * memory;
  if (i == 0)
    moment += -share * stiffness * h.pivot_rest_angle + h.pivot_stiffness * angle +
              h.pivot_damping * rate + h.pivot_friction * rounded_sign(rate);
  return moment;
}

Chain::Moving Chain::support(double t) const {
  const Hidden& h = hidden_;
  const double w = 2 * std::numbers::pi * h.support_frequency;
  Moving support;
  const auto harmonic = [&](double amplitude, double phase, double& x, double& xd, double& xdd) {
    x = amplitude * std::sin(w * t + phase);
    xd = amplitude * w * std::cos(w * t + phase);
    xdd = -w * w * x;
  };
  harmonic(h.support_side_amplitude, h.support_side_phase, support.position.side,
           support.velocity.side, support.acceleration.side);
  harmonic(h.support_down_amplitude, h.support_down_phase, support.position.down,
           support.velocity.down, support.acceleration.down);
  return support;
}

void Chain::residual(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                     const VectorXd& memory, VectorXd& r, OutsideForces* outside) const {
  const Hidden& h = hidden_;
  const bool stretches = unknowns_ > n_;
  thread_local std::vector<Vector> lack, along, across;
  thread_local std::vector<double> turning;  // moments on a link, but for those of its joints
  lack.resize(static_cast<std::size_t>(n_));
  along.resize(lack.size());
  across.resize(lack.size());
  turning.resize(lack.size());

  const Vector gravity = {cable_.gravity * std::sin(h.gravity_tilt),
                          cable_.gravity * std::cos(h.gravity_tilt)};
  Moving end = support(t), tied;  // what the tie holds at mid-cable

  // Down the chain: positions, velocities, accelerations and the force that each link lacks.
  for (int i = 0; i < n_; ++i) {
    const auto k = static_cast<std::size_t>(i);
    along[k] = {std::sin(q[i]), std::cos(q[i])};
    across[k] = {std::cos(q[i]), -std::sin(q[i])};
    const double e = stretches ? q[n_ + i] : 0, ed = stretches ? v[n_ + i] : 0,
                 edd = stretches ? a[n_ + i] : 0;
    const auto beyond = [&](double distance, double share) -> Moving {
      const double d = distance + share * e, dd = share * ed, ddd = share * edd;
      return {end.position + d * along[k], end.velocity + dd * along[k] + (d * v[i]) * across[k],
              end.acceleration + (ddd - d * v[i] * v[i]) * along[k] +
                  (d * a[i] + 2 * dd * v[i]) * across[k]};
    };
    const Moving centre = beyond((0.5 + h.centre_fraction) * link_, 0.5 + h.centre_fraction);
    lack[k] = link_mass_ * (gravity - centre.acceleration) +
              cable_force(centre.velocity, along[k], across[k]);
    turning[k] = -h.link_damping * link_ * v[i];
    if (h.added_normal != 0 || h.added_tangential != 0) {
      // The fluid's momentum is link (normal vn n + tangential vt t); force = minus its rate, and
      // the axes that turn with the link leave the moment link (tangential - normal) vn vt.
      const double vn = dot(centre.velocity, across[k]), vt = dot(centre.velocity, along[k]);
      const double vnd = dot(centre.acceleration, across[k]) - v[i] * vt;
      const double vtd = dot(centre.acceleration, along[k]) + v[i] * vn;
      lack[k] = lack[k] - link_ * h.added_normal * (vnd * across[k] - (vn * v[i]) * along[k]) -
                link_ * h.added_tangential * (vtd * along[k] + (vt * v[i]) * across[k]);
      turning[k] += link_ * (h.added_tangential - h.added_normal) * vn * vt;
    }
    if (i == n_ / 2 - 1) {  // the link whose lower end is mid-cable
      const Vector force = middle_force(t, centre.position, centre.velocity, centre.acceleration);
      lack[k] = lack[k] + force;
      if (outside)
        outside->middle = {centre.position, centre.velocity, centre.acceleration, q[i], force};
      tied = centre;
    }
    if (i == n_ - 1 && n_ > 2) {
      const Vector apart = centre.position - tied.position;
      const double distance = norm(apart),
                   rate = dot(apart, centre.velocity - tied.velocity) / distance;
      const Vector drawn = (tie_force(distance, rate) / distance) * apart;
      lack[k] = lack[k] - drawn;
      const auto above = static_cast<std::size_t>(n_ / 2 - 1);
      lack[above] = lack[above] + drawn;
      if (outside) outside->tie = {distance, rate, -tie_force(distance, rate)};
    }
    end = beyond(link_, 1.0);
  }
  const auto last = static_cast<std::size_t>(n_ - 1);
  const double load = cable_.load_mass + h.load_mass_extra - h.leak * t;
  // The load's centre sits h.load_offset beyond the end of the last link.
  const double d = h.load_offset;
  const Moving load_centre = {end.position + d * along[last],
                              end.velocity + (d * v[n_ - 1]) * across[last],
                              end.acceleration + (-d * v[n_ - 1] * v[n_ - 1]) * along[last] +
                                  (d * a[n_ - 1]) * across[last]};
  const Vector on_load = load_force(t, load_centre.position, load_centre.velocity);
  if (outside)
    outside->load = {load_centre.position, load_centre.velocity, load_centre.acceleration,
                     q[n_ - 1], on_load};
  Vector carried = load * (gravity - load_centre.acceleration) + on_load -
                   h.load_added_mass * load_centre.acceleration;

  // Up the chain: the projections.
  const double rotary = link_mass_ * link_ * link_ / 12;
  double moment_below = 0;  // joint moment on link i from link i + 1's joint
  for (int i = n_ - 1; i >= 0; --i) {
    const auto k = static_cast<std::size_t>(i);
    const double e = stretches ? q[n_ + i] : 0;
    const double angle = q[i] - (i > 0 ? q[i - 1] : 0), rate = v[i] - (i > 0 ? v[i - 1] : 0);
    const double moment = joint_moment(i, angle, rate, norm(carried + lack[k]), memory[i], outside);
    const double lever = (0.5 + h.centre_fraction) * (link_ + e);
    double torque = dot(across[k], (link_ + e) * carried + lever * lack[k]) - rotary * a[i] -
                    moment + moment_below + turning[k];
    if (i == n_ - 1) torque += d * dot(across[k], carried) - h.load_rotary_inertia * a[i];
    r[i] = torque;
    if (stretches)
      r[n_ + i] = dot(along[k], carried + (0.5 + h.centre_fraction) * lack[k]) -
                  h.axial_stiffness / link_ * (e + h.axial_relaxation * v[n_ + i]);
    moment_below = moment;
    carried = carried + lack[k];
  }
}

double Chain::mechanical_energy(const VectorXd& q, const VectorXd& v) const {
  Vector position, velocity;
  double energy = 0, before = 0;
  for (int i = 0; i < n_; ++i) {
    const Vector t = {std::sin(q[i]), std::cos(q[i])}, m = {std::cos(q[i]), -std::sin(q[i])};
    const Vector centre_velocity = velocity + (0.5 * link_ * v[i]) * m;
    energy += 0.5 * link_mass_ *
              (dot(centre_velocity, centre_velocity) + link_ * link_ / 12 * v[i] * v[i]);
    energy -= link_mass_ * cable_.gravity * (position + (0.5 * link_) * t).down;
    energy +=
        (i == 0 ? 1.0 : 0.5) * cable_.bending_stiffness / link_ * (q[i] - before) * (q[i] - before);
    before = q[i];
    position = position + link_ * t;
    velocity = velocity + (link_ * v[i]) * m;
  }
  return energy + 0.5 * cable_.load_mass * dot(velocity, velocity) -
         cable_.load_mass * cable_.gravity * position.down;
}

/// One trajectory, step by step.
class Midpoint {
 public:
  Midpoint(const Chain& chain, const Hidden& hidden, VectorXd q, double step)
      : chain_(chain),
        hidden_(hidden),
        step_(step),
        q_(std::move(q)),
        v_(VectorXd::Zero(q_.size())),
        memory_(VectorXd::Zero(chain.links())) {
    q_before_ = q_;
    v_before_ = v_;
  }

  double time() const { return step_ * static_cast<double>(steps_); }
  const VectorXd& q() const { return q_; }
  const VectorXd& v() const { return v_; }

  /// Between the last two step ends.
  VectorXd angles_at(double t) const {
    return hermite(q_before_, v_before_, q_, v_, step_, (t - (time() - step_)) / step_);
  }

  /// In the middle of the last step.
  OutsideForces outside() const {
    OutsideForces outside;
    outside.time = time() - 0.5 * step_;
    outside.joints.resize(static_cast<std::size_t>(chain_.links()));
    VectorXd r(v_.size());
    chain_.residual(outside.time, 0.5 * (q_before_ + q_), 0.5 * (v_before_ + v_),
                    (v_ - v_before_) / step_, memory_, r, &outside);
    return outside;
  }

  void advance() {
    q_before_ = q_;
    v_before_ = v_;
    VectorXd middle = v_, r(v_.size());
    if (newton(middle, r) || careful_newton(middle = v_, r)) {
      finish(middle);
      return;
    }
    throw std::runtime_error(
        "the hidden truth's integrator failed at t = " + std::to_string(time()) + " s");
  }

 private:
  /// Newton's method with a matrix that is kept for many steps.
  bool newton(VectorXd& middle, VectorXd& r) {
    if (age_ > 40) age_ = 0;
    double before = 1e300;
    for (int iteration = 0; iteration < 30; ++iteration) {
      lack(middle, r);
      if (age_ == 0 || (iteration > 0 && iteration % 5 == 0)) make_matrix(middle, r);
      const VectorXd change = factor_.solve(r);
      middle -= change;
      const double size = change.lpNorm<Eigen::Infinity>();
      if (!(size < 1e6)) return false;
      if (size < 1e-9 || (size < 1e-7 && size > 0.5 * before)) return true;
      before = size;
    }
    return false;
  }

  /// Newton's method with a new matrix in each iteration and steps that reduce the residual. With
  /// dry friction near zero rate, full steps would alternate between the two signs.
  bool careful_newton(VectorXd& middle, VectorXd& r) {
    VectorXd r_new(r.size());
    lack(middle, r);
    for (int iteration = 0; iteration < 200; ++iteration) {
      make_matrix(middle, r);
      const VectorXd change = factor_.solve(r);
      double share = 1;
      for (; share > 1e-6; share /= 2) {
        lack(middle - share * change, r_new);
        if (r_new.norm() < r.norm()) break;
      }
      if (share <= 1e-6) return change.lpNorm<Eigen::Infinity>() < 1e-7;
      middle -= share * change;
      r = r_new;
      if (share == 1 && change.lpNorm<Eigen::Infinity>() < 1e-9) return true;
    }
    return false;
  }

  void lack(const VectorXd& middle, VectorXd& r) {
    const double h = step_;
    const VectorXd q = q_ + 0.5 * h * middle;
    const VectorXd a = (middle - v_) * (2 / h);
    chain_.residual(time() + 0.5 * h, q, middle, a, middle_memory(middle), r);
  }

  /// Dahl: dm/dt = w - |w| m / m_c, or Maxwell: dm/dt = w - m / lag, at the middle of the step; linear in the
  /// memory m.
  VectorXd middle_memory(const VectorXd& middle) const {
    VectorXd m = memory_;
    if (hidden_.hysteresis_moment == 0 && hidden_.maxwell == 0) return m;
    for (int i = 0; i < chain_.links(); ++i) {
      const double w = middle[i] - (i > 0 ? middle[i - 1] : 0);
      const double fading =
          hidden_.maxwell != 0 ? 1 / hidden_.maxwell_lag : std::abs(w) / hidden_.hysteresis_reach;
      m[i] = (memory_[i] + 0.5 * step_ * w) / (1 + 0.5 * step_ * fading);
    }
    return m;
  }

  void make_matrix(const VectorXd& middle, const VectorXd& r) {
    Eigen::MatrixXd matrix(r.size(), r.size());
    VectorXd moved = middle, r_moved(r.size());
    for (Index j = 0; j < r.size(); ++j) {
      const double delta = 1e-6;
      moved[j] += delta;
      lack(moved, r_moved);
      matrix.col(j) = (r_moved - r) / delta;
      moved[j] = middle[j];
    }
    factor_.compute(matrix);
    age_ = 1;
  }

  void finish(const VectorXd& middle) {
    memory_ = 2 * middle_memory(middle) - memory_;
    q_ += step_ * middle;
    v_ = 2 * middle - v_;
    ++steps_;
    ++age_;
  }

  const Chain& chain_;
  const Hidden& hidden_;
  double step_;
  VectorXd q_, v_, memory_, q_before_, v_before_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
  long steps_ = 0;
  int age_ = 0;
};

VectorXd start_state(const Cable& cable, const Hidden& hidden, const Chain& chain,
                     const std::vector<double>& angles) {
  if (static_cast<int>(angles.size()) != cable.links)
    throw std::invalid_argument("start_angles: one angle per link is needed");
  VectorXd q = VectorXd::Zero(chain.unknowns());
  for (int i = 0; i < cable.links; ++i) q[i] = angles[static_cast<std::size_t>(i)];
  // an extensible cable starts stretched by the weight of the load
  if (chain.unknowns() > cable.links)
    q.tail(cable.links)
        .setConstant(chain.link() * cable.load_mass * cable.gravity / hidden.axial_stiffness);
  return q;
}

}  // namespace

Motion move(const Cable& cable, const Hidden& hidden, const std::vector<double>& start_angles,
            const std::vector<double>& arc, const std::vector<double>& time,
            const Integration& integration) {
  if (hidden.stribeck != 0 || hidden.drag_growth != 0)
    throw std::invalid_argument("friction_law and drag_law: coded for the rod only");
  if (hidden.maxwell != 0 && hidden.hysteresis_moment != 0)
    throw std::invalid_argument("maxwell and joint_hysteresis: a joint has one memory only");
  const Chain chain(cable, hidden);
  Midpoint state(chain, hidden, start_state(cable, hidden, chain, start_angles), integration.step);
  Motion motion;
  motion.time = time;
  motion.arc = arc;
  state.advance();
  for (const double t : time) {
    while (state.time() < t) state.advance();
    const VectorXd q = state.angles_at(t);
    std::vector<double> side, down, angle;
    for (const double s : arc) {
      Vector at = chain.support(t).position;
      double left = s;
      int i = 0;
      for (; i < cable.links - 1 && left > chain.link() * (1 + 1e-12); ++i, left -= chain.link())
        at = at + (chain.link() + chain.extension(q, i)) * Vector{std::sin(q[i]), std::cos(q[i])};
      at = at + (left * (1 + chain.extension(q, i) / chain.link())) *
                    Vector{std::sin(q[i]), std::cos(q[i])};
      side.push_back(at.side);
      down.push_back(at.down);
      angle.push_back(q[i]);
    }
    motion.side.push_back(side);
    motion.down.push_back(down);
    motion.angle.push_back(angle);
  }
  return motion;
}

std::vector<OutsideForces> outside_forces(const Cable& cable, const Hidden& hidden,
                                          const std::vector<double>& start_angles,
                                          const std::vector<double>& time,
                                          const Integration& integration) {
  const Chain chain(cable, hidden);
  Midpoint state(chain, hidden, start_state(cable, hidden, chain, start_angles), integration.step);
  state.advance();
  std::vector<OutsideForces> forces;
  for (const double t : time) {
    while (state.time() < t) state.advance();
    forces.push_back(state.outside());
  }
  return forces;
}

std::vector<double> mechanical_energy(const Cable& cable, const std::vector<double>& start_angles,
                                      const std::vector<double>& time,
                                      const Integration& integration) {
  const Hidden nothing;
  const Chain chain(cable, nothing);
  Midpoint state(chain, nothing, start_state(cable, nothing, chain, start_angles),
                 integration.step);
  std::vector<double> energy;
  for (const double t : time) {
    while (state.time() < t) state.advance();
    energy.push_back(chain.mechanical_energy(state.q(), state.v()));
  }
  return energy;
}

std::vector<double> catenary_angles(const Cable& cable, double held_side, double held_down) {
  const double span = std::abs(held_side), length = cable.length;
  if (span < 1e-6 || std::hypot(held_side, held_down) >= length)
    throw std::invalid_argument(
        "the held point must be off the vertical and within the cable's length");
  // side(s) = a asinh((s - s0)/a) + ..., down(s) = -sqrt(a^2 + (s - s0)^2) + ...; the parameter a
  // from sqrt(length^2 - held_down^2) = 2 a sinh(span / (2 a)), by bisection on span / (2 a).
  const double ratio = std::sqrt(length * length - held_down * held_down) / span;
  double low = 1e-8, high = 50;
  for (int i = 0; i < 200; ++i) {
    const double x = 0.5 * (low + high);
    (std::sinh(x) / x < ratio ? low : high) = x;
  }
  const double a = span / (2 * low);
  // tanh of the middle parameter: held_down / length = tanh((x_0 + ...)), solved for the lowest
  // point
  const double middle =
      std::atanh(held_down / length);  // (x0 + x1)/2 measured from the lowest point
  const double x0 = -middle - span / (2 * a);
  const double s0 = -a * std::sinh(x0);  // arc length from the support to the lowest point
  std::vector<double> angles;
  const double link = length / cable.links;
  const auto side = [&](double s) { return a * std::asinh((s - s0) / a); };
  const auto down = [&](double s) { return -std::hypot(a, s - s0); };
  for (int i = 0; i < cable.links; ++i) {
    const double from = i * link, to = (i + 1) * link;
    const double angle = std::atan2(side(to) - side(from), down(to) - down(from));
    angles.push_back(held_side > 0 ? angle : -angle);
  }
  return angles;
}

}  // namespace truth
