// SPDX-License-Identifier: BSD-3-Clause
//
// The mass matrix of models in space, in time proportional to the number of links. The second derivatives
// of a link's unit vector e and of its coordinates q are
//
//     e'' = E x + (what is known),   q'' = |q| E x + (what is known),
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
// `isotropic`: row_i, column_i and diagonal_i are numbers times E', E' and the unit matrix; arrays 0 have these.
// Else entry (k, r) of row_i and of column_i is in array k * rank + r; entries (0, 0), (1, 0) and (1, 1) of
// diagonal_i are in arrays 0, 1, 2; component c of tangent k is in array 3 k + c. Tangent k of link i in a vector
// of x is at k * links + i, component c of link i in a vector of coordinates at c * links + i.
#pragma once

#include <cstddef>

#include "pair.hpp"
#include "scalar.hpp"

namespace catena {

template <class T, int links, int rank, bool isotropic = false>
struct TangentSemiseparable {
  /// An array begins at a multiple of a register of 8 numbers, where it has as many.
  static constexpr int kPlaces = links < 8 ? links : (links + 7) / 8 * 8;
  static constexpr std::size_t kAligned = links < 8 ? alignof(T) : 8 * sizeof(double);
  using Rows = T[isotropic ? 1 : 2 * rank][kPlaces];
  alignas(kAligned) Rows row;
  alignas(kAligned) Rows column;
  alignas(kAligned) T diagonal[isotropic ? 1 : 3][kPlaces];
  alignas(kAligned) T tangent[6][kPlaces];
  alignas(kAligned) T size[kPlaces];  ///< |q|
  T right[2 * links];                 ///< of the equations of x
  T along[links];  ///< the inertia of q along itself, which to_dense() alone reads

