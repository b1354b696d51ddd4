// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations whose matrix is tridiagonal plus semiseparable, in time proportional to n.
//
//     A_ij = upper_row_i . upper_column_j                 j > i + 1
//     A_ij = upper_row_i . upper_column_j + above_i       j = i + 1
//     A_ii = diagonal_i
//     A_ij = lower_row_i . lower_column_j + below_i       j = i - 1
//     A_ij = lower_row_i . lower_column_j                 j < i - 1
//
// Elimination from the last row up. What is left of the matrix after the rows below j are gone is
// of the same form, with the correction
//
//     A_ik - upper_row_i . W lower_column_k  (and W's neighbours for row and column j alone),
//
// W an upper_rank x lower_rank matrix that each step updates by a rank-one term. No pivoting:
// stable for positive definite matrices, as the mass matrix is, and for Newton matrices M + (small)
// that an integrator's step size keeps near one.
#pragma once

#include "scalar.hpp"

namespace catena {

/// What of the matrix is kept.
template <class T, int size, int upper_rank, int lower_rank>
struct QuasiseparableEntries {
  static constexpr int n = size;
  static constexpr int ru = upper_rank > 0 ? upper_rank : 1;
  static constexpr int rl = lower_rank > 0 ? lower_rank : 1;
  T upper_row[n][ru], upper_column[n][ru], lower_row[n][rl], lower_column[n][rl];
  T diagonal[n], below[n], above[n];
};

/// The same, n known at run time, in memory of the caller's: numbers(n) of them.
template <class T, int upper_rank, int lower_rank>
struct QuasiseparableEntries<T, kAtRunTime, upper_rank, lower_rank> {
  static constexpr int ru = upper_rank > 0 ? upper_rank : 1;
  static constexpr int rl = lower_rank > 0 ? lower_rank : 1;
  static constexpr int numbers(int n) { return n * (2 * ru + 2 * rl + 3); }

  QuasiseparableEntries(int size, T* memory)
      : n(size),
        upper_row(reinterpret_cast<T (*)[ru]>(memory)),
        upper_column(upper_row + n),
        lower_row(reinterpret_cast<T (*)[rl]>(upper_column + n)),
        lower_column(lower_row + n),
        diagonal(*(lower_column + n)),
        below(diagonal + n),
        above(below + n) {}

  const int n;
  T (*const upper_row)[ru], (*const upper_column)[ru];
  T (*const lower_row)[rl], (*const lower_column)[rl];
  T *const diagonal, *const below, *const above;
};

template <class T, int size, int upper_rank, int lower_rank>
struct Quasiseparable : QuasiseparableEntries<T, size, upper_rank, lower_rank> {
  using Entries = QuasiseparableEntries<T, size, upper_rank, lower_rank>;
  using Entries::above, Entries::below, Entries::diagonal, Entries::Entries;
  using Entries::lower_column, Entries::lower_row, Entries::upper_column, Entries::upper_row;
  using Entries::n, Entries::ru, Entries::rl;

  /// Factors in place; afterwards the members hold what solve() needs:
  ///   diagonal      reciprocal pivots d
  ///   upper_column, lower_row      those of the triangular factors
  ///   upper_row, lower_row         each row times its d
  ///   above_i, below_i             the neighbour's whole entry (semiseparable part included) times
  ///   d_i
  /// Returns 0, or the 1-based row whose pivot vanished.
  ///
  /// The steps depend on each other through W, so that the time of a sweep is the latency of its
  /// longest chain of operations: products that do not need W are formed apart from it.
  int factor() {
    T w[ru][rl], w_column[ru], w_row[rl], w_corner = T(0);
    for (int r = 0; r < ru; ++r) {
      w_column[r] = T(0);
      for (int s = 0; s < rl; ++s) w[r][s] = T(0);
    }
    for (int s = 0; s < rl; ++s) w_row[s] = T(0);
    for (int j = n - 1; j >= 0; --j) {
      T* column = upper_column[j];
      T* row = lower_row[j];
      T known = w_corner;
      for (int r = 0; r < upper_rank; ++r) {
        T terms = upper_row[j][r] * w_column[r];
        for (int s = 0; s < lower_rank; ++s)
          terms += upper_row[j][r] * lower_column[j][s] * w[r][s];
        known += terms;
      }
      for (int s = 0; s < lower_rank; ++s) known += lower_column[j][s] * w_row[s];
      const T pivot = diagonal[j] - known;
      for (int r = 0; r < upper_rank; ++r) {
        T w_q = w_column[r];
        for (int s = 0; s < lower_rank; ++s) w_q += w[r][s] * lower_column[j][s];
        column[r] -= w_q;
      }
      for (int s = 0; s < lower_rank; ++s) {
        T w_p = w_row[s];
        for (int r = 0; r < upper_rank; ++r) w_p += w[r][s] * upper_row[j][r];
        row[s] -= w_p;
      }
      if (!usable_pivot(pivot)) return j + 1;
      const T reciprocal = T(1) / pivot;
      diagonal[j] = reciprocal;
      if (j == 0) break;
      const T before = above[j - 1] * reciprocal;
      for (int r = 0; r < upper_rank; ++r) {
        for (int s = 0; s < lower_rank; ++s) w[r][s] += column[r] * row[s] * reciprocal;
        w_column[r] = column[r] * below[j] * reciprocal;
      }
      for (int s = 0; s < lower_rank; ++s) w_row[s] = before * row[s];
      w_corner = before * below[j];
    }
    for (int j = 0; j < n; ++j) {
      if (j + 1 < n) {
        for (int r = 0; r < upper_rank; ++r) above[j] += upper_row[j][r] * upper_column[j + 1][r];
        above[j] *= diagonal[j];
      }
      if (j > 0) {
        for (int s = 0; s < lower_rank; ++s) below[j] += lower_row[j][s] * lower_column[j - 1][s];
        below[j] *= diagonal[j];
      }
      for (int r = 0; r < upper_rank; ++r) upper_row[j][r] *= diagonal[j];
      for (int s = 0; s < lower_rank; ++s) lower_row[j][s] *= diagonal[j];
    }
    return 0;
  }

