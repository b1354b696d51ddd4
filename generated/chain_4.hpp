// SPDX-License-Identifier: BSD-3-Clause
// Written by catena-derive. Do not edit: change the model description and derive again.
//
// Equations of motion of a hanging chain of 4 rigid links with elastic, damped joints and a load.
// Arguments, shapes, units and signs: catena_model.h. T is any scalar type, see scalar.hpp;
// D, of differentials, is T or one that holds several directions, see directions.hpp.
//
// Structure found:
//   M: semiseparable of rank 2, symmetric (proved for every pair of links)
//   ca dr/da + cv dr/dv + cq dr/dq: tridiagonal plus semiseparable, ranks 2 (above) and 2 (below the diagonal)
//   K: constant, symmetric, tridiagonal
//   C: constant, symmetric, tridiagonal
#pragma once

#include "batch.hpp"
#include "dense.hpp"
#include "quasiseparable.hpp"
#include "scalar.hpp"
#include "semiseparable.hpp"

extern "C" {
struct catena_model;
}

namespace catena::chain_4 {

inline constexpr int kLinks = 4;
inline constexpr int kCoordinates = 4;
inline constexpr int kStates = 0;
inline constexpr int kSignals = 0;
inline constexpr int kParameters = 26;

/// The same functions behind the table of catena_model.h, in double precision.
const ::catena_model& table();

/// Mass matrix in the form in which it is factored.
template <class T>
using MassMatrix = SymmetricSemiseparable<T, kLinks, 2>;

/// ca dr/da + cv dr/dv + cq dr/dq in the form in which it is factored.
template <class T>
using NewtonMatrix = Quasiseparable<T, kLinks, 2, 2>;

/// r(t, q, v, a, z, u, p), the inverse dynamics.
/// 68 additions, 82 multiplications, 0 divisions, 0 functions
template <class T>
void residual(const Point<T>& at, T* r) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const FromOne<T> torque(at.p + 20);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T joint_moment_4 = stiffness[4] * joint_angle_4 + damping[4] * joint_rate_4;
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T span_down_force_4 = cut_force_down_5 + ratio<T>(1, 2) * centre_down_force_4;
  const T span_side_force_4 = cut_force_side_5 + ratio<T>(1, 2) * centre_side_force_4;
  const T joint_moment_3 = stiffness[3] * joint_angle_3 + damping[3] * joint_rate_3;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T span_down_force_3 = cut_force_down_4 + ratio<T>(1, 2) * centre_down_force_3;
  const T span_side_force_3 = cut_force_side_4 + ratio<T>(1, 2) * centre_side_force_3;
  const T joint_moment_2 = stiffness[2] * joint_angle_2 + damping[2] * joint_rate_2;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T span_down_force_2 = cut_force_down_3 + ratio<T>(1, 2) * centre_down_force_2;
  const T span_side_force_2 = cut_force_side_3 + ratio<T>(1, 2) * centre_side_force_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1 + damping[1] * joint_rate_1;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T span_down_force_1 = cut_force_down_2 + ratio<T>(1, 2) * centre_down_force_1;
  const T span_side_force_1 = cut_force_side_2 + ratio<T>(1, 2) * centre_side_force_1;
  r[0] = inertia[1] * theta_ddot[1] - torque[1] + joint_moment_1 - joint_moment_2
      + length[1] * (cosine[1] * span_side_force_1 - sine[1] * span_down_force_1);
  r[1] = inertia[2] * theta_ddot[2] - torque[2] + joint_moment_2 - joint_moment_3
      + length[2] * (cosine[2] * span_side_force_2 - sine[2] * span_down_force_2);
  r[2] = inertia[3] * theta_ddot[3] - torque[3] + joint_moment_3 - joint_moment_4
      + length[3] * (cosine[3] * span_side_force_3 - sine[3] * span_down_force_3);
  r[3] = inertia[4] * theta_ddot[4] - torque[4] + joint_moment_4
      + length[4] * (cosine[4] * span_side_force_4 - sine[4] * span_down_force_4);
}

/// Derivative of r along `along`.
/// 188 additions, 254 multiplications, 0 divisions, 0 functions
template <class T, class D>
void residual_tangent(const Point<T>& at, const Point<D>& along, D* dr) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const FromOne<D> d_length(along.p);
  const FromOne<D> d_mass(along.p + 4);
  const FromOne<D> d_inertia(along.p + 8);
  const FromOne<D> d_stiffness(along.p + 12);
  const FromOne<D> d_damping(along.p + 16);
  const FromOne<D> d_torque(along.p + 20);
  const D d_load_mass = along.p[24];
  const D d_gravity = along.p[25];
  const FromOne<D> d_theta(along.q);
  const FromOne<D> d_theta_dot(along.v);
  const FromOne<D> d_theta_ddot(along.a);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T span_down_force_4 = cut_force_down_5 + ratio<T>(1, 2) * centre_down_force_4;
  const T span_side_force_4 = cut_force_side_5 + ratio<T>(1, 2) * centre_side_force_4;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T span_down_force_3 = cut_force_down_4 + ratio<T>(1, 2) * centre_down_force_3;
  const T span_side_force_3 = cut_force_side_4 + ratio<T>(1, 2) * centre_side_force_3;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T span_down_force_2 = cut_force_down_3 + ratio<T>(1, 2) * centre_down_force_2;
  const T span_side_force_2 = cut_force_side_3 + ratio<T>(1, 2) * centre_side_force_2;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T span_down_force_1 = cut_force_down_2 + ratio<T>(1, 2) * centre_down_force_1;
  const T span_side_force_1 = cut_force_side_2 + ratio<T>(1, 2) * centre_side_force_1;
  const D d_joint_angle_2 = d_theta[2] - d_theta[1];
  const D d_joint_rate_2 = d_theta_dot[2] - d_theta_dot[1];
  const D d_joint_moment_2 = stiffness[2] * d_joint_angle_2 + damping[2] * d_joint_rate_2
      + joint_angle_2 * d_stiffness[2] + joint_rate_2 * d_damping[2];
  const D d_joint_moment_1 = stiffness[1] * d_theta[1] + damping[1] * d_theta_dot[1]
      + joint_angle_1 * d_stiffness[1] + joint_rate_1 * d_damping[1];
  const D d_span_down_acceleration_1 = length[1] * (theta_dot[1] * (theta_dot[1] * sine[1]
      * d_theta[1] - T(2) * cosine[1] * d_theta_dot[1]) - (theta_ddot[1] * cosine[1] * d_theta[1]
      + sine[1] * d_theta_ddot[1])) - d_length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const D d_span_down_acceleration_2 = length[2] * (theta_dot[2] * (theta_dot[2] * sine[2]
      * d_theta[2] - T(2) * cosine[2] * d_theta_dot[2]) - (theta_ddot[2] * cosine[2] * d_theta[2]
      + sine[2] * d_theta_ddot[2])) - d_length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const D d_joint_down_acceleration_2 = d_span_down_acceleration_1 + d_span_down_acceleration_2;
  const D d_span_down_acceleration_3 = length[3] * (theta_dot[3] * (theta_dot[3] * sine[3]
      * d_theta[3] - T(2) * cosine[3] * d_theta_dot[3]) - (theta_ddot[3] * cosine[3] * d_theta[3]
      + sine[3] * d_theta_ddot[3])) - d_length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const D d_joint_down_acceleration_3 = d_span_down_acceleration_3 + d_joint_down_acceleration_2;
  const D d_span_down_acceleration_4 = length[4] * (theta_dot[4] * (theta_dot[4] * sine[4]
      * d_theta[4] - T(2) * cosine[4] * d_theta_dot[4]) - (theta_ddot[4] * cosine[4] * d_theta[4]
      + sine[4] * d_theta_ddot[4])) - d_length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const D d_joint_down_acceleration_4 = d_span_down_acceleration_4 + d_joint_down_acceleration_3;
  const D d_cut_force_down_5 = d_load_mass * (joint_down_acceleration_4 - gravity)
      + load_mass * (d_joint_down_acceleration_4 - d_gravity);
  const D d_centre_down_acceleration_4 = ratio<T>(1, 2) * d_span_down_acceleration_4
      + d_joint_down_acceleration_3;
  const D d_centre_down_force_4 = d_mass[4] * (centre_down_acceleration_4 - gravity)
      + mass[4] * (d_centre_down_acceleration_4 - d_gravity);
  const D d_cut_force_down_4 = d_cut_force_down_5 + d_centre_down_force_4;
  const D d_centre_down_acceleration_3 = ratio<T>(1, 2) * d_span_down_acceleration_3
      + d_joint_down_acceleration_2;
  const D d_centre_down_force_3 = d_mass[3] * (centre_down_acceleration_3 - gravity)
      + mass[3] * (d_centre_down_acceleration_3 - d_gravity);
  const D d_cut_force_down_3 = d_cut_force_down_4 + d_centre_down_force_3;
  const D d_centre_down_acceleration_2 = d_span_down_acceleration_1
      + ratio<T>(1, 2) * d_span_down_acceleration_2;
  const D d_centre_down_force_2 = d_mass[2] * (centre_down_acceleration_2 - gravity)
      + mass[2] * (d_centre_down_acceleration_2 - d_gravity);
  const D d_cut_force_down_2 = d_cut_force_down_3 + d_centre_down_force_2;
  const D d_centre_down_acceleration_1 = ratio<T>(1, 2) * d_span_down_acceleration_1;
  const D d_centre_down_force_1 = d_mass[1] * (centre_down_acceleration_1 - gravity)
      + mass[1] * (d_centre_down_acceleration_1 - d_gravity);
  const D d_span_down_force_1 = d_cut_force_down_2 + ratio<T>(1, 2) * d_centre_down_force_1;
  const D d_span_side_acceleration_1 = d_length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]) + length[1] * (cosine[1] * d_theta_ddot[1]
      - theta_ddot[1] * sine[1] * d_theta[1] - theta_dot[1] * (T(2) * sine[1] * d_theta_dot[1]
      + theta_dot[1] * cosine[1] * d_theta[1]));
  const D d_span_side_acceleration_2 = d_length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]) + length[2] * (cosine[2] * d_theta_ddot[2]
      - theta_ddot[2] * sine[2] * d_theta[2] - theta_dot[2] * (T(2) * sine[2] * d_theta_dot[2]
      + theta_dot[2] * cosine[2] * d_theta[2]));
  const D d_joint_side_acceleration_2 = d_span_side_acceleration_1 + d_span_side_acceleration_2;
  const D d_span_side_acceleration_3 = d_length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]) + length[3] * (cosine[3] * d_theta_ddot[3]
      - theta_ddot[3] * sine[3] * d_theta[3] - theta_dot[3] * (T(2) * sine[3] * d_theta_dot[3]
      + theta_dot[3] * cosine[3] * d_theta[3]));
  const D d_joint_side_acceleration_3 = d_span_side_acceleration_3 + d_joint_side_acceleration_2;
  const D d_span_side_acceleration_4 = d_length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]) + length[4] * (cosine[4] * d_theta_ddot[4]
      - theta_ddot[4] * sine[4] * d_theta[4] - theta_dot[4] * (T(2) * sine[4] * d_theta_dot[4]
      + theta_dot[4] * cosine[4] * d_theta[4]));
  const D d_joint_side_acceleration_4 = d_span_side_acceleration_4 + d_joint_side_acceleration_3;
  const D d_cut_force_side_5 = load_mass * d_joint_side_acceleration_4
      + joint_side_acceleration_4 * d_load_mass;
  const D d_centre_side_acceleration_4 = ratio<T>(1, 2) * d_span_side_acceleration_4
      + d_joint_side_acceleration_3;
  const D d_centre_side_force_4 = mass[4] * d_centre_side_acceleration_4
      + centre_side_acceleration_4 * d_mass[4];
  const D d_cut_force_side_4 = d_cut_force_side_5 + d_centre_side_force_4;
  const D d_centre_side_acceleration_3 = ratio<T>(1, 2) * d_span_side_acceleration_3
      + d_joint_side_acceleration_2;
  const D d_centre_side_force_3 = mass[3] * d_centre_side_acceleration_3
      + centre_side_acceleration_3 * d_mass[3];
  const D d_cut_force_side_3 = d_cut_force_side_4 + d_centre_side_force_3;
  const D d_centre_side_acceleration_2 = d_span_side_acceleration_1
      + ratio<T>(1, 2) * d_span_side_acceleration_2;
  const D d_centre_side_force_2 = mass[2] * d_centre_side_acceleration_2
      + centre_side_acceleration_2 * d_mass[2];
  const D d_cut_force_side_2 = d_cut_force_side_3 + d_centre_side_force_2;
  const D d_centre_side_acceleration_1 = ratio<T>(1, 2) * d_span_side_acceleration_1;
  const D d_centre_side_force_1 = mass[1] * d_centre_side_acceleration_1
      + centre_side_acceleration_1 * d_mass[1];
  const D d_span_side_force_1 = d_cut_force_side_2 + ratio<T>(1, 2) * d_centre_side_force_1;
  const D d_joint_angle_3 = d_theta[3] - d_theta[2];
  const D d_joint_rate_3 = d_theta_dot[3] - d_theta_dot[2];
  const D d_joint_moment_3 = stiffness[3] * d_joint_angle_3 + damping[3] * d_joint_rate_3
      + joint_angle_3 * d_stiffness[3] + joint_rate_3 * d_damping[3];
  const D d_span_down_force_2 = d_cut_force_down_3 + ratio<T>(1, 2) * d_centre_down_force_2;
  const D d_span_side_force_2 = d_cut_force_side_3 + ratio<T>(1, 2) * d_centre_side_force_2;
  const D d_joint_angle_4 = d_theta[4] - d_theta[3];
  const D d_joint_rate_4 = d_theta_dot[4] - d_theta_dot[3];
  const D d_joint_moment_4 = stiffness[4] * d_joint_angle_4 + damping[4] * d_joint_rate_4
      + joint_angle_4 * d_stiffness[4] + joint_rate_4 * d_damping[4];
  const D d_span_down_force_3 = d_cut_force_down_4 + ratio<T>(1, 2) * d_centre_down_force_3;
  const D d_span_side_force_3 = d_cut_force_side_4 + ratio<T>(1, 2) * d_centre_side_force_3;
  const D d_span_down_force_4 = d_cut_force_down_5 + ratio<T>(1, 2) * d_centre_down_force_4;
  const D d_span_side_force_4 = d_cut_force_side_5 + ratio<T>(1, 2) * d_centre_side_force_4;
  dr[0] = inertia[1] * d_theta_ddot[1] + theta_ddot[1] * d_inertia[1] - d_torque[1]
      + d_joint_moment_1 - d_joint_moment_2 + d_length[1] * (cosine[1] * span_side_force_1
      - sine[1] * span_down_force_1) + length[1] * (cosine[1] * (d_span_side_force_1
      - span_down_force_1 * d_theta[1]) - sine[1] * (span_side_force_1 * d_theta[1]
      + d_span_down_force_1));
  dr[1] = inertia[2] * d_theta_ddot[2] + theta_ddot[2] * d_inertia[2] - d_torque[2]
      + d_joint_moment_2 - d_joint_moment_3 + d_length[2] * (cosine[2] * span_side_force_2
      - sine[2] * span_down_force_2) + length[2] * (cosine[2] * (d_span_side_force_2
      - span_down_force_2 * d_theta[2]) - sine[2] * (span_side_force_2 * d_theta[2]
      + d_span_down_force_2));
  dr[2] = inertia[3] * d_theta_ddot[3] + theta_ddot[3] * d_inertia[3] - d_torque[3]
      + d_joint_moment_3 - d_joint_moment_4 + d_length[3] * (cosine[3] * span_side_force_3
      - sine[3] * span_down_force_3) + length[3] * (cosine[3] * (d_span_side_force_3
      - span_down_force_3 * d_theta[3]) - sine[3] * (span_side_force_3 * d_theta[3]
      + d_span_down_force_3));
  dr[3] = inertia[4] * d_theta_ddot[4] + theta_ddot[4] * d_inertia[4] - d_torque[4]
      + d_joint_moment_4 + d_length[4] * (cosine[4] * span_side_force_4
      - sine[4] * span_down_force_4) + length[4] * (cosine[4] * (d_span_side_force_4
      - span_down_force_4 * d_theta[4]) - sine[4] * (span_side_force_4 * d_theta[4]
      + d_span_down_force_4));
}

