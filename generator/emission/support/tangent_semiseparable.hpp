// SPDX-License-Identifier: BSD-3-Clause
//
// The mass matrix of models in space, in time proportional to the number of links. The second derivative
// of the vector q along a link is
//
//     a = E x + (what is along q, which is known),
//
// E (3 x 2) two tangents: of length one, perpendicular to each other and to q. The equations of x have a
// matrix that is symmetric, positive definite and semiseparable in blocks of 2 x 2,
//
//     A_ij = row_i column_j' for j < i,  A_ii = diagonal_i,     row_i, column_j: 2 x rank.
//
// The elimination is that of semiseparable.hpp, which has numbers in the places of blocks: from both ends at
// once, the two sweeps as one in pairs of numbers, with
//
//     sum = sum_0 - V carried,   carried = carried_0 - W sum,
//     V = C' A_top^-1 C,         W = R' A_bottom^-1 R
//
// between the halves (C the columns of the top, R the rows of the bottom).
//
// Entry (k, r) of row_i and of column_i is in array k * rank + r; entries (0, 0), (1, 0) and (1, 1) of
// diagonal_i are in arrays 0, 1, 2; component c of tangent k is in array 3 k + c. Tangent k of link i in a vector
// of x is at k * links + i, component c of link i in a vector of coordinates at c * links + i.
#pragma once

#include "pair.hpp"
#include "scalar.hpp"

namespace catena {

template <class T, int links, int rank>
struct TangentSemiseparable {
  T row[2 * rank][links], column[2 * rank][links], diagonal[3][links];
  T tangent[6][links];
  T right[2 * links];  ///< of the equations of x
  T along[links];      ///< the inertia of q along itself, which to_dense() alone reads

