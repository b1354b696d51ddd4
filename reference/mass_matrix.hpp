// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

#include "reference/chain_constants.hpp"

namespace catena::reference {

/// Mass matrix M (kg m^2), symmetric, links x links; theta in rad. Dissertation (4.3) and (4.4),
/// which call it I and give the upper triangle; the lower one follows from symmetry.
template <class T>
Matrix<T> mass_matrix(const Chain<T>& chain, const Vector<T>& theta) {
  using std::cos;
  const std::size_t n = chain.links();
  const auto& l = chain.length;
  const auto& m = chain.mass;
  Matrix<T> inertia = zero_matrix<T>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      // I(i, j) = l_i l_j (m_j / 2 + m_c + sum_{k = j + 1}^n m_k) cos(theta_i - theta_j)
      inertia[i][j] = l[i] * l[j] * (m[j] / 2 + mass_beyond(chain, j)) * cos(theta[i] - theta[j]);
      inertia[j][i] = inertia[i][j];
    }
    // I(i, i) = l_i^2 [m_i / 4 + m_c + sum_{k = i + 1}^n m_k] + I_Ri
    inertia[i][i] = l[i] * l[i] * (m[i] / 4 + mass_beyond(chain, i)) + chain.inertia[i];
  }
  return inertia;
}

}  // namespace catena::reference
