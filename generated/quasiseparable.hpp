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
// Elimination from the last row up. What is left of the matrix after the rows below j are gone is of
// the same form, with the correction
//
//     A_ik - upper_row_i . W lower_column_k  (and W's neighbours for row and column j alone),
//
// W an upper_rank x lower_rank matrix that each step updates by a rank-one term. No pivoting: stable
// for positive definite matrices, as the mass matrix is, and for Newton matrices M + (small) that an
// integrator's step size keeps near one.
#pragma once

#include "scalar.hpp"

namespace catena {

template <class T, int n, int upper_rank, int lower_rank>
struct Quasiseparable {
  static constexpr int ru = upper_rank > 0 ? upper_rank : 1;
  static constexpr int rl = lower_rank > 0 ? lower_rank : 1;
  T upper_row[n][ru], upper_column[n][ru], lower_row[n][rl], lower_column[n][rl];
  T diagonal[n], below[n], above[n];

  /// Factors in place; afterwards the members hold what solve() needs:
  ///   diagonal      reciprocal pivots d
  ///   upper_column, lower_row      those of the triangular factors
  ///   upper_row, lower_row         each row times its d
  ///   above_i, below_i             the neighbour's whole entry (semiseparable part included) times d_i
  /// Returns 0, or the 1-based row whose pivot vanished.
  ///
  /// The steps depend on each other through W, so that the time of a sweep is the latency of its longest
  /// chain of operations: products that do not need W are formed apart from it.
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

