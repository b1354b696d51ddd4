// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations with a full, symmetric, positive definite matrix: for models whose mass matrix
// has no structure to exploit.
#pragma once

#include "scalar.hpp"

namespace catena {

/// Solves A x = b, A = L D L' (n x n, row by row; overwritten), x holding b before and x after.
/// Returns 0, or the 1-based row whose pivot is not positive.
template <class T>
inline int solve_symmetric(int n, T* a, T* x) {
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < j; ++k) {
      const T scaled = a[j * n + k] * a[k * n + k];
      a[j * n + j] -= a[j * n + k] * scaled;
      for (int i = j + 1; i < n; ++i) a[i * n + j] -= a[i * n + k] * scaled;
    }
    if (!positive_pivot(a[j * n + j])) return j + 1;
    for (int i = j + 1; i < n; ++i) a[i * n + j] = a[i * n + j] / a[j * n + j];
  }
  for (int i = 0; i < n; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= a[i * n + k] * x[k];
  }
  for (int i = 0; i < n; ++i) x[i] = x[i] / a[i * n + i];
  for (int i = n - 1; i >= 0; --i) {
    for (int k = i + 1; k < n; ++k) x[i] -= a[k * n + i] * x[k];
  }
  return 0;
}
template <int n, class T>
inline int solve_symmetric(T* a, T* x) {
  return solve_symmetric(n, a, x);
}

}  // namespace catena
