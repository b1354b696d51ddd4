// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "reference/chain_constants.hpp"

/// Four links, (3.10)-(3.14), typed from section 3.4 term by term, independently of the generic
/// algorithms. Symbols are as printed. The vectors of the chain must have four entries.
namespace catena::reference::four_links {

/// L = T - V (J), (3.10).
template <class T>
T lagrangian(const Chain<T> &chain, const Vector<T> &theta, const Vector<T> &rate) {
  using std::cos;
  const T &l1 = chain.length[0], &l2 = chain.length[1], &l3 = chain.length[2],
          &l4 = chain.length[3];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &m3 = chain.mass[2], &m4 = chain.mass[3];
  const T &mc = chain.load_mass, &g = chain.gravity;
  const T &ir1 = chain.inertia[0], &ir2 = chain.inertia[1], &ir3 = chain.inertia[2],
          &ir4 = chain.inertia[3];
  const T &k1 = chain.stiffness[0], &k2 = chain.stiffness[1], &k3 = chain.stiffness[2],
          &k4 = chain.stiffness[3];
  const T &t1 = theta[0], &t2 = theta[1], &t3 = theta[2], &t4 = theta[3];
  const T &w1 = rate[0], &w2 = rate[1], &w3 = rate[2], &w4 = rate[3];
  return ir1 * w1 * w1 / 2 + ir2 * w2 * w2 / 2 + ir3 * w3 * w3 / 2 + ir4 * w4 * w4 / 2 +
         (m1 / 4 + m2 + m3 + m4 + mc) * l1 * l1 * w1 * w1 / 2 +
         (m2 / 4 + m3 + m4 + mc) * l2 * l2 * w2 * w2 / 2 +
         (m3 / 4 + m4 + mc) * l3 * l3 * w3 * w3 / 2 + (m4 / 4 + mc) * l4 * l4 * w4 * w4 / 2 +
         (m2 / 2 + m3 + m4 + mc) * l1 * l2 * cos(t1 - t2) * w1 * w2 +
         (m3 / 2 + m4 + mc) * l1 * l3 * cos(t1 - t3) * w1 * w3 +
         (m4 / 2 + mc) * l1 * l4 * cos(t1 - t4) * w1 * w4 +
         (m3 / 2 + m4 + mc) * l2 * l3 * cos(t2 - t3) * w2 * w3 +
         (m4 / 2 + mc) * l2 * l4 * cos(t2 - t4) * w2 * w4 +
         (m4 / 2 + mc) * l3 * l4 * cos(t3 - t4) * w3 * w4 - k1 * t1 * t1 / 2 -
         k2 * (t2 - t1) * (t2 - t1) / 2 - k3 * (t3 - t2) * (t3 - t2) / 2 -
         k4 * (t4 - t3) * (t4 - t3) / 2 - (m1 / 2 + m2 + m3 + m4 + mc) * g * l1 * (1 - cos(t1)) -
         (m2 / 2 + m3 + m4 + mc) * g * l2 * (1 - cos(t2)) -
         (m3 / 2 + m4 + mc) * g * l3 * (1 - cos(t3)) - (m4 / 2 + mc) * g * l4 * (1 - cos(t4));
}

/// Right-hand sides without the external torques (N m): minus the derivative of the dissipation
/// function, (3.11)-(3.14).
template <class T>
Vector<T> friction_force(const Chain<T> &chain, const Vector<T> &rate) {
  const T &c1 = chain.damping[0], &c2 = chain.damping[1], &c3 = chain.damping[2],
          &c4 = chain.damping[3];
  const T &w1 = rate[0], &w2 = rate[1], &w3 = rate[2], &w4 = rate[3];
  return {-c1 * w1 - c2 * (w1 - w2), -c2 * (w2 - w1) - c3 * (w2 - w3),
          -c3 * (w3 - w2) - c4 * (w3 - w4), -c4 * (w4 - w3)};
}

template <class T>
Matrix<T> mass_matrix(const Chain<T> &chain, const Vector<T> &theta) {
  using std::cos;
  const T &l1 = chain.length[0], &l2 = chain.length[1], &l3 = chain.length[2],
          &l4 = chain.length[3];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &m3 = chain.mass[2], &m4 = chain.mass[3];
  const T &mc = chain.load_mass;
  const T &t1 = theta[0], &t2 = theta[1], &t3 = theta[2], &t4 = theta[3];
  const T i11 = (m1 / 4 + m2 + m3 + m4 + mc) * l1 * l1 + chain.inertia[0];
  const T i12 = l1 * l2 * (m2 / 2 + m3 + m4 + mc) * cos(t1 - t2);
  const T i13 = l1 * l3 * (m3 / 2 + m4 + mc) * cos(t1 - t3);
  const T i14 = l1 * l4 * (m4 / 2 + mc) * cos(t1 - t4);
  const T i22 = (m2 / 4 + m3 + m4 + mc) * l2 * l2 + chain.inertia[1];
  const T i23 = l2 * l3 * (m3 / 2 + m4 + mc) * cos(t2 - t3);
  const T i24 = l2 * l4 * (m4 / 2 + mc) * cos(t2 - t4);
  const T i33 = (m3 / 4 + m4 + mc) * l3 * l3 + chain.inertia[2];
  const T i34 = l3 * l4 * (m4 / 2 + mc) * cos(t3 - t4);
  const T i44 = (m4 / 4 + mc) * l4 * l4 + chain.inertia[3];
  return {{i11, i12, i13, i14}, {i12, i22, i23, i24}, {i13, i23, i33, i34}, {i14, i24, i34, i44}};
}

/// K from the k_i; C has the same form in the c_i.
template <class T>
Matrix<T> joint_matrix(const Vector<T> &joint) {
  const T &k1 = joint[0], &k2 = joint[1], &k3 = joint[2], &k4 = joint[3];
  const T zero(0);
  return {{k1 + k2, -k2, zero, zero},
          {-k2, k2 + k3, -k3, zero},
          {zero, -k3, k3 + k4, -k4},
          {zero, zero, -k4, k4}};
}

template <class T>
Vector<T> coriolis(const Chain<T> &chain, const Vector<T> &theta, const Vector<T> &rate) {
  using std::sin;
  const T &l1 = chain.length[0], &l2 = chain.length[1], &l3 = chain.length[2],
          &l4 = chain.length[3];
  const T &m2 = chain.mass[1], &m3 = chain.mass[2], &m4 = chain.mass[3], &mc = chain.load_mass;
  const T &t1 = theta[0], &t2 = theta[1], &t3 = theta[2], &t4 = theta[3];
  const T &w1 = rate[0], &w2 = rate[1], &w3 = rate[2], &w4 = rate[3];
  return {l1 * l2 * (m2 / 2 + m3 + m4 + mc) * sin(t1 - t2) * w2 * w2 +
              l1 * l3 * (m3 / 2 + m4 + mc) * sin(t1 - t3) * w3 * w3 +
              l1 * l4 * (m4 / 2 + mc) * sin(t1 - t4) * w4 * w4,
          -l1 * l2 * (m2 / 2 + m3 + m4 + mc) * sin(t1 - t2) * w1 * w1 +
              l2 * l3 * (m3 / 2 + m4 + mc) * sin(t2 - t3) * w3 * w3 +
              l2 * l4 * (m4 / 2 + mc) * sin(t2 - t4) * w4 * w4,
          -l1 * l3 * (m3 / 2 + m4 + mc) * sin(t1 - t3) * w1 * w1 -
              l2 * l3 * (m3 / 2 + m4 + mc) * sin(t2 - t3) * w2 * w2 +
              l3 * l4 * (m4 / 2 + mc) * sin(t3 - t4) * w4 * w4,
          -l1 * l4 * (m4 / 2 + mc) * sin(t1 - t4) * w1 * w1 -
              l2 * l4 * (m4 / 2 + mc) * sin(t2 - t4) * w2 * w2 -
              l3 * l4 * (m4 / 2 + mc) * sin(t3 - t4) * w3 * w3};
}

template <class T>
Vector<T> gravity(const Chain<T> &chain, const Vector<T> &theta) {
  using std::sin;
  const T &l1 = chain.length[0], &l2 = chain.length[1], &l3 = chain.length[2],
          &l4 = chain.length[3];
  const T &m1 = chain.mass[0], &m2 = chain.mass[1], &m3 = chain.mass[2], &m4 = chain.mass[3];
  const T &mc = chain.load_mass, &g = chain.gravity;
  return {(m1 / 2 + m2 + m3 + m4 + mc) * g * l1 * sin(theta[0]),
          (m2 / 2 + m3 + m4 + mc) * g * l2 * sin(theta[1]),
          (m3 / 2 + m4 + mc) * g * l3 * sin(theta[2]), (m4 / 2 + mc) * g * l4 * sin(theta[3])};
}

}  // namespace catena::reference::four_links
