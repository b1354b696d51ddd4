// SPDX-License-Identifier: BSD-3-Clause
//
// Notation. Node k has the position x_k and the angle p_k of its section; node 0 is clamped. In the
// element between nodes k - 1 and k, of length h, d = (x_k - x_{k-1}) / h, p = (p_{k-1} + p_k) / 2,
// and with the unit vectors t(p), n(p):
//
//   strain e = t.d - 1,  shear s = n.d,  bend b = (p_k - p_{k-1}) / h
//   normal force N = EA (e + T e'),  shear force Q = GA (s + T s'),  moment M = EI (b - b_0) + c b' + ...
//
// Virtual work: the force f = N t + Q n pulls node k back, the moment h/2 (Q t.d - N n.d) -+ M turns
// its section. Mass and inertia are at the nodes.
#include "truth/rod.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "truth/hermite.hpp"
#include "truth/vector.hpp"

namespace truth {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr double kRadius = 3e-3;         // m, of a round section: EA = 4 EI / r^2
constexpr double kShearShare = 0.35;     // GA over EA: G = E / 2.6, nine tenths of the area
constexpr double kRelaxation = 1e-3;     // s, of strain and shear
constexpr double kFrictionReach = 5e-4;  // rad over an element, until friction slips
constexpr double kStribeckRate = 0.1;    // rad/(m s), of the curvature
constexpr double kHoldingStep = 2e-3, kCarried = 3, kLongestHold = 60;  // s
constexpr double kFollowing = 50;    // 1/s, of the end that is carried
constexpr double kHeldStill = 1e-7;  // m/s and rad/s
constexpr double kHoldingDrag = 8;   // 1/s, on every mass while it is held

/// Sections that slip: the moment approaches its limit with the relative angle (Bouc and Wen, square).
double slipped(double memory, double turn, double reach) {
  // The end of a step of z' = w - |w| z |z| / reach^2, implicit.
  const double a = std::abs(turn) / (reach * reach), b = memory + turn;
  if (a == 0) return b;
  return std::copysign((std::sqrt(1 + 4 * a * std::abs(b)) - 1) / (2 * a), b);
}

/// The same with friction that is larger by a share `stribeck` at rest than in motion: the LuGre model
/// (Canudas de Wit and others 1995), z' = w - |w| z / (reach g(w)).
double slipped_lugre(double memory, double turn, double reach, double rate, double stribeck) {
  const double limit = reach * (1 + stribeck * std::exp(-std::pow(rate / kStribeckRate, 2)));
  return (memory + turn) / (1 + std::abs(turn) / limit);
}

/// What multiplies the coefficient of quadratic drag: that of a cylinder is 1 + 10 Re^(-2/3) times
/// its largest (White 1974).
double growth_of_drag(double speed, double growth) {
  return growth == 0 || speed == 0 ? 1 : 1 + std::pow(growth / speed, 2.0 / 3);
}

struct Memory {
  VectorXd friction, hysteresis;  // rad, of every element
};

class Rod {
 public:
  Rod(const Cable& cable, const Hidden& hidden, std::optional<Vector> held)
      : cable_(cable),
        hidden_(hidden),
        held_(held),
        elements_(cable.links),
        h_(cable.length / cable.links),
        axial_(hidden.axial_stiffness > 0 ? hidden.axial_stiffness
                                          : 4 * cable.bending_stiffness / (kRadius * kRadius)) {}

  /// Where a node's three coordinates begin: side, down, angle of its section.
  static Index first_of(Index node) { return 3 * (node - 1); }
  Index unknowns() const { return first_of(elements_ + 1); }
  int elements() const { return elements_; }
  double length_of_element() const { return h_; }

  Vector support(double t, int derivative) const {
    const double w = 2 * std::numbers::pi * hidden_.support_frequency;
    const auto harmonic = [&](double amplitude, double phase) {
      const double turned = w * t + phase + derivative * std::numbers::pi / 2;
      return amplitude * std::pow(w, derivative) * std::sin(turned);
    };
    return {harmonic(hidden_.support_side_amplitude, hidden_.support_side_phase),
            harmonic(hidden_.support_down_amplitude, hidden_.support_down_phase)};
  }

