// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

/// The equations of the dissertation, coded from its text only. Emitted models are compared with
/// them. They are templates on the scalar T, which needs + - * /, a conversion from small integers,
/// and sin and cos found by argument-dependent look-up: double, long double, a dual number, a GiNaC
/// expression. They are written for clarity, not for speed.
///
/// Indices: the dissertation counts links from 1, arrays count from 0. Link i of the text is entry
/// i - 1.
namespace catena::reference {

template <class T>
using Vector = std::vector<T>;

/// A matrix by rows: matrix[i][j].
template <class T>
using Matrix = std::vector<std::vector<T>>;

template <class T>
Matrix<T> zero_matrix(std::size_t size) {
  return Matrix<T>(size, Vector<T>(size, T(0)));
}

/// The constants of a chain; every vector has one entry per link (SI units, see
/// generated/catena_model.h).
template <class T>
struct Chain {
  Vector<T> length;     ///< l_i, m
  Vector<T> mass;       ///< m_i, kg, at the middle of the link
  Vector<T> inertia;    ///< I_Ri, kg m^2, about the link's own centre
  Vector<T> stiffness;  ///< k_i, N m/rad, on theta_i - theta_{i-1}
  Vector<T> damping;    ///< c_i, N m s/rad
  T load_mass;          ///< m_c, kg
  T gravity;            ///< g, m/s^2

  std::size_t links() const { return length.size(); }
};

/// m_c + sum_{k > j} m_k (kg): the mass below link j, counted from 0.
template <class T>
T mass_beyond(const Chain<T>& chain, std::size_t j) {
  T sum = chain.load_mass;
  for (std::size_t k = j + 1; k < chain.links(); ++k) sum = sum + chain.mass[k];
  return sum;
}

}  // namespace catena::reference
