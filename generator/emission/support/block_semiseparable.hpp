// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations of models in space whose matrix is symmetric, positive definite and semiseparable in
// blocks of block x block, in time proportional to the number of links:
//
//     A_ij = row_i column_j' for j < i,  A_ii = diagonal_i,     row_i, column_j: block x rank.
//
// The blocks of size one, of models in the plane, are in semiseparable.hpp; there more of the work is
// arranged around the one division of a row. The elimination is the same: from both ends at once, the
// two sweeps as one in pairs of numbers, with
//
//     sum = sum_0 - V carried,   carried = carried_0 - W sum,
//     V = C' A_top^-1 C,         W = R' A_bottom^-1 R
//
// between the halves (C the columns of the top, R the rows of the bottom).
//
// Entry (a, r) of row_i and of column_i is in array a * rank + r, entry (a, b), b <= a, of diagonal_i in
// array a (a + 1) / 2 + b. Component a of link i of a vector is at a * links + i.
#pragma once

#include "pair.hpp"
#include "scalar.hpp"

namespace catena {

template <class T, int links, int rank, int block>
struct SymmetricBlockSemiseparable {
  static constexpr int kDiagonal = block * (block + 1) / 2;
  T row[block * rank][links], column[block * rank][links], diagonal[kDiagonal][links];

  /// Overwrites x, the right-hand side, with the solution. Returns 0, or the 1-based number of an
  /// unknown whose pivot is not positive: then x is not to be used.
  int solve(T* x) const {
    constexpr int m = links / 2;  // of each sweep; one link may be left in the middle
    Row<Both> rows[m > 0 ? m : 1];
    Coupling<Both> both;
    both.clear();
    for (int i = 0; i < m; ++i) {
      const int bottom = links - 1 - i;
      Both own[block][rank], other[block][rank], pivot[kDiagonal];
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          own[a][r] = Both{column[a * rank + r][i], row[a * rank + r][bottom]};
          other[a][r] = Both{row[a * rank + r][i], column[a * rank + r][bottom]};
        }
        rows[i].solved[a] = Both{x[a * links + i], x[a * links + bottom]};
      }
      CATENA_UNROLLED
      for (int k = 0; k < kDiagonal; ++k) pivot[k] = Both{diagonal[k][i], diagonal[k][bottom]};
      const int failed = eliminate(own, other, pivot, both, rows[i]);
      if (failed > 0) {
        const int a = failed - 1;
        return a * links + (positive_pivot(pivot[first_of(a)].first()) ? bottom : i) + 1;
      }
    }