  Vector place(double t, const VectorXd& q, int node, int derivative = 0) const {
    if (node == 0) return support(t, derivative);
    return {q[first_of(node)], q[first_of(node) + 1]};
  }
  double angle(const VectorXd& q, int node) const { return node == 0 ? 0 : q[first_of(node) + 2]; }

  /// Inertia times a, minus all forces. `memory` is that of the beginning of the step of length
  /// `step`; the sections slip within it at the rates v.
  void residual(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                const Memory& memory, double step, VectorXd& r) const;

  /// The friction's memory at the end of a step in which the section of an element turns by `turn`.
  double friction_after(double memory, double turn, double step) const {
    if (hidden_.stribeck == 0 || step == 0) return slipped(memory, turn, kFrictionReach);
    return slipped_lugre(memory, turn, kFrictionReach, turn / (step * h_), hidden_.stribeck);
  }

  void slip(Memory& memory, const VectorXd& v, double step) const {
    for (int e = 0; e < elements_; ++e) {
      const double turn = step * (angle(v, e + 1) - angle(v, e));
      memory.friction[e] = friction_after(memory.friction[e], turn, step);
      memory.hysteresis[e] = slipped(memory.hysteresis[e], turn, hidden_.hysteresis_reach);
    }
  }

 private:
  Vector force_per_length(Vector velocity, double section) const;

