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
// An array for each entry of these vectors, so that what fills them vectorises.
//
// Elimination from the last row up. What is left of the matrix after the rows below j are gone is
// of the same form, with the correction
//
//     A_ik - upper_row_i . W lower_column_k,
//
// W an upper_rank x lower_rank matrix that each step updates by a rank-one term; in row and column
// j - 1 the whole entries beside the diagonal take part too. No pivoting: stable for positive
// definite matrices, as the mass matrix is, and for Newton matrices M + (small) that an
// integrator's step size keeps near one.
#pragma once

#include "scalar.hpp"

namespace catena {

/// What of the matrix is kept.
template <class T, int size, int upper_rank, int lower_rank>
struct QuasiseparableEntries {
  static constexpr int n = size;
  static constexpr int ru = upper_rank > 0 ? upper_rank : 1;
  static constexpr int rl = lower_rank > 0 ? lower_rank : 1;
  T upper_row[ru][n], upper_column[ru][n], lower_row[rl][n], lower_column[rl][n];
  T diagonal[n], below[n], above[n];
};

/// The same, n known at run time, in memory of the caller's: numbers(n) of them.
template <class T, int upper_rank, int lower_rank>
struct QuasiseparableEntries<T, kAtRunTime, upper_rank, lower_rank> {
  static constexpr int ru = upper_rank > 0 ? upper_rank : 1;
  static constexpr int rl = lower_rank > 0 ? lower_rank : 1;
  static constexpr int numbers(int n) { return n * (2 * ru + 2 * rl + 3); }

  QuasiseparableEntries(int size, T* memory) : n(size) {
    for (int r = 0; r < ru; ++r, memory += n) upper_row[r] = memory;
    for (int r = 0; r < ru; ++r, memory += n) upper_column[r] = memory;
    for (int s = 0; s < rl; ++s, memory += n) lower_row[s] = memory;
    for (int s = 0; s < rl; ++s, memory += n) lower_column[s] = memory;
    diagonal = memory;
    below = diagonal + n;
    above = below + n;
  }

  const int n;
  T *upper_row[ru], *upper_column[ru], *lower_row[rl], *lower_column[rl];
  T *diagonal, *below, *above;
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
  /// A step waits for the division of the one before. So it prepares what of the next row does not
  /// need the quotient, and the pivots, one product away from it, come first.
  int factor() {
    T w[ru][rl], column[ru], row[rl];  // of the rows below j; of row j, corrected
    CATENA_UNROLLED
    for (int r = 0; r < ru; ++r) {
      column[r] = upper_column[r][n - 1];
      CATENA_UNROLLED
      for (int s = 0; s < rl; ++s) w[r][s] = T(0);
    }
    CATENA_UNROLLED
    for (int s = 0; s < rl; ++s) row[s] = lower_row[s][n - 1];
    above[n - 1] = T(0);
    T pivot = diagonal[n - 1];
    for (int j = n - 1; j >= 0; --j) {
      if (!usable_pivot(pivot)) return j + 1;
      const T reciprocal = T(1) / pivot;
      diagonal[j] = reciprocal;
      above[j] *= reciprocal;
      T scaled_row[rl];
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r) {
        upper_column[r][j] = column[r];
        upper_row[r][j] *= reciprocal;
      }
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s) lower_row[s][j] = scaled_row[s] = row[s] * reciprocal;
      if (j == 0) break;