    T v[rank][rank], w[rank][rank], sum[rank], carried[rank];
    Coupling<T> lower;
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      sum[r] = both.carried[r].first();
      lower.carried[r] = both.carried[r].second();
      CATENA_UNROLLED
      for (int s = 0; s <= r; ++s) {
        v[r][s] = v[s][r] = both.w[r][s].first();
        lower.w[r][s] = both.w[r][s].second();
      }
    }
    Row<T> middle;
    if constexpr (links % 2 == 1) {
      T own[block][rank], other[block][rank], pivot[kDiagonal];
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          own[a][r] = row[a * rank + r][m];
          other[a][r] = column[a * rank + r][m];
        }
        middle.solved[a] = x[a * links + m];
      }
      CATENA_UNROLLED
      for (int k = 0; k < kDiagonal; ++k) pivot[k] = diagonal[k][m];
      const int failed = eliminate(own, other, pivot, lower, middle);
      if (failed > 0) return (failed - 1) * links + m + 1;
    }
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      carried[r] = lower.carried[r];
      CATENA_UNROLLED
      for (int s = 0; s <= r; ++s) w[r][s] = w[s][r] = lower.w[r][s];
    }
    join(v, w, sum, carried);
    Both from[rank];
    if constexpr (links % 2 == 1) {
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) x[a * links + m] = middle.solution(a, sum);
    }
    // The bottom depends on what is above it, the middle too; the top on what is below it.
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      T above = sum[r];
      if constexpr (links % 2 == 1) {
        CATENA_UNROLLED
        for (int a = 0; a < block; ++a)
          above = multiply_add(column[a * rank + r][m], x[a * links + m], above);
      }
      from[r] = Both{carried[r], above};
    }
    for (int i = m - 1; i >= 0; --i) {
      const int bottom = links - 1 - i;
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) rows[i].solved[a] = rows[i].solution(a, from);
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        const Both& solution = rows[i].solved[a];
        x[a * links + i] = solution.first();
        x[a * links + bottom] = solution.second();
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          from[r] = multiply_add(Both{row[a * rank + r][i], column[a * rank + r][bottom]}, solution,
                                 from[r]);
      }
    }
    return 0;
  }

  /// The whole matrix, row by row.
  void to_dense(T* matrix) const {
    constexpr int n = block * links;
    for (int i = 0; i < links; ++i) {
      for (int j = 0; j <= i; ++j) {
        for (int a = 0; a < block; ++a) {
          for (int b = 0; b < block; ++b) {
            T entry = T(0);
            if (i == j) {
              entry = diagonal[a >= b ? first_of(a) - a + b : first_of(b) - b + a][i];
            } else {
              for (int r = 0; r < rank; ++r)
                entry += row[a * rank + r][i] * column[b * rank + r][j];
            }
            matrix[(a * links + i) * n + b * links + j] = entry;
            matrix[(b * links + j) * n + a * links + i] = entry;
          }
        }
      }
    }
  }

 private:
  using Both = Pair<T>;  // what belongs to the top sweep, and to the bottom sweep

  /// Where entry (a, a) of a symmetric block is.
  static constexpr int first_of(int a) { return a * (a + 1) / 2 + a; }

  /// What a row's solution is: solved - scaled . from.
  template <class Number>
  struct Row {
    Number scaled[block][rank], solved[block];
    Number solution(int a, const Number* from) const {
      Number rest = solved[a];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) rest = negative_multiply_add(scaled[a][r], from[r], rest);
      return rest;
    }
  };

  /// Of the rows that are eliminated: W, of which the lower triangle is kept, and carried.
  template <class Number>
  struct Coupling {
    Number w[rank][rank], carried[rank];
    void clear() {
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        carried[r] = number(Number(), 0);
        CATENA_UNROLLED
        for (int s = 0; s <= r; ++s) w[r][s] = number(Number(), 0);
      }
    }
    const Number& entry(int r, int s) const { return s <= r ? w[r][s] : w[s][r]; }
  };

  /// The argument before it tells of which type.
  static T number(const T&, int value) { return T(value); }
  static Both number(const Both&, int value) { return {T(value), T(value)}; }

  static bool both_positive(const T& pivot) { return positive_pivot(pivot); }
  static bool both_positive(const Both& pivot) {
    return positive_pivot(pivot.first()) && positive_pivot(pivot.second());
  }

  /// Eliminates a row, whose right-hand side is in result.solved. `own` couples it to those left,
  /// `other` those left to it, which W reaches; both are used up. Returns 0, or the 1-based row of the
  /// block whose pivot is not positive; it is in pivot.
  template <class Number>
  static int eliminate(Number (&own)[block][rank], const Number (&other)[block][rank],
                       Number (&pivot)[kDiagonal], Coupling<Number>& coupling,
                       Row<Number>& result) {
    Number y[block];
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      y[a] = result.solved[a];
      Number reached[rank];  // row a of other W
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        y[a] = negative_multiply_add(other[a][r], coupling.carried[r], y[a]);
        reached[r] = coupling.entry(r, 0) * other[a][0];
        CATENA_UNROLLED
        for (int s = 1; s < rank; ++s)
          reached[r] = multiply_add(coupling.entry(r, s), other[a][s], reached[r]);
        own[a][r] = own[a][r] - reached[r];
      }
      CATENA_UNROLLED
      for (int b = 0; b <= a; ++b) {
        Number& entry = pivot[first_of(a) - a + b];
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          entry = negative_multiply_add(reached[r], other[b][r], entry);
      }
    }
    // pivot = L D L', and own and y become L^-1 own and L^-1 y
    Number reciprocal[block], factor[block][block];
    CATENA_UNROLLED
    for (int k = 0; k < block; ++k) {
      const Number& d = pivot[first_of(k)];
      if (!both_positive(d)) return k + 1;
      reciprocal[k] = number(d, 1) / d;
      CATENA_UNROLLED
      for (int a = k + 1; a < block; ++a) {
        factor[a][k] = pivot[first_of(a) - a + k] * reciprocal[k];
        CATENA_UNROLLED
        for (int b = k + 1; b <= a; ++b)
          pivot[first_of(a) - a + b] = negative_multiply_add(
              factor[a][k], pivot[first_of(b) - b + k], pivot[first_of(a) - a + b]);
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          own[a][r] = negative_multiply_add(factor[a][k], own[k][r], own[a][r]);
        y[a] = negative_multiply_add(factor[a][k], y[k], y[a]);
      }
    }
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      result.solved[a] = y[a] * reciprocal[a];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        result.scaled[a][r] = own[a][r] * reciprocal[a];
        coupling.carried[r] = multiply_add(result.scaled[a][r], y[a], coupling.carried[r]);
        CATENA_UNROLLED
        for (int s = 0; s <= r; ++s)
          coupling.w[r][s] = multiply_add(result.scaled[a][r], own[a][s], coupling.w[r][s]);
      }
    }
    CATENA_UNROLLED
    for (int k = block - 1; k > 0; --k) {
      CATENA_UNROLLED
      for (int a = 0; a < k; ++a) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          result.scaled[a][r] =
              negative_multiply_add(factor[k][a], result.scaled[k][r], result.scaled[a][r]);
        result.solved[a] = negative_multiply_add(factor[k][a], result.solved[k], result.solved[a]);
      }
    }
    return 0;
  }

  /// (1 - V W) sum = sum_0 - V carried_0, by elimination; then carried.
  static void join(const T (&v)[rank][rank], const T (&w)[rank][rank], T* sum, T* carried) {
    T a[rank][rank];
    for (int r = 0; r < rank; ++r) {
      for (int s = 0; s < rank; ++s) {
        a[r][s] = T(r == s ? 1 : 0);
        for (int t = 0; t < rank; ++t) a[r][s] = negative_multiply_add(v[r][t], w[t][s], a[r][s]);
        sum[r] = negative_multiply_add(v[r][s], carried[s], sum[r]);
      }
    }
    for (int k = 0; k < rank; ++k) {
      for (int r = k + 1; r < rank; ++r) {
        const T factor = a[r][k] / a[k][k];
        for (int s = k + 1; s < rank; ++s)
          a[r][s] = negative_multiply_add(factor, a[k][s], a[r][s]);
        sum[r] = negative_multiply_add(factor, sum[k], sum[r]);
      }
    }
    for (int k = rank - 1; k >= 0; --k) {
      for (int s = k + 1; s < rank; ++s) sum[k] = negative_multiply_add(a[k][s], sum[s], sum[k]);
      sum[k] = sum[k] / a[k][k];
    }
    for (int r = 0; r < rank; ++r) {
      for (int s = 0; s < rank; ++s)
        carried[r] = negative_multiply_add(w[r][s], sum[s], carried[r]);
    }
  }
};

}  // namespace catena
