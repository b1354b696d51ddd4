// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reference/chain_constants.hpp"

namespace catena::reference {

/// Stiffness matrix K (N m/rad) from k_i, or damping matrix C (N m s/rad) from c_i: one value per
/// joint; tridiagonal, symmetric. Dissertation (4.11), with one departure: as printed, each inner
/// step ends with K(i, j) = K(j, i), which overwrites the -k_j just set with an entry not yet set
/// and leaves K diagonal. Here K starts at zero and K(j, i) is set inside the branch j = i + 1,
/// which gives (4.8)-(4.10).
template <class T>
Matrix<T> joint_matrix(const Vector<T>& joint) {
  const std::size_t n = joint.size();
  Matrix<T> matrix = zero_matrix<T>(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i == j && i + 1 < n) matrix[i][j] = joint[i] + joint[i + 1];
      if (i == j && i + 1 == n) matrix[i][j] = joint[i];
      if (j == i + 1) {
        matrix[i][j] = -joint[j];
        matrix[j][i] = matrix[i][j];
      }
    }
  }
  return matrix;
}

}  // namespace catena::reference