      T upper[ru], lower[rl];
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r) upper[r] = upper_row[r][j - 1];
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s) lower[s] = lower_column[s][j - 1];
      T entry_above = above[j - 1], entry_below = below[j];
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r)
        entry_above = multiply_add(upper[r], column[r], entry_above);
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s)
        entry_below = multiply_add(row[s], lower[s], entry_below);
      pivot = diagonal[j - 1];
      T next_column[ru], next_row[rl];
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r) {
        T w_lower = T(0);
        CATENA_UNROLLED
        for (int s = 0; s < lower_rank; ++s) w_lower = multiply_add(w[r][s], lower[s], w_lower);
        pivot = negative_multiply_add(upper[r], w_lower, pivot);
        next_column[r] = upper_column[r][j - 1] - w_lower;
      }
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s) {
        next_row[s] = lower_row[s][j - 1];
        CATENA_UNROLLED
        for (int r = 0; r < upper_rank; ++r)
          next_row[s] = negative_multiply_add(upper[r], w[r][s], next_row[s]);
      }
      pivot = negative_multiply_add(entry_above * entry_below, reciprocal, pivot);
      above[j - 1] = entry_above;
      below[j] = entry_below * reciprocal;
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r) {
        CATENA_UNROLLED
        for (int s = 0; s < lower_rank; ++s)
          w[r][s] = multiply_add(column[r], scaled_row[s], w[r][s]);
        column[r] = negative_multiply_add(column[r], below[j], next_column[r]);
      }
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s)
        row[s] = negative_multiply_add(entry_above, scaled_row[s], next_row[s]);
    }
    return 0;
  }

  /// Overwrites x, the right-hand side, with the solution. The neighbour's value enters by above
  /// and below; the sums `carried` hold what lies beyond it, so that a step waits for one product
  /// and one difference. X is T, or holds several right-hand sides (directions.hpp).
  template <class X>
  void solve(X* x) const {
    X carried[ru], sum[rl];
    CATENA_UNROLLED
    for (int r = 0; r < ru; ++r) carried[r] = X(0);
    CATENA_UNROLLED
    for (int s = 0; s < rl; ++s) sum[s] = X(0);
    X last = X(0), last_but_one = X(0);
    for (int j = n - 1; j >= 0; --j) {
      if (j + 2 < n) {
        CATENA_UNROLLED
        for (int r = 0; r < upper_rank; ++r)
          carried[r] = multiply_add(upper_column[r][j + 2], last_but_one, carried[r]);
      }
      X rest = x[j] * diagonal[j];
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r)
        rest = negative_multiply_add(upper_row[r][j], carried[r], rest);
      last_but_one = last;
      last = j + 1 < n ? negative_multiply_add(above[j], last, rest) : rest;
      x[j] = last;
    }
    for (int j = 1; j < n; ++j) {  // last is x[0]
      if (j > 1) {
        CATENA_UNROLLED
        for (int s = 0; s < lower_rank; ++s)
          sum[s] = multiply_add(lower_column[s][j - 2], last_but_one, sum[s]);
      }
      X rest = x[j];
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s)
        rest = negative_multiply_add(lower_row[s][j], sum[s], rest);
      last_but_one = last;
      last = negative_multiply_add(below[j], last, rest);
      x[j] = last;
    }
  }

  /// The same with the transpose of the matrix.
  void solve_transposed(T* x) const {
    T carried[ru], sum[rl];
    CATENA_UNROLLED
    for (int r = 0; r < ru; ++r) carried[r] = T(0);
    CATENA_UNROLLED
    for (int s = 0; s < rl; ++s) sum[s] = T(0);
    for (int j = n - 2; j >= 0; --j) {
      if (j + 2 < n) {
        CATENA_UNROLLED
        for (int s = 0; s < lower_rank; ++s)
          sum[s] = multiply_add(lower_row[s][j + 2], x[j + 2], sum[s]);
      }
      CATENA_UNROLLED
      for (int s = 0; s < lower_rank; ++s)
        x[j] = negative_multiply_add(lower_column[s][j], sum[s], x[j]);
      x[j] = negative_multiply_add(below[j + 1], x[j + 1], x[j]);
    }
    // x is divided by the pivots where the rows after it have used it undivided
    for (int j = 1; j < n; ++j) {
      if (j > 1) {
        CATENA_UNROLLED
        for (int r = 0; r < upper_rank; ++r)
          carried[r] = multiply_add(upper_row[r][j - 2], x[j - 2], carried[r]);
      }
      CATENA_UNROLLED
      for (int r = 0; r < upper_rank; ++r)
        x[j] = negative_multiply_add(upper_column[r][j], carried[r], x[j]);
      x[j] = negative_multiply_add(above[j - 1], x[j - 1], x[j]);
    }
    for (int j = 0; j < n; ++j) x[j] *= diagonal[j];
  }

  /// The whole matrix, row by row. Not after factor().
  void to_dense(T* matrix) const {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        T entry = i == j ? diagonal[i] : T(0);
        if (j > i) {
          for (int r = 0; r < upper_rank; ++r) entry += upper_row[r][i] * upper_column[r][j];
          if (j == i + 1) entry += above[i];
        } else if (j < i) {
          for (int s = 0; s < lower_rank; ++s) entry += lower_row[s][i] * lower_column[s][j];
          if (j == i - 1) entry += below[i];
        }
        matrix[i * n + j] = entry;
      }
    }
  }
};

}  // namespace catena