  Cable cable_;
  Hidden hidden_;
  std::optional<Vector> held_;  // where a hand carries the end to
  int elements_;
  double h_, axial_;
};

Vector Rod::force_per_length(Vector velocity, double section) const {
  const Hidden& h = hidden_;
  const Vector t = along(section), n = across(section);
  const double vn = dot(velocity, n), vt = dot(velocity, t);
  const Vector wind = velocity - Vector{h.wind, 0};
  const double un = dot(wind, n), ut = dot(wind, t);
  const double of_drag = growth_of_drag(norm(velocity), h.drag_growth);
  const double of_wind = growth_of_drag(norm(wind), h.drag_growth);
  const auto squared = [](double rate) { return std::abs(rate) * rate; };
  return -1 *
         (of_drag * h.drag_isotropic * norm(velocity) * velocity +
          (h.drag_linear_normal * vn + of_drag * h.drag_quadratic_normal * squared(vn) +
           of_wind * h.wind_normal * squared(un)) *
              n +
          (h.drag_linear_tangential * vt + of_drag * h.drag_quadratic_tangential * squared(vt) +
           of_wind * h.wind_tangential * squared(ut)) *
              t);
}

void Rod::residual(double t, const VectorXd& q, const VectorXd& v, const VectorXd& a,
                   const Memory& memory, double step, VectorXd& r) const {
  const Vector gravity = {cable_.gravity * std::sin(hidden_.gravity_tilt),
                          cable_.gravity * std::cos(hidden_.gravity_tilt)};
  r.setZero(unknowns());
  const auto push = [&](int node, Vector force, double moment) {
    if (node == 0) return;
    r[first_of(node)] -= force.side;
    r[first_of(node) + 1] -= force.down;
    r[first_of(node) + 2] -= moment;
  };
  // How far a hand that holds the end has carried it: a rest curvature grows on the way.
  const double turned =
      held_ ? std::min(std::numbers::pi * t / kCarried, std::numbers::pi) : std::numbers::pi;
  const double carried = (1 - std::cos(turned)) / 2;
  const double inertia = cable_.density * kRadius * kRadius / 4;  // kg m, of a length
  for (int k = 1; k <= elements_; ++k) {
    const bool last = k == elements_;
    const double share = last ? h_ / 2 : h_;
    const double load = last ? cable_.load_mass + hidden_.load_mass_extra : 0;
    const double mass = cable_.density * share + load;
    const Vector velocity = place(t, v, k), acceleration = place(t, a, k);
    Vector force = mass * (gravity - acceleration);
    if (last)
      force = force - growth_of_drag(norm(velocity), hidden_.drag_growth) * hidden_.load_drag *
                          norm(velocity) * velocity;
    double moment = -inertia * share * angle(a, k);
    if (held_) {
      force = force - kHoldingDrag * mass * velocity;
      moment -= kHoldingDrag * inertia * share * angle(v, k);
    }
    push(k, force, moment);
  }
  for (int e = 0; e < elements_; ++e) {
    const double section = (angle(q, e) + angle(q, e + 1)) / 2;
    const double turning = (angle(v, e) + angle(v, e + 1)) / 2;
    const Vector tangent = along(section), normal = across(section);
    const Vector d = (1 / h_) * (place(t, q, e + 1) - place(t, q, e));
    const Vector above = place(t, v, e, 1), below = place(t, v, e + 1);
    const Vector rate = (1 / h_) * (below - above);
    const double stretch = dot(tangent, d), shear = dot(normal, d);
    const double stretching = dot(tangent, rate) + shear * turning;
    const double shearing = dot(normal, rate) - stretch * turning;
    const double bend = (angle(q, e + 1) - angle(q, e)) / h_;
    const double bending = (angle(v, e + 1) - angle(v, e)) / h_;
    const double normal_force = axial_ * (stretch - 1 + kRelaxation * stretching);
    const double shear_force = kShearShare * axial_ * (shear + kRelaxation * shearing);
    double moment = cable_.bending_stiffness * (bend - carried * hidden_.rest_curvature) +
                    cable_.bending_damping * bending;
    const double turn = step * bending * h_;
    if (hidden_.joint_friction != 0)
      moment +=
          hidden_.joint_friction / kFrictionReach * friction_after(memory.friction[e], turn, step);
    if (hidden_.hysteresis_moment != 0)
      moment += hidden_.hysteresis_moment / hidden_.hysteresis_reach *
                slipped(memory.hysteresis[e], turn, hidden_.hysteresis_reach);
    const Vector pull = normal_force * tangent + shear_force * normal;
    const double turned = h_ / 2 * (shear_force * stretch - normal_force * shear);
    const Vector outside = (h_ / 2) * force_per_length(0.5 * (above + below), section);
    push(e, pull + outside, turned + moment);
    push(e + 1, outside - pull, turned - moment);
  }
  if (held_) {  // from plumb to the point on a smooth way, which the end follows
    const double w = std::numbers::pi / kCarried;
    const Vector plumb = {0, cable_.length}, way = *held_ - plumb;
    const Vector at = plumb + carried * way;
    const Vector rate = (w / 2 * std::sin(turned)) * way;
    const Vector speeding = (t < kCarried ? w * w / 2 * std::cos(turned) : 0) * way;
    const Vector lacks = place(t, a, elements_) - speeding +
                         2 * kFollowing * (place(t, v, elements_) - rate) +
                         kFollowing * kFollowing * (place(t, q, elements_) - at);
    r[unknowns() - 3] = lacks.side;
    r[unknowns() - 2] = lacks.down;
  }
}

/// One trajectory, step by step, by the generalised-alpha method with spectral radius 0.8.
class GeneralisedAlpha {
 public:
  GeneralisedAlpha(const Rod& rod, VectorXd q, VectorXd v, double step)
      : rod_(rod),
        step_(step),
        q_(std::move(q)),
        v_(std::move(v)),
        a_(VectorXd::Zero(q_.size())),
        memory_{VectorXd::Zero(rod.elements()), VectorXd::Zero(rod.elements())} {
    // Accelerations at the start: the residual is linear in them.
    VectorXd without, with;
    Eigen::MatrixXd inertia(a_.size(), a_.size());
    rod_.residual(0, q_, v_, a_, memory_, 0, without);
    for (Index j = 0; j < a_.size(); ++j) {
      VectorXd unit = VectorXd::Unit(a_.size(), j);
      rod_.residual(0, q_, v_, unit, memory_, 0, with);
      inertia.col(j) = with - without;
    }
    a_ = -inertia.partialPivLu().solve(without);
    q_before_ = q_;
    v_before_ = v_;
  }

  double time() const { return step_ * static_cast<double>(steps_); }
  const VectorXd& q() const { return q_; }
  const VectorXd& v() const { return v_; }