  /// Adds |q| E x to a, which has what is known; overwrites `right`. Returns 0, or the 1-based number of a
  /// coordinate of the link whose pivot is not positive: then a is not to be used.
  int solve(T* a) {
    const int failed = solve_for_tangents(right);
    if (failed > 0) return failed;
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < links; ++i) {
        const T turned =
            multiply_add(tangent[3 + c][i], right[links + i], tangent[c][i] * right[i]);
        a[c * links + i] = multiply_add(size[i], turned, a[c * links + i]);
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
            block[k][l] = T(0);
            if (i == j && !isotropic) block[k][l] = diagonal[k + l][i];
            if (i == j && isotropic && k == l) block[k][l] = diagonal[0][i];
            for (int r = 0; j < i && r < rank; ++r)
              block[k][l] += part(At{i}, row, row, k, r) * part(At{j}, column, column, l, r);
          }
        }
        for (int c = 0; c < 3; ++c) {
          for (int d = 0; d < 3; ++d) {
            T entry = i == j ? along[i] * normal(c, i) * normal(d, i) : T(0);
            for (int k = 0; k < 2; ++k) {
              for (int l = 0; l < 2; ++l)
                entry += tangent[3 * k + c][i] * block[k][l] * tangent[3 * l + d][j] /
                         (size[i] * size[j]);
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

  /// Numbers of a link from arrays of the top sweep and of the bottom sweep: of one link, and of one in each.
  struct At {
    int i;
    T operator()(const T*, const T* array) const { return array[i]; }
  };
  struct AtBoth {
    int top, bottom;
    Both operator()(const T* top_array, const T* bottom_array) const {
      return {top_array[top], bottom_array[bottom]};
    }
  };
  /// Entry (k, r) of a link's row or column.
  template <class Entry>
  auto part(const Entry& entry, const Rows& top, const Rows& bottom, int k, int r) const {
    if constexpr (isotropic)
      return entry(top[0], bottom[0]) * entry(tangent[3 * k + r], tangent[3 * k + r]);
    else
      return entry(top[k * rank + r], bottom[k * rank + r]);
  }

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
      const AtBoth entry{i, bottom};
      if (!eliminate(entry, x, both, rows[i])) {
        const Both* const pivot = rows[i].solved;
        const int k = all_positive(pivot[0], pivot[0]) ? 1 : 0;
        return k * links + (positive_pivot(pivot[k].first()) ? bottom : i) + 1;
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
      if (!eliminate(At{m}, x, lower, middle))
        return (positive_pivot(middle.solved[0]) ? links : 0) + m + 1;
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
          above = multiply_add(part(At{m}, column, column, k, r), x[k * links + m], above);
      }
      from[r] = Both{carried[r], above};
    }
    for (int i = m - 1; i >= 0; --i) {
      const int bottom = links - 1 - i;
      const AtBoth entry{i, bottom};
      Both solution[2];
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        solution[k] = rows[i].solution(k, from);
        x[k * links + i] = solution[k].first();
        x[k * links + bottom] = solution[k].second();
      }
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        CATENA_UNROLLED
        for (int k = 0; k < 2; ++k)
          from[r] = multiply_add(part(entry, row, column, k, r), solution[k], from[r]);
      }
    }
    return 0;
  }

  /// What a link's solution is: solved + scaled . from.
  template <class Number>
  struct Row {
    Number scaled[2][rank], solved[2];
    Number solution(int k, const Number* from) const {
      Number rest = solved[k];
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) rest = multiply_add(scaled[k][r], from[r], rest);
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

  static bool all_positive(const T& a, const T& b) {
    return positive_pivot(a) && positive_pivot(b);
  }
  static bool all_positive(const Both& a, const Both& b) { return Both::all_positive(a, b); }

  /// Eliminates a link of the right-hand side x; `entry` takes its numbers from an array of the top sweep and one
  /// of the bottom sweep. `own` couples it to those left, `other` those left to it, which W reaches. The block
  /// that is left of its diagonal is inverted as adjugate / determinant: only one product waits for the division.
  /// False if a pivot is not positive; both are in result.solved then.
  ///
  /// It has to be part of the loop, or W goes through memory from link to link.
  template <class Entry, class Number>
  [[gnu::always_inline]] bool eliminate(const Entry& entry, const T* x, Coupling<Number>& coupling,
                                        Row<Number>& result) const {
    Number own[2][rank], y[2], block[2], beside;  // own, beside: with the opposite sign
    {
      Number other[2][rank], reached[2][rank];  // reached: rows of other W
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k) {
        constexpr int kLast = isotropic ? 0 : 2;
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) other[k][r] = part(entry, row, column, k, r);
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) reached[k][r] = product(coupling, r, other[k]);
        block[k] = entry(diagonal[k * kLast], diagonal[k * kLast]);
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          block[k] = negative_multiply_add(reached[k][r], other[k][r], block[k]);
        y[k] = entry(x + k * links, x + k * links) - product(coupling.carried, other[k]);
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r) own[k][r] = less_part(reached[k][r], entry, k, r);
      }
      beside = product(reached[0], other[1]);
      if constexpr (!isotropic) beside = beside - entry(diagonal[1], diagonal[1]);
    }
    const Number determinant = negative_multiply_add(beside, beside, block[0] * block[1]);
    if (!all_positive(block[0], determinant)) {
      result.solved[0] = block[0];
      result.solved[1] = determinant;
      return false;
    }
    const Number reciprocal = number(beside, 1) / determinant;
    Number adjusted[2][rank];  // adjugate own
    CATENA_UNROLLED
    for (int k = 0; k < 2; ++k) {
      result.solved[k] = multiply_add(beside, y[1 - k], block[1 - k] * y[k]) * reciprocal;
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r) {
        adjusted[k][r] = multiply_add(beside, own[1 - k][r], block[1 - k] * own[k][r]);
        result.scaled[k][r] = adjusted[k][r] * reciprocal;
      }
    }
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      CATENA_UNROLLED
      for (int s = 0; s <= r; ++s) {
        const Number both = multiply_add(own[1][r], adjusted[1][s], own[0][r] * adjusted[0][s]);
        coupling.w[r][s] = multiply_add(both, reciprocal, coupling.w[r][s]);
      }
      CATENA_UNROLLED
      for (int k = 0; k < 2; ++k)
        coupling.carried[r] =
            negative_multiply_add(own[k][r], result.solved[k], coupling.carried[r]);
    }
    return true;
  }

  /// A number less the entry of what couples a link to those left.
  template <class Number, class Entry>
  Number less_part(const Number& from, const Entry& entry, int k, int r) const {
    if constexpr (isotropic)
      return negative_multiply_add(entry(column[0], row[0]),
                                   entry(tangent[3 * k + r], tangent[3 * k + r]), from);
    else
      return from - part(entry, column, row, k, r);
  }

  template <class Number>
  static Number product(const Number* a, const Number* b) {
    Number sum = a[0] * b[0];
    CATENA_UNROLLED
    for (int r = 1; r < rank; ++r) sum = multiply_add(a[r], b[r], sum);
    return sum;
  }
  /// Row r of W with a vector.
  template <class Number>
  static Number product(const Coupling<Number>& coupling, int r, const Number* vector) {
    Number sum = coupling.entry(r, 0) * vector[0];
    CATENA_UNROLLED
    for (int s = 1; s < rank; ++s) sum = multiply_add(coupling.entry(r, s), vector[s], sum);
    return sum;
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
    T reciprocal[rank];
    for (int k = 0; k < rank; ++k) {
      reciprocal[k] = T(1) / a[k][k];
      for (int r = k + 1; r < rank; ++r) {
        const T factor = a[r][k] * reciprocal[k];
        for (int s = k + 1; s < rank; ++s)
          a[r][s] = negative_multiply_add(factor, a[k][s], a[r][s]);
        sum[r] = negative_multiply_add(factor, sum[k], sum[r]);
      }
    }
    for (int k = rank - 1; k >= 0; --k) {
      for (int s = k + 1; s < rank; ++s) sum[k] = negative_multiply_add(a[k][s], sum[s], sum[k]);
      sum[k] = sum[k] * reciprocal[k];
    }
    for (int r = 0; r < rank; ++r) {
      for (int s = 0; s < rank; ++s)
        carried[r] = negative_multiply_add(w[r][s], sum[s], carried[r]);
    }
  }
};

}  // namespace catena
