// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
//
// Equations of motion of a hanging chain of any number of rigid links, from 5, with elastic, damped
// joints and a load. Expressions in `links` come from what is derived for 12 and 13 links;
// every statement was compared with what is derived for 5, 24, 60, 240.
// The arrays of a call are on the stack (arrays whose length is a variable, as GNU C++ has them),
// in double precision at most 176 bytes a link.
// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see scalar.hpp;
// D, of differentials, is T or one that holds several directions, see directions.hpp.
//
// Structure found:
//   M: semiseparable of rank 2, symmetric (proved for every pair of links)
//   ca dr/da + cv dr/dv + cq dr/dq: tridiagonal plus semiseparable, ranks 2 (above) and 2 (below the diagonal)
//   K: constant, symmetric, tridiagonal
//   C: constant, symmetric, tridiagonal
#pragma once

#include <array>

#include "any_links_table.hpp"
#include "batch.hpp"
#include "dense.hpp"
#include "quasiseparable.hpp"
#include "scalar.hpp"
#include "semiseparable.hpp"

namespace catena::chain_any {

/// The fewest links.
inline constexpr int kFewestLinks = 5;

/// Mass matrix in the form in which it is factored.
template <class T>
using MassMatrix = SymmetricSemiseparable<T, kAtRunTime, 2>;

/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.
template <class T>
using NewtonMatrix = Quasiseparable<T, kAtRunTime, 2, 2>;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wvla"

struct Chain {
  int number;  ///< of links, at least kFewestLinks

  /// What the table lists.
  static constexpr const char* kId = "chain";
  static constexpr std::array<ParameterFamily, 8> kParameters = {{
      {{"length", "m", "length of link", NAN, 0.0, INFINITY, NAN}, true, true},
      {{"mass", "kg", "mass of link", NAN, 0.0, INFINITY, NAN}, true, true},
      {{"inertia", "kg m^2", "rotational inertia about its own centre of link", NAN, 0.0, INFINITY, NAN}, true, true},
      {{"stiffness", "N m/rad", "stiffness of joint", NAN, 0.0, INFINITY, NAN}, true, true},
      {{"damping", "N m s/rad", "damping of joint", NAN, 0.0, INFINITY, NAN}, true, true},
      {{"torque", "N m", "external torque on the angle of link", 0.0, -INFINITY, INFINITY, NAN}, true, true},
      {{"load_mass", "kg", "mass of the load at the free end", NAN, 0.0, INFINITY, NAN}, false, false},
      {{"gravity", "m/s^2", "acceleration of gravity", 9.8100000000000005, -INFINITY, INFINITY, NAN}, false, false},
  }};
  static constexpr std::array<QuantityFamily, 1> kCoordinates = {{
      {{"theta", "rad"}, true},
  }};
  static constexpr std::array<QuantityFamily, 0> kStates{};
  static constexpr std::array<QuantityFamily, 0> kSignals{};
  static constexpr std::array<QuantityFamily, 0> kEvents{};

  /// The number of links, as one the compiler may count on.
  int links() const {
    if (number < kFewestLinks) __builtin_unreachable();
    return number;
  }
  int coordinates() const {
    const int links = number;
    return links;
  }
  int states() const {
    return 0;
  }
  int signals() const {
    return 0;
  }
  int events() const {
    return 0;
  }
  int parameters() const {
    const int links = number;
    return 6 * links + 2;
  }

  /// r(t, q, v, a, z, u, p), the inverse dynamics.
  /// 19 * links - 8 additions, 20 * links + 2 multiplications, 0 divisions, 0 functions
  template <class T>
  void residual(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> torque(at.p + 5 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    T joint_moment[links + 1];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      joint_moment[1] = stiffness[1] * joint_angle + damping[1] * joint_rate;
    }
    for (int i = 2; i <= links; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      joint_moment[i] = stiffness[i] * joint_angle + damping[i] * joint_rate;
    }
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    for (int i = 2; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
    }
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
    }
    for (int i = 2; i <= links; ++i) {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
    }
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    for (int i = links; i >= 2; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
    }
    for (int i = 1; i <= links - 1; ++i) {
      const T span_down_force = cut_force_down[i + 1] + ratio<T>(1, 2) * centre_down_force[i];
      const T span_side_force = cut_force_side[i + 1] + ratio<T>(1, 2) * centre_side_force[i];
      r[i - 1] = inertia[i] * theta_ddot[i] - torque[i] + joint_moment[i] - joint_moment[i + 1]
          + length[i] * (cosine[i] * span_side_force - sine[i] * span_down_force);
    }
    {
      const T span_down_force = cut_force_down[links + 1]
          + ratio<T>(1, 2) * centre_down_force[links];
      const T span_side_force = cut_force_side[links + 1]
          + ratio<T>(1, 2) * centre_side_force[links];
      r[links - 1] = inertia[links] * theta_ddot[links] - torque[links] + joint_moment[links]
          + length[links] * (cosine[links] * span_side_force - sine[links] * span_down_force);
    }
  }