  /// Between the last two step ends.
  VectorXd at(double t) const {
    return hermite(q_before_, v_before_, q_, v_, step_, (t - (time() - step_)) / step_);
  }

  void advance() {
    VectorXd next = a_, r;
    double before = 1e300;
    for (int iteration = 0;; ++iteration) {
      lack(next, r);
      if (age_ == 0 || iteration % 6 == 5) make_matrix(next, r);
      const VectorXd change = factor_.solve(r);
      next -= change;
      const double size = kGamma * step_ * change.lpNorm<Eigen::Infinity>();  // m/s and rad/s
      if (size < 1e-9 || (size < 1e-7 && size > 0.5 * before)) break;
      if (!(size < 1e6) || iteration > 60)
        throw std::runtime_error("the rod's integrator failed at t = " + std::to_string(time()) +
                                 " s");
      before = size;
    }
    VectorXd v_middle, q_middle, a_middle;
    middle(next, q_middle, v_middle, a_middle);
    rod_.slip(memory_, v_middle, step_);
    q_before_ = q_;
    v_before_ = v_;
    q_ += step_ * v_ + step_ * step_ * ((0.5 - kBeta) * a_ + kBeta * next);
    v_ += step_ * ((1 - kGamma) * a_ + kGamma * next);
    a_ = next;
    ++steps_;
    age_ = age_ > 40 ? 0 : age_ + 1;
  }

 private:
  static constexpr double kRho = 0.8;
  static constexpr double kAlphaM = (2 * kRho - 1) / (kRho + 1), kAlphaF = kRho / (kRho + 1);
  static constexpr double kGamma = 0.5 + kAlphaF - kAlphaM;
  static constexpr double kBeta = 0.25 * (1 + kAlphaF - kAlphaM) * (1 + kAlphaF - kAlphaM);

  void middle(const VectorXd& next, VectorXd& q, VectorXd& v, VectorXd& a) const {
    const double share = 1 - kAlphaF;
    q = q_ + share * (step_ * v_ + step_ * step_ * ((0.5 - kBeta) * a_ + kBeta * next));
    v = v_ + share * step_ * ((1 - kGamma) * a_ + kGamma * next);
    a = (1 - kAlphaM) * next + kAlphaM * a_;
  }

  void lack(const VectorXd& next, VectorXd& r) const {
    VectorXd q, v, a;
    middle(next, q, v, a);
    rod_.residual(time() + (1 - kAlphaF) * step_, q, v, a, memory_, step_, r);
  }

  /// By differences; elements couple neighbouring nodes only, so every third node moves at once.
  void make_matrix(const VectorXd& next, const VectorXd& r) {
    const double delta = 1e-6 / (kGamma * step_);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(r.size(), r.size());
    VectorXd moved, r_moved;
    for (Index first = 0; first < 9; ++first) {
      moved = next;
      for (Index j = first; j < r.size(); j += 9) moved[j] += delta;
      lack(moved, r_moved);
      for (Index j = first; j < r.size(); j += 9) {
        const Index node = j / 3;
        const Index top = 3 * std::max<Index>(0, node - 1),
                    end = std::min<Index>(r.size(), 3 * (node + 2));
        matrix.col(j).segment(top, end - top) = (r_moved - r).segment(top, end - top) / delta;
      }
    }
    factor_.compute(matrix);
    age_ = 1;
  }

