// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "reference/chain_constants.hpp"

/// The chain in space: one unit vector q_i for each link, from its upper to its lower end. Written by
/// hand for n links after T. Lee, M. Leok, N. H. McClamroch, International Journal for Numerical Methods
/// in Engineering 79:1147 (2009), with bending and damping of the joints added. Components are side,
/// down, across. Each function gives one vector for each link, N m. The equations of motion are
///
///     inertia + gravity + elastic + friction = lambda_i q_i,
///
/// lambda_i from |q_i| = 1: only the part that is perpendicular to q_i matters.
namespace catena::reference::space {

template <class T>
using Vector3 = std::array<T, 3>;

template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Adds scale * vector to `to`.
template <class T>
void add(Vector3<T>& to, const T& scale, const Vector3<T>& vector) {
  for (std::size_t c = 0; c < 3; ++c) to[c] = to[c] + scale * vector[c];
}

template <class T>
Vector<Vector3<T>> zero_vectors(std::size_t size) {
  return Vector<Vector3<T>>(size, Vector3<T>{T(0), T(0), T(0)});
}

/// A_ij of T = 1/2 sum A_ij qdot_i . qdot_j (kg m^2), i <= j, as (4.3), (4.4) without their cosine.
template <class T>
T mass_scalar(const Chain<T>& chain, std::size_t i, std::size_t j) {
  const T beyond = mass_beyond(chain, j);
  if (i == j)
    return chain.length[i] * chain.length[i] * (chain.mass[i] / 4 + beyond) + chain.inertia[i];
  return chain.length[i] * chain.length[j] * (chain.mass[j] / 2 + beyond);
}

/// sum_j A_ij qddot_j.
template <class T>
Vector<Vector3<T>> inertia(const Chain<T>& chain, const Vector<Vector3<T>>& acceleration) {
  const std::size_t n = chain.links();
  auto sum = zero_vectors<T>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      const T mass = mass_scalar(chain, i, j);
      add(sum[i], mass, acceleration[j]);
      if (j != i) add(sum[j], mass, acceleration[i]);
    }
  }
  return sum;
}

/// The potential falls by g times the mass below, times the length, as a link turns down.
template <class T>
Vector<Vector3<T>> gravity(const Chain<T>& chain) {
  auto torque = zero_vectors<T>(chain.links());
  for (std::size_t i = 0; i < chain.links(); ++i)
    torque[i][1] = -chain.length[i] * (chain.mass[i] / 2 + mass_beyond(chain, i)) * chain.gravity;
  return torque;
}

/// Bending: V = k_i b_i^2 / 2, cos b_i = q_{i-1} . q_i, q_0 straight down. `angle_over_sine` gives
/// b / sin b from cos b.
template <class T, class AngleOverSine>
Vector<Vector3<T>> elastic(const Chain<T>& chain, const Vector<Vector3<T>>& direction,
                           const AngleOverSine& angle_over_sine) {
  auto sum = zero_vectors<T>(chain.links());
  Vector3<T> above{T(0), T(1), T(0)};
  for (std::size_t i = 0; i < chain.links(); ++i) {
    const T strength = -chain.stiffness[i] * angle_over_sine(dot(above, direction[i]));
    add(sum[i], strength, above);
    if (i > 0) add(sum[i - 1], strength, direction[i]);
    above = direction[i];
  }
  return sum;
}

/// Damping: D = c_i |w_i - w_{i-1}|^2 / 2, with the angular velocities w_i = q_i x qdot_i.
template <class T>
Vector<Vector3<T>> friction(const Chain<T>& chain, const Vector<Vector3<T>>& direction,
                            const Vector<Vector3<T>>& rate) {
  auto sum = zero_vectors<T>(chain.links());
  Vector3<T> above{T(0), T(0), T(0)};
  for (std::size_t i = 0; i < chain.links(); ++i) {
    const Vector3<T> turning = cross(direction[i], rate[i]);
    Vector3<T> relative = turning;
    add(relative, T(-1), above);
    add(sum[i], chain.damping[i], cross(relative, direction[i]));
    if (i > 0) add(sum[i - 1], T(0) - chain.damping[i], cross(relative, direction[i - 1]));
    above = turning;
  }
  return sum;
}

}  // namespace catena::reference::space