  /// Derivative of r along `along`.
  /// 50 * links - 12 additions, 62 * links + 6 multiplications, 0 divisions, 0 functions
  template <class T, class D>
  void residual_tangent(const Point<T>& at, const Point<D>& along, D* dr) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    const FromOne<D> d_length(along.p);
    const FromOne<D> d_mass(along.p + links);
    const FromOne<D> d_inertia(along.p + 2 * links);
    const FromOne<D> d_stiffness(along.p + 3 * links);
    const FromOne<D> d_damping(along.p + 4 * links);
    const FromOne<D> d_torque(along.p + 5 * links);
    const D d_load_mass = along.p[6 * links];
    const D d_gravity = along.p[6 * links + 1];
    const FromOne<D> d_theta(along.q);
    const FromOne<D> d_theta_dot(along.v);
    const FromOne<D> d_theta_ddot(along.a);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    D d_joint_moment[links + 1];
    D d_span_down_acceleration[links + 1];
    D d_span_side_acceleration[links + 1];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      d_joint_moment[1] = stiffness[1] * d_theta[1] + damping[1] * d_theta_dot[1]
          + joint_angle * d_stiffness[1] + joint_rate * d_damping[1];
      d_span_down_acceleration[1] = length[1] * (theta_dot[1] * (theta_dot[1] * sine[1]
          * d_theta[1] - T(2) * cosine[1] * d_theta_dot[1])
          - (theta_ddot[1] * cosine[1] * d_theta[1] + sine[1] * d_theta_ddot[1]))
          - d_length[1] * (theta_dot[1] * theta_dot[1] * cosine[1] + theta_ddot[1] * sine[1]);
      d_span_side_acceleration[1] = d_length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]) + length[1] * (cosine[1] * d_theta_ddot[1]
          - theta_ddot[1] * sine[1] * d_theta[1]
          - theta_dot[1] * (T(2) * sine[1] * d_theta_dot[1]
          + theta_dot[1] * cosine[1] * d_theta[1]));
    }
    for (int i = 2; i <= links; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      const D d_joint_angle = d_theta[i] - d_theta[i - 1];
      const D d_joint_rate = d_theta_dot[i] - d_theta_dot[i - 1];
      d_joint_moment[i] = stiffness[i] * d_joint_angle + damping[i] * d_joint_rate
          + joint_angle * d_stiffness[i] + joint_rate * d_damping[i];
      d_span_down_acceleration[i] = length[i] * (theta_dot[i] * (theta_dot[i] * sine[i]
          * d_theta[i] - T(2) * cosine[i] * d_theta_dot[i])
          - (theta_ddot[i] * cosine[i] * d_theta[i] + sine[i] * d_theta_ddot[i]))
          - d_length[i] * (theta_dot[i] * theta_dot[i] * cosine[i] + theta_ddot[i] * sine[i]);
      d_span_side_acceleration[i] = d_length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]) + length[i] * (cosine[i] * d_theta_ddot[i]
          - theta_ddot[i] * sine[i] * d_theta[i]
          - theta_dot[i] * (T(2) * sine[i] * d_theta_dot[i]
          + theta_dot[i] * cosine[i] * d_theta[i]));
    }
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    D d_joint_down_acceleration[links + 1];
    D d_joint_side_acceleration[links + 1];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    joint_side_acceleration[2] = span_side_acceleration[2] + joint_side_acceleration[1];
    joint_down_acceleration[2] = span_down_acceleration[2] + joint_down_acceleration[1];
    d_joint_down_acceleration[2] = d_span_down_acceleration[1] + d_span_down_acceleration[2];
    d_joint_side_acceleration[2] = d_span_side_acceleration[1] + d_span_side_acceleration[2];
    for (int i = 3; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
      d_joint_down_acceleration[i] = d_span_down_acceleration[i] + d_joint_down_acceleration[i - 1];
      d_joint_side_acceleration[i] = d_span_side_acceleration[i] + d_joint_side_acceleration[i - 1];
    }
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    D d_centre_down_force[links + 1];
    D d_centre_side_force[links + 1];
    {
      const D d_centre_down_acceleration = ratio<T>(1, 2) * d_span_down_acceleration[1];
      const D d_centre_side_acceleration = ratio<T>(1, 2) * d_span_side_acceleration[1];
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
      d_centre_down_force[1] = d_mass[1] * (centre_down_acceleration - gravity)
          + mass[1] * (d_centre_down_acceleration - d_gravity);
      d_centre_side_force[1] = mass[1] * d_centre_side_acceleration
          + centre_side_acceleration * d_mass[1];
    }
    {
      const D d_centre_down_acceleration = d_span_down_acceleration[1]
          + ratio<T>(1, 2) * d_span_down_acceleration[2];
      const D d_centre_side_acceleration = d_span_side_acceleration[1]
          + ratio<T>(1, 2) * d_span_side_acceleration[2];
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[2]
          + joint_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[2]
          + joint_down_acceleration[1];
      centre_down_force[2] = mass[2] * (centre_down_acceleration - gravity);
      centre_side_force[2] = mass[2] * centre_side_acceleration;
      d_centre_down_force[2] = d_mass[2] * (centre_down_acceleration - gravity)
          + mass[2] * (d_centre_down_acceleration - d_gravity);
      d_centre_side_force[2] = mass[2] * d_centre_side_acceleration
          + centre_side_acceleration * d_mass[2];
    }
    for (int i = 3; i <= links; ++i) {
      const D d_centre_down_acceleration = ratio<T>(1, 2) * d_span_down_acceleration[i]
          + d_joint_down_acceleration[i - 1];
      const D d_centre_side_acceleration = ratio<T>(1, 2) * d_span_side_acceleration[i]
          + d_joint_side_acceleration[i - 1];
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
      d_centre_down_force[i] = d_mass[i] * (centre_down_acceleration - gravity)
          + mass[i] * (d_centre_down_acceleration - d_gravity);
      d_centre_side_force[i] = mass[i] * d_centre_side_acceleration
          + centre_side_acceleration * d_mass[i];
    }
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    D d_cut_force_down[links + 2];
    D d_cut_force_side[links + 2];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    d_cut_force_down[links + 1] = d_load_mass * (joint_down_acceleration[links] - gravity)
        + load_mass * (d_joint_down_acceleration[links] - d_gravity);
    d_cut_force_side[links + 1] = load_mass * d_joint_side_acceleration[links]
        + joint_side_acceleration[links] * d_load_mass;
    for (int i = links; i >= 2; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
      d_cut_force_down[i] = d_cut_force_down[i + 1] + d_centre_down_force[i];
      d_cut_force_side[i] = d_cut_force_side[i + 1] + d_centre_side_force[i];
    }
    for (int i = 1; i <= links - 1; ++i) {
      const T span_down_force = cut_force_down[i + 1] + ratio<T>(1, 2) * centre_down_force[i];
      const T span_side_force = cut_force_side[i + 1] + ratio<T>(1, 2) * centre_side_force[i];
      const D d_span_down_force = d_cut_force_down[i + 1] + ratio<T>(1, 2) * d_centre_down_force[i];
      const D d_span_side_force = d_cut_force_side[i + 1] + ratio<T>(1, 2) * d_centre_side_force[i];
      dr[i - 1] = inertia[i] * d_theta_ddot[i] + theta_ddot[i] * d_inertia[i] - d_torque[i]
          + d_joint_moment[i] - d_joint_moment[i + 1]
          + d_length[i] * (cosine[i] * span_side_force - sine[i] * span_down_force)
          + length[i] * (cosine[i] * (d_span_side_force - span_down_force * d_theta[i])
          - sine[i] * (span_side_force * d_theta[i] + d_span_down_force));
    }
    {
      const T span_down_force = cut_force_down[links + 1]
          + ratio<T>(1, 2) * centre_down_force[links];
      const T span_side_force = cut_force_side[links + 1]
          + ratio<T>(1, 2) * centre_side_force[links];
      const D d_span_down_force = d_cut_force_down[links + 1]
          + ratio<T>(1, 2) * d_centre_down_force[links];
      const D d_span_side_force = d_cut_force_side[links + 1]
          + ratio<T>(1, 2) * d_centre_side_force[links];
      dr[links - 1] = inertia[links] * d_theta_ddot[links] + theta_ddot[links] * d_inertia[links]
          - d_torque[links] + d_joint_moment[links]
          + d_length[links] * (cosine[links] * span_side_force - sine[links] * span_down_force)
          + length[links] * (cosine[links] * (d_span_side_force
          - span_down_force * d_theta[links]) - sine[links] * (span_side_force * d_theta[links]
          + d_span_down_force));
    }
  }

  /// The term inertia of r alone.
  /// 10 * links - 6 additions, 14 * links + 2 multiplications, 0 divisions, 0 functions
  template <class T>
  void term_inertia(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const T load_mass = at.p[6 * links];
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_down_acceleration_inertial[links + 1];
    T span_side_acceleration_inertial[links + 1];
    for (int i = 1; i <= links; ++i) {
      span_down_acceleration_inertial[i] = -length[i] * theta_ddot[i] * sine[i];
      span_side_acceleration_inertial[i] = length[i] * theta_ddot[i] * cosine[i];
    }
    T joint_down_acceleration_inertial[links + 1];
    T joint_side_acceleration_inertial[links + 1];
    joint_down_acceleration_inertial[2] = span_down_acceleration_inertial[1]
        + span_down_acceleration_inertial[2];
    joint_side_acceleration_inertial[2] = span_side_acceleration_inertial[1]
        + span_side_acceleration_inertial[2];
    for (int i = 3; i <= links; ++i) {
      joint_down_acceleration_inertial[i] = span_down_acceleration_inertial[i]
          + joint_down_acceleration_inertial[i - 1];
      joint_side_acceleration_inertial[i] = span_side_acceleration_inertial[i]
          + joint_side_acceleration_inertial[i - 1];
    }
    T centre_down_force_inertial[links + 1];
    T centre_side_force_inertial[links + 1];
    {
      const T centre_down_acceleration_inertial = ratio<T>(1, 2)
          * span_down_acceleration_inertial[1];
      centre_down_force_inertial[1] = mass[1] * centre_down_acceleration_inertial;
      const T centre_side_acceleration_inertial = ratio<T>(1, 2)
          * span_side_acceleration_inertial[1];
      centre_side_force_inertial[1] = mass[1] * centre_side_acceleration_inertial;
    }
    {
      const T centre_down_acceleration_inertial = span_down_acceleration_inertial[1]
          + ratio<T>(1, 2) * span_down_acceleration_inertial[2];
      centre_down_force_inertial[2] = mass[2] * centre_down_acceleration_inertial;
      const T centre_side_acceleration_inertial = span_side_acceleration_inertial[1]
          + ratio<T>(1, 2) * span_side_acceleration_inertial[2];
      centre_side_force_inertial[2] = mass[2] * centre_side_acceleration_inertial;
    }
    for (int i = 3; i <= links; ++i) {
      const T centre_down_acceleration_inertial = ratio<T>(1, 2)
          * span_down_acceleration_inertial[i] + joint_down_acceleration_inertial[i - 1];
      centre_down_force_inertial[i] = mass[i] * centre_down_acceleration_inertial;
      const T centre_side_acceleration_inertial = ratio<T>(1, 2)
          * span_side_acceleration_inertial[i] + joint_side_acceleration_inertial[i - 1];
      centre_side_force_inertial[i] = mass[i] * centre_side_acceleration_inertial;
    }
    T cut_force_down_inertial[links + 2];
    T cut_force_side_inertial[links + 2];
    cut_force_down_inertial[links + 1] = load_mass * joint_down_acceleration_inertial[links];
    cut_force_side_inertial[links + 1] = load_mass * joint_side_acceleration_inertial[links];
    for (int i = links; i >= 2; --i) {
      cut_force_down_inertial[i] = cut_force_down_inertial[i + 1] + centre_down_force_inertial[i];
      cut_force_side_inertial[i] = cut_force_side_inertial[i + 1] + centre_side_force_inertial[i];
    }
    for (int i = 1; i <= links; ++i) {
      const T span_down_force_inertial = cut_force_down_inertial[i + 1]
          + ratio<T>(1, 2) * centre_down_force_inertial[i];
      const T span_side_force_inertial = cut_force_side_inertial[i + 1]
          + ratio<T>(1, 2) * centre_side_force_inertial[i];
      r[i - 1] = inertia[i] * theta_ddot[i] + length[i] * (cosine[i] * span_side_force_inertial
          - sine[i] * span_down_force_inertial);
    }
  }

  /// The term coriolis of r alone.
  /// 9 * links - 6 additions, 15 * links + 2 multiplications, 0 divisions, 0 functions
  template <class T>
  void term_coriolis(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const T load_mass = at.p[6 * links];
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_down_acceleration_bias[links + 1];
    T span_side_acceleration_bias[links + 1];
    for (int i = 1; i <= links; ++i) {
      span_down_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * cosine[i];
      span_side_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * sine[i];
    }
    T joint_down_acceleration_bias[links + 1];
    T joint_side_acceleration_bias[links + 1];
    joint_down_acceleration_bias[2] = span_down_acceleration_bias[1]
        + span_down_acceleration_bias[2];
    joint_side_acceleration_bias[2] = span_side_acceleration_bias[1]
        + span_side_acceleration_bias[2];
    for (int i = 3; i <= links; ++i) {
      joint_down_acceleration_bias[i] = span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      joint_side_acceleration_bias[i] = span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
    }
    T centre_down_force_bias[links + 1];
    T centre_side_force_bias[links + 1];
    {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[1];
      centre_down_force_bias[1] = mass[1] * centre_down_acceleration_bias;
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[1];
      centre_side_force_bias[1] = mass[1] * centre_side_acceleration_bias;
    }
    {
      const T centre_down_acceleration_bias = span_down_acceleration_bias[1]
          + ratio<T>(1, 2) * span_down_acceleration_bias[2];
      centre_down_force_bias[2] = mass[2] * centre_down_acceleration_bias;
      const T centre_side_acceleration_bias = span_side_acceleration_bias[1]
          + ratio<T>(1, 2) * span_side_acceleration_bias[2];
      centre_side_force_bias[2] = mass[2] * centre_side_acceleration_bias;
    }
    for (int i = 3; i <= links; ++i) {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      centre_down_force_bias[i] = mass[i] * centre_down_acceleration_bias;
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
      centre_side_force_bias[i] = mass[i] * centre_side_acceleration_bias;
    }
    T cut_force_down_bias[links + 2];
    T cut_force_side_bias[links + 2];
    cut_force_down_bias[links + 1] = load_mass * joint_down_acceleration_bias[links];
    cut_force_side_bias[links + 1] = load_mass * joint_side_acceleration_bias[links];
    for (int i = links; i >= 2; --i) {
      cut_force_down_bias[i] = cut_force_down_bias[i + 1] + centre_down_force_bias[i];
      cut_force_side_bias[i] = cut_force_side_bias[i + 1] + centre_side_force_bias[i];
    }
    for (int i = 1; i <= links; ++i) {
      const T span_down_force_bias = cut_force_down_bias[i + 1]
          + ratio<T>(1, 2) * centre_down_force_bias[i];
      const T span_side_force_bias = cut_force_side_bias[i + 1]
          + ratio<T>(1, 2) * centre_side_force_bias[i];
      r[i - 1] = length[i] * (cosine[i] * span_side_force_bias - sine[i] * span_down_force_bias);
    }
  }

  /// The term gravity of r alone.
  /// 2 * links - 1 additions, 4 * links + 1 multiplications, 0 divisions, 0 functions
  template <class T>
  void term_gravity(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T centre_down_force[links + 1];
    for (int i = 1; i <= links; ++i) {
      centre_down_force[i] = -mass[i] * gravity;
    }
    T cut_force_down[links + 2];
    cut_force_down[links + 1] = -load_mass * gravity;
    for (int i = links; i >= 2; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
    }
    for (int i = 1; i <= links; ++i) {
      const T span_down_force = cut_force_down[i + 1] + ratio<T>(1, 2) * centre_down_force[i];
      r[i - 1] = -length[i] * sine[i] * span_down_force;
    }
  }

  /// The term elastic of r alone.
  /// 2 * links - 2 additions, links multiplications, 0 divisions, 0 functions
  template <class T>
  void term_elastic(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> theta(at.q);
    T joint_moment[links + 1];
    {
      const T joint_angle = theta[1];
      joint_moment[1] = stiffness[1] * joint_angle;
    }
    for (int i = 2; i <= links; ++i) {
      const T joint_angle = theta[i] - theta[i - 1];
      joint_moment[i] = stiffness[i] * joint_angle;
    }
    for (int i = 1; i <= links - 1; ++i) {
      r[i - 1] = joint_moment[i] - joint_moment[i + 1];
    }
    r[links - 1] = joint_moment[links];
  }

  /// The term friction of r alone.
  /// 2 * links - 2 additions, links multiplications, 0 divisions, 0 functions
  template <class T>
  void term_friction(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> theta_dot(at.v);
    T joint_moment[links + 1];
    {
      const T joint_rate = theta_dot[1];
      joint_moment[1] = damping[1] * joint_rate;
    }
    for (int i = 2; i <= links; ++i) {
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      joint_moment[i] = damping[i] * joint_rate;
    }
    for (int i = 1; i <= links - 1; ++i) {
      r[i - 1] = joint_moment[i] - joint_moment[i + 1];
    }
    r[links - 1] = joint_moment[links];
  }

  /// The term torque of r alone.
  /// 0 additions, 0 multiplications, 0 divisions, 0 functions
  template <class T>
  void term_torque(const Point<T>& at, T* r) const {
    const int links = this->links();
    const FromOne<T> torque(at.p + 5 * links);
    for (int i = 1; i <= links; ++i) {
      r[i - 1] = -torque[i];
    }
  }

  /// One term of r, numbered as in the table; their sum is r.
  template <class T>
  void residual_term(const Point<T>& at, int term, T* r) const {
    switch (term) {
      case 0:
        term_inertia(at, r);
        break;
      case 1:
        term_coriolis(at, r);
        break;
      case 2:
        term_gravity(at, r);
        break;
      case 3:
        term_elastic(at, r);
        break;
      case 4:
        term_friction(at, r);
        break;
      case 5:
        term_torque(at, r);
        break;
    }
  }

  /// r with a = 0.
  /// 16 * links - 8 additions, 17 * links + 2 multiplications, 0 divisions, 0 functions
  template <class T>
  void bias(const Point<T>& at, T* h) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> torque(at.p + 5 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T joint_moment[links + 1];
    T span_down_acceleration_bias[links + 1];
    T span_side_acceleration_bias[links + 1];
    {
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      joint_moment[1] = stiffness[1] * joint_angle + damping[1] * joint_rate;
      span_down_acceleration_bias[1] = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
      span_side_acceleration_bias[1] = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
    }
    for (int i = 2; i <= links; ++i) {
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      joint_moment[i] = stiffness[i] * joint_angle + damping[i] * joint_rate;
      span_down_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * cosine[i];
      span_side_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * sine[i];
    }
    T joint_down_acceleration_bias[links + 1];
    T joint_side_acceleration_bias[links + 1];
    joint_down_acceleration_bias[2] = span_down_acceleration_bias[1]
        + span_down_acceleration_bias[2];
    joint_side_acceleration_bias[2] = span_side_acceleration_bias[1]
        + span_side_acceleration_bias[2];
    for (int i = 3; i <= links; ++i) {
      joint_down_acceleration_bias[i] = span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      joint_side_acceleration_bias[i] = span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
    }
    T centre_down_force_bias[links + 1];
    T centre_side_force_bias[links + 1];
    {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[1];
      centre_down_force_bias[1] = mass[1] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[1];
      centre_side_force_bias[1] = mass[1] * centre_side_acceleration_bias;
    }
    {
      const T centre_down_acceleration_bias = span_down_acceleration_bias[1]
          + ratio<T>(1, 2) * span_down_acceleration_bias[2];
      centre_down_force_bias[2] = mass[2] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = span_side_acceleration_bias[1]
          + ratio<T>(1, 2) * span_side_acceleration_bias[2];
      centre_side_force_bias[2] = mass[2] * centre_side_acceleration_bias;
    }
    for (int i = 3; i <= links; ++i) {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      centre_down_force_bias[i] = mass[i] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
      centre_side_force_bias[i] = mass[i] * centre_side_acceleration_bias;
    }
    T cut_force_down_bias[links + 2];
    T cut_force_side_bias[links + 2];
    cut_force_down_bias[links + 1] = load_mass * (joint_down_acceleration_bias[links] - gravity);
    cut_force_side_bias[links + 1] = load_mass * joint_side_acceleration_bias[links];
    for (int i = links; i >= 2; --i) {
      cut_force_down_bias[i] = cut_force_down_bias[i + 1] + centre_down_force_bias[i];
      cut_force_side_bias[i] = cut_force_side_bias[i + 1] + centre_side_force_bias[i];
    }
    for (int i = 1; i <= links - 1; ++i) {
      const T span_down_force_bias = cut_force_down_bias[i + 1]
          + ratio<T>(1, 2) * centre_down_force_bias[i];
      const T span_side_force_bias = cut_force_side_bias[i + 1]
          + ratio<T>(1, 2) * centre_side_force_bias[i];
      h[i - 1] = joint_moment[i] - torque[i] - joint_moment[i + 1]
          + length[i] * (cosine[i] * span_side_force_bias - sine[i] * span_down_force_bias);
    }
    {
      const T span_down_force_bias = cut_force_down_bias[links + 1]
          + ratio<T>(1, 2) * centre_down_force_bias[links];
      const T span_side_force_bias = cut_force_side_bias[links + 1]
          + ratio<T>(1, 2) * centre_side_force_bias[links];
      h[links - 1] = joint_moment[links] - torque[links]
          + length[links] * (cosine[links] * span_side_force_bias
          - sine[links] * span_down_force_bias);
    }
  }

  /// M, row by row.
  /// 5 * links - 3 additions, 11 * links - 2 multiplications, 0 divisions, 0 functions
  template <class T>
  void mass_matrix(const Point<T>& at, T* M) const {
    const int links = this->links();
    T row[2][links], column[2][links], diagonal[links];
    const MassMatrix<T> matrix{links, {row[0], row[1]}, {column[0], column[1]}, diagonal};
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const T load_mass = at.p[6 * links];
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    for (int i = 1; i <= links; ++i) {
      const T mass_joint_down_acceleration_gain = -length[i] * sine[i];
      const T mass_joint_side_acceleration_gain = length[i] * cosine[i];
      matrix.column[0][i - 1] = mass_joint_down_acceleration_gain;
      matrix.column[1][i - 1] = mass_joint_side_acceleration_gain;
    }
    T mass_cut_force_down_per_joint_down_acceleration[links + 1];
    mass_cut_force_down_per_joint_down_acceleration[links] = mass[links] + load_mass;
    for (int i = links - 1; i >= 2; --i) {
      mass_cut_force_down_per_joint_down_acceleration[i] = mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1];
    }
    matrix.row[0][0] = -length[1] * sine[1] * mass_cut_force_down_per_joint_down_acceleration[2];
    matrix.row[1][0] = length[1] * cosine[1] * mass_cut_force_down_per_joint_down_acceleration[2];
    matrix.diagonal[0] = inertia[1] + length[1] * length[1] * (ratio<T>(1, 4) * mass[1]
        + mass_cut_force_down_per_joint_down_acceleration[2]);
    for (int i = 2; i <= links - 1; ++i) {
      matrix.row[0][i - 1] = -length[i] * sine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.row[1][i - 1] = length[i] * cosine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.diagonal[i - 1] = inertia[i] + length[i] * length[i] * (ratio<T>(1, 4) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
    }
    matrix.row[0][links - 1] = -length[links] * sine[links] * (ratio<T>(1, 2) * mass[links]
        + load_mass);
    matrix.row[1][links - 1] = length[links] * cosine[links] * (ratio<T>(1, 2) * mass[links]
        + load_mass);
    matrix.diagonal[links - 1] = inertia[links]
        + length[links] * length[links] * (ratio<T>(1, 4) * mass[links] + load_mass);
    matrix.to_dense(M);
  }

  /// a such that r = 0. Returns 0, or the 1-based coordinate whose pivot is not positive.
  /// 21 * links - 11 additions, 28 * links multiplications, 0 divisions, 0 functions
  template <class T>
  int acceleration(const Point<T>& at, T* a) const {
    const int links = this->links();
    T row[2][links], column[2][links], diagonal[links];
    const MassMatrix<T> matrix{links, {row[0], row[1]}, {column[0], column[1]}, diagonal};
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> torque(at.p + 5 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T joint_moment[links + 1];
    T span_down_acceleration_bias[links + 1];
    T span_side_acceleration_bias[links + 1];
    {
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      joint_moment[1] = stiffness[1] * joint_angle + damping[1] * joint_rate;
      span_down_acceleration_bias[1] = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
      span_side_acceleration_bias[1] = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
      const T mass_joint_down_acceleration_gain = -length[1] * sine[1];
      const T mass_joint_side_acceleration_gain = length[1] * cosine[1];
      matrix.column[0][0] = mass_joint_down_acceleration_gain;
      matrix.column[1][0] = mass_joint_side_acceleration_gain;
    }
    for (int i = 2; i <= links; ++i) {
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      joint_moment[i] = stiffness[i] * joint_angle + damping[i] * joint_rate;
      span_down_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * cosine[i];
      span_side_acceleration_bias[i] = -length[i] * theta_dot[i] * theta_dot[i] * sine[i];
      const T mass_joint_down_acceleration_gain = -length[i] * sine[i];
      const T mass_joint_side_acceleration_gain = length[i] * cosine[i];
      matrix.column[0][i - 1] = mass_joint_down_acceleration_gain;
      matrix.column[1][i - 1] = mass_joint_side_acceleration_gain;
    }
    T joint_down_acceleration_bias[links + 1];
    T joint_side_acceleration_bias[links + 1];
    joint_down_acceleration_bias[2] = span_down_acceleration_bias[1]
        + span_down_acceleration_bias[2];
    joint_side_acceleration_bias[2] = span_side_acceleration_bias[1]
        + span_side_acceleration_bias[2];
    for (int i = 3; i <= links; ++i) {
      joint_down_acceleration_bias[i] = span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      joint_side_acceleration_bias[i] = span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
    }
    T centre_down_force_bias[links + 1];
    T centre_side_force_bias[links + 1];
    {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[1];
      centre_down_force_bias[1] = mass[1] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[1];
      centre_side_force_bias[1] = mass[1] * centre_side_acceleration_bias;
    }
    {
      const T centre_down_acceleration_bias = span_down_acceleration_bias[1]
          + ratio<T>(1, 2) * span_down_acceleration_bias[2];
      centre_down_force_bias[2] = mass[2] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = span_side_acceleration_bias[1]
          + ratio<T>(1, 2) * span_side_acceleration_bias[2];
      centre_side_force_bias[2] = mass[2] * centre_side_acceleration_bias;
    }
    for (int i = 3; i <= links; ++i) {
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias[i]
          + joint_down_acceleration_bias[i - 1];
      centre_down_force_bias[i] = mass[i] * (centre_down_acceleration_bias - gravity);
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias[i]
          + joint_side_acceleration_bias[i - 1];
      centre_side_force_bias[i] = mass[i] * centre_side_acceleration_bias;
    }
    T cut_force_down_bias[links + 2];
    T cut_force_side_bias[links + 2];
    T mass_cut_force_down_per_joint_down_acceleration[links + 1];
    cut_force_down_bias[links + 1] = load_mass * (joint_down_acceleration_bias[links] - gravity);
    cut_force_side_bias[links + 1] = load_mass * joint_side_acceleration_bias[links];
    cut_force_down_bias[links] = cut_force_down_bias[links + 1] + centre_down_force_bias[links];
    cut_force_side_bias[links] = cut_force_side_bias[links + 1] + centre_side_force_bias[links];
    mass_cut_force_down_per_joint_down_acceleration[links] = mass[links] + load_mass;
    for (int i = links - 1; i >= 2; --i) {
      cut_force_down_bias[i] = cut_force_down_bias[i + 1] + centre_down_force_bias[i];
      cut_force_side_bias[i] = cut_force_side_bias[i + 1] + centre_side_force_bias[i];
      mass_cut_force_down_per_joint_down_acceleration[i] = mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1];
    }
    {
      const T span_down_force_bias = cut_force_down_bias[2]
          + ratio<T>(1, 2) * centre_down_force_bias[1];
      const T span_side_force_bias = cut_force_side_bias[2]
          + ratio<T>(1, 2) * centre_side_force_bias[1];
      matrix.row[0][0] = -length[1] * sine[1] * mass_cut_force_down_per_joint_down_acceleration[2];
      matrix.row[1][0] = length[1] * cosine[1] * mass_cut_force_down_per_joint_down_acceleration[2];
      matrix.diagonal[0] = inertia[1] + length[1] * length[1] * (ratio<T>(1, 4) * mass[1]
          + mass_cut_force_down_per_joint_down_acceleration[2]);
      a[0] = torque[1] - joint_moment[1] + joint_moment[2]
          + length[1] * (sine[1] * span_down_force_bias - cosine[1] * span_side_force_bias);
    }
    for (int i = 2; i <= links - 1; ++i) {
      const T span_down_force_bias = cut_force_down_bias[i + 1]
          + ratio<T>(1, 2) * centre_down_force_bias[i];
      const T span_side_force_bias = cut_force_side_bias[i + 1]
          + ratio<T>(1, 2) * centre_side_force_bias[i];
      matrix.row[0][i - 1] = -length[i] * sine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.row[1][i - 1] = length[i] * cosine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.diagonal[i - 1] = inertia[i] + length[i] * length[i] * (ratio<T>(1, 4) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      a[i - 1] = torque[i] - joint_moment[i] + joint_moment[i + 1]
          + length[i] * (sine[i] * span_down_force_bias - cosine[i] * span_side_force_bias);
    }
    {
      const T span_down_force_bias = cut_force_down_bias[links + 1]
          + ratio<T>(1, 2) * centre_down_force_bias[links];
      const T span_side_force_bias = cut_force_side_bias[links + 1]
          + ratio<T>(1, 2) * centre_side_force_bias[links];
      matrix.row[0][links - 1] = -length[links] * sine[links] * (ratio<T>(1, 2) * mass[links]
          + load_mass);
      matrix.row[1][links - 1] = length[links] * cosine[links] * (ratio<T>(1, 2) * mass[links]
          + load_mass);
      matrix.diagonal[links - 1] = inertia[links]
          + length[links] * length[links] * (ratio<T>(1, 4) * mass[links] + load_mass);
      a[links - 1] = torque[links] - joint_moment[links]
          + length[links] * (sine[links] * span_down_force_bias
          - cosine[links] * span_side_force_bias);
    }
    return matrix.solve(a);
  }

  /// The same, bit for bit, in the order that suits a T of several numbers.
  /// 21 * links - 11 additions, 28 * links multiplications, 0 divisions, 0 functions
  template <class T>
  int accelerations(const Point<T>& at, T* a) const {
    const int links = this->links();
    T row[2][links], column[2][links], diagonal[links];
    const MassMatrix<T> matrix{links, {row[0], row[1]}, {column[0], column[1]}, diagonal};
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> torque(at.p + 5 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T joint_moment[links + 1];
    T span_down_acceleration_bias_last;
    T joint_down_acceleration_bias_last;
    T centre_down_force_bias[links + 1];
    T span_side_acceleration_bias_last;
    T joint_side_acceleration_bias_last;
    T centre_side_force_bias[links + 1];
    {
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      joint_moment[1] = stiffness[1] * joint_angle + damping[1] * joint_rate;
      const T span_down_acceleration_bias = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias;
      centre_down_force_bias[1] = mass[1] * (centre_down_acceleration_bias - gravity);
      const T span_side_acceleration_bias = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias;
      centre_side_force_bias[1] = mass[1] * centre_side_acceleration_bias;
      const T mass_joint_down_acceleration_gain = -length[1] * sine[1];
      const T mass_joint_side_acceleration_gain = length[1] * cosine[1];
      matrix.column[0][0] = mass_joint_down_acceleration_gain;
      matrix.column[1][0] = mass_joint_side_acceleration_gain;
      span_down_acceleration_bias_last = span_down_acceleration_bias;
      span_side_acceleration_bias_last = span_side_acceleration_bias;
    }
    {
      const T joint_angle = theta[2] - theta[1];
      const T joint_rate = theta_dot[2] - theta_dot[1];
      joint_moment[2] = stiffness[2] * joint_angle + damping[2] * joint_rate;
      const T span_down_acceleration_bias = -length[2] * theta_dot[2] * theta_dot[2] * cosine[2];
      const T joint_down_acceleration_bias = span_down_acceleration_bias_last
          + span_down_acceleration_bias;
      const T centre_down_acceleration_bias = span_down_acceleration_bias_last
          + ratio<T>(1, 2) * span_down_acceleration_bias;
      centre_down_force_bias[2] = mass[2] * (centre_down_acceleration_bias - gravity);
      const T span_side_acceleration_bias = -length[2] * theta_dot[2] * theta_dot[2] * sine[2];
      const T joint_side_acceleration_bias = span_side_acceleration_bias_last
          + span_side_acceleration_bias;
      const T centre_side_acceleration_bias = span_side_acceleration_bias_last
          + ratio<T>(1, 2) * span_side_acceleration_bias;
      centre_side_force_bias[2] = mass[2] * centre_side_acceleration_bias;
      const T mass_joint_down_acceleration_gain = -length[2] * sine[2];
      const T mass_joint_side_acceleration_gain = length[2] * cosine[2];
      matrix.column[0][1] = mass_joint_down_acceleration_gain;
      matrix.column[1][1] = mass_joint_side_acceleration_gain;
      span_down_acceleration_bias_last = span_down_acceleration_bias;
      joint_down_acceleration_bias_last = joint_down_acceleration_bias;
      span_side_acceleration_bias_last = span_side_acceleration_bias;
      joint_side_acceleration_bias_last = joint_side_acceleration_bias;
    }
    for (int i = 3; i <= links; ++i) {
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      joint_moment[i] = stiffness[i] * joint_angle + damping[i] * joint_rate;
      const T span_down_acceleration_bias = -length[i] * theta_dot[i] * theta_dot[i] * cosine[i];
      const T joint_down_acceleration_bias = span_down_acceleration_bias
          + joint_down_acceleration_bias_last;
      const T centre_down_acceleration_bias = ratio<T>(1, 2) * span_down_acceleration_bias
          + joint_down_acceleration_bias_last;
      centre_down_force_bias[i] = mass[i] * (centre_down_acceleration_bias - gravity);
      const T span_side_acceleration_bias = -length[i] * theta_dot[i] * theta_dot[i] * sine[i];
      const T joint_side_acceleration_bias = span_side_acceleration_bias
          + joint_side_acceleration_bias_last;
      const T centre_side_acceleration_bias = ratio<T>(1, 2) * span_side_acceleration_bias
          + joint_side_acceleration_bias_last;
      centre_side_force_bias[i] = mass[i] * centre_side_acceleration_bias;
      const T mass_joint_down_acceleration_gain = -length[i] * sine[i];
      const T mass_joint_side_acceleration_gain = length[i] * cosine[i];
      matrix.column[0][i - 1] = mass_joint_down_acceleration_gain;
      matrix.column[1][i - 1] = mass_joint_side_acceleration_gain;
      span_down_acceleration_bias_last = span_down_acceleration_bias;
      joint_down_acceleration_bias_last = joint_down_acceleration_bias;
      span_side_acceleration_bias_last = span_side_acceleration_bias;
      joint_side_acceleration_bias_last = joint_side_acceleration_bias;
    }
    T cut_force_down_bias_last;
    T cut_force_side_bias_last;
    T mass_cut_force_down_per_joint_down_acceleration_last;
    {
      const T cut_force_down_bias = load_mass * (joint_down_acceleration_bias_last - gravity);
      const T cut_force_side_bias = load_mass * joint_side_acceleration_bias_last;
      cut_force_down_bias_last = cut_force_down_bias;
      cut_force_side_bias_last = cut_force_side_bias;
    }
    {
      const T cut_force_down_bias = cut_force_down_bias_last + centre_down_force_bias[links];
      const T span_down_force_bias = cut_force_down_bias_last
          + ratio<T>(1, 2) * centre_down_force_bias[links];
      const T cut_force_side_bias = cut_force_side_bias_last + centre_side_force_bias[links];
      const T span_side_force_bias = cut_force_side_bias_last
          + ratio<T>(1, 2) * centre_side_force_bias[links];
      const T mass_cut_force_down_per_joint_down_acceleration = mass[links] + load_mass;
      matrix.row[0][links - 1] = -length[links] * sine[links] * (ratio<T>(1, 2) * mass[links]
          + load_mass);
      matrix.row[1][links - 1] = length[links] * cosine[links] * (ratio<T>(1, 2) * mass[links]
          + load_mass);
      matrix.diagonal[links - 1] = inertia[links]
          + length[links] * length[links] * (ratio<T>(1, 4) * mass[links] + load_mass);
      a[links - 1] = torque[links] - joint_moment[links]
          + length[links] * (sine[links] * span_down_force_bias
          - cosine[links] * span_side_force_bias);
      cut_force_down_bias_last = cut_force_down_bias;
      cut_force_side_bias_last = cut_force_side_bias;
      mass_cut_force_down_per_joint_down_acceleration_last = mass_cut_force_down_per_joint_down_acceleration;
    }
    for (int i = links - 1; i >= 2; --i) {
      const T cut_force_down_bias = cut_force_down_bias_last + centre_down_force_bias[i];
      const T span_down_force_bias = cut_force_down_bias_last
          + ratio<T>(1, 2) * centre_down_force_bias[i];
      const T cut_force_side_bias = cut_force_side_bias_last + centre_side_force_bias[i];
      const T span_side_force_bias = cut_force_side_bias_last
          + ratio<T>(1, 2) * centre_side_force_bias[i];
      const T mass_cut_force_down_per_joint_down_acceleration = mass[i]
          + mass_cut_force_down_per_joint_down_acceleration_last;
      matrix.row[0][i - 1] = -length[i] * sine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration_last);
      matrix.row[1][i - 1] = length[i] * cosine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration_last);
      matrix.diagonal[i - 1] = inertia[i] + length[i] * length[i] * (ratio<T>(1, 4) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration_last);
      a[i - 1] = torque[i] - joint_moment[i] + joint_moment[i + 1]
          + length[i] * (sine[i] * span_down_force_bias - cosine[i] * span_side_force_bias);
      cut_force_down_bias_last = cut_force_down_bias;
      cut_force_side_bias_last = cut_force_side_bias;
      mass_cut_force_down_per_joint_down_acceleration_last = mass_cut_force_down_per_joint_down_acceleration;
    }
    {
      const T span_down_force_bias = cut_force_down_bias_last
          + ratio<T>(1, 2) * centre_down_force_bias[1];
      const T span_side_force_bias = cut_force_side_bias_last
          + ratio<T>(1, 2) * centre_side_force_bias[1];
      matrix.row[0][0] = -length[1] * sine[1]
          * mass_cut_force_down_per_joint_down_acceleration_last;
      matrix.row[1][0] = length[1] * cosine[1]
          * mass_cut_force_down_per_joint_down_acceleration_last;
      matrix.diagonal[0] = inertia[1] + length[1] * length[1] * (ratio<T>(1, 4) * mass[1]
          + mass_cut_force_down_per_joint_down_acceleration_last);
      a[0] = torque[1] - joint_moment[1] + joint_moment[2]
          + length[1] * (sine[1] * span_down_force_bias - cosine[1] * span_side_force_bias);
    }
    return matrix.solve(a);
  }

  /// ca dr/da + cv dr/dv + cq dr/dq at the point (at.a is read).
  /// 40 * links - 14 additions, 83 * links - 12 multiplications, 0 divisions, 0 functions
  template <class T>
  void newton_matrix(const Point<T>& at, const T& ca, const T& cv, const T& cq,
                     NewtonMatrix<T>& matrix) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T newton_joint_down_acceleration_gain = length[1] * (theta_dot[1] * (theta_dot[1]
          * sine[1] * cq - T(2) * cosine[1] * cv) - (theta_ddot[1] * cosine[1] * cq
          + sine[1] * ca));
      const T newton_joint_side_acceleration_gain = length[1] * (cosine[1] * ca
          - theta_ddot[1] * sine[1] * cq - theta_dot[1] * (T(2) * sine[1] * cv
          + theta_dot[1] * cosine[1] * cq));
      matrix.upper_row[0][0] = -length[1] * sine[1];
      matrix.upper_row[1][0] = length[1] * cosine[1];
      matrix.lower_column[0][0] = newton_joint_down_acceleration_gain;
      matrix.lower_column[1][0] = newton_joint_side_acceleration_gain;
      matrix.below[0] = T(0);
      matrix.above[0] = -(stiffness[2] * cq + damping[2] * cv);
    }
    for (int i = 2; i <= links - 1; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
      const T newton_joint_down_acceleration_gain = length[i] * (theta_dot[i] * (theta_dot[i]
          * sine[i] * cq - T(2) * cosine[i] * cv) - (theta_ddot[i] * cosine[i] * cq
          + sine[i] * ca));
      const T newton_joint_side_acceleration_gain = length[i] * (cosine[i] * ca
          - theta_ddot[i] * sine[i] * cq - theta_dot[i] * (T(2) * sine[i] * cv
          + theta_dot[i] * cosine[i] * cq));
      matrix.upper_row[0][i - 1] = -length[i] * sine[i];
      matrix.upper_row[1][i - 1] = length[i] * cosine[i];
      matrix.lower_column[0][i - 1] = newton_joint_down_acceleration_gain;
      matrix.lower_column[1][i - 1] = newton_joint_side_acceleration_gain;
      matrix.below[i - 1] = -(stiffness[i] * cq + damping[i] * cv);
      matrix.above[i - 1] = -(stiffness[i + 1] * cq + damping[i + 1] * cv);
    }
    {
      span_side_acceleration[links] = length[links] * (theta_ddot[links] * cosine[links]
          - theta_dot[links] * theta_dot[links] * sine[links]);
      span_down_acceleration[links] = -length[links] * (theta_dot[links] * theta_dot[links]
          * cosine[links] + theta_ddot[links] * sine[links]);
      const T newton_joint_down_acceleration_gain = length[links] * (theta_dot[links]
          * (theta_dot[links] * sine[links] * cq - T(2) * cosine[links] * cv)
          - (theta_ddot[links] * cosine[links] * cq + sine[links] * ca));
      const T newton_joint_side_acceleration_gain = length[links] * (cosine[links] * ca
          - theta_ddot[links] * sine[links] * cq - theta_dot[links] * (T(2) * sine[links] * cv
          + theta_dot[links] * cosine[links] * cq));
      matrix.upper_row[0][links - 1] = T(0);
      matrix.upper_row[1][links - 1] = T(0);
      matrix.lower_column[0][links - 1] = newton_joint_down_acceleration_gain;
      matrix.lower_column[1][links - 1] = newton_joint_side_acceleration_gain;
      matrix.below[links - 1] = -(stiffness[links] * cq + damping[links] * cv);
      matrix.above[links - 1] = T(0);
    }
    const FromOne<T> newton_joint_down_acceleration_gain(matrix.lower_column[0]);
    const FromOne<T> newton_joint_side_acceleration_gain(matrix.lower_column[1]);
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    for (int i = 2; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
    }
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
    }
    for (int i = 2; i <= links; ++i) {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
    }
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    T mass_cut_force_down_per_joint_down_acceleration[links + 1];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    cut_force_down[links] = cut_force_down[links + 1] + centre_down_force[links];
    cut_force_side[links] = cut_force_side[links + 1] + centre_side_force[links];
    mass_cut_force_down_per_joint_down_acceleration[links] = mass[links] + load_mass;
    for (int i = links - 1; i >= 2; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
      mass_cut_force_down_per_joint_down_acceleration[i] = mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1];
    }
    {
      const T span_down_force = cut_force_down[2] + ratio<T>(1, 2) * centre_down_force[1];
      const T span_side_force = cut_force_side[2] + ratio<T>(1, 2) * centre_side_force[1];
      matrix.upper_column[0][0] = mass_cut_force_down_per_joint_down_acceleration[2]
          * newton_joint_down_acceleration_gain[1];
      matrix.upper_column[1][0] = mass_cut_force_down_per_joint_down_acceleration[2]
          * newton_joint_side_acceleration_gain[1];
      matrix.lower_row[0][0] = -length[1] * sine[1]
          * mass_cut_force_down_per_joint_down_acceleration[2];
      matrix.lower_row[1][0] = length[1] * cosine[1]
          * mass_cut_force_down_per_joint_down_acceleration[2];
      matrix.diagonal[0] = inertia[1] * ca + cq * (stiffness[1] + stiffness[2])
          + cv * (damping[1] + damping[2]) + length[1] * (length[1]
          * (mass_cut_force_down_per_joint_down_acceleration[2] * (ca
          - theta_dot[1] * theta_dot[1] * cq) + ratio<T>(1, 4) * mass[1] * (ca
          - theta_dot[1] * theta_dot[1] * cq)) - cq * (sine[1] * span_side_force
          + cosine[1] * span_down_force));
    }
    for (int i = 2; i <= links - 1; ++i) {
      const T span_down_force = cut_force_down[i + 1] + ratio<T>(1, 2) * centre_down_force[i];
      const T span_side_force = cut_force_side[i + 1] + ratio<T>(1, 2) * centre_side_force[i];
      matrix.upper_column[0][i - 1] = mass_cut_force_down_per_joint_down_acceleration[i + 1]
          * newton_joint_down_acceleration_gain[i]
          + length[i] * mass[i] * (theta_dot[i] * (ratio<T>(1, 2) * theta_dot[i] * sine[i] * cq
          - cosine[i] * cv) - ratio<T>(1, 2) * (theta_ddot[i] * cosine[i] * cq + sine[i] * ca));
      matrix.upper_column[1][i - 1] = mass_cut_force_down_per_joint_down_acceleration[i + 1]
          * newton_joint_side_acceleration_gain[i]
          + length[i] * mass[i] * (ratio<T>(1, 2) * (cosine[i] * ca
          - theta_ddot[i] * sine[i] * cq) - theta_dot[i] * (sine[i] * cv
          + ratio<T>(1, 2) * theta_dot[i] * cosine[i] * cq));
      matrix.lower_row[0][i - 1] = -length[i] * sine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.lower_row[1][i - 1] = length[i] * cosine[i] * (ratio<T>(1, 2) * mass[i]
          + mass_cut_force_down_per_joint_down_acceleration[i + 1]);
      matrix.diagonal[i - 1] = inertia[i] * ca + cq * (stiffness[i] + stiffness[i + 1])
          + cv * (damping[i] + damping[i + 1])
          + length[i] * (length[i] * (mass_cut_force_down_per_joint_down_acceleration[i + 1]
          * (ca - theta_dot[i] * theta_dot[i] * cq) + ratio<T>(1, 4) * mass[i] * (ca
          - theta_dot[i] * theta_dot[i] * cq)) - cq * (sine[i] * span_side_force
          + cosine[i] * span_down_force));
    }
    {
      const T span_down_force = cut_force_down[links + 1]
          + ratio<T>(1, 2) * centre_down_force[links];
      const T span_side_force = cut_force_side[links + 1]
          + ratio<T>(1, 2) * centre_side_force[links];
      matrix.upper_column[0][links - 1] = length[links] * (load_mass * (theta_dot[links]
          * (theta_dot[links] * sine[links] * cq - T(2) * cosine[links] * cv)
          - (theta_ddot[links] * cosine[links] * cq + sine[links] * ca))
          + mass[links] * (theta_dot[links] * (ratio<T>(1, 2) * theta_dot[links] * sine[links]
          * cq - cosine[links] * cv) - ratio<T>(1, 2) * (theta_ddot[links] * cosine[links] * cq
          + sine[links] * ca)));
      matrix.upper_column[1][links - 1] = length[links] * (load_mass * (cosine[links] * ca
          - theta_ddot[links] * sine[links] * cq - theta_dot[links] * (T(2) * sine[links] * cv
          + theta_dot[links] * cosine[links] * cq))
          + mass[links] * (ratio<T>(1, 2) * (cosine[links] * ca
          - theta_ddot[links] * sine[links] * cq) - theta_dot[links] * (sine[links] * cv
          + ratio<T>(1, 2) * theta_dot[links] * cosine[links] * cq)));
      matrix.lower_row[0][links - 1] = -length[links] * sine[links] * (ratio<T>(1, 2)
          * mass[links] + load_mass);
      matrix.lower_row[1][links - 1] = length[links] * cosine[links] * (ratio<T>(1, 2)
          * mass[links] + load_mass);
      matrix.diagonal[links - 1] = inertia[links] * ca + stiffness[links] * cq
          + damping[links] * cv + length[links] * (length[links] * (load_mass * (ca
          - theta_dot[links] * theta_dot[links] * cq) + ratio<T>(1, 4) * mass[links] * (ca
          - theta_dot[links] * theta_dot[links] * cq)) - cq * (sine[links] * span_side_force
          + cosine[links] * span_down_force));
    }
  }

  /// Energies (J) and powers (W), in the order of the table.
  /// 18 * links - 9 additions, 24 * links + 5 multiplications, 0 divisions, 0 functions
  template <class T>
  void energy(const Point<T>& at, T* e) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> inertia(at.p + 2 * links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const FromOne<T> torque(at.p + 5 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_velocity[links + 1];
    T span_down[links + 1];
    T span_down_velocity[links + 1];
    T joint_angle[links + 1];
    T joint_rate[links + 1];
    span_side_velocity[1] = length[1] * theta_dot[1] * cosine[1];
    span_down[1] = length[1] * cosine[1];
    span_down_velocity[1] = -length[1] * theta_dot[1] * sine[1];
    joint_angle[1] = theta[1];
    joint_rate[1] = theta_dot[1];
    for (int i = 2; i <= links; ++i) {
      span_side_velocity[i] = length[i] * theta_dot[i] * cosine[i];
      span_down[i] = length[i] * cosine[i];
      span_down_velocity[i] = -length[i] * theta_dot[i] * sine[i];
      joint_angle[i] = theta[i] - theta[i - 1];
      joint_rate[i] = theta_dot[i] - theta_dot[i - 1];
    }
    T joint_side_velocity[links + 1];
    T joint_down_velocity[links + 1];
    T arc[links + 1];
    T joint_elastic_energy_sum[links + 1];
    T joint_damping_power_sum[links + 1];
    T torque_power_sum[links + 1];
    T joint_down[links + 1];
    T kinetic_energy_sum[links + 2];
    T gravity_energy_sum[links + 2];
    {
      joint_down[0] = T(0);
    }
    {
      joint_side_velocity[1] = span_side_velocity[1];
      joint_down_velocity[1] = span_down_velocity[1];
      joint_elastic_energy_sum[1] = ratio<T>(1, 2) * stiffness[1] * joint_angle[1] * joint_angle[1];
      joint_damping_power_sum[1] = damping[1] * joint_rate[1] * joint_rate[1];
      torque_power_sum[1] = torque[1] * theta_dot[1];
      joint_down[1] = joint_down[0] + span_down[1];
      const T centre_side_velocity = ratio<T>(1, 2) * span_side_velocity[1];
      const T centre_down = joint_down[0] + ratio<T>(1, 2) * span_down[1];
      const T centre_down_velocity = ratio<T>(1, 2) * span_down_velocity[1];
      kinetic_energy_sum[1] = ratio<T>(1, 2) * (inertia[1] * theta_dot[1] * theta_dot[1]
          + mass[1] * (centre_side_velocity * centre_side_velocity
          + centre_down_velocity * centre_down_velocity));
      gravity_energy_sum[1] = mass[1] * gravity * (ratio<T>(1, 2) * length[1] - centre_down);
    }
    {
      joint_side_velocity[2] = span_side_velocity[2] + joint_side_velocity[1];
      joint_down_velocity[2] = span_down_velocity[2] + joint_down_velocity[1];
      arc[2] = length[1] + length[2];
      joint_elastic_energy_sum[2] = ratio<T>(1, 2) * stiffness[2] * joint_angle[2]
          * joint_angle[2] + joint_elastic_energy_sum[1];
      joint_damping_power_sum[2] = damping[2] * joint_rate[2] * joint_rate[2]
          + joint_damping_power_sum[1];
      torque_power_sum[2] = torque[2] * theta_dot[2] + torque_power_sum[1];
      joint_down[2] = joint_down[1] + span_down[2];
      const T centre_side_velocity = ratio<T>(1, 2) * span_side_velocity[2]
          + joint_side_velocity[1];
      const T centre_down = joint_down[1] + ratio<T>(1, 2) * span_down[2];
      const T centre_down_velocity = ratio<T>(1, 2) * span_down_velocity[2]
          + joint_down_velocity[1];
      kinetic_energy_sum[2] = ratio<T>(1, 2) * inertia[2] * theta_dot[2] * theta_dot[2]
          + kinetic_energy_sum[1] + ratio<T>(1, 2) * mass[2] * (centre_side_velocity
          * centre_side_velocity + centre_down_velocity * centre_down_velocity);
      gravity_energy_sum[2] = gravity_energy_sum[1] + mass[2] * gravity * (length[1]
          + ratio<T>(1, 2) * length[2] - centre_down);
    }
    for (int i = 3; i <= links; ++i) {
      joint_side_velocity[i] = span_side_velocity[i] + joint_side_velocity[i - 1];
      joint_down_velocity[i] = span_down_velocity[i] + joint_down_velocity[i - 1];
      arc[i] = length[i] + arc[i - 1];
      joint_elastic_energy_sum[i] = ratio<T>(1, 2) * stiffness[i] * joint_angle[i]
          * joint_angle[i] + joint_elastic_energy_sum[i - 1];
      joint_damping_power_sum[i] = damping[i] * joint_rate[i] * joint_rate[i]
          + joint_damping_power_sum[i - 1];
      torque_power_sum[i] = torque[i] * theta_dot[i] + torque_power_sum[i - 1];
      joint_down[i] = joint_down[i - 1] + span_down[i];
      const T centre_side_velocity = ratio<T>(1, 2) * span_side_velocity[i]
          + joint_side_velocity[i - 1];
      const T centre_down = joint_down[i - 1] + ratio<T>(1, 2) * span_down[i];
      const T centre_down_velocity = ratio<T>(1, 2) * span_down_velocity[i]
          + joint_down_velocity[i - 1];
      kinetic_energy_sum[i] = ratio<T>(1, 2) * inertia[i] * theta_dot[i] * theta_dot[i]
          + kinetic_energy_sum[i - 1] + ratio<T>(1, 2) * mass[i] * (centre_side_velocity
          * centre_side_velocity + centre_down_velocity * centre_down_velocity);
      gravity_energy_sum[i] = gravity_energy_sum[i - 1]
          + mass[i] * gravity * (ratio<T>(1, 2) * length[i] - centre_down + arc[i - 1]);
    }
    {
      kinetic_energy_sum[links + 1] = kinetic_energy_sum[links]
          + ratio<T>(1, 2) * load_mass * (joint_side_velocity[links] * joint_side_velocity[links]
          + joint_down_velocity[links] * joint_down_velocity[links]);
      gravity_energy_sum[links + 1] = gravity_energy_sum[links]
          + load_mass * gravity * (arc[links] - joint_down[links]);
    }
    e[0] = kinetic_energy_sum[links + 1];
    e[1] = gravity_energy_sum[links + 1];
    e[2] = joint_elastic_energy_sum[links];
    e[3] = joint_damping_power_sum[links];
    e[4] = torque_power_sum[links];
  }

  /// Support (0), far end of each link (1..), load (last): side and down, m.
  /// 2 * links additions, 2 * links multiplications, 0 divisions, 0 functions
  template <class T>
  void positions(const Point<T>& at, T* side, T* down) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side[links + 1];
    T span_down[links + 1];
    for (int i = 1; i <= links; ++i) {
      span_side[i] = length[i] * sine[i];
      span_down[i] = length[i] * cosine[i];
    }
    T joint_side[links + 1];
    T joint_down[links + 1];
    joint_side[0] = T(0);
    joint_down[0] = T(0);
    for (int i = 1; i <= links; ++i) {
      joint_side[i] = joint_side[i - 1] + span_side[i];
      joint_down[i] = joint_down[i - 1] + span_down[i];
    }
    for (int i = 0; i <= links; ++i) {
      side[i] = joint_side[i];
      down[i] = joint_down[i];
    }
    side[links + 1] = joint_side[links];
    down[links + 1] = joint_down[links];
  }

  /// Derivative of the positions along `along`.
  /// 4 * links - 2 additions, 6 * links multiplications, 0 divisions, 0 functions
  template <class T, class D>
  void positions_tangent(const Point<T>& at, const Point<D>& along, D* dside, D* ddown) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    const FromOne<D> d_length(along.p);
    const FromOne<D> d_theta(along.q);
    D d_span_side[links + 1];
    D d_span_down[links + 1];
    for (int i = 1; i <= links; ++i) {
      d_span_side[i] = length[i] * cosine[i] * d_theta[i] + sine[i] * d_length[i];
      d_span_down[i] = cosine[i] * d_length[i] - length[i] * sine[i] * d_theta[i];
    }
    D d_joint_side[links + 1];
    D d_joint_down[links + 1];
    d_joint_side[2] = d_span_side[1] + d_span_side[2];
    d_joint_down[2] = d_span_down[1] + d_span_down[2];
    for (int i = 3; i <= links; ++i) {
      d_joint_side[i] = d_span_side[i] + d_joint_side[i - 1];
      d_joint_down[i] = d_span_down[i] + d_joint_down[i - 1];
    }
    dside[0] = D(T(0));
    ddown[0] = D(T(0));
    dside[1] = d_span_side[1];
    ddown[1] = d_span_down[1];
    for (int i = 2; i <= links; ++i) {
      dside[i] = d_joint_side[i];
      ddown[i] = d_joint_down[i];
    }
    dside[links + 1] = d_joint_side[links];
    ddown[links + 1] = d_joint_down[links];
  }

  /// Velocities of the same points, m/s.
  /// 2 * links - 2 additions, 4 * links multiplications, 0 divisions, 0 functions
  template <class T>
  void velocities(const Point<T>& at, T* side_rate, T* down_rate) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> theta_dot(at.v);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_velocity[links + 1];
    T span_down_velocity[links + 1];
    for (int i = 1; i <= links; ++i) {
      span_side_velocity[i] = length[i] * theta_dot[i] * cosine[i];
      span_down_velocity[i] = -length[i] * theta_dot[i] * sine[i];
    }
    T joint_side_velocity[links + 1];
    T joint_down_velocity[links + 1];
    joint_side_velocity[1] = span_side_velocity[1];
    joint_down_velocity[1] = span_down_velocity[1];
    for (int i = 2; i <= links; ++i) {
      joint_side_velocity[i] = span_side_velocity[i] + joint_side_velocity[i - 1];
      joint_down_velocity[i] = span_down_velocity[i] + joint_down_velocity[i - 1];
    }
    side_rate[0] = T(0);
    down_rate[0] = T(0);
    for (int i = 1; i <= links; ++i) {
      side_rate[i] = joint_side_velocity[i];
      down_rate[i] = joint_down_velocity[i];
    }
    side_rate[links + 1] = joint_side_velocity[links];
    down_rate[links + 1] = joint_down_velocity[links];
  }

  /// Joint moments (N m), link tensions (N), curvatures at joints (rad/m).
  /// 15 * links - 7 additions, 17 * links + 2 multiplications, links divisions, 0 functions
  template <class T>
  void internal_forces(const Point<T>& at, T* moment, T* tension, T* curvature) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      const T joint_moment = stiffness[1] * joint_angle + damping[1] * joint_rate;
      moment[0] = -joint_moment;
      curvature[0] = T(2) * theta[1] / length[1];
    }
    {
      span_side_acceleration[2] = length[2] * (theta_ddot[2] * cosine[2]
          - theta_dot[2] * theta_dot[2] * sine[2]);
      span_down_acceleration[2] = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
          + theta_ddot[2] * sine[2]);
      const T joint_angle = theta[2] - theta[1];
      const T joint_rate = theta_dot[2] - theta_dot[1];
      const T arc = length[1] + length[2];
      const T joint_moment = stiffness[2] * joint_angle + damping[2] * joint_rate;
      moment[1] = -joint_moment;
      curvature[1] = T(2) * (theta[2] - theta[1]) / arc;
    }
    for (int i = 3; i <= links; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      const T joint_moment = stiffness[i] * joint_angle + damping[i] * joint_rate;
      const T curvature_divisor = length[i - 1] + length[i];
      moment[i - 1] = -joint_moment;
      curvature[i - 1] = T(2) * (theta[i] - theta[i - 1]) / curvature_divisor;
    }
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    for (int i = 2; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
    }
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
    }
    for (int i = 2; i <= links; ++i) {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
    }
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    for (int i = links; i >= 1; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
    }
    for (int i = 1; i <= links; ++i) {
      tension[i - 1] = -(sine[i] * cut_force_side[i] + cosine[i] * cut_force_down[i]);
    }
  }

  /// What holds the support, then a held end: forces (N) and moments (N m).
  /// 9 * links - 2 additions, 12 * links + 4 multiplications, 0 divisions, 0 functions
  template <class T>
  void reactions(const Point<T>& at, T* force, T* moment) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    T joint_moment[2];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      joint_moment[1] = stiffness[1] * joint_angle + damping[1] * joint_rate;
    }
    for (int i = 2; i <= links; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
    }
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    for (int i = 2; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
    }
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
    }
    for (int i = 2; i <= links; ++i) {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
    }
    moment[0] = -joint_moment[1];
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    for (int i = links; i >= 1; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
    }
    force[0] = cut_force_side[1];
    force[1] = cut_force_down[1];
  }

  /// Gradient of weights . r + rate_weights . zdot with respect to q, v, z and p.
  /// 40 * links - 14 additions, 59 * links + 7 multiplications, 0 divisions, 0 functions
  template <class T>
  void residual_adjoint(const Point<T>& at, const T* weights,
                        [[maybe_unused]] const T* rate_weights, T* dq, T* dv,
                        [[maybe_unused]] T* dz, T* dp) const {
    const int links = this->links();
    const FromOne<T> length(at.p);
    const FromOne<T> mass(at.p + links);
    const FromOne<T> stiffness(at.p + 3 * links);
    const FromOne<T> damping(at.p + 4 * links);
    const T load_mass = at.p[6 * links];
    const T gravity = at.p[6 * links + 1];
    const FromOne<T> theta(at.q);
    const FromOne<T> theta_dot(at.v);
    const FromOne<T> theta_ddot(at.a);
    T sine[links + 1], cosine[links + 1];
    sines_and_cosines(links, at.q, sine + 1, cosine + 1);
    const FromOne<T> weight(weights);
    T span_side_acceleration[links + 1];
    T span_down_acceleration[links + 1];
    T adjoint_span_side_force[links + 1];
    T adjoint_span_down_force[links + 1];
    T adjoint_joint_rate[links + 1];
    T adjoint_joint_angle[links + 1];
    {
      span_side_acceleration[1] = length[1] * (theta_ddot[1] * cosine[1]
          - theta_dot[1] * theta_dot[1] * sine[1]);
      span_down_acceleration[1] = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
          + theta_ddot[1] * sine[1]);
      const T joint_angle = theta[1];
      const T joint_rate = theta_dot[1];
      adjoint_span_side_force[1] = length[1] * cosine[1] * weight[1];
      adjoint_span_down_force[1] = -length[1] * sine[1] * weight[1];
      adjoint_joint_rate[1] = damping[1] * weight[1];
      adjoint_joint_angle[1] = stiffness[1] * weight[1];
      const T adjoint_torque = -weight[1];
      const T adjoint_damping = joint_rate * weight[1];
      const T adjoint_stiffness = joint_angle * weight[1];
      const T adjoint_inertia = theta_ddot[1] * weight[1];
      dp[2 * links + 0] = adjoint_inertia;
      dp[3 * links + 0] = adjoint_stiffness;
      dp[4 * links + 0] = adjoint_damping;
      dp[5 * links + 0] = adjoint_torque;
    }
    for (int i = 2; i <= links; ++i) {
      span_side_acceleration[i] = length[i] * (theta_ddot[i] * cosine[i]
          - theta_dot[i] * theta_dot[i] * sine[i]);
      span_down_acceleration[i] = -length[i] * (theta_dot[i] * theta_dot[i] * cosine[i]
          + theta_ddot[i] * sine[i]);
      const T joint_angle = theta[i] - theta[i - 1];
      const T joint_rate = theta_dot[i] - theta_dot[i - 1];
      adjoint_span_side_force[i] = length[i] * cosine[i] * weight[i];
      adjoint_span_down_force[i] = -length[i] * sine[i] * weight[i];
      const T adjoint_joint_moment = weight[i] - weight[i - 1];
      adjoint_joint_rate[i] = damping[i] * adjoint_joint_moment;
      adjoint_joint_angle[i] = stiffness[i] * adjoint_joint_moment;
      const T adjoint_torque = -weight[i];
      const T adjoint_damping = joint_rate * adjoint_joint_moment;
      const T adjoint_stiffness = joint_angle * adjoint_joint_moment;
      const T adjoint_inertia = theta_ddot[i] * weight[i];
      dp[2 * links + i - 1] = adjoint_inertia;
      dp[3 * links + i - 1] = adjoint_stiffness;
      dp[4 * links + i - 1] = adjoint_damping;
      dp[5 * links + i - 1] = adjoint_torque;
    }
    T joint_side_acceleration[links + 1];
    T joint_down_acceleration[links + 1];
    T adjoint_cut_force_side[links + 2];
    T adjoint_cut_force_down[links + 2];
    T adjoint_centre_down_force[links + 1];
    T adjoint_gravity_sum[links + 2];
    joint_side_acceleration[1] = span_side_acceleration[1];
    joint_down_acceleration[1] = span_down_acceleration[1];
    adjoint_centre_down_force[1] = ratio<T>(1, 2) * adjoint_span_down_force[1];
    adjoint_gravity_sum[1] = -mass[1] * adjoint_centre_down_force[1];
    joint_side_acceleration[2] = span_side_acceleration[2] + joint_side_acceleration[1];
    joint_down_acceleration[2] = span_down_acceleration[2] + joint_down_acceleration[1];
    adjoint_centre_down_force[2] = adjoint_span_down_force[1]
        + ratio<T>(1, 2) * adjoint_span_down_force[2];
    adjoint_gravity_sum[2] = adjoint_gravity_sum[1] - mass[2] * adjoint_centre_down_force[2];
    joint_side_acceleration[3] = span_side_acceleration[3] + joint_side_acceleration[2];
    joint_down_acceleration[3] = span_down_acceleration[3] + joint_down_acceleration[2];
    adjoint_cut_force_side[3] = adjoint_span_side_force[1] + adjoint_span_side_force[2];
    adjoint_cut_force_down[3] = adjoint_span_down_force[1] + adjoint_span_down_force[2];
    adjoint_centre_down_force[3] = ratio<T>(1, 2) * adjoint_span_down_force[3]
        + adjoint_cut_force_down[3];
    adjoint_gravity_sum[3] = adjoint_gravity_sum[2] - mass[3] * adjoint_centre_down_force[3];
    for (int i = 4; i <= links; ++i) {
      joint_side_acceleration[i] = span_side_acceleration[i] + joint_side_acceleration[i - 1];
      joint_down_acceleration[i] = span_down_acceleration[i] + joint_down_acceleration[i - 1];
      adjoint_cut_force_side[i] = adjoint_span_side_force[i - 1] + adjoint_cut_force_side[i - 1];
      adjoint_cut_force_down[i] = adjoint_span_down_force[i - 1] + adjoint_cut_force_down[i - 1];
      adjoint_centre_down_force[i] = ratio<T>(1, 2) * adjoint_span_down_force[i]
          + adjoint_cut_force_down[i];
      adjoint_gravity_sum[i] = adjoint_gravity_sum[i - 1] - mass[i] * adjoint_centre_down_force[i];
    }
    adjoint_cut_force_side[links + 1] = adjoint_span_side_force[links]
        + adjoint_cut_force_side[links];
    adjoint_cut_force_down[links + 1] = adjoint_span_down_force[links]
        + adjoint_cut_force_down[links];
    adjoint_gravity_sum[links + 1] = adjoint_gravity_sum[links]
        - load_mass * adjoint_cut_force_down[links + 1];
    T centre_down_force[links + 1];
    T centre_side_force[links + 1];
    T adjoint_centre_down_acceleration[links + 1];
    T adjoint_centre_side_acceleration[links + 1];
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[1];
      centre_down_force[1] = mass[1] * (centre_down_acceleration - gravity);
      centre_side_force[1] = mass[1] * centre_side_acceleration;
      const T adjoint_centre_side_force = ratio<T>(1, 2) * adjoint_span_side_force[1];
      adjoint_centre_down_acceleration[1] = mass[1] * adjoint_centre_down_force[1];
      adjoint_centre_side_acceleration[1] = mass[1] * adjoint_centre_side_force;
      const T adjoint_mass = centre_side_acceleration * adjoint_centre_side_force
          + adjoint_centre_down_force[1] * (centre_down_acceleration - gravity);
      dp[links + 0] = adjoint_mass;
    }
    {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[2]
          + joint_side_acceleration[1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[2]
          + joint_down_acceleration[1];
      centre_down_force[2] = mass[2] * (centre_down_acceleration - gravity);
      centre_side_force[2] = mass[2] * centre_side_acceleration;
      const T adjoint_centre_side_force = adjoint_span_side_force[1]
          + ratio<T>(1, 2) * adjoint_span_side_force[2];
      adjoint_centre_down_acceleration[2] = mass[2] * adjoint_centre_down_force[2];
      adjoint_centre_side_acceleration[2] = mass[2] * adjoint_centre_side_force;
      const T adjoint_mass = centre_side_acceleration * adjoint_centre_side_force
          + adjoint_centre_down_force[2] * (centre_down_acceleration - gravity);
      dp[links + 1] = adjoint_mass;
    }
    for (int i = 3; i <= links; ++i) {
      const T centre_side_acceleration = ratio<T>(1, 2) * span_side_acceleration[i]
          + joint_side_acceleration[i - 1];
      const T centre_down_acceleration = ratio<T>(1, 2) * span_down_acceleration[i]
          + joint_down_acceleration[i - 1];
      centre_down_force[i] = mass[i] * (centre_down_acceleration - gravity);
      centre_side_force[i] = mass[i] * centre_side_acceleration;
      const T adjoint_centre_side_force = ratio<T>(1, 2) * adjoint_span_side_force[i]
          + adjoint_cut_force_side[i];
      adjoint_centre_down_acceleration[i] = mass[i] * adjoint_centre_down_force[i];
      adjoint_centre_side_acceleration[i] = mass[i] * adjoint_centre_side_force;
      const T adjoint_mass = centre_side_acceleration * adjoint_centre_side_force
          + adjoint_centre_down_force[i] * (centre_down_acceleration - gravity);
      dp[links + i - 1] = adjoint_mass;
    }
    const T adjoint_load_mass = joint_side_acceleration[links]
        * adjoint_cut_force_side[links + 1]
        + adjoint_cut_force_down[links + 1] * (joint_down_acceleration[links] - gravity);
    dp[6 * links] = adjoint_load_mass;
    dp[6 * links + 1] = adjoint_gravity_sum[links + 1];
    T cut_force_down[links + 2];
    T cut_force_side[links + 2];
    T adjoint_joint_down_acceleration[links + 1];
    T adjoint_joint_side_acceleration[links + 1];
    cut_force_down[links + 1] = load_mass * (joint_down_acceleration[links] - gravity);
    cut_force_side[links + 1] = load_mass * joint_side_acceleration[links];
    cut_force_down[links] = cut_force_down[links + 1] + centre_down_force[links];
    cut_force_side[links] = cut_force_side[links + 1] + centre_side_force[links];
    adjoint_joint_down_acceleration[links] = load_mass * adjoint_cut_force_down[links + 1];
    adjoint_joint_side_acceleration[links] = load_mass * adjoint_cut_force_side[links + 1];
    for (int i = links - 1; i >= 2; --i) {
      cut_force_down[i] = cut_force_down[i + 1] + centre_down_force[i];
      cut_force_side[i] = cut_force_side[i + 1] + centre_side_force[i];
      adjoint_joint_down_acceleration[i] = adjoint_joint_down_acceleration[i + 1]
          + adjoint_centre_down_acceleration[i + 1];
      adjoint_joint_side_acceleration[i] = adjoint_joint_side_acceleration[i + 1]
          + adjoint_centre_side_acceleration[i + 1];
    }
    adjoint_joint_down_acceleration[1] = adjoint_joint_down_acceleration[2]
        + adjoint_centre_down_acceleration[2];
    adjoint_joint_side_acceleration[1] = adjoint_joint_side_acceleration[2]
        + adjoint_centre_side_acceleration[2];
    for (int i = 1; i <= links - 1; ++i) {
      const T span_down_force = cut_force_down[i + 1] + ratio<T>(1, 2) * centre_down_force[i];
      const T span_side_force = cut_force_side[i + 1] + ratio<T>(1, 2) * centre_side_force[i];
      const T adjoint_span_down_acceleration = adjoint_joint_down_acceleration[i]
          + ratio<T>(1, 2) * adjoint_centre_down_acceleration[i];
      const T adjoint_span_side_acceleration = adjoint_joint_side_acceleration[i]
          + ratio<T>(1, 2) * adjoint_centre_side_acceleration[i];
      const T adjoint_cosine = length[i] * (theta_ddot[i] * adjoint_span_side_acceleration
          - theta_dot[i] * theta_dot[i] * adjoint_span_down_acceleration
          + span_side_force * weight[i]);
      const T adjoint_sine = -length[i] * (theta_dot[i] * theta_dot[i]
          * adjoint_span_side_acceleration + theta_ddot[i] * adjoint_span_down_acceleration
          + span_down_force * weight[i]);
      const T adjoint_theta_dot = adjoint_joint_rate[i] - adjoint_joint_rate[i + 1]
          - T(2) * length[i] * theta_dot[i] * (sine[i] * adjoint_span_side_acceleration
          + cosine[i] * adjoint_span_down_acceleration);
      const T adjoint_theta = cosine[i] * adjoint_sine - sine[i] * adjoint_cosine
          + adjoint_joint_angle[i] - adjoint_joint_angle[i + 1];
      const T adjoint_length = cosine[i] * (theta_ddot[i] * adjoint_span_side_acceleration
          - theta_dot[i] * theta_dot[i] * adjoint_span_down_acceleration
          + span_side_force * weight[i]) - sine[i] * (theta_dot[i] * theta_dot[i]
          * adjoint_span_side_acceleration + theta_ddot[i] * adjoint_span_down_acceleration
          + span_down_force * weight[i]);
      dp[i - 1] = adjoint_length;
      dq[i - 1] = adjoint_theta;
      dv[i - 1] = adjoint_theta_dot;
    }
    {
      const T span_down_force = cut_force_down[links + 1]
          + ratio<T>(1, 2) * centre_down_force[links];
      const T span_side_force = cut_force_side[links + 1]
          + ratio<T>(1, 2) * centre_side_force[links];
      const T adjoint_span_down_acceleration = adjoint_joint_down_acceleration[links]
          + ratio<T>(1, 2) * adjoint_centre_down_acceleration[links];
      const T adjoint_span_side_acceleration = adjoint_joint_side_acceleration[links]
          + ratio<T>(1, 2) * adjoint_centre_side_acceleration[links];
      const T adjoint_cosine = length[links] * (theta_ddot[links]
          * adjoint_span_side_acceleration - theta_dot[links] * theta_dot[links]
          * adjoint_span_down_acceleration + span_side_force * weight[links]);
      const T adjoint_sine = -length[links] * (theta_dot[links] * theta_dot[links]
          * adjoint_span_side_acceleration + theta_ddot[links] * adjoint_span_down_acceleration
          + span_down_force * weight[links]);
      const T adjoint_theta_dot = adjoint_joint_rate[links]
          - T(2) * length[links] * theta_dot[links] * (sine[links]
          * adjoint_span_side_acceleration + cosine[links] * adjoint_span_down_acceleration);
      const T adjoint_theta = cosine[links] * adjoint_sine - sine[links] * adjoint_cosine
          + adjoint_joint_angle[links];
      const T adjoint_length = cosine[links] * (theta_ddot[links]
          * adjoint_span_side_acceleration - theta_dot[links] * theta_dot[links]
          * adjoint_span_down_acceleration + span_side_force * weight[links])
          - sine[links] * (theta_dot[links] * theta_dot[links] * adjoint_span_side_acceleration
          + theta_ddot[links] * adjoint_span_down_acceleration + span_down_force * weight[links]);
      dp[links - 1] = adjoint_length;
      dq[links - 1] = adjoint_theta;
      dv[links - 1] = adjoint_theta_dot;
    }
  }
};

#pragma GCC diagnostic pop

/// The table of a chain, in double precision. Its id and what it lists are to be filled in:
/// names take memory (AnyLinksModel of any_links_table.hpp does it). Its context is `chain`, which is
/// to live as long as the table.
catena_model table(const Chain& chain);

}  // namespace catena::chain_any
