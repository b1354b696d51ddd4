// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations whose matrix is symmetric, positive definite and semiseparable, in time
// proportional to n:
//
//     A_ij = row_i . column_j for j < i,  A_ii = diagonal_i.
#pragma once

#include "pair.hpp"
#include "scalar.hpp"

namespace catena {

/// What of the matrix is kept.
template <class T, int size, int rank>
struct SymmetricSemiseparableEntries {
  static_assert(rank > 0 || size == 1);
  static constexpr int n = size;
  static constexpr int rr = rank > 0 ? rank : 1;
  T row[rr][n], column[rr][n], diagonal[n];
};

/// The same, n known at run time, from 5 on, in arrays of the caller's.
template <class T, int rank>
struct SymmetricSemiseparableEntries<T, kAtRunTime, rank> {
  static_assert(rank > 0);
  static constexpr int rr = rank;
  int n;
  T *row[rr], *column[rr], *diagonal;
};

template <class T, int size, int rank>
struct SymmetricSemiseparable : SymmetricSemiseparableEntries<T, size, rank> {
  using Entries = SymmetricSemiseparableEntries<T, size, rank>;
  using Entries::column, Entries::diagonal, Entries::n, Entries::row, Entries::rr;

  /// Overwrites x, the right-hand side, with the solution. Returns 0, or the 1-based row whose
  /// pivot is not positive: then x is not to be used.
  int solve(T* x) const {
    if constexpr (size == kAtRunTime)
      return n == 5 ? solve_short<5>(x) : solve_from_both_ends(x);
    else if constexpr (size < 6)
      return solve_short<size>(x);
    else
      return solve_from_both_ends(x);
  }

  /// The whole matrix, row by row.
  void to_dense(T* matrix) const {
    for (int i = 0; i < n; ++i) {
      matrix[i * n + i] = diagonal[i];
      for (int j = 0; j < i; ++j) {
        T entry = T(0);
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) entry += row[r][i] * column[r][j];
        matrix[i * n + j] = matrix[j * n + i] = entry;
      }
    }
  }

 private:
  using Both = Pair<T>;  // what belongs to the top sweep, and to the bottom sweep

  // Rows 0, 1, ... are eliminated from the first on, rows n-1, n-2, ... from the last up. The two
  // sweeps do the same and do not depend on each other: one vector operation serves both. A step
  // waits for the one before, through W; so each takes two rows, whose pivots alpha and
  // beta - gamma^2 / alpha = determinant / alpha are divided by at the same time. Where the longest
  // wait allows it, products are formed once and shared.
  //
  // What couples the halves is a vector each way, sum = C' x_top and carried = R' x_bottom (C the
  // columns of the top, R the rows of the bottom), found from
  //
  //     sum = sum_0 - V carried,   carried = carried_0 - W sum,
  //     V = C' A_top^-1 C,         W = R' A_bottom^-1 R.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wvla"  // of a number of rows known at run time
  int solve_from_both_ends(T* x) const {
    const int m = n / 4 * 2;  // rows of the top sweep; those between are the bottom's last
    const Both zero{T(0), T(0)}, one{T(1), T(1)};
    Both scaled[m][rr], solved[m];
    Both w[rr][rr], carried[rr];
    CATENA_UNROLLED
    for (int r = 0; r < rr; ++r) {
      carried[r] = zero;
      CATENA_UNROLLED
      for (int s = 0; s < rr; ++s) w[r][s] = zero;
    }
#pragma GCC unroll 4
    for (int i = 0; i < m; i += 2) {
      // `own` couples a row to those left, `other` those left to it, which W reaches.
      Both own[2][rr], other[2][rr], pivot[2], y[2], reached[rr];
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        const int top = i + k, bottom = n - 1 - top;
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          own[k][r] = Both{column[r][top], row[r][bottom]};
          other[k][r] = Both{row[r][top], column[r][bottom]};
        }
        pivot[k] = Both{diagonal[top], diagonal[bottom]};
        y[k] = less_product(Both{x[top], x[bottom]}, other[k], carried);
      }
      pivot[0] = reduced_pivot(pivot[0], other[0], w);
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        own[0][r] = less_product_with_row(own[0][r], w, r, other[0]);
        reached[r] = product_with_row(w, r, other[1]);
        own[1][r] = own[1][r] - reached[r];
      }
      pivot[1] = less_product(pivot[1], other[1], reached);
      const Both gamma = product(own[0], other[1]);
      const Both determinant = negative_multiply_add(gamma, gamma, pivot[0] * pivot[1]);
      if (!positive_pivot(pivot[0].first())) return i + 1;
      if (!positive_pivot(pivot[0].second())) return n - i;
      if (!positive_pivot(determinant.first())) return i + 2;
      if (!positive_pivot(determinant.second())) return n - i - 1;
      const Both reciprocal[2] = {one / pivot[0], pivot[0] / determinant};
      const Both factor = gamma * reciprocal[0];
      y[1] = negative_multiply_add(factor, y[0], y[1]);
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r)
        own[1][r] = negative_multiply_add(factor, own[0][r], own[1][r]);
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        solved[i + k] = y[k] * reciprocal[k];
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          scaled[i + k][r] = own[k][r] * reciprocal[k];
          carried[r] = multiply_add(own[k][r], solved[i + k], carried[r]);
        }
      }
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        CATENA_UNROLLED
        for (int s = 0; s <= r; ++s) {
          const Both first = multiply_add(scaled[i][r], own[0][s], w[r][s]);
          w[r][s] = multiply_add(own[1][r] * own[1][s], reciprocal[1], first);
        }
      }
    }

    T v_top[rr][rr], w_bottom[rr][rr], sum[rr], known[rr];
    CATENA_UNROLLED
    for (int r = 0; r < rr; ++r) {
      sum[r] = carried[r].first();
      known[r] = carried[r].second();
      CATENA_UNROLLED
      for (int s = 0; s <= r; ++s) {
        v_top[r][s] = v_top[s][r] = w[r][s].first();
        w_bottom[r][s] = w_bottom[s][r] = w[r][s].second();
      }
    }
    T middle_scaled[3][rr];
    for (int j = n - 1 - m; j >= m; --j) {
      if (!eliminate(j, w_bottom, known, middle_scaled[j - m], x[j])) return j + 1;
    }
    join(v_top, w_bottom, sum, known);
    for (int j = m; j < n - m; ++j) {
      x[j] = less_product(x[j], middle_scaled[j - m], sum);
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) sum[r] = multiply_add(column[r][j], x[j], sum[r]);
    }

    // x = solved - scaled . from, and `from` grows by other x: with x put in, `from` becomes
    // (1 - other scaled') from + other solved, and a step waits for two operations.
    Both from[rr];
    CATENA_UNROLLED
    for (int r = 0; r < rr; ++r) from[r] = Both{known[r], sum[r]};
