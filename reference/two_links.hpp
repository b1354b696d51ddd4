// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "reference/chain_constants.hpp"

/// Two links, (3.1)-(3.5), typed from section 3.2 term by term, independently of the generic
/// algorithms. Symbols are as printed. The vectors of the chain must have two entries.
namespace catena::reference::two_links {

/// L = T - V (J), (3.1).
template <class T>
T lagrangian(const Chain<T> &chain, const Vector<T> &theta, const Vector<T> &rate) {
  using std::cos;
  const T &l1 = chain.length[0], &l2 = chain.length[1];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &mc = chain.load_mass, &g = chain.gravity;
  const T &ir1 = chain.inertia[0], &ir2 = chain.inertia[1];
  const T &k1 = chain.stiffness[0], &k2 = chain.stiffness[1];
  const T &t1 = theta[0], &t2 = theta[1], &w1 = rate[0], &w2 = rate[1];
  return ir1 * w1 * w1 / 2 + ir2 * w2 * w2 / 2 + (m1 / 4 + m2 + mc) * l1 * l1 * w1 * w1 / 2 +
         (m2 / 4 + mc) * l2 * l2 * w2 * w2 / 2 + (m2 / 2 + mc) * l1 * l2 * cos(t1 - t2) * w1 * w2 -
         k1 * t1 * t1 / 2 - k2 * (t2 - t1) * (t2 - t1) / 2 -
         (m1 / 2 + m2 + mc) * g * l1 * (1 - cos(t1)) - (m2 / 2 + mc) * g * l2 * (1 - cos(t2));
}

/// Right-hand sides without the external torques (N m): minus the derivative of the dissipation
/// function, (3.2), (3.3).
template <class T>
Vector<T> friction_force(const Chain<T> &chain, const Vector<T> &rate) {
  const T &c1 = chain.damping[0], &c2 = chain.damping[1];
  const T &w1 = rate[0], &w2 = rate[1];
  return {-c1 * w1 - c2 * (w1 - w2), -c2 * (w2 - w1)};
}

template <class T>
Matrix<T> mass_matrix(const Chain<T> &chain, const Vector<T> &theta) {
  using std::cos;
  const T &l1 = chain.length[0], &l2 = chain.length[1];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &mc = chain.load_mass;
  const T i11 = (m1 / 4 + m2 + mc) * l1 * l1 + chain.inertia[0];
  const T i12 = l1 * l2 * (m2 / 2 + mc) * cos(theta[0] - theta[1]);
  const T i22 = (m2 / 4 + mc) * l2 * l2 + chain.inertia[1];
  return {{i11, i12}, {i12, i22}};
}

/// K from the k_i; C has the same form in the c_i.
template <class T>
Matrix<T> joint_matrix(const Vector<T> &joint) {
  const T &k1 = joint[0], &k2 = joint[1];
  return {{k1 + k2, -k2}, {-k2, k2}};
}

template <class T>
Vector<T> coriolis(const Chain<T> &chain, const Vector<T> &theta, const Vector<T> &rate) {
  using std::sin;
  const T &l1 = chain.length[0], &l2 = chain.length[1];
  const T &m2 = chain.mass[1], &mc = chain.load_mass;
  const T &t1 = theta[0], &t2 = theta[1], &w1 = rate[0], &w2 = rate[1];
  return {l1 * l2 * (m2 / 2 + mc) * sin(t1 - t2) * w2 * w2,
          -l1 * l2 * (m2 / 2 + mc) * sin(t1 - t2) * w1 * w1};
}

template <class T>
Vector<T> gravity(const Chain<T> &chain, const Vector<T> &theta) {
  using std::sin;
  const T &l1 = chain.length[0], &l2 = chain.length[1];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &mc = chain.load_mass, &g = chain.gravity;
  return {(m1 / 2 + m2 + mc) * g * l1 * sin(theta[0]), (m2 / 2 + mc) * g * l2 * sin(theta[1])};
}

}  // namespace catena::reference::two_links