/// The term inertia of r alone.
/// 34 additions, 58 multiplications, 0 divisions, 0 functions
template <class T>
void term_inertia(const Point<T>& at, T* r) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const T load_mass = at.p[24];
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_down_acceleration_inertial_1 = -length[1] * theta_ddot[1] * sine[1];
  const T span_down_acceleration_inertial_2 = -length[2] * theta_ddot[2] * sine[2];
  const T joint_down_acceleration_inertial_2 = span_down_acceleration_inertial_1
      + span_down_acceleration_inertial_2;
  const T span_down_acceleration_inertial_3 = -length[3] * theta_ddot[3] * sine[3];
  const T joint_down_acceleration_inertial_3 = span_down_acceleration_inertial_3
      + joint_down_acceleration_inertial_2;
  const T span_down_acceleration_inertial_4 = -length[4] * theta_ddot[4] * sine[4];
  const T joint_down_acceleration_inertial_4 = span_down_acceleration_inertial_4
      + joint_down_acceleration_inertial_3;
  const T cut_force_down_inertial_5 = load_mass * joint_down_acceleration_inertial_4;
  const T centre_down_acceleration_inertial_4 = ratio<T>(1, 2)
      * span_down_acceleration_inertial_4 + joint_down_acceleration_inertial_3;
  const T centre_down_force_inertial_4 = mass[4] * centre_down_acceleration_inertial_4;
  const T cut_force_down_inertial_4 = cut_force_down_inertial_5 + centre_down_force_inertial_4;
  const T centre_down_acceleration_inertial_3 = ratio<T>(1, 2)
      * span_down_acceleration_inertial_3 + joint_down_acceleration_inertial_2;
  const T centre_down_force_inertial_3 = mass[3] * centre_down_acceleration_inertial_3;
  const T cut_force_down_inertial_3 = cut_force_down_inertial_4 + centre_down_force_inertial_3;
  const T centre_down_acceleration_inertial_2 = span_down_acceleration_inertial_1
      + ratio<T>(1, 2) * span_down_acceleration_inertial_2;
  const T centre_down_force_inertial_2 = mass[2] * centre_down_acceleration_inertial_2;
  const T cut_force_down_inertial_2 = cut_force_down_inertial_3 + centre_down_force_inertial_2;
  const T centre_down_acceleration_inertial_1 = ratio<T>(1, 2) * span_down_acceleration_inertial_1;
  const T centre_down_force_inertial_1 = mass[1] * centre_down_acceleration_inertial_1;
  const T span_down_force_inertial_1 = cut_force_down_inertial_2
      + ratio<T>(1, 2) * centre_down_force_inertial_1;
  const T span_side_acceleration_inertial_1 = length[1] * theta_ddot[1] * cosine[1];
  const T span_side_acceleration_inertial_2 = length[2] * theta_ddot[2] * cosine[2];
  const T joint_side_acceleration_inertial_2 = span_side_acceleration_inertial_1
      + span_side_acceleration_inertial_2;
  const T span_side_acceleration_inertial_3 = length[3] * theta_ddot[3] * cosine[3];
  const T joint_side_acceleration_inertial_3 = span_side_acceleration_inertial_3
      + joint_side_acceleration_inertial_2;
  const T span_side_acceleration_inertial_4 = length[4] * theta_ddot[4] * cosine[4];
  const T joint_side_acceleration_inertial_4 = span_side_acceleration_inertial_4
      + joint_side_acceleration_inertial_3;
  const T cut_force_side_inertial_5 = load_mass * joint_side_acceleration_inertial_4;
  const T centre_side_acceleration_inertial_4 = ratio<T>(1, 2)
      * span_side_acceleration_inertial_4 + joint_side_acceleration_inertial_3;
  const T centre_side_force_inertial_4 = mass[4] * centre_side_acceleration_inertial_4;
  const T cut_force_side_inertial_4 = cut_force_side_inertial_5 + centre_side_force_inertial_4;
  const T centre_side_acceleration_inertial_3 = ratio<T>(1, 2)
      * span_side_acceleration_inertial_3 + joint_side_acceleration_inertial_2;
  const T centre_side_force_inertial_3 = mass[3] * centre_side_acceleration_inertial_3;
  const T cut_force_side_inertial_3 = cut_force_side_inertial_4 + centre_side_force_inertial_3;
  const T centre_side_acceleration_inertial_2 = span_side_acceleration_inertial_1
      + ratio<T>(1, 2) * span_side_acceleration_inertial_2;
  const T centre_side_force_inertial_2 = mass[2] * centre_side_acceleration_inertial_2;
  const T cut_force_side_inertial_2 = cut_force_side_inertial_3 + centre_side_force_inertial_2;
  const T centre_side_acceleration_inertial_1 = ratio<T>(1, 2) * span_side_acceleration_inertial_1;
  const T centre_side_force_inertial_1 = mass[1] * centre_side_acceleration_inertial_1;
  const T span_side_force_inertial_1 = cut_force_side_inertial_2
      + ratio<T>(1, 2) * centre_side_force_inertial_1;
  const T span_down_force_inertial_2 = cut_force_down_inertial_3
      + ratio<T>(1, 2) * centre_down_force_inertial_2;
  const T span_side_force_inertial_2 = cut_force_side_inertial_3
      + ratio<T>(1, 2) * centre_side_force_inertial_2;
  const T span_down_force_inertial_3 = cut_force_down_inertial_4
      + ratio<T>(1, 2) * centre_down_force_inertial_3;
  const T span_side_force_inertial_3 = cut_force_side_inertial_4
      + ratio<T>(1, 2) * centre_side_force_inertial_3;
  const T span_down_force_inertial_4 = cut_force_down_inertial_5
      + ratio<T>(1, 2) * centre_down_force_inertial_4;
  const T span_side_force_inertial_4 = cut_force_side_inertial_5
      + ratio<T>(1, 2) * centre_side_force_inertial_4;
  r[0] = inertia[1] * theta_ddot[1] + length[1] * (cosine[1] * span_side_force_inertial_1
      - sine[1] * span_down_force_inertial_1);
  r[1] = inertia[2] * theta_ddot[2] + length[2] * (cosine[2] * span_side_force_inertial_2
      - sine[2] * span_down_force_inertial_2);
  r[2] = inertia[3] * theta_ddot[3] + length[3] * (cosine[3] * span_side_force_inertial_3
      - sine[3] * span_down_force_inertial_3);
  r[3] = inertia[4] * theta_ddot[4] + length[4] * (cosine[4] * span_side_force_inertial_4
      - sine[4] * span_down_force_inertial_4);
}