  /// Adds E x to a, which has what is along q; overwrites `right`. Returns 0, or the 1-based number of a
  /// coordinate of the link whose pivot is not positive: then a is not to be used.
  int solve(T* a) {
    const int failed = solve_for_tangents(right);
    if (failed > 0) return failed;
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < links; ++i) {
        T& component = a[c * links + i];
        component = multiply_add(tangent[c][i], right[i], component);
        component = multiply_add(tangent[3 + c][i], right[links + i], component);
      }
    }
    return 0;
  }

  /// The matrix by coordinates, row by row.
  void to_dense(T* matrix) const {
    constexpr int n = 3 * links;
    for (int i = 0; i < links; ++i) {
      for (int j = 0; j <= i; ++j) {
        T block[2][2];
        for (int k = 0; k < 2; ++k) {
          for (int l = 0; l < 2; ++l) {
            block[k][l] = i == j ? diagonal[k + l][i] : T(0);
            for (int r = 0; j < i && r < rank; ++r)
              block[k][l] += row[k * rank + r][i] * column[l * rank + r][j];
          }
        }
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) {
            T entry = i == j ? along[i] * normal(c, i) * normal(d, i) : T(0);
            for (int k = 0; k < 2; ++k) {
              for (int l = 0; l < 2; ++l)
                entry += tangent[3 * k + c][i] * block[k][l] * tangent[3 * l + d][j];
            }
            matrix[(c * links + i) * n + d * links + j] = entry;
            matrix[(d * links + j) * n + c * links + i] = entry;
          }
        }
      }
    }
  }

 private:
  using Both = Pair<T>;  // what belongs to the top sweep, and to the bottom sweep

  /// Component c of the unit vector that is perpendicular to the tangents of link i.
  T normal(int c, int i) const {
    const int d = (c + 1) % 3, e = (c + 2) % 3;
    return tangent[d][i] * tangent[3 + e][i] - tangent[e][i] * tangent[3 + d][i];
  }

  /// Overwrites x, the right-hand side, with the solution.
  int solve_for_tangents(T* x) const {
    constexpr int m = links / 2;  // of each sweep; one link may be left in the middle
    Row<Both> rows[m > 0 ? m : 1];
    Coupling<Both> both;
    both.clear();
    for (int i = 0; i < m; ++i) {
      const int bottom = links - 1 - i;
      Both own[2][rank], other[2][rank], pivot[3];
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          own[k][r] = Both{column[k * rank + r][i], row[k * rank + r][bottom]};
          other[k][r] = Both{row[k * rank + r][i], column[k * rank + r][bottom]};
        }
        rows[i].solved[k] = Both{x[k * links + i], x[k * links + bottom]};
      }
      CATENA_UNROLLED
      for (int k = 0; k < 3; ++k) pivot[k] = Both{diagonal[k][i], diagonal[k][bottom]};
      const int failed = eliminate(own, other, pivot, both, rows[i]);
      if (failed > 0) {
        const int k = failed - 1;
        return k * links + (positive_pivot(pivot[2 * k].first()) ? bottom : i) + 1;
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
      T own[2][rank], other[2][rank], pivot[3];
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) {
          own[k][r] = row[k * rank + r][m];
          other[k][r] = column[k * rank + r][m];
        }
        middle.solved[k] = x[k * links + m];
      }
      CATENA_UNROLLED
      for (int k = 0; k < 3; ++k) pivot[k] = diagonal[k][m];
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
      for (int k = 0; k < 2; ++k) x[k * links + m] = middle.solution(k, sum);
    }
    // The bottom depends on what is above it, the middle too; the top on what is below it.
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      T above = sum[r];
      if constexpr (links % 2 == 1) {
        CATENA_UNROLLED
        for (int k = 0; k < 2; ++k)
          above = multiply_add(column[k * rank + r][m], x[k * links + m], above);
      }
      from[r] = Both{carried[r], above};
    }
    for (int i = m - 1; i >= 0; --i) {
      const int bottom = links - 1 - i;
      Both solution[2];
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        solution[k] = rows[i].solution(k, from);
        x[k * links + i] = solution[k].first();
        x[k * links + bottom] = solution[k].second();
      }
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          from[r] = multiply_add(Both{row[k * rank + r][i], column[k * rank + r][bottom]},
                                 solution[k], from[r]);
      }
    }
    return 0;
  }

  /// What a link's solution is: solved - scaled . from.
  template <class Number>
  struct Row {
    Number scaled[2][rank], solved[2];
    Number solution(int k, const Number* from) const {
      Number rest = solved[k];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) rest = negative_multiply_add(scaled[k][r], from[r], rest);
      return rest;
    }
  };

  /// Of the links that are eliminated: W, of which the lower triangle is kept, and carried.
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

  /// Eliminates a link, whose right-hand side is in result.solved. `own` couples it to those left,
  /// `other` those left to it, which W reaches; `own` is used up. Both pivots are divided by at the same time: the
  /// second is determinant / first. Returns 0, or the 1-based tangent whose pivot is not positive; its sign is
  /// in pivot[2 * tangent - 2].
  template <class Number>
  static int eliminate(Number (&own)[2][rank], const Number (&other)[2][rank], Number (&pivot)[3],
                       Coupling<Number>& coupling, Row<Number>& result) {
    Number y[2], reached[2][rank];  // rows of other W
    CATENA_UNROLLED
    for (int k = 0; k < 2; ++k) {
      y[k] = result.solved[k];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        y[k] = negative_multiply_add(other[k][r], coupling.carried[r], y[k]);
        reached[k][r] = coupling.entry(r, 0) * other[k][0];
        CATENA_UNROLLED
        for (int s = 1; s < rank; ++s)
          reached[k][r] = multiply_add(coupling.entry(r, s), other[k][s], reached[k][r]);
        own[k][r] = own[k][r] - reached[k][r];
      }
    }
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      pivot[0] = negative_multiply_add(reached[0][r], other[0][r], pivot[0]);
      pivot[1] = negative_multiply_add(reached[0][r], other[1][r], pivot[1]);
      pivot[2] = negative_multiply_add(reached[1][r], other[1][r], pivot[2]);
    }
    const Number first = pivot[0];
    pivot[2] = negative_multiply_add(pivot[1], pivot[1], first * pivot[2]);
    if (!both_positive(first)) return 1;
    if (!both_positive(pivot[2])) return 2;
    const Number reciprocal[2] = {number(first, 1) / first, first / pivot[2]};
    const Number factor = pivot[1] * reciprocal[0];
    y[1] = negative_multiply_add(factor, y[0], y[1]);
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) own[1][r] = negative_multiply_add(factor, own[0][r], own[1][r]);
    CATENA_UNROLLED
    for (int k = 0; k < 2; ++k) {
      result.solved[k] = y[k] * reciprocal[k];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        result.scaled[k][r] = own[k][r] * reciprocal[k];
        coupling.carried[r] = multiply_add(result.scaled[k][r], y[k], coupling.carried[r]);
        CATENA_UNROLLED
        for (int s = 0; s <= r; ++s)
          coupling.w[r][s] = multiply_add(result.scaled[k][r], own[k][s], coupling.w[r][s]);
      }
    }
    result.solved[0] = negative_multiply_add(factor, result.solved[1], result.solved[0]);
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r)
      result.scaled[0][r] = negative_multiply_add(factor, result.scaled[1][r], result.scaled[0][r]);
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