  /// Overwrites x, the right-hand side, with the solution. The neighbour's value enters by above
  /// and below; the sums `carried` hold what lies beyond it, so that a step waits for one product
  /// and one difference. X is T, or holds several right-hand sides (directions.hpp).
  template <class X>
  void solve(X* x) const {
    X carried[ru], sum[rl];
    for (int r = 0; r < ru; ++r) carried[r] = X(0);
    for (int s = 0; s < rl; ++s) sum[s] = X(0);
    X last = X(0), last_but_one = X(0);
    for (int j = n - 1; j >= 0; --j) {
      if (j + 2 < n) {
        for (int r = 0; r < upper_rank; ++r) carried[r] += upper_column[j + 2][r] * last_but_one;
      }
      X rest = x[j] * diagonal[j];
      for (int r = 0; r < upper_rank; ++r) rest -= upper_row[j][r] * carried[r];
      last_but_one = last;
      last = j + 1 < n ? rest - above[j] * last : rest;
      x[j] = last;
    }
    for (int j = 1; j < n; ++j) {  // last is x[0]
      if (j > 1) {
        for (int s = 0; s < lower_rank; ++s) sum[s] += lower_column[j - 2][s] * last_but_one;
      }
      X rest = x[j];
      for (int s = 0; s < lower_rank; ++s) rest -= lower_row[j][s] * sum[s];
      last_but_one = last;
      last = rest - below[j] * last;
      x[j] = last;
    }
  }

  /// The same with the transpose of the matrix.
  void solve_transposed(T* x) const {
    T carried[ru], sum[rl];
    for (int r = 0; r < ru; ++r) carried[r] = T(0);
    for (int s = 0; s < rl; ++s) sum[s] = T(0);
    for (int j = n - 2; j >= 0; --j) {
      if (j + 2 < n) {
        for (int s = 0; s < lower_rank; ++s) sum[s] += lower_row[j + 2][s] * x[j + 2];
      }
      for (int s = 0; s < lower_rank; ++s) x[j] -= lower_column[j][s] * sum[s];
      x[j] -= below[j + 1] * x[j + 1];
    }
    // x is divided by the pivots where the rows after it have used it undivided
    for (int j = 1; j < n; ++j) {
      if (j > 1) {
        for (int r = 0; r < upper_rank; ++r) carried[r] += upper_row[j - 2][r] * x[j - 2];
      }
      for (int r = 0; r < upper_rank; ++r) x[j] -= upper_column[j][r] * carried[r];
      x[j] -= above[j - 1] * x[j - 1];
    }
    for (int j = 0; j < n; ++j) x[j] *= diagonal[j];
  }

  /// The whole matrix, row by row. Not after factor().
  void to_dense(T* matrix) const {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        T entry = i == j ? diagonal[i] : T(0);
        if (j > i) {
          for (int r = 0; r < upper_rank; ++r) entry += upper_row[i][r] * upper_column[j][r];
          if (j == i + 1) entry += above[i];
        } else if (j < i) {
          for (int s = 0; s < lower_rank; ++s) entry += lower_row[i][s] * lower_column[j][s];
          if (j == i - 1) entry += below[i];
        }
        matrix[i * n + j] = entry;
      }
    }
  }
};

}  // namespace catena