/// The term coriolis of r alone.
/// 30 additions, 62 multiplications, 0 divisions, 0 functions
template <class T>
void term_coriolis(const Point<T>& at, T* r) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const T load_mass = at.p[24];
  const FromOne<T> theta_dot(at.v);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_down_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
  const T span_down_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * cosine[2];
  const T joint_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + span_down_acceleration_bias_2;
  const T span_down_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * cosine[3];
  const T joint_down_acceleration_bias_3 = span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T span_down_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * cosine[4];
  const T joint_down_acceleration_bias_4 = span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T cut_force_down_bias_5 = load_mass * joint_down_acceleration_bias_4;
  const T centre_down_acceleration_bias_4 = ratio<T>(1, 2) * span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T centre_down_force_bias_4 = mass[4] * centre_down_acceleration_bias_4;
  const T cut_force_down_bias_4 = cut_force_down_bias_5 + centre_down_force_bias_4;
  const T centre_down_acceleration_bias_3 = ratio<T>(1, 2) * span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T centre_down_force_bias_3 = mass[3] * centre_down_acceleration_bias_3;
  const T cut_force_down_bias_3 = cut_force_down_bias_4 + centre_down_force_bias_3;
  const T centre_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + ratio<T>(1, 2) * span_down_acceleration_bias_2;
  const T centre_down_force_bias_2 = mass[2] * centre_down_acceleration_bias_2;
  const T cut_force_down_bias_2 = cut_force_down_bias_3 + centre_down_force_bias_2;
  const T centre_down_acceleration_bias_1 = ratio<T>(1, 2) * span_down_acceleration_bias_1;
  const T centre_down_force_bias_1 = mass[1] * centre_down_acceleration_bias_1;
  const T span_down_force_bias_1 = cut_force_down_bias_2
      + ratio<T>(1, 2) * centre_down_force_bias_1;
  const T span_side_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
  const T span_side_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * sine[2];
  const T joint_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + span_side_acceleration_bias_2;
  const T span_side_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * sine[3];
  const T joint_side_acceleration_bias_3 = span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T span_side_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * sine[4];
  const T joint_side_acceleration_bias_4 = span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T cut_force_side_bias_5 = load_mass * joint_side_acceleration_bias_4;
  const T centre_side_acceleration_bias_4 = ratio<T>(1, 2) * span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T centre_side_force_bias_4 = mass[4] * centre_side_acceleration_bias_4;
  const T cut_force_side_bias_4 = cut_force_side_bias_5 + centre_side_force_bias_4;
  const T centre_side_acceleration_bias_3 = ratio<T>(1, 2) * span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T centre_side_force_bias_3 = mass[3] * centre_side_acceleration_bias_3;
  const T cut_force_side_bias_3 = cut_force_side_bias_4 + centre_side_force_bias_3;
  const T centre_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + ratio<T>(1, 2) * span_side_acceleration_bias_2;
  const T centre_side_force_bias_2 = mass[2] * centre_side_acceleration_bias_2;
  const T cut_force_side_bias_2 = cut_force_side_bias_3 + centre_side_force_bias_2;
  const T centre_side_acceleration_bias_1 = ratio<T>(1, 2) * span_side_acceleration_bias_1;
  const T centre_side_force_bias_1 = mass[1] * centre_side_acceleration_bias_1;
  const T span_side_force_bias_1 = cut_force_side_bias_2
      + ratio<T>(1, 2) * centre_side_force_bias_1;
  const T span_down_force_bias_2 = cut_force_down_bias_3
      + ratio<T>(1, 2) * centre_down_force_bias_2;
  const T span_side_force_bias_2 = cut_force_side_bias_3
      + ratio<T>(1, 2) * centre_side_force_bias_2;
  const T span_down_force_bias_3 = cut_force_down_bias_4
      + ratio<T>(1, 2) * centre_down_force_bias_3;
  const T span_side_force_bias_3 = cut_force_side_bias_4
      + ratio<T>(1, 2) * centre_side_force_bias_3;
  const T span_down_force_bias_4 = cut_force_down_bias_5
      + ratio<T>(1, 2) * centre_down_force_bias_4;
  const T span_side_force_bias_4 = cut_force_side_bias_5
      + ratio<T>(1, 2) * centre_side_force_bias_4;
  r[0] = length[1] * (cosine[1] * span_side_force_bias_1 - sine[1] * span_down_force_bias_1);
  r[1] = length[2] * (cosine[2] * span_side_force_bias_2 - sine[2] * span_down_force_bias_2);
  r[2] = length[3] * (cosine[3] * span_side_force_bias_3 - sine[3] * span_down_force_bias_3);
  r[3] = length[4] * (cosine[4] * span_side_force_bias_4 - sine[4] * span_down_force_bias_4);
}

/// The term gravity of r alone.
/// 7 additions, 17 multiplications, 0 divisions, 0 functions
template <class T>
void term_gravity(const Point<T>& at, T* r) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T cut_force_down_5 = -load_mass * gravity;
  const T centre_down_force_4 = -mass[4] * gravity;
  const T span_down_force_4 = cut_force_down_5 + ratio<T>(1, 2) * centre_down_force_4;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T centre_down_force_3 = -mass[3] * gravity;
  const T span_down_force_3 = cut_force_down_4 + ratio<T>(1, 2) * centre_down_force_3;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T centre_down_force_2 = -mass[2] * gravity;
  const T span_down_force_2 = cut_force_down_3 + ratio<T>(1, 2) * centre_down_force_2;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T centre_down_force_1 = -mass[1] * gravity;
  const T span_down_force_1 = cut_force_down_2 + ratio<T>(1, 2) * centre_down_force_1;
  r[0] = -length[1] * sine[1] * span_down_force_1;
  r[1] = -length[2] * sine[2] * span_down_force_2;
  r[2] = -length[3] * sine[3] * span_down_force_3;
  r[3] = -length[4] * sine[4] * span_down_force_4;
}

/// The term elastic of r alone.
/// 6 additions, 4 multiplications, 0 divisions, 0 functions
template <class T>
void term_elastic(const Point<T>& at, T* r) {
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> theta(at.q);
  const T joint_angle_1 = theta[1];
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_moment_4 = stiffness[4] * joint_angle_4;
  const T joint_moment_3 = stiffness[3] * joint_angle_3;
  const T joint_moment_2 = stiffness[2] * joint_angle_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1;
  r[0] = joint_moment_1 - joint_moment_2;
  r[1] = joint_moment_2 - joint_moment_3;
  r[2] = joint_moment_3 - joint_moment_4;
  r[3] = joint_moment_4;
}

