// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations of models with coordinates of no link, those of the load or the multipliers of a held end:
// those of block_quasiseparable.hpp, N, with a few more rows and columns,
//
//     ( N  C ) (x)
//     ( R  E ) (m)
//
// in time proportional to the number of links, by the Schur complement S = E - R N^-1 C.
//
// Entry (a, k) of border_column and border_row is in array a * border + k: of row a of link i and unknown k of
// m, and of row k beyond the links and unknown a of link i. m stands after all links. Entry (k, l) of E is
// corner[k * border + l].
#pragma once

#include "block_quasiseparable.hpp"

namespace catena {

template <class T, int links, int upper_rank, int lower_rank, int block, int border>
struct Bordered : BlockQuasiseparable<T, links, upper_rank, lower_rank, block> {
  using Inner = BlockQuasiseparable<T, links, upper_rank, lower_rank, block>;
  static constexpr int n = block * links;
  T border_column[block * border][links], border_row[block * border][links];
  T corner[border * border];
  T schur[border][border];

  /// Factors in place; afterwards border_column holds N^-1 C and schur the inverse of S. Returns 0, or the
  /// 1-based number of an unknown whose pivot vanished.
  int factor() {
    if (const int failed = Inner::factor()) return failed;
    for (int k = 0; k < border; ++k) {
      T column[n];
      for (int a = 0; a < block; ++a)
        for (int i = 0; i < links; ++i) column[a * links + i] = border_column[a * border + k][i];
      Inner::solve(column);
      for (int a = 0; a < block; ++a)
        for (int i = 0; i < links; ++i) border_column[a * border + k][i] = column[a * links + i];
    }
    Square complement, inverse;
    for (int k = 0; k < border; ++k) {
      for (int l = 0; l < border; ++l) {
        T sum = corner[k * border + l];
        for (int a = 0; a < block; ++a)
          for (int i = 0; i < links; ++i)
            sum = negative_multiply_add(border_row[a * border + k][i],
                                        border_column[a * border + l][i], sum);
        complement.at[k][l] = sum;
      }
    }
    if (const int failed = Inner::template invert<border>(complement, inverse)) return n + failed;
    for (int k = 0; k < border; ++k)
      for (int l = 0; l < border; ++l) schur[k][l] = inverse.at[k][l];
    return 0;
  }

  /// Overwrites x, the right-hand side, with the solution. X is T, or holds several right-hand sides
  /// (directions.hpp).
  template <class X>
  void solve(X* x) const {
    X right[border];
    for (int k = 0; k < border; ++k) {
      right[k] = x[n + k];
      x[n + k] = X(0);
    }
    Inner::solve(x);
    // Where N^-1 b is much larger than the solution, as that of a chain without what holds it, the first time
    // leaves more than a rounding of the last rows; the second time solves for what is left.
    for (int time = 0; time < 2; ++time) {
      X rest[border];
      for (int k = 0; k < border; ++k) {
        rest[k] = right[k];
        for (int l = 0; l < border; ++l)
          rest[k] = negative_multiply_add(corner[k * border + l], x[n + l], rest[k]);
        for (int a = 0; a < block; ++a)
          for (int i = 0; i < links; ++i)
            rest[k] =
                negative_multiply_add(border_row[a * border + k][i], x[a * links + i], rest[k]);
      }
      for (int k = 0; k < border; ++k) {
        X change = X(0);
        for (int l = 0; l < border; ++l) change = multiply_add(schur[k][l], rest[l], change);
        x[n + k] = x[n + k] + change;
        for (int a = 0; a < block; ++a)
          for (int i = 0; i < links; ++i)
            x[a * links + i] =
                negative_multiply_add(border_column[a * border + k][i], change, x[a * links + i]);
      }
    }
  }

  /// The same with the transpose of the matrix.
  void solve_transposed(T* x) const {
    T rest[border];
    for (int k = 0; k < border; ++k) {
      rest[k] = x[n + k];
      for (int a = 0; a < block; ++a)
        for (int i = 0; i < links; ++i)
          rest[k] =
              negative_multiply_add(border_column[a * border + k][i], x[a * links + i], rest[k]);
    }
    for (int k = 0; k < border; ++k) {
      T multiplier = T(0);
      for (int l = 0; l < border; ++l) multiplier = multiply_add(schur[l][k], rest[l], multiplier);
      x[n + k] = multiplier;
      for (int a = 0; a < block; ++a)
        for (int i = 0; i < links; ++i)
          x[a * links + i] =
              negative_multiply_add(border_row[a * border + k][i], multiplier, x[a * links + i]);
    }
    Inner::solve_transposed(x);
  }

  /// The whole matrix, row by row. Not after factor().
  void to_dense(T* matrix) const {
    constexpr int whole = n + border;
    Inner::to_dense(matrix);
    // from rows of n to rows of n + border, the last first
    for (int i = n - 1; i >= 0; --i)
      for (int j = n - 1; j >= 0; --j) matrix[i * whole + j] = matrix[i * n + j];
    for (int k = 0; k < border; ++k) {
      for (int l = 0; l < border; ++l) matrix[(n + k) * whole + n + l] = corner[k * border + l];
      for (int a = 0; a < block; ++a) {
        for (int i = 0; i < links; ++i) {
          matrix[(a * links + i) * whole + n + k] = border_column[a * border + k][i];
          matrix[(n + k) * whole + a * links + i] = border_row[a * border + k][i];
        }
      }
    }
  }

 private:
  using Square = typename Inner::template Matrix<border, border>;
};

}  // namespace catena