  const Rod& rod_;
  double step_;
  VectorXd q_, v_, a_, q_before_, v_before_;
  Memory memory_;
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
  long steps_ = 0;
  int age_ = 0;
};

void refuse_what_is_not_there(const Hidden& hidden) {
  const Hidden nothing;
  Hidden rest = hidden;
  for (double Hidden::*known : {&Hidden::drag_isotropic,
                                &Hidden::drag_linear_normal,
                                &Hidden::drag_linear_tangential,
                                &Hidden::drag_quadratic_normal,
                                &Hidden::drag_quadratic_tangential,
                                &Hidden::wind,
                                &Hidden::wind_normal,
                                &Hidden::wind_tangential,
                                &Hidden::load_drag,
                                &Hidden::load_mass_extra,
                                &Hidden::joint_friction,
                                &Hidden::rest_curvature,
                                &Hidden::hysteresis_moment,
                                &Hidden::hysteresis_reach,
                                &Hidden::gravity_tilt,
                                &Hidden::axial_stiffness,
                                &Hidden::stribeck,
                                &Hidden::drag_growth,
                                &Hidden::support_side_amplitude,
                                &Hidden::support_down_amplitude,
                                &Hidden::support_frequency,
                                &Hidden::support_side_phase,
                                &Hidden::support_down_phase,
                                &Hidden::clock_offset,
                                &Hidden::scale,
                                &Hidden::camera_tilt,
                                &Hidden::marker_across,
                                &Hidden::marker_along,
                                &Hidden::origin_side,
                                &Hidden::origin_down})
    rest.*known = nothing.*known;
  for (const HiddenParameter& parameter : hidden_parameters())
    if (rest.*parameter.value != nothing.*parameter.value)
      throw std::invalid_argument(std::string(parameter.name) + ": not coded for the rod");
}

/// The rod held at its end, at rest.
VectorXd held_rod(const Cable& cable, const Hidden& hidden, const std::vector<double>& held) {
  Hidden still;  // no force that depends on rates, and no memory: it was brought there slowly
  still.rest_curvature = hidden.rest_curvature;
  still.gravity_tilt = hidden.gravity_tilt;
  still.axial_stiffness = hidden.axial_stiffness;
  const Rod rod(cable, still, Vector{held.at(0), held.at(1)});
  VectorXd q(rod.unknowns());
  for (int k = 1; k <= rod.elements(); ++k)
    q.segment<3>(Rod::first_of(k)) << 0, k * rod.length_of_element(), 0;
  GeneralisedAlpha state(rod, q, VectorXd::Zero(q.size()), kHoldingStep);
  while (state.time() < kCarried || state.v().lpNorm<Eigen::Infinity>() > kHeldStill) {
    state.advance();
    if (state.time() > kLongestHold) throw std::runtime_error("the held rod does not come to rest");
  }
  return state.q();
}

/// Adds one instant: positions along the cubic curve through the nodes.
void see(const Rod& rod, double t, const VectorXd& q, Motion& motion) {
  std::vector<double> side, down, angle;
  for (const double s : motion.arc) {
    const double h = rod.length_of_element();
    const int e = std::clamp(static_cast<int>(s / h), 0, rod.elements() - 1);
    const double u = s / h - e;
    const Vector above = rod.place(t, q, e), below = rod.place(t, q, e + 1);
    const double first = rod.angle(q, e), second = rod.angle(q, e + 1);
    const double chord = norm(below - above);
    const Vector at = hermite(above, along(first), below, along(second), chord, u);
    side.push_back(at.side);
    down.push_back(at.down);
    angle.push_back((1 - u) * first + u * second);
  }
  motion.time.push_back(t);
  motion.side.push_back(side);
  motion.down.push_back(down);
  motion.angle.push_back(angle);
}

}  // namespace

Motion move_rod(const Cable& cable, const Hidden& hidden, const std::vector<double>& held,
                const std::vector<double>& arc, const std::vector<double>& time,
                const Integration& integration) {
  refuse_what_is_not_there(hidden);
  const Rod rod(cable, hidden, {});
  VectorXd q = held_rod(cable, hidden, held), v = VectorXd::Zero(q.size());
  const Vector moved = rod.support(0, 0), moving = rod.support(0, 1);  // and the cable with it
  for (Index k = 0; k < q.size(); k += 3) {
    q[k] += moved.side;
    q[k + 1] += moved.down;
    v[k] = moving.side;
    v[k + 1] = moving.down;
  }
  GeneralisedAlpha state(rod, std::move(q), std::move(v), integration.step);
  Motion motion;
  motion.arc = arc;
  state.advance();
  for (const double t : time) {
    while (state.time() < t) state.advance();
    see(rod, t, state.at(t), motion);
  }
  return motion;
}

}  // namespace truth