#pragma GCC unroll 6
    for (int i = m - 1; i >= 0; --i) {
      const Both solution = less_product(solved[i], scaled[i], from);
      x[i] = solution.first();
      x[n - 1 - i] = solution.second();
      Both next[rr];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        const Both other{row[r][i], column[r][n - 1 - i]};
        next[r] = other * solved[i];
        CATENA_UNROLLED
        for (int s = 0; s < rank; ++s) {
          if (s != r) next[r] = negative_multiply_add(other * scaled[i][s], from[s], next[r]);
        }
        next[r] = multiply_add(negative_multiply_add(other, scaled[i][r], one), from[r], next[r]);
      }
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) from[r] = next[r];
    }
    return 0;
  }

#pragma GCC diagnostic pop

  // The same for one row, as the bottom's last: overwrites x, its right-hand side, with what a
  // solution would be if nothing were left.
  bool eliminate(int j, T (&w)[rr][rr], T* carried, T* scaled, T& x) const {
    T other[rr];
    CATENA_UNROLLED
    for (int r = 0; r < rr; ++r) other[r] = column[r][j];
    const T pivot = reduced_pivot(diagonal[j], other, w);
    if (!positive_pivot(pivot)) return false;
    const T reciprocal = T(1) / pivot;
    const T y = less_product(x, other, carried);
    T own[rr];
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) own[r] = less_product_with_row(row[r][j], w, r, other);
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      CATENA_UNROLLED
      for (int s = 0; s < rank; ++s) w[r][s] = multiply_add(own[r] * own[s], reciprocal, w[r][s]);
      scaled[r] = own[r] * reciprocal;
      carried[r] = multiply_add(scaled[r], y, carried[r]);
    }
    x = y * reciprocal;
    return true;
  }

  template <class Number>
  static Number product(const Number* a, const Number* b) {
    Number sum = a[0] * b[0];
    CATENA_UNROLLED
    for (int r = 1; r < rank; ++r) sum = multiply_add(a[r], b[r], sum);
    return sum;
  }

  // number - a . b
  template <class Number>
  static Number less_product(const Number& number, const Number* a, const Number* b) {
    Number rest = number;
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) rest = negative_multiply_add(a[r], b[r], rest);
    return rest;
  }

  // Entry r of the product of a symmetric matrix, of which the lower triangle is read, and a
  // vector.
  template <class Number>
  static Number product_with_row(const Number (&w)[rr][rr], int r, const Number* vector) {
    Number sum = w[r][0] * vector[0];
    CATENA_UNROLLED
    for (int s = 1; s < rank; ++s) sum = multiply_add(s <= r ? w[r][s] : w[s][r], vector[s], sum);
    return sum;
  }
  template <class Number>
  static Number less_product_with_row(const Number& number, const Number (&w)[rr][rr], int r,
                                      const Number* vector) {
    Number rest = number;
    CATENA_UNROLLED
    for (int s = 0; s < rank; ++s)
      rest = negative_multiply_add(s <= r ? w[r][s] : w[s][r], vector[s], rest);
    return rest;
  }

  // diagonal - other' W other; the products of `other` alone do not wait for W.
  template <class Number>
  static Number reduced_pivot(const Number& diagonal, const Number* other,
                              const Number (&w)[rr][rr]) {
    const Number reduced = negative_multiply_add(other[0] * other[0], w[0][0], diagonal);
    if constexpr (rank == 1) {
      return reduced;
    } else {
      Number rest = (other[1] * other[1]) * w[1][1];
      CATENA_UNROLLED
      for (int r = 2; r < rank; ++r) rest = multiply_add(other[r] * other[r], w[r][r], rest);
      CATENA_UNROLLED
      for (int r = 1; r < rank; ++r) {
        CATENA_UNROLLED
        for (int s = 0; s < r; ++s) {
          const Number half = other[r] * other[s];
          rest = multiply_add(half + half, w[r][s], rest);
        }
      }
      return reduced - rest;
    }
  }

  // (1 - V W) sum = sum_0 - V carried_0, by elimination; then carried.
  static void join(const T (&v)[rr][rr], const T (&w)[rr][rr], T* sum, T* carried) {
    T a[rr][rr];
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      CATENA_UNROLLED
      for (int s = 0; s < rank; ++s) {
        a[r][s] = T(r == s ? 1 : 0);
        CATENA_UNROLLED
        for (int t = 0; t < rank; ++t) a[r][s] = negative_multiply_add(v[r][t], w[t][s], a[r][s]);
        sum[r] = negative_multiply_add(v[r][s], carried[s], sum[r]);
      }
    }
    if constexpr (rank == 2) {  // the second pivot again without waiting for the first's reciprocal
      const T determinant = negative_multiply_add(a[0][1], a[1][0], a[0][0] * a[1][1]);
      const T reciprocal = T(1) / a[0][0], second = a[0][0] / determinant;
      sum[1] = negative_multiply_add(a[1][0] * reciprocal, sum[0], sum[1]) * second;
      sum[0] = negative_multiply_add(a[0][1], sum[1], sum[0]) * reciprocal;
    } else {
      CATENA_UNROLLED
      for (int k = 0; k < rank; ++k) {
        CATENA_UNROLLED
        for (int r = k + 1; r < rank; ++r) {
          const T factor = a[r][k] / a[k][k];
          CATENA_UNROLLED
          for (int s = k + 1; s < rank; ++s)
            a[r][s] = negative_multiply_add(factor, a[k][s], a[r][s]);
          sum[r] = negative_multiply_add(factor, sum[k], sum[r]);
        }
      }
      CATENA_UNROLLED
      for (int k = rank - 1; k >= 0; --k) {
        CATENA_UNROLLED
        for (int s = k + 1; s < rank; ++s) sum[k] = negative_multiply_add(a[k][s], sum[s], sum[k]);
        sum[k] = sum[k] / a[k][k];
      }
    }
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      CATENA_UNROLLED
      for (int s = 0; s < rank; ++s)
        carried[r] = negative_multiply_add(w[r][s], sum[s], carried[r]);
    }
  }

  // A few rows are solved faster as a full matrix, A = L D L' with D in the diagonal's place. Two
  // columns at a time: the second pivot is (a b - c c) / a, so that its reciprocal need not wait
  // for the first one's.
  template <int rows>
  int solve_short(T* right) const {
    T a[rows][rows], x[rows], reciprocal[rows];
    CATENA_UNROLLED
    for (int i = 0; i < rows; ++i) {
      x[i] = right[i];
      a[i][i] = diagonal[i];
      CATENA_UNROLLED
      for (int j = 0; j < i; ++j) {
        a[i][j] = row[0][i] * column[0][j];
        CATENA_UNROLLED
        for (int r = 1; r < rank; ++r) a[i][j] = multiply_add(row[r][i], column[r][j], a[i][j]);
      }
    }
    CATENA_UNROLLED
    for (int j = 0; j < rows; j += 2) {
      if (!positive_pivot(a[j][j])) return j + 1;
      reciprocal[j] = T(1) / a[j][j];
      if (j + 1 < rows) {
        const T determinant =
            negative_multiply_add(a[j + 1][j], a[j + 1][j], a[j][j] * a[j + 1][j + 1]);
        if (!positive_pivot(determinant)) return j + 2;
        reciprocal[j + 1] = a[j][j] / determinant;
      }
      const int end = j + 2 < rows ? j + 2 : rows;
      CATENA_UNROLLED
      for (int k = j; k < end; ++k) {
        CATENA_UNROLLED
        for (int i = k + 1; i < rows; ++i) {
          const T scaled = a[i][k] * reciprocal[k];
          x[i] = negative_multiply_add(scaled, x[k], x[i]);
          CATENA_UNROLLED
          for (int c = k + 1; c <= i; ++c)
            a[i][c] = negative_multiply_add(scaled, a[c][k], a[i][c]);
        }
      }
    }
    CATENA_UNROLLED
    for (int j = rows - 1; j >= 0; --j) {
      CATENA_UNROLLED
      for (int i = rows - 1; i > j; --i) x[j] = negative_multiply_add(a[i][j], x[i], x[j]);
      right[j] = x[j] = x[j] * reciprocal[j];
    }
    return 0;
  }
};

}  // namespace catena