  /// Overwrites x, the right-hand side, with the solution. The neighbour's value enters by above and
  /// below; the sums `carried` hold what lies beyond it, so that a step waits for one product and one
  /// difference.
  void solve(T* x) const {
    T carried[ru], sum[rl];
    for (int r = 0; r < ru; ++r) carried[r] = T(0);
    for (int s = 0; s < rl; ++s) sum[s] = T(0);
    T last = T(0), last_but_one = T(0);
    for (int j = n - 1; j >= 0; --j) {
      if (j + 2 < n) {
        for (int r = 0; r < upper_rank; ++r) carried[r] += upper_column[j + 2][r] * last_but_one;
      }
      T rest = x[j] * diagonal[j];
      for (int r = 0; r < upper_rank; ++r) rest -= upper_row[j][r] * carried[r];
      last_but_one = last;
      last = j + 1 < n ? rest - above[j] * last : rest;
      x[j] = last;
    }
    for (int j = 1; j < n; ++j) {  // last is x[0]
      if (j > 1) {
        for (int s = 0; s < lower_rank; ++s) sum[s] += lower_column[j - 2][s] * last_but_one;
      }
      T rest = x[j];
      for (int s = 0; s < lower_rank; ++s) rest -= lower_row[j][s] * sum[s];
      last_but_one = last;
      last = rest - below[j] * last;
      x[j] = last;
    }
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

/// The symmetric, positive definite case without tridiagonal part:
///
///     A_ij = row_i . column_j  for j < i,  A_ii = diagonal_i.
template <class T, int n, int rank>
struct SymmetricSemiseparable {
  static constexpr int rr = rank > 0 ? rank : 1;
  T row[n][rr], column[n][rr], diagonal[n];

  /// Overwrites x, the right-hand side, with the solution; row, column and diagonal are used up.
  /// Returns 0, or the 1-based row whose pivot is not positive.
  ///
  /// Rows 0..m-1 are eliminated from the first on, rows n-1..m from the last up. The two sweeps do
  /// not depend on each other, so a processor works on both at once: half the latency of one
  /// sweep. What couples the halves is a vector each way, sum = C' x_top and carried = R' x_bottom
  /// (C the columns of the top, R the rows of the bottom), found from
  ///
  ///     sum = sum_0 - V carried,   carried = carried_0 - W sum,
  ///     V = C' A_top^-1 C,         W = R' A_bottom^-1 R.
  int solve_in_place(T* x) {
    if constexpr (n < 6) return solve_short(x);
    constexpr int m = n / 2;
    T v[rr][rr], w[rr][rr], sum[rr], carried[rr];
    for (int r = 0; r < rr; ++r) {
      sum[r] = carried[r] = T(0);
      for (int s = 0; s < rr; ++s) v[r][s] = w[r][s] = T(0);
    }
    for (int j = n - 1; j >= 2 * m; --j) {
      if (!eliminate(row[j], column[j], diagonal[j], x[j], w, carried)) return j + 1;
    }
    for (int i = 0; i < m; ++i) {
      const int j = 2 * m - 1 - i;
      const bool top = eliminate(column[i], row[i], diagonal[i], x[i], v, sum);
      const bool bottom = eliminate(row[j], column[j], diagonal[j], x[j], w, carried);
      if (!top) return i + 1;
      if (!bottom) return j + 1;
    }
    join(v, w, sum, carried);
    for (int i = m - 1; i >= 0; --i) {
      const int j = 2 * m - 1 - i;
      substitute(column[i], row[i], diagonal[i], x[i], carried);
      substitute(row[j], column[j], diagonal[j], x[j], sum);
    }
    for (int j = 2 * m; j < n; ++j) substitute(row[j], column[j], diagonal[j], x[j], sum);
    return 0;
  }

  /// The whole matrix, row by row. Not after solve_in_place().
  void to_dense(T* matrix) const {
    for (int i = 0; i < n; ++i) {
      matrix[i * n + i] = diagonal[i];
      for (int j = 0; j < i; ++j) {
        T entry = T(0);
        for (int r = 0; r < rank; ++r) entry += row[i][r] * column[j][r];
        matrix[i * n + j] = matrix[j * n + i] = entry;
      }
    }
  }

 private:
  // A few rows are solved faster as a full matrix: A = L D L', L D in the lower triangle.
  int solve_short(T* x) {
    T a[n][n];
    for (int i = 0; i < n; ++i) {
      a[i][i] = diagonal[i];
      for (int j = 0; j < i; ++j) {
        a[i][j] = row[i][0] * column[j][0];
        for (int r = 1; r < rank; ++r) a[i][j] += row[i][r] * column[j][r];
      }
    }
    for (int j = 0; j < n; ++j) {
      if (!positive_pivot(a[j][j])) return j + 1;
      diagonal[j] = T(1) / a[j][j];
      x[j] = x[j] * diagonal[j];
      for (int i = j + 1; i < n; ++i) {
        const T scaled = a[i][j] * diagonal[j];
        for (int k = j + 1; k <= i; ++k) a[i][k] -= scaled * a[k][j];
        x[i] -= a[i][j] * x[j];
      }
    }
    for (int j = n - 1; j >= 0; --j) {
      T rest = T(0);
      for (int i = j + 1; i < n; ++i) rest += a[i][j] * x[i];
      x[j] -= rest * diagonal[j];
    }
    return 0;
  }

  // One step of an elimination. `own` couples the row to those left, `other` those left to it.
  static bool eliminate(T* own, const T* other, T& pivot, T& x, T (&w)[rr][rr], T* carried) {
    for (int r = 0; r < rank; ++r) {
      T product = T(0);
      for (int s = 0; s < rank; ++s) product += (s <= r ? w[r][s] : w[s][r]) * other[s];
      pivot -= other[r] * product;
      x -= other[r] * carried[r];
      own[r] -= product;
    }
    if (!positive_pivot(pivot)) return false;
    pivot = T(1) / pivot;
    x = x * pivot;
    for (int r = 0; r < rank; ++r) {
      const T scaled = own[r] * pivot;
      for (int s = 0; s <= r; ++s) w[r][s] += scaled * own[s];
      carried[r] += own[r] * x;
    }
    return true;
  }

  static void substitute(const T* own, const T* other, const T& reciprocal, T& x, T* known) {
    T product = T(0);
    for (int r = 0; r < rank; ++r) product += own[r] * known[r];
    x -= product * reciprocal;
    for (int r = 0; r < rank; ++r) known[r] += other[r] * x;
  }

  // (1 - V W) sum = sum_0 - V carried_0, by elimination; then carried.
  static void join(const T (&v)[rr][rr], const T (&w)[rr][rr], T* sum, T* carried) {
    const auto at = [](const T(&a)[rr][rr], int r, int s) -> const T& {
      return s <= r ? a[r][s] : a[s][r];
    };
    T a[rr][rr];
    for (int r = 0; r < rank; ++r) {
      for (int s = 0; s < rank; ++s) {
        a[r][s] = T(r == s ? 1 : 0);
        for (int t = 0; t < rank; ++t) a[r][s] -= at(v, r, t) * at(w, t, s);
        sum[r] -= at(v, r, s) * carried[s];
      }
    }
    for (int k = 0; k < rank; ++k) {
      for (int r = k + 1; r < rank; ++r) {
        const T factor = a[r][k] / a[k][k];
        for (int s = k + 1; s < rank; ++s) a[r][s] -= factor * a[k][s];
        sum[r] -= factor * sum[k];
      }
    }
    for (int k = rank - 1; k >= 0; --k) {
      for (int s = k + 1; s < rank; ++s) sum[k] -= a[k][s] * sum[s];
      sum[k] = sum[k] / a[k][k];
    }
    for (int r = 0; r < rank; ++r) {
      for (int s = 0; s < rank; ++s) carried[r] -= at(w, r, s) * sum[s];
    }
  }
};

}  // namespace catena