/// The term friction of r alone.
/// 6 additions, 4 multiplications, 0 divisions, 0 functions
template <class T>
void term_friction(const Point<T>& at, T* r) {
  const FromOne<T> damping(at.p + 16);
  const FromOne<T> theta_dot(at.v);
  const T joint_rate_1 = theta_dot[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T joint_moment_4 = damping[4] * joint_rate_4;
  const T joint_moment_3 = damping[3] * joint_rate_3;
  const T joint_moment_2 = damping[2] * joint_rate_2;
  const T joint_moment_1 = damping[1] * joint_rate_1;
  r[0] = joint_moment_1 - joint_moment_2;
  r[1] = joint_moment_2 - joint_moment_3;
  r[2] = joint_moment_3 - joint_moment_4;
  r[3] = joint_moment_4;
}

/// The term torque of r alone.
/// 0 additions, 0 multiplications, 0 divisions, 0 functions
template <class T>
void term_torque(const Point<T>& at, T* r) {
  const FromOne<T> torque(at.p + 20);
  r[0] = -torque[1];
  r[1] = -torque[2];
  r[2] = -torque[3];
  r[3] = -torque[4];
}

/// One term of r, numbered as in the table; their sum is r.
template <class T>
void residual_term(const Point<T>& at, int term, T* r) {
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
/// 56 additions, 70 multiplications, 0 divisions, 0 functions
template <class T>
void bias(const Point<T>& at, T* h) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const FromOne<T> torque(at.p + 20);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T joint_moment_4 = stiffness[4] * joint_angle_4 + damping[4] * joint_rate_4;
  const T joint_moment_3 = stiffness[3] * joint_angle_3 + damping[3] * joint_rate_3;
  const T joint_moment_2 = stiffness[2] * joint_angle_2 + damping[2] * joint_rate_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1 + damping[1] * joint_rate_1;
  const T span_down_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
  const T span_down_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * cosine[2];
  const T joint_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + span_down_acceleration_bias_2;
  const T span_down_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * cosine[3];
  const T joint_down_acceleration_bias_3 = span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T span_down_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * cosine[4];
  const T joint_down_acceleration_bias_4 = span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T cut_force_down_bias_5 = load_mass * (joint_down_acceleration_bias_4 - gravity);
  const T centre_down_acceleration_bias_4 = ratio<T>(1, 2) * span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T centre_down_force_bias_4 = mass[4] * (centre_down_acceleration_bias_4 - gravity);
  const T cut_force_down_bias_4 = cut_force_down_bias_5 + centre_down_force_bias_4;
  const T centre_down_acceleration_bias_3 = ratio<T>(1, 2) * span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T centre_down_force_bias_3 = mass[3] * (centre_down_acceleration_bias_3 - gravity);
  const T cut_force_down_bias_3 = cut_force_down_bias_4 + centre_down_force_bias_3;
  const T centre_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + ratio<T>(1, 2) * span_down_acceleration_bias_2;
  const T centre_down_force_bias_2 = mass[2] * (centre_down_acceleration_bias_2 - gravity);
  const T cut_force_down_bias_2 = cut_force_down_bias_3 + centre_down_force_bias_2;
  const T centre_down_acceleration_bias_1 = ratio<T>(1, 2) * span_down_acceleration_bias_1;
  const T centre_down_force_bias_1 = mass[1] * (centre_down_acceleration_bias_1 - gravity);
  const T span_down_force_bias_1 = cut_force_down_bias_2
      + ratio<T>(1, 2) * centre_down_force_bias_1;
  const T span_side_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
  const T span_side_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * sine[2];
  const T joint_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + span_side_acceleration_bias_2;
  const T span_side_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * sine[3];
  const T joint_side_acceleration_bias_3 = span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T span_side_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * sine[4];
  const T joint_side_acceleration_bias_4 = span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T cut_force_side_bias_5 = load_mass * joint_side_acceleration_bias_4;
  const T centre_side_acceleration_bias_4 = ratio<T>(1, 2) * span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T centre_side_force_bias_4 = mass[4] * centre_side_acceleration_bias_4;
  const T cut_force_side_bias_4 = cut_force_side_bias_5 + centre_side_force_bias_4;
  const T centre_side_acceleration_bias_3 = ratio<T>(1, 2) * span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T centre_side_force_bias_3 = mass[3] * centre_side_acceleration_bias_3;
  const T cut_force_side_bias_3 = cut_force_side_bias_4 + centre_side_force_bias_3;
  const T centre_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + ratio<T>(1, 2) * span_side_acceleration_bias_2;
  const T centre_side_force_bias_2 = mass[2] * centre_side_acceleration_bias_2;
  const T cut_force_side_bias_2 = cut_force_side_bias_3 + centre_side_force_bias_2;
  const T centre_side_acceleration_bias_1 = ratio<T>(1, 2) * span_side_acceleration_bias_1;
  const T centre_side_force_bias_1 = mass[1] * centre_side_acceleration_bias_1;
  const T span_side_force_bias_1 = cut_force_side_bias_2
      + ratio<T>(1, 2) * centre_side_force_bias_1;
  const T span_down_force_bias_2 = cut_force_down_bias_3
      + ratio<T>(1, 2) * centre_down_force_bias_2;
  const T span_side_force_bias_2 = cut_force_side_bias_3
      + ratio<T>(1, 2) * centre_side_force_bias_2;
  const T span_down_force_bias_3 = cut_force_down_bias_4
      + ratio<T>(1, 2) * centre_down_force_bias_3;
  const T span_side_force_bias_3 = cut_force_side_bias_4
      + ratio<T>(1, 2) * centre_side_force_bias_3;
  const T span_down_force_bias_4 = cut_force_down_bias_5
      + ratio<T>(1, 2) * centre_down_force_bias_4;
  const T span_side_force_bias_4 = cut_force_side_bias_5
      + ratio<T>(1, 2) * centre_side_force_bias_4;
  h[0] = joint_moment_1 - torque[1] - joint_moment_2
      + length[1] * (cosine[1] * span_side_force_bias_1 - sine[1] * span_down_force_bias_1);
  h[1] = joint_moment_2 - torque[2] - joint_moment_3
      + length[2] * (cosine[2] * span_side_force_bias_2 - sine[2] * span_down_force_bias_2);
  h[2] = joint_moment_3 - torque[3] - joint_moment_4
      + length[3] * (cosine[3] * span_side_force_bias_3 - sine[3] * span_down_force_bias_3);
  h[3] = joint_moment_4 - torque[4] + length[4] * (cosine[4] * span_side_force_bias_4
      - sine[4] * span_down_force_bias_4);
}

/// M, row by row.
/// 17 additions, 42 multiplications, 0 divisions, 0 functions
template <class T>
void mass_matrix(const Point<T>& at, T* M) {
  MassMatrix<T> matrix;
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const T load_mass = at.p[24];
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T mass_joint_down_acceleration_gain_1 = -length[1] * sine[1];
  const T mass_joint_side_acceleration_gain_1 = length[1] * cosine[1];
  const T mass_joint_down_acceleration_gain_2 = -length[2] * sine[2];
  const T mass_joint_side_acceleration_gain_2 = length[2] * cosine[2];
  const T mass_joint_down_acceleration_gain_3 = -length[3] * sine[3];
  const T mass_joint_side_acceleration_gain_3 = length[3] * cosine[3];
  const T mass_joint_down_acceleration_gain_4 = -length[4] * sine[4];
  const T mass_joint_side_acceleration_gain_4 = length[4] * cosine[4];
  const T mass_cut_force_down_per_joint_down_acceleration_4 = mass[4] + load_mass;
  const T mass_cut_force_down_per_joint_down_acceleration_3 = mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4;
  const T mass_cut_force_down_per_joint_down_acceleration_2 = mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3;
  matrix.row[0][0] = -length[1] * sine[1] * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.row[1][0] = length[1] * cosine[1] * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.row[0][1] = -length[2] * sine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.row[1][1] = length[2] * cosine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.row[0][2] = -length[3] * sine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.row[1][2] = length[3] * cosine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.row[0][3] = -length[4] * sine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.row[1][3] = length[4] * cosine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.column[0][0] = mass_joint_down_acceleration_gain_1;
  matrix.column[1][0] = mass_joint_side_acceleration_gain_1;
  matrix.column[0][1] = mass_joint_down_acceleration_gain_2;
  matrix.column[1][1] = mass_joint_side_acceleration_gain_2;
  matrix.column[0][2] = mass_joint_down_acceleration_gain_3;
  matrix.column[1][2] = mass_joint_side_acceleration_gain_3;
  matrix.column[0][3] = mass_joint_down_acceleration_gain_4;
  matrix.column[1][3] = mass_joint_side_acceleration_gain_4;
  matrix.diagonal[0] = inertia[1] + length[1] * length[1] * (ratio<T>(1, 4) * mass[1]
      + mass_cut_force_down_per_joint_down_acceleration_2);
  matrix.diagonal[1] = inertia[2] + length[2] * length[2] * (ratio<T>(1, 4) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.diagonal[2] = inertia[3] + length[3] * length[3] * (ratio<T>(1, 4) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.diagonal[3] = inertia[4] + length[4] * length[4] * (ratio<T>(1, 4) * mass[4] + load_mass);
  matrix.to_dense(M);
}

/// a such that r = 0. Returns 0, or the 1-based coordinate whose pivot is not positive.
/// 73 additions, 112 multiplications, 0 divisions, 0 functions
template <class T>
int acceleration(const Point<T>& at, T* a) {
  MassMatrix<T> matrix;
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const FromOne<T> torque(at.p + 20);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T joint_moment_4 = stiffness[4] * joint_angle_4 + damping[4] * joint_rate_4;
  const T joint_moment_3 = stiffness[3] * joint_angle_3 + damping[3] * joint_rate_3;
  const T joint_moment_2 = stiffness[2] * joint_angle_2 + damping[2] * joint_rate_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1 + damping[1] * joint_rate_1;
  const T span_down_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * cosine[1];
  const T span_down_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * cosine[2];
  const T joint_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + span_down_acceleration_bias_2;
  const T span_down_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * cosine[3];
  const T joint_down_acceleration_bias_3 = span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T span_down_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * cosine[4];
  const T joint_down_acceleration_bias_4 = span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T cut_force_down_bias_5 = load_mass * (joint_down_acceleration_bias_4 - gravity);
  const T centre_down_acceleration_bias_4 = ratio<T>(1, 2) * span_down_acceleration_bias_4
      + joint_down_acceleration_bias_3;
  const T centre_down_force_bias_4 = mass[4] * (centre_down_acceleration_bias_4 - gravity);
  const T cut_force_down_bias_4 = cut_force_down_bias_5 + centre_down_force_bias_4;
  const T centre_down_acceleration_bias_3 = ratio<T>(1, 2) * span_down_acceleration_bias_3
      + joint_down_acceleration_bias_2;
  const T centre_down_force_bias_3 = mass[3] * (centre_down_acceleration_bias_3 - gravity);
  const T cut_force_down_bias_3 = cut_force_down_bias_4 + centre_down_force_bias_3;
  const T centre_down_acceleration_bias_2 = span_down_acceleration_bias_1
      + ratio<T>(1, 2) * span_down_acceleration_bias_2;
  const T centre_down_force_bias_2 = mass[2] * (centre_down_acceleration_bias_2 - gravity);
  const T cut_force_down_bias_2 = cut_force_down_bias_3 + centre_down_force_bias_2;
  const T centre_down_acceleration_bias_1 = ratio<T>(1, 2) * span_down_acceleration_bias_1;
  const T centre_down_force_bias_1 = mass[1] * (centre_down_acceleration_bias_1 - gravity);
  const T span_down_force_bias_1 = cut_force_down_bias_2
      + ratio<T>(1, 2) * centre_down_force_bias_1;
  const T span_side_acceleration_bias_1 = -length[1] * theta_dot[1] * theta_dot[1] * sine[1];
  const T span_side_acceleration_bias_2 = -length[2] * theta_dot[2] * theta_dot[2] * sine[2];
  const T joint_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + span_side_acceleration_bias_2;
  const T span_side_acceleration_bias_3 = -length[3] * theta_dot[3] * theta_dot[3] * sine[3];
  const T joint_side_acceleration_bias_3 = span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T span_side_acceleration_bias_4 = -length[4] * theta_dot[4] * theta_dot[4] * sine[4];
  const T joint_side_acceleration_bias_4 = span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T cut_force_side_bias_5 = load_mass * joint_side_acceleration_bias_4;
  const T centre_side_acceleration_bias_4 = ratio<T>(1, 2) * span_side_acceleration_bias_4
      + joint_side_acceleration_bias_3;
  const T centre_side_force_bias_4 = mass[4] * centre_side_acceleration_bias_4;
  const T cut_force_side_bias_4 = cut_force_side_bias_5 + centre_side_force_bias_4;
  const T centre_side_acceleration_bias_3 = ratio<T>(1, 2) * span_side_acceleration_bias_3
      + joint_side_acceleration_bias_2;
  const T centre_side_force_bias_3 = mass[3] * centre_side_acceleration_bias_3;
  const T cut_force_side_bias_3 = cut_force_side_bias_4 + centre_side_force_bias_3;
  const T centre_side_acceleration_bias_2 = span_side_acceleration_bias_1
      + ratio<T>(1, 2) * span_side_acceleration_bias_2;
  const T centre_side_force_bias_2 = mass[2] * centre_side_acceleration_bias_2;
  const T cut_force_side_bias_2 = cut_force_side_bias_3 + centre_side_force_bias_2;
  const T centre_side_acceleration_bias_1 = ratio<T>(1, 2) * span_side_acceleration_bias_1;
  const T centre_side_force_bias_1 = mass[1] * centre_side_acceleration_bias_1;
  const T span_side_force_bias_1 = cut_force_side_bias_2
      + ratio<T>(1, 2) * centre_side_force_bias_1;
  const T span_down_force_bias_2 = cut_force_down_bias_3
      + ratio<T>(1, 2) * centre_down_force_bias_2;
  const T span_side_force_bias_2 = cut_force_side_bias_3
      + ratio<T>(1, 2) * centre_side_force_bias_2;
  const T span_down_force_bias_3 = cut_force_down_bias_4
      + ratio<T>(1, 2) * centre_down_force_bias_3;
  const T span_side_force_bias_3 = cut_force_side_bias_4
      + ratio<T>(1, 2) * centre_side_force_bias_3;
  const T span_down_force_bias_4 = cut_force_down_bias_5
      + ratio<T>(1, 2) * centre_down_force_bias_4;
  const T span_side_force_bias_4 = cut_force_side_bias_5
      + ratio<T>(1, 2) * centre_side_force_bias_4;
  const T mass_joint_down_acceleration_gain_1 = -length[1] * sine[1];
  const T mass_joint_side_acceleration_gain_1 = length[1] * cosine[1];
  const T mass_joint_down_acceleration_gain_2 = -length[2] * sine[2];
  const T mass_joint_side_acceleration_gain_2 = length[2] * cosine[2];
  const T mass_joint_down_acceleration_gain_3 = -length[3] * sine[3];
  const T mass_joint_side_acceleration_gain_3 = length[3] * cosine[3];
  const T mass_joint_down_acceleration_gain_4 = -length[4] * sine[4];
  const T mass_joint_side_acceleration_gain_4 = length[4] * cosine[4];
  const T mass_cut_force_down_per_joint_down_acceleration_4 = mass[4] + load_mass;
  const T mass_cut_force_down_per_joint_down_acceleration_3 = mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4;
  const T mass_cut_force_down_per_joint_down_acceleration_2 = mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3;
  matrix.row[0][0] = -length[1] * sine[1] * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.row[1][0] = length[1] * cosine[1] * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.row[0][1] = -length[2] * sine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.row[1][1] = length[2] * cosine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.row[0][2] = -length[3] * sine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.row[1][2] = length[3] * cosine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.row[0][3] = -length[4] * sine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.row[1][3] = length[4] * cosine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.column[0][0] = mass_joint_down_acceleration_gain_1;
  matrix.column[1][0] = mass_joint_side_acceleration_gain_1;
  matrix.column[0][1] = mass_joint_down_acceleration_gain_2;
  matrix.column[1][1] = mass_joint_side_acceleration_gain_2;
  matrix.column[0][2] = mass_joint_down_acceleration_gain_3;
  matrix.column[1][2] = mass_joint_side_acceleration_gain_3;
  matrix.column[0][3] = mass_joint_down_acceleration_gain_4;
  matrix.column[1][3] = mass_joint_side_acceleration_gain_4;
  matrix.diagonal[0] = inertia[1] + length[1] * length[1] * (ratio<T>(1, 4) * mass[1]
      + mass_cut_force_down_per_joint_down_acceleration_2);
  matrix.diagonal[1] = inertia[2] + length[2] * length[2] * (ratio<T>(1, 4) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.diagonal[2] = inertia[3] + length[3] * length[3] * (ratio<T>(1, 4) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.diagonal[3] = inertia[4] + length[4] * length[4] * (ratio<T>(1, 4) * mass[4] + load_mass);
  a[0] = torque[1] - joint_moment_1 + joint_moment_2
      + length[1] * (sine[1] * span_down_force_bias_1 - cosine[1] * span_side_force_bias_1);
  a[1] = torque[2] - joint_moment_2 + joint_moment_3
      + length[2] * (sine[2] * span_down_force_bias_2 - cosine[2] * span_side_force_bias_2);
  a[2] = torque[3] - joint_moment_3 + joint_moment_4
      + length[3] * (sine[3] * span_down_force_bias_3 - cosine[3] * span_side_force_bias_3);
  a[3] = torque[4] - joint_moment_4 + length[4] * (sine[4] * span_down_force_bias_4
      - cosine[4] * span_side_force_bias_4);
  return matrix.solve(a);
}

/// ca dr/da + cv dr/dv + cq dr/dq at the point (at.a is read).
/// 146 additions, 320 multiplications, 0 divisions, 0 functions
template <class T>
void newton_matrix(const Point<T>& at, const T& ca, const T& cv, const T& cq,
                   NewtonMatrix<T>& matrix) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T span_down_force_4 = cut_force_down_5 + ratio<T>(1, 2) * centre_down_force_4;
  const T span_side_force_4 = cut_force_side_5 + ratio<T>(1, 2) * centre_side_force_4;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T span_down_force_3 = cut_force_down_4 + ratio<T>(1, 2) * centre_down_force_3;
  const T span_side_force_3 = cut_force_side_4 + ratio<T>(1, 2) * centre_side_force_3;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T span_down_force_2 = cut_force_down_3 + ratio<T>(1, 2) * centre_down_force_2;
  const T span_side_force_2 = cut_force_side_3 + ratio<T>(1, 2) * centre_side_force_2;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T span_down_force_1 = cut_force_down_2 + ratio<T>(1, 2) * centre_down_force_1;
  const T span_side_force_1 = cut_force_side_2 + ratio<T>(1, 2) * centre_side_force_1;
  const T mass_cut_force_down_per_joint_down_acceleration_4 = mass[4] + load_mass;
  const T mass_cut_force_down_per_joint_down_acceleration_3 = mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4;
  const T mass_cut_force_down_per_joint_down_acceleration_2 = mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3;
  const T newton_joint_down_acceleration_gain_1 = length[1] * (theta_dot[1] * (theta_dot[1]
      * sine[1] * cq - T(2) * cosine[1] * cv) - (theta_ddot[1] * cosine[1] * cq + sine[1] * ca));
  const T newton_joint_side_acceleration_gain_1 = length[1] * (cosine[1] * ca
      - theta_ddot[1] * sine[1] * cq - theta_dot[1] * (T(2) * sine[1] * cv
      + theta_dot[1] * cosine[1] * cq));
  const T newton_joint_down_acceleration_gain_2 = length[2] * (theta_dot[2] * (theta_dot[2]
      * sine[2] * cq - T(2) * cosine[2] * cv) - (theta_ddot[2] * cosine[2] * cq + sine[2] * ca));
  const T newton_joint_side_acceleration_gain_2 = length[2] * (cosine[2] * ca
      - theta_ddot[2] * sine[2] * cq - theta_dot[2] * (T(2) * sine[2] * cv
      + theta_dot[2] * cosine[2] * cq));
  const T newton_joint_down_acceleration_gain_3 = length[3] * (theta_dot[3] * (theta_dot[3]
      * sine[3] * cq - T(2) * cosine[3] * cv) - (theta_ddot[3] * cosine[3] * cq + sine[3] * ca));
  const T newton_joint_side_acceleration_gain_3 = length[3] * (cosine[3] * ca
      - theta_ddot[3] * sine[3] * cq - theta_dot[3] * (T(2) * sine[3] * cv
      + theta_dot[3] * cosine[3] * cq));
  const T newton_joint_down_acceleration_gain_4 = length[4] * (theta_dot[4] * (theta_dot[4]
      * sine[4] * cq - T(2) * cosine[4] * cv) - (theta_ddot[4] * cosine[4] * cq + sine[4] * ca));
  const T newton_joint_side_acceleration_gain_4 = length[4] * (cosine[4] * ca
      - theta_ddot[4] * sine[4] * cq - theta_dot[4] * (T(2) * sine[4] * cv
      + theta_dot[4] * cosine[4] * cq));
  matrix.upper_row[0][0] = -length[1] * sine[1];
  matrix.upper_row[1][0] = length[1] * cosine[1];
  matrix.upper_row[0][1] = -length[2] * sine[2];
  matrix.upper_row[1][1] = length[2] * cosine[2];
  matrix.upper_row[0][2] = -length[3] * sine[3];
  matrix.upper_row[1][2] = length[3] * cosine[3];
  matrix.upper_row[0][3] = T(0);
  matrix.upper_row[1][3] = T(0);
  matrix.upper_column[0][0] = mass_cut_force_down_per_joint_down_acceleration_2
      * newton_joint_down_acceleration_gain_1;
  matrix.upper_column[1][0] = mass_cut_force_down_per_joint_down_acceleration_2
      * newton_joint_side_acceleration_gain_1;
  matrix.upper_column[0][1] = mass_cut_force_down_per_joint_down_acceleration_3
      * newton_joint_down_acceleration_gain_2
      + length[2] * mass[2] * (theta_dot[2] * (ratio<T>(1, 2) * theta_dot[2] * sine[2] * cq
      - cosine[2] * cv) - ratio<T>(1, 2) * (theta_ddot[2] * cosine[2] * cq + sine[2] * ca));
  matrix.upper_column[1][1] = mass_cut_force_down_per_joint_down_acceleration_3
      * newton_joint_side_acceleration_gain_2
      + length[2] * mass[2] * (ratio<T>(1, 2) * (cosine[2] * ca - theta_ddot[2] * sine[2] * cq)
      - theta_dot[2] * (sine[2] * cv + ratio<T>(1, 2) * theta_dot[2] * cosine[2] * cq));
  matrix.upper_column[0][2] = mass_cut_force_down_per_joint_down_acceleration_4
      * newton_joint_down_acceleration_gain_3
      + length[3] * mass[3] * (theta_dot[3] * (ratio<T>(1, 2) * theta_dot[3] * sine[3] * cq
      - cosine[3] * cv) - ratio<T>(1, 2) * (theta_ddot[3] * cosine[3] * cq + sine[3] * ca));
  matrix.upper_column[1][2] = mass_cut_force_down_per_joint_down_acceleration_4
      * newton_joint_side_acceleration_gain_3
      + length[3] * mass[3] * (ratio<T>(1, 2) * (cosine[3] * ca - theta_ddot[3] * sine[3] * cq)
      - theta_dot[3] * (sine[3] * cv + ratio<T>(1, 2) * theta_dot[3] * cosine[3] * cq));
  matrix.upper_column[0][3] = length[4] * (load_mass * (theta_dot[4] * (theta_dot[4] * sine[4]
      * cq - T(2) * cosine[4] * cv) - (theta_ddot[4] * cosine[4] * cq + sine[4] * ca))
      + mass[4] * (theta_dot[4] * (ratio<T>(1, 2) * theta_dot[4] * sine[4] * cq - cosine[4] * cv)
      - ratio<T>(1, 2) * (theta_ddot[4] * cosine[4] * cq + sine[4] * ca)));
  matrix.upper_column[1][3] = length[4] * (load_mass * (cosine[4] * ca
      - theta_ddot[4] * sine[4] * cq - theta_dot[4] * (T(2) * sine[4] * cv
      + theta_dot[4] * cosine[4] * cq)) + mass[4] * (ratio<T>(1, 2) * (cosine[4] * ca
      - theta_ddot[4] * sine[4] * cq) - theta_dot[4] * (sine[4] * cv
      + ratio<T>(1, 2) * theta_dot[4] * cosine[4] * cq)));
  matrix.lower_row[0][0] = -length[1] * sine[1] * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.lower_row[1][0] = length[1] * cosine[1]
      * mass_cut_force_down_per_joint_down_acceleration_2;
  matrix.lower_row[0][1] = -length[2] * sine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.lower_row[1][1] = length[2] * cosine[2] * (ratio<T>(1, 2) * mass[2]
      + mass_cut_force_down_per_joint_down_acceleration_3);
  matrix.lower_row[0][2] = -length[3] * sine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.lower_row[1][2] = length[3] * cosine[3] * (ratio<T>(1, 2) * mass[3]
      + mass_cut_force_down_per_joint_down_acceleration_4);
  matrix.lower_row[0][3] = -length[4] * sine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.lower_row[1][3] = length[4] * cosine[4] * (ratio<T>(1, 2) * mass[4] + load_mass);
  matrix.lower_column[0][0] = newton_joint_down_acceleration_gain_1;
  matrix.lower_column[1][0] = newton_joint_side_acceleration_gain_1;
  matrix.lower_column[0][1] = newton_joint_down_acceleration_gain_2;
  matrix.lower_column[1][1] = newton_joint_side_acceleration_gain_2;
  matrix.lower_column[0][2] = newton_joint_down_acceleration_gain_3;
  matrix.lower_column[1][2] = newton_joint_side_acceleration_gain_3;
  matrix.lower_column[0][3] = newton_joint_down_acceleration_gain_4;
  matrix.lower_column[1][3] = newton_joint_side_acceleration_gain_4;
  matrix.diagonal[0] = inertia[1] * ca + cq * (stiffness[1] + stiffness[2]) + cv * (damping[1]
      + damping[2]) + length[1] * (length[1] * (mass_cut_force_down_per_joint_down_acceleration_2
      * (ca - theta_dot[1] * theta_dot[1] * cq) + ratio<T>(1, 4) * mass[1] * (ca
      - theta_dot[1] * theta_dot[1] * cq)) - cq * (sine[1] * span_side_force_1
      + cosine[1] * span_down_force_1));
  matrix.diagonal[1] = inertia[2] * ca + cq * (stiffness[2] + stiffness[3]) + cv * (damping[2]
      + damping[3]) + length[2] * (length[2] * (mass_cut_force_down_per_joint_down_acceleration_3
      * (ca - theta_dot[2] * theta_dot[2] * cq) + ratio<T>(1, 4) * mass[2] * (ca
      - theta_dot[2] * theta_dot[2] * cq)) - cq * (sine[2] * span_side_force_2
      + cosine[2] * span_down_force_2));
  matrix.diagonal[2] = inertia[3] * ca + cq * (stiffness[3] + stiffness[4]) + cv * (damping[3]
      + damping[4]) + length[3] * (length[3] * (mass_cut_force_down_per_joint_down_acceleration_4
      * (ca - theta_dot[3] * theta_dot[3] * cq) + ratio<T>(1, 4) * mass[3] * (ca
      - theta_dot[3] * theta_dot[3] * cq)) - cq * (sine[3] * span_side_force_3
      + cosine[3] * span_down_force_3));
  matrix.diagonal[3] = inertia[4] * ca + stiffness[4] * cq + damping[4] * cv
      + length[4] * (length[4] * (load_mass * (ca - theta_dot[4] * theta_dot[4] * cq)
      + ratio<T>(1, 4) * mass[4] * (ca - theta_dot[4] * theta_dot[4] * cq))
      - cq * (sine[4] * span_side_force_4 + cosine[4] * span_down_force_4));
  matrix.below[0] = T(0);
  matrix.below[1] = -(stiffness[2] * cq + damping[2] * cv);
  matrix.below[2] = -(stiffness[3] * cq + damping[3] * cv);
  matrix.below[3] = -(stiffness[4] * cq + damping[4] * cv);
  matrix.above[0] = -(stiffness[2] * cq + damping[2] * cv);
  matrix.above[1] = -(stiffness[3] * cq + damping[3] * cv);
  matrix.above[2] = -(stiffness[4] * cq + damping[4] * cv);
  matrix.above[3] = T(0);
}

/// Energies (J) and powers (W), in the order of the table.
/// 63 additions, 101 multiplications, 0 divisions, 0 functions
template <class T>
void energy(const Point<T>& at, T* e) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> inertia(at.p + 8);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const FromOne<T> torque(at.p + 20);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T joint_down_0 = T(0);
  const T span_side_velocity_1 = length[1] * theta_dot[1] * cosine[1];
  const T span_down_1 = length[1] * cosine[1];
  const T span_down_velocity_1 = -length[1] * theta_dot[1] * sine[1];
  const T centre_side_velocity_1 = ratio<T>(1, 2) * span_side_velocity_1;
  const T centre_down_1 = joint_down_0 + ratio<T>(1, 2) * span_down_1;
  const T centre_down_velocity_1 = ratio<T>(1, 2) * span_down_velocity_1;
  const T joint_side_velocity_1 = span_side_velocity_1;
  const T joint_down_1 = joint_down_0 + span_down_1;
  const T joint_down_velocity_1 = span_down_velocity_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T arc_2 = length[1] + length[2];
  const T span_side_velocity_2 = length[2] * theta_dot[2] * cosine[2];
  const T span_down_2 = length[2] * cosine[2];
  const T span_down_velocity_2 = -length[2] * theta_dot[2] * sine[2];
  const T centre_side_velocity_2 = ratio<T>(1, 2) * span_side_velocity_2 + joint_side_velocity_1;
  const T centre_down_2 = joint_down_1 + ratio<T>(1, 2) * span_down_2;
  const T centre_down_velocity_2 = ratio<T>(1, 2) * span_down_velocity_2 + joint_down_velocity_1;
  const T joint_side_velocity_2 = span_side_velocity_2 + joint_side_velocity_1;
  const T joint_down_2 = joint_down_1 + span_down_2;
  const T joint_down_velocity_2 = span_down_velocity_2 + joint_down_velocity_1;
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T arc_3 = length[3] + arc_2;
  const T span_side_velocity_3 = length[3] * theta_dot[3] * cosine[3];
  const T span_down_3 = length[3] * cosine[3];
  const T span_down_velocity_3 = -length[3] * theta_dot[3] * sine[3];
  const T centre_side_velocity_3 = ratio<T>(1, 2) * span_side_velocity_3 + joint_side_velocity_2;
  const T centre_down_3 = joint_down_2 + ratio<T>(1, 2) * span_down_3;
  const T centre_down_velocity_3 = ratio<T>(1, 2) * span_down_velocity_3 + joint_down_velocity_2;
  const T joint_side_velocity_3 = span_side_velocity_3 + joint_side_velocity_2;
  const T joint_down_3 = joint_down_2 + span_down_3;
  const T joint_down_velocity_3 = span_down_velocity_3 + joint_down_velocity_2;
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T arc_4 = length[4] + arc_3;
  const T span_side_velocity_4 = length[4] * theta_dot[4] * cosine[4];
  const T span_down_4 = length[4] * cosine[4];
  const T span_down_velocity_4 = -length[4] * theta_dot[4] * sine[4];
  const T centre_side_velocity_4 = ratio<T>(1, 2) * span_side_velocity_4 + joint_side_velocity_3;
  const T centre_down_4 = joint_down_3 + ratio<T>(1, 2) * span_down_4;
  const T centre_down_velocity_4 = ratio<T>(1, 2) * span_down_velocity_4 + joint_down_velocity_3;
  const T joint_side_velocity_4 = span_side_velocity_4 + joint_side_velocity_3;
  const T joint_down_4 = joint_down_3 + span_down_4;
  const T joint_down_velocity_4 = span_down_velocity_4 + joint_down_velocity_3;
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T kinetic_energy_sum_1 = ratio<T>(1, 2) * (inertia[1] * theta_dot[1] * theta_dot[1]
      + mass[1] * (centre_side_velocity_1 * centre_side_velocity_1
      + centre_down_velocity_1 * centre_down_velocity_1));
  const T kinetic_energy_sum_2 = ratio<T>(1, 2) * inertia[2] * theta_dot[2] * theta_dot[2]
      + kinetic_energy_sum_1 + ratio<T>(1, 2) * mass[2] * (centre_side_velocity_2
      * centre_side_velocity_2 + centre_down_velocity_2 * centre_down_velocity_2);
  const T kinetic_energy_sum_3 = ratio<T>(1, 2) * inertia[3] * theta_dot[3] * theta_dot[3]
      + kinetic_energy_sum_2 + ratio<T>(1, 2) * mass[3] * (centre_side_velocity_3
      * centre_side_velocity_3 + centre_down_velocity_3 * centre_down_velocity_3);
  const T kinetic_energy_sum_4 = ratio<T>(1, 2) * inertia[4] * theta_dot[4] * theta_dot[4]
      + kinetic_energy_sum_3 + ratio<T>(1, 2) * mass[4] * (centre_side_velocity_4
      * centre_side_velocity_4 + centre_down_velocity_4 * centre_down_velocity_4);
  const T kinetic_energy_sum_5 = kinetic_energy_sum_4
      + ratio<T>(1, 2) * load_mass * (joint_side_velocity_4 * joint_side_velocity_4
      + joint_down_velocity_4 * joint_down_velocity_4);
  const T gravity_energy_sum_1 = mass[1] * gravity * (ratio<T>(1, 2) * length[1] - centre_down_1);
  const T gravity_energy_sum_2 = gravity_energy_sum_1 + mass[2] * gravity * (length[1]
      + ratio<T>(1, 2) * length[2] - centre_down_2);
  const T gravity_energy_sum_3 = gravity_energy_sum_2
      + mass[3] * gravity * (ratio<T>(1, 2) * length[3] - centre_down_3 + arc_2);
  const T gravity_energy_sum_4 = gravity_energy_sum_3
      + mass[4] * gravity * (ratio<T>(1, 2) * length[4] - centre_down_4 + arc_3);
  const T gravity_energy_sum_5 = gravity_energy_sum_4 + load_mass * gravity * (arc_4
      - joint_down_4);
  const T joint_elastic_energy_sum_1 = ratio<T>(1, 2) * stiffness[1] * joint_angle_1
      * joint_angle_1;
  const T joint_elastic_energy_sum_2 = ratio<T>(1, 2) * stiffness[2] * joint_angle_2
      * joint_angle_2 + joint_elastic_energy_sum_1;
  const T joint_elastic_energy_sum_3 = ratio<T>(1, 2) * stiffness[3] * joint_angle_3
      * joint_angle_3 + joint_elastic_energy_sum_2;
  const T joint_elastic_energy_sum_4 = ratio<T>(1, 2) * stiffness[4] * joint_angle_4
      * joint_angle_4 + joint_elastic_energy_sum_3;
  const T joint_damping_power_sum_1 = damping[1] * joint_rate_1 * joint_rate_1;
  const T joint_damping_power_sum_2 = damping[2] * joint_rate_2 * joint_rate_2
      + joint_damping_power_sum_1;
  const T joint_damping_power_sum_3 = damping[3] * joint_rate_3 * joint_rate_3
      + joint_damping_power_sum_2;
  const T joint_damping_power_sum_4 = damping[4] * joint_rate_4 * joint_rate_4
      + joint_damping_power_sum_3;
  const T torque_power_sum_1 = torque[1] * theta_dot[1];
  const T torque_power_sum_2 = torque[2] * theta_dot[2] + torque_power_sum_1;
  const T torque_power_sum_3 = torque[3] * theta_dot[3] + torque_power_sum_2;
  const T torque_power_sum_4 = torque[4] * theta_dot[4] + torque_power_sum_3;
  e[0] = kinetic_energy_sum_5;
  e[1] = gravity_energy_sum_5;
  e[2] = joint_elastic_energy_sum_4;
  e[3] = joint_damping_power_sum_4;
  e[4] = torque_power_sum_4;
}

/// Support (0), far end of each link (1..), load (last): side and down, m.
/// 8 additions, 8 multiplications, 0 divisions, 0 functions
template <class T>
void positions(const Point<T>& at, T* side, T* down) {
  const FromOne<T> length(at.p);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T joint_side_0 = T(0);
  const T joint_down_0 = T(0);
  const T span_side_1 = length[1] * sine[1];
  const T span_down_1 = length[1] * cosine[1];
  const T joint_side_1 = joint_side_0 + span_side_1;
  const T joint_down_1 = joint_down_0 + span_down_1;
  const T span_side_2 = length[2] * sine[2];
  const T span_down_2 = length[2] * cosine[2];
  const T joint_side_2 = joint_side_1 + span_side_2;
  const T joint_down_2 = joint_down_1 + span_down_2;
  const T span_side_3 = length[3] * sine[3];
  const T span_down_3 = length[3] * cosine[3];
  const T joint_side_3 = joint_side_2 + span_side_3;
  const T joint_down_3 = joint_down_2 + span_down_3;
  const T span_side_4 = length[4] * sine[4];
  const T span_down_4 = length[4] * cosine[4];
  const T joint_side_4 = joint_side_3 + span_side_4;
  const T joint_down_4 = joint_down_3 + span_down_4;
  side[0] = joint_side_0;
  down[0] = joint_down_0;
  side[1] = joint_side_1;
  down[1] = joint_down_1;
  side[2] = joint_side_2;
  down[2] = joint_down_2;
  side[3] = joint_side_3;
  down[3] = joint_down_3;
  side[4] = joint_side_4;
  down[4] = joint_down_4;
  side[5] = joint_side_4;
  down[5] = joint_down_4;
}

/// Derivative of the positions along `along`.
/// 14 additions, 24 multiplications, 0 divisions, 0 functions
template <class T, class D>
void positions_tangent(const Point<T>& at, const Point<D>& along, D* dside, D* ddown) {
  const FromOne<T> length(at.p);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const FromOne<D> d_length(along.p);
  const FromOne<D> d_theta(along.q);
  const D d_span_side_1 = length[1] * cosine[1] * d_theta[1] + sine[1] * d_length[1];
  const D d_span_down_1 = cosine[1] * d_length[1] - length[1] * sine[1] * d_theta[1];
  const D d_span_side_2 = length[2] * cosine[2] * d_theta[2] + sine[2] * d_length[2];
  const D d_joint_side_2 = d_span_side_1 + d_span_side_2;
  const D d_span_down_2 = cosine[2] * d_length[2] - length[2] * sine[2] * d_theta[2];
  const D d_joint_down_2 = d_span_down_1 + d_span_down_2;
  const D d_span_side_3 = length[3] * cosine[3] * d_theta[3] + sine[3] * d_length[3];
  const D d_joint_side_3 = d_span_side_3 + d_joint_side_2;
  const D d_span_down_3 = cosine[3] * d_length[3] - length[3] * sine[3] * d_theta[3];
  const D d_joint_down_3 = d_span_down_3 + d_joint_down_2;
  const D d_span_side_4 = length[4] * cosine[4] * d_theta[4] + sine[4] * d_length[4];
  const D d_joint_side_4 = d_span_side_4 + d_joint_side_3;
  const D d_span_down_4 = cosine[4] * d_length[4] - length[4] * sine[4] * d_theta[4];
  const D d_joint_down_4 = d_span_down_4 + d_joint_down_3;
  dside[0] = D(T(0));
  ddown[0] = D(T(0));
  dside[1] = d_span_side_1;
  ddown[1] = d_span_down_1;
  dside[2] = d_joint_side_2;
  ddown[2] = d_joint_down_2;
  dside[3] = d_joint_side_3;
  ddown[3] = d_joint_down_3;
  dside[4] = d_joint_side_4;
  ddown[4] = d_joint_down_4;
  dside[5] = d_joint_side_4;
  ddown[5] = d_joint_down_4;
}

/// Velocities of the same points, m/s.
/// 6 additions, 16 multiplications, 0 divisions, 0 functions
template <class T>
void velocities(const Point<T>& at, T* side_rate, T* down_rate) {
  const FromOne<T> length(at.p);
  const FromOne<T> theta_dot(at.v);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_side_velocity_1 = length[1] * theta_dot[1] * cosine[1];
  const T span_down_velocity_1 = -length[1] * theta_dot[1] * sine[1];
  const T joint_side_velocity_1 = span_side_velocity_1;
  const T joint_down_velocity_1 = span_down_velocity_1;
  const T span_side_velocity_2 = length[2] * theta_dot[2] * cosine[2];
  const T span_down_velocity_2 = -length[2] * theta_dot[2] * sine[2];
  const T joint_side_velocity_2 = span_side_velocity_2 + joint_side_velocity_1;
  const T joint_down_velocity_2 = span_down_velocity_2 + joint_down_velocity_1;
  const T span_side_velocity_3 = length[3] * theta_dot[3] * cosine[3];
  const T span_down_velocity_3 = -length[3] * theta_dot[3] * sine[3];
  const T joint_side_velocity_3 = span_side_velocity_3 + joint_side_velocity_2;
  const T joint_down_velocity_3 = span_down_velocity_3 + joint_down_velocity_2;
  const T span_side_velocity_4 = length[4] * theta_dot[4] * cosine[4];
  const T span_down_velocity_4 = -length[4] * theta_dot[4] * sine[4];
  const T joint_side_velocity_4 = span_side_velocity_4 + joint_side_velocity_3;
  const T joint_down_velocity_4 = span_down_velocity_4 + joint_down_velocity_3;
  side_rate[0] = T(0);
  down_rate[0] = T(0);
  side_rate[1] = joint_side_velocity_1;
  down_rate[1] = joint_down_velocity_1;
  side_rate[2] = joint_side_velocity_2;
  down_rate[2] = joint_down_velocity_2;
  side_rate[3] = joint_side_velocity_3;
  down_rate[3] = joint_down_velocity_3;
  side_rate[4] = joint_side_velocity_4;
  down_rate[4] = joint_down_velocity_4;
  side_rate[5] = joint_side_velocity_4;
  down_rate[5] = joint_down_velocity_4;
}

/// Joint moments (N m), link tensions (N), curvatures at joints (rad/m).
/// 53 additions, 70 multiplications, 4 divisions, 0 functions
template <class T>
void internal_forces(const Point<T>& at, T* moment, T* tension, T* curvature) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T arc_2 = length[1] + length[2];
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T joint_moment_4 = stiffness[4] * joint_angle_4 + damping[4] * joint_rate_4;
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T joint_moment_3 = stiffness[3] * joint_angle_3 + damping[3] * joint_rate_3;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T joint_moment_2 = stiffness[2] * joint_angle_2 + damping[2] * joint_rate_2;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1 + damping[1] * joint_rate_1;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T cut_force_down_1 = cut_force_down_2 + centre_down_force_1;
  const T cut_force_side_1 = cut_force_side_2 + centre_side_force_1;
  const T curvature_divisor_3 = length[2] + length[3];
  const T curvature_divisor_4 = length[3] + length[4];
  moment[0] = -joint_moment_1;
  moment[1] = -joint_moment_2;
  moment[2] = -joint_moment_3;
  moment[3] = -joint_moment_4;
  tension[0] = -(sine[1] * cut_force_side_1 + cosine[1] * cut_force_down_1);
  tension[1] = -(sine[2] * cut_force_side_2 + cosine[2] * cut_force_down_2);
  tension[2] = -(sine[3] * cut_force_side_3 + cosine[3] * cut_force_down_3);
  tension[3] = -(sine[4] * cut_force_side_4 + cosine[4] * cut_force_down_4);
  curvature[0] = T(2) * theta[1] / length[1];
  curvature[1] = T(2) * (theta[2] - theta[1]) / arc_2;
  curvature[2] = T(2) * (theta[3] - theta[2]) / curvature_divisor_3;
  curvature[3] = T(2) * (theta[4] - theta[3]) / curvature_divisor_4;
}

/// What holds the support, then a held end: forces (N) and moments (N m).
/// 34 additions, 52 multiplications, 0 divisions, 0 functions
template <class T>
void reactions(const Point<T>& at, T* force, T* moment) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T joint_moment_1 = stiffness[1] * joint_angle_1 + damping[1] * joint_rate_1;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T cut_force_down_1 = cut_force_down_2 + centre_down_force_1;
  const T cut_force_side_1 = cut_force_side_2 + centre_side_force_1;
  force[0] = cut_force_side_1;
  force[1] = cut_force_down_1;
  moment[0] = -joint_moment_1;
}

/// Gradient of weights . r + rate_weights . zdot with respect to q, v, z and p.
/// 146 additions, 243 multiplications, 0 divisions, 0 functions
template <class T>
void residual_adjoint(const Point<T>& at, const T* weights,
                      [[maybe_unused]] const T* rate_weights, T* dq, T* dv,
                      [[maybe_unused]] T* dz, T* dp) {
  const FromOne<T> length(at.p);
  const FromOne<T> mass(at.p + 4);
  const FromOne<T> stiffness(at.p + 12);
  const FromOne<T> damping(at.p + 16);
  const T load_mass = at.p[24];
  const T gravity = at.p[25];
  const FromOne<T> theta(at.q);
  const FromOne<T> theta_dot(at.v);
  const FromOne<T> theta_ddot(at.a);
  T sine[5], cosine[5];
  sines_and_cosines<4>(at.q, sine + 1, cosine + 1);
  const FromOne<T> weight(weights);
  const T span_side_acceleration_1 = length[1] * (theta_ddot[1] * cosine[1]
      - theta_dot[1] * theta_dot[1] * sine[1]);
  const T span_down_acceleration_1 = -length[1] * (theta_dot[1] * theta_dot[1] * cosine[1]
      + theta_ddot[1] * sine[1]);
  const T centre_side_acceleration_1 = ratio<T>(1, 2) * span_side_acceleration_1;
  const T centre_down_acceleration_1 = ratio<T>(1, 2) * span_down_acceleration_1;
  const T joint_side_acceleration_1 = span_side_acceleration_1;
  const T joint_down_acceleration_1 = span_down_acceleration_1;
  const T joint_angle_1 = theta[1];
  const T joint_rate_1 = theta_dot[1];
  const T span_side_acceleration_2 = length[2] * (theta_ddot[2] * cosine[2]
      - theta_dot[2] * theta_dot[2] * sine[2]);
  const T span_down_acceleration_2 = -length[2] * (theta_dot[2] * theta_dot[2] * cosine[2]
      + theta_ddot[2] * sine[2]);
  const T centre_side_acceleration_2 = ratio<T>(1, 2) * span_side_acceleration_2
      + joint_side_acceleration_1;
  const T centre_down_acceleration_2 = ratio<T>(1, 2) * span_down_acceleration_2
      + joint_down_acceleration_1;
  const T joint_side_acceleration_2 = span_side_acceleration_2 + joint_side_acceleration_1;
  const T joint_down_acceleration_2 = span_down_acceleration_2 + joint_down_acceleration_1;
  const T joint_angle_2 = theta[2] - theta[1];
  const T joint_rate_2 = theta_dot[2] - theta_dot[1];
  const T span_side_acceleration_3 = length[3] * (theta_ddot[3] * cosine[3]
      - theta_dot[3] * theta_dot[3] * sine[3]);
  const T span_down_acceleration_3 = -length[3] * (theta_dot[3] * theta_dot[3] * cosine[3]
      + theta_ddot[3] * sine[3]);
  const T centre_side_acceleration_3 = ratio<T>(1, 2) * span_side_acceleration_3
      + joint_side_acceleration_2;
  const T centre_down_acceleration_3 = ratio<T>(1, 2) * span_down_acceleration_3
      + joint_down_acceleration_2;
  const T joint_side_acceleration_3 = span_side_acceleration_3 + joint_side_acceleration_2;
  const T joint_down_acceleration_3 = span_down_acceleration_3 + joint_down_acceleration_2;
  const T joint_angle_3 = theta[3] - theta[2];
  const T joint_rate_3 = theta_dot[3] - theta_dot[2];
  const T span_side_acceleration_4 = length[4] * (theta_ddot[4] * cosine[4]
      - theta_dot[4] * theta_dot[4] * sine[4]);
  const T span_down_acceleration_4 = -length[4] * (theta_dot[4] * theta_dot[4] * cosine[4]
      + theta_ddot[4] * sine[4]);
  const T centre_side_acceleration_4 = ratio<T>(1, 2) * span_side_acceleration_4
      + joint_side_acceleration_3;
  const T centre_down_acceleration_4 = ratio<T>(1, 2) * span_down_acceleration_4
      + joint_down_acceleration_3;
  const T joint_side_acceleration_4 = span_side_acceleration_4 + joint_side_acceleration_3;
  const T joint_down_acceleration_4 = span_down_acceleration_4 + joint_down_acceleration_3;
  const T joint_angle_4 = theta[4] - theta[3];
  const T joint_rate_4 = theta_dot[4] - theta_dot[3];
  const T cut_force_down_5 = load_mass * (joint_down_acceleration_4 - gravity);
  const T cut_force_side_5 = load_mass * joint_side_acceleration_4;
  const T centre_down_force_4 = mass[4] * (centre_down_acceleration_4 - gravity);
  const T centre_side_force_4 = mass[4] * centre_side_acceleration_4;
  const T span_down_force_4 = cut_force_down_5 + ratio<T>(1, 2) * centre_down_force_4;
  const T span_side_force_4 = cut_force_side_5 + ratio<T>(1, 2) * centre_side_force_4;
  const T cut_force_down_4 = cut_force_down_5 + centre_down_force_4;
  const T cut_force_side_4 = cut_force_side_5 + centre_side_force_4;
  const T centre_down_force_3 = mass[3] * (centre_down_acceleration_3 - gravity);
  const T centre_side_force_3 = mass[3] * centre_side_acceleration_3;
  const T span_down_force_3 = cut_force_down_4 + ratio<T>(1, 2) * centre_down_force_3;
  const T span_side_force_3 = cut_force_side_4 + ratio<T>(1, 2) * centre_side_force_3;
  const T cut_force_down_3 = cut_force_down_4 + centre_down_force_3;
  const T cut_force_side_3 = cut_force_side_4 + centre_side_force_3;
  const T centre_down_force_2 = mass[2] * (centre_down_acceleration_2 - gravity);
  const T centre_side_force_2 = mass[2] * centre_side_acceleration_2;
  const T span_down_force_2 = cut_force_down_3 + ratio<T>(1, 2) * centre_down_force_2;
  const T span_side_force_2 = cut_force_side_3 + ratio<T>(1, 2) * centre_side_force_2;
  const T cut_force_down_2 = cut_force_down_3 + centre_down_force_2;
  const T cut_force_side_2 = cut_force_side_3 + centre_side_force_2;
  const T centre_down_force_1 = mass[1] * (centre_down_acceleration_1 - gravity);
  const T centre_side_force_1 = mass[1] * centre_side_acceleration_1;
  const T span_down_force_1 = cut_force_down_2 + ratio<T>(1, 2) * centre_down_force_1;
  const T span_side_force_1 = cut_force_side_2 + ratio<T>(1, 2) * centre_side_force_1;
  const T adjoint_span_side_force_1 = length[1] * cosine[1] * weight[1];
  const T adjoint_span_down_force_1 = -length[1] * sine[1] * weight[1];
  const T adjoint_centre_side_force_1 = ratio<T>(1, 2) * adjoint_span_side_force_1;
  const T adjoint_centre_down_force_1 = ratio<T>(1, 2) * adjoint_span_down_force_1;
  const T adjoint_span_side_force_2 = length[2] * cosine[2] * weight[2];
  const T adjoint_span_down_force_2 = -length[2] * sine[2] * weight[2];
  const T adjoint_centre_side_force_2 = adjoint_span_side_force_1
      + ratio<T>(1, 2) * adjoint_span_side_force_2;
  const T adjoint_centre_down_force_2 = adjoint_span_down_force_1
      + ratio<T>(1, 2) * adjoint_span_down_force_2;
  const T adjoint_cut_force_side_3 = adjoint_span_side_force_1 + adjoint_span_side_force_2;
  const T adjoint_cut_force_down_3 = adjoint_span_down_force_1 + adjoint_span_down_force_2;
  const T adjoint_joint_moment_2 = weight[2] - weight[1];
  const T adjoint_span_side_force_3 = length[3] * cosine[3] * weight[3];
  const T adjoint_span_down_force_3 = -length[3] * sine[3] * weight[3];
  const T adjoint_centre_side_force_3 = ratio<T>(1, 2) * adjoint_span_side_force_3
      + adjoint_cut_force_side_3;
  const T adjoint_centre_down_force_3 = ratio<T>(1, 2) * adjoint_span_down_force_3
      + adjoint_cut_force_down_3;
  const T adjoint_cut_force_side_4 = adjoint_span_side_force_3 + adjoint_cut_force_side_3;
  const T adjoint_cut_force_down_4 = adjoint_span_down_force_3 + adjoint_cut_force_down_3;
  const T adjoint_joint_moment_3 = weight[3] - weight[2];
  const T adjoint_span_side_force_4 = length[4] * cosine[4] * weight[4];
  const T adjoint_span_down_force_4 = -length[4] * sine[4] * weight[4];
  const T adjoint_centre_side_force_4 = ratio<T>(1, 2) * adjoint_span_side_force_4
      + adjoint_cut_force_side_4;
  const T adjoint_centre_down_force_4 = ratio<T>(1, 2) * adjoint_span_down_force_4
      + adjoint_cut_force_down_4;
  const T adjoint_cut_force_side_5 = adjoint_span_side_force_4 + adjoint_cut_force_side_4;
  const T adjoint_cut_force_down_5 = adjoint_span_down_force_4 + adjoint_cut_force_down_4;
  const T adjoint_joint_moment_4 = weight[4] - weight[3];
  const T adjoint_joint_rate_4 = damping[4] * adjoint_joint_moment_4;
  const T adjoint_joint_angle_4 = stiffness[4] * adjoint_joint_moment_4;
  const T adjoint_joint_down_acceleration_4 = load_mass * adjoint_cut_force_down_5;
  const T adjoint_joint_side_acceleration_4 = load_mass * adjoint_cut_force_side_5;
  const T adjoint_centre_down_acceleration_4 = mass[4] * adjoint_centre_down_force_4;
  const T adjoint_centre_side_acceleration_4 = mass[4] * adjoint_centre_side_force_4;
  const T adjoint_span_down_acceleration_4 = adjoint_joint_down_acceleration_4
      + ratio<T>(1, 2) * adjoint_centre_down_acceleration_4;
  const T adjoint_span_side_acceleration_4 = adjoint_joint_side_acceleration_4
      + ratio<T>(1, 2) * adjoint_centre_side_acceleration_4;
  const T adjoint_joint_rate_3 = damping[3] * adjoint_joint_moment_3;
  const T adjoint_joint_angle_3 = stiffness[3] * adjoint_joint_moment_3;
  const T adjoint_joint_down_acceleration_3 = adjoint_joint_down_acceleration_4
      + adjoint_centre_down_acceleration_4;
  const T adjoint_joint_side_acceleration_3 = adjoint_joint_side_acceleration_4
      + adjoint_centre_side_acceleration_4;
  const T adjoint_centre_down_acceleration_3 = mass[3] * adjoint_centre_down_force_3;
  const T adjoint_centre_side_acceleration_3 = mass[3] * adjoint_centre_side_force_3;
  const T adjoint_span_down_acceleration_3 = adjoint_joint_down_acceleration_3
      + ratio<T>(1, 2) * adjoint_centre_down_acceleration_3;
  const T adjoint_span_side_acceleration_3 = adjoint_joint_side_acceleration_3
      + ratio<T>(1, 2) * adjoint_centre_side_acceleration_3;
  const T adjoint_joint_rate_2 = damping[2] * adjoint_joint_moment_2;
  const T adjoint_joint_angle_2 = stiffness[2] * adjoint_joint_moment_2;
  const T adjoint_joint_down_acceleration_2 = adjoint_joint_down_acceleration_3
      + adjoint_centre_down_acceleration_3;
  const T adjoint_joint_side_acceleration_2 = adjoint_joint_side_acceleration_3
      + adjoint_centre_side_acceleration_3;
  const T adjoint_centre_down_acceleration_2 = mass[2] * adjoint_centre_down_force_2;
  const T adjoint_centre_side_acceleration_2 = mass[2] * adjoint_centre_side_force_2;
  const T adjoint_span_down_acceleration_2 = adjoint_joint_down_acceleration_2
      + ratio<T>(1, 2) * adjoint_centre_down_acceleration_2;
  const T adjoint_span_side_acceleration_2 = adjoint_joint_side_acceleration_2
      + ratio<T>(1, 2) * adjoint_centre_side_acceleration_2;
  const T adjoint_joint_rate_1 = damping[1] * weight[1];
  const T adjoint_joint_angle_1 = stiffness[1] * weight[1];
  const T adjoint_joint_down_acceleration_1 = adjoint_joint_down_acceleration_2
      + adjoint_centre_down_acceleration_2;
  const T adjoint_joint_side_acceleration_1 = adjoint_joint_side_acceleration_2
      + adjoint_centre_side_acceleration_2;
  const T adjoint_centre_down_acceleration_1 = mass[1] * adjoint_centre_down_force_1;
  const T adjoint_centre_side_acceleration_1 = mass[1] * adjoint_centre_side_force_1;
  const T adjoint_span_down_acceleration_1 = adjoint_joint_down_acceleration_1
      + ratio<T>(1, 2) * adjoint_centre_down_acceleration_1;
  const T adjoint_span_side_acceleration_1 = adjoint_joint_side_acceleration_1
      + ratio<T>(1, 2) * adjoint_centre_side_acceleration_1;
  const T adjoint_cosine_4 = length[4] * (theta_ddot[4] * adjoint_span_side_acceleration_4
      - theta_dot[4] * theta_dot[4] * adjoint_span_down_acceleration_4
      + span_side_force_4 * weight[4]);
  const T adjoint_sine_4 = -length[4] * (theta_dot[4] * theta_dot[4]
      * adjoint_span_side_acceleration_4 + theta_ddot[4] * adjoint_span_down_acceleration_4
      + span_down_force_4 * weight[4]);
  const T adjoint_cosine_3 = length[3] * (theta_ddot[3] * adjoint_span_side_acceleration_3
      - theta_dot[3] * theta_dot[3] * adjoint_span_down_acceleration_3
      + span_side_force_3 * weight[3]);
  const T adjoint_sine_3 = -length[3] * (theta_dot[3] * theta_dot[3]
      * adjoint_span_side_acceleration_3 + theta_ddot[3] * adjoint_span_down_acceleration_3
      + span_down_force_3 * weight[3]);
  const T adjoint_cosine_2 = length[2] * (theta_ddot[2] * adjoint_span_side_acceleration_2
      - theta_dot[2] * theta_dot[2] * adjoint_span_down_acceleration_2
      + span_side_force_2 * weight[2]);
  const T adjoint_sine_2 = -length[2] * (theta_dot[2] * theta_dot[2]
      * adjoint_span_side_acceleration_2 + theta_ddot[2] * adjoint_span_down_acceleration_2
      + span_down_force_2 * weight[2]);
  const T adjoint_cosine_1 = length[1] * (theta_ddot[1] * adjoint_span_side_acceleration_1
      - theta_dot[1] * theta_dot[1] * adjoint_span_down_acceleration_1
      + span_side_force_1 * weight[1]);
  const T adjoint_sine_1 = -length[1] * (theta_dot[1] * theta_dot[1]
      * adjoint_span_side_acceleration_1 + theta_ddot[1] * adjoint_span_down_acceleration_1
      + span_down_force_1 * weight[1]);
  const T adjoint_theta_dot_4 = adjoint_joint_rate_4
      - T(2) * length[4] * theta_dot[4] * (sine[4] * adjoint_span_side_acceleration_4
      + cosine[4] * adjoint_span_down_acceleration_4);
  const T adjoint_theta_dot_3 = adjoint_joint_rate_3 - adjoint_joint_rate_4
      - T(2) * length[3] * theta_dot[3] * (sine[3] * adjoint_span_side_acceleration_3
      + cosine[3] * adjoint_span_down_acceleration_3);
  const T adjoint_theta_dot_2 = adjoint_joint_rate_2 - adjoint_joint_rate_3
      - T(2) * length[2] * theta_dot[2] * (sine[2] * adjoint_span_side_acceleration_2
      + cosine[2] * adjoint_span_down_acceleration_2);
  const T adjoint_theta_dot_1 = adjoint_joint_rate_1 - adjoint_joint_rate_2
      - T(2) * length[1] * theta_dot[1] * (sine[1] * adjoint_span_side_acceleration_1
      + cosine[1] * adjoint_span_down_acceleration_1);
  const T adjoint_theta_4 = cosine[4] * adjoint_sine_4 - sine[4] * adjoint_cosine_4
      + adjoint_joint_angle_4;
  const T adjoint_theta_3 = cosine[3] * adjoint_sine_3 - sine[3] * adjoint_cosine_3
      + adjoint_joint_angle_3 - adjoint_joint_angle_4;
  const T adjoint_theta_2 = cosine[2] * adjoint_sine_2 - sine[2] * adjoint_cosine_2
      + adjoint_joint_angle_2 - adjoint_joint_angle_3;
  const T adjoint_theta_1 = cosine[1] * adjoint_sine_1 - sine[1] * adjoint_cosine_1
      + adjoint_joint_angle_1 - adjoint_joint_angle_2;
  const T adjoint_gravity_sum_1 = -mass[1] * adjoint_centre_down_force_1;
  const T adjoint_gravity_sum_2 = adjoint_gravity_sum_1 - mass[2] * adjoint_centre_down_force_2;
  const T adjoint_gravity_sum_3 = adjoint_gravity_sum_2 - mass[3] * adjoint_centre_down_force_3;
  const T adjoint_gravity_sum_4 = adjoint_gravity_sum_3 - mass[4] * adjoint_centre_down_force_4;
  const T adjoint_gravity_sum_5 = adjoint_gravity_sum_4 - load_mass * adjoint_cut_force_down_5;
  const T adjoint_load_mass = joint_side_acceleration_4 * adjoint_cut_force_side_5
      + adjoint_cut_force_down_5 * (joint_down_acceleration_4 - gravity);
  const T adjoint_torque_4 = -weight[4];
  const T adjoint_torque_3 = -weight[3];
  const T adjoint_torque_2 = -weight[2];
  const T adjoint_torque_1 = -weight[1];
  const T adjoint_damping_4 = joint_rate_4 * adjoint_joint_moment_4;
  const T adjoint_damping_3 = joint_rate_3 * adjoint_joint_moment_3;
  const T adjoint_damping_2 = joint_rate_2 * adjoint_joint_moment_2;
  const T adjoint_damping_1 = joint_rate_1 * weight[1];
  const T adjoint_stiffness_4 = joint_angle_4 * adjoint_joint_moment_4;
  const T adjoint_stiffness_3 = joint_angle_3 * adjoint_joint_moment_3;
  const T adjoint_stiffness_2 = joint_angle_2 * adjoint_joint_moment_2;
  const T adjoint_stiffness_1 = joint_angle_1 * weight[1];
  const T adjoint_inertia_4 = theta_ddot[4] * weight[4];
  const T adjoint_inertia_3 = theta_ddot[3] * weight[3];
  const T adjoint_inertia_2 = theta_ddot[2] * weight[2];
  const T adjoint_inertia_1 = theta_ddot[1] * weight[1];
  const T adjoint_mass_4 = centre_side_acceleration_4 * adjoint_centre_side_force_4
      + adjoint_centre_down_force_4 * (centre_down_acceleration_4 - gravity);
  const T adjoint_mass_3 = centre_side_acceleration_3 * adjoint_centre_side_force_3
      + adjoint_centre_down_force_3 * (centre_down_acceleration_3 - gravity);
  const T adjoint_mass_2 = centre_side_acceleration_2 * adjoint_centre_side_force_2
      + adjoint_centre_down_force_2 * (centre_down_acceleration_2 - gravity);
  const T adjoint_mass_1 = centre_side_acceleration_1 * adjoint_centre_side_force_1
      + adjoint_centre_down_force_1 * (centre_down_acceleration_1 - gravity);
  const T adjoint_length_4 = cosine[4] * (theta_ddot[4] * adjoint_span_side_acceleration_4
      - theta_dot[4] * theta_dot[4] * adjoint_span_down_acceleration_4
      + span_side_force_4 * weight[4]) - sine[4] * (theta_dot[4] * theta_dot[4]
      * adjoint_span_side_acceleration_4 + theta_ddot[4] * adjoint_span_down_acceleration_4
      + span_down_force_4 * weight[4]);
  const T adjoint_length_3 = cosine[3] * (theta_ddot[3] * adjoint_span_side_acceleration_3
      - theta_dot[3] * theta_dot[3] * adjoint_span_down_acceleration_3
      + span_side_force_3 * weight[3]) - sine[3] * (theta_dot[3] * theta_dot[3]
      * adjoint_span_side_acceleration_3 + theta_ddot[3] * adjoint_span_down_acceleration_3
      + span_down_force_3 * weight[3]);
  const T adjoint_length_2 = cosine[2] * (theta_ddot[2] * adjoint_span_side_acceleration_2
      - theta_dot[2] * theta_dot[2] * adjoint_span_down_acceleration_2
      + span_side_force_2 * weight[2]) - sine[2] * (theta_dot[2] * theta_dot[2]
      * adjoint_span_side_acceleration_2 + theta_ddot[2] * adjoint_span_down_acceleration_2
      + span_down_force_2 * weight[2]);
  const T adjoint_length_1 = cosine[1] * (theta_ddot[1] * adjoint_span_side_acceleration_1
      - theta_dot[1] * theta_dot[1] * adjoint_span_down_acceleration_1
      + span_side_force_1 * weight[1]) - sine[1] * (theta_dot[1] * theta_dot[1]
      * adjoint_span_side_acceleration_1 + theta_ddot[1] * adjoint_span_down_acceleration_1
      + span_down_force_1 * weight[1]);
  dp[0] = adjoint_length_1;
  dp[1] = adjoint_length_2;
  dp[2] = adjoint_length_3;
  dp[3] = adjoint_length_4;
  dp[4 + 0] = adjoint_mass_1;
  dp[4 + 1] = adjoint_mass_2;
  dp[4 + 2] = adjoint_mass_3;
  dp[4 + 3] = adjoint_mass_4;
  dp[8 + 0] = adjoint_inertia_1;
  dp[8 + 1] = adjoint_inertia_2;
  dp[8 + 2] = adjoint_inertia_3;
  dp[8 + 3] = adjoint_inertia_4;
  dp[12 + 0] = adjoint_stiffness_1;
  dp[12 + 1] = adjoint_stiffness_2;
  dp[12 + 2] = adjoint_stiffness_3;
  dp[12 + 3] = adjoint_stiffness_4;
  dp[16 + 0] = adjoint_damping_1;
  dp[16 + 1] = adjoint_damping_2;
  dp[16 + 2] = adjoint_damping_3;
  dp[16 + 3] = adjoint_damping_4;
  dp[20 + 0] = adjoint_torque_1;
  dp[20 + 1] = adjoint_torque_2;
  dp[20 + 2] = adjoint_torque_3;
  dp[20 + 3] = adjoint_torque_4;
  dp[24] = adjoint_load_mass;
  dp[25] = adjoint_gravity_sum_5;
  dq[0] = adjoint_theta_1;
  dq[1] = adjoint_theta_2;
  dq[2] = adjoint_theta_3;
  dq[3] = adjoint_theta_4;
  dv[0] = adjoint_theta_dot_1;
  dv[1] = adjoint_theta_dot_2;
  dv[2] = adjoint_theta_dot_3;
  dv[3] = adjoint_theta_dot_4;
}

}  // namespace catena::chain_4
