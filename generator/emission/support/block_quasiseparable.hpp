// SPDX-License-Identifier: BSD-3-Clause
//
// Linear equations of models in space whose matrix is tridiagonal plus semiseparable in blocks of
// block x block, in time proportional to the number of links. All of quasiseparable.hpp holds, where the
// blocks have size one, with blocks in the places of numbers:
//
//     A_ij = upper_row_i upper_column_j'                 j > i + 1
//     A_ij = upper_row_i upper_column_j' + above_i       j = i + 1
//     A_ii = diagonal_i
//     A_ij = lower_row_i lower_column_j' + below_i       j = i - 1
//     A_ij = lower_row_i lower_column_j'                 j < i - 1
//
// Entry (a, r) of a row or column is in array a * rank + r, entry (a, b) of diagonal, below and above in
// array a * block + b. Component a of link i of a vector is at a * links + i.
#pragma once

#include "scalar.hpp"

namespace catena {

template <class T, int links, int upper_rank, int lower_rank, int block>
struct BlockQuasiseparable {
  static constexpr int ru = upper_rank, rl = lower_rank, bb = block * block;
  T upper_row[block * ru][links], upper_column[block * ru][links];
  T lower_row[block * rl][links], lower_column[block * rl][links];
  T diagonal[bb][links], below[bb][links], above[bb][links];

  /// Factors in place; afterwards the members hold what solve() needs:
  ///   diagonal                     inverses of the pivots
  ///   upper_column                 those of the triangular factors
  ///   upper_row, lower_row         the inverse pivot times each row
  ///   above, below                 the inverse pivot times the neighbour's whole entry
  /// Returns 0, or the 1-based number of an unknown whose pivot vanished.
  int factor() {
    Matrix<ru, rl> w;  // of the links below j
    for (int r = 0; r < ru; ++r) {
      CATENA_UNROLLED
      for (int s = 0; s < rl; ++s) w.at[r][s] = T(0);
    }
    // of link j, corrected
    Matrix<block, block> pivot = at<block>(diagonal, links - 1);
    Matrix<block, ru> column = at<ru>(upper_column, links - 1);
    Matrix<block, rl> row = at<rl>(lower_row, links - 1);
    for (int a = 0; a < bb; ++a) above[a][links - 1] = T(0);
    for (int j = links - 1;; --j) {
      Matrix<block, block> inverse;
      if (const int failed = invert(pivot, inverse)) return (failed - 1) * links + j + 1;
      const Matrix<block, rl> scaled_row = product(inverse, row);
      put(diagonal, j, inverse);
      put(above, j, product(inverse, at<block>(above, j)));
      put(upper_row, j, product(inverse, at<ru>(upper_row, j)));
      put(upper_column, j, column);
      put(lower_row, j, scaled_row);
      if (j == 0) return 0;

      const Matrix<block, ru> upper = at<ru>(upper_row, j - 1);
      const Matrix<block, rl> lower = at<rl>(lower_column, j - 1);
      Matrix<block, block> entry_above = at<block>(above, j - 1), entry_below = at<block>(below, j);
      add(entry_above, upper, column);
      add(entry_below, row, lower);
      const Matrix<block, block> scaled_below = product(inverse, entry_below);
      put(above, j - 1, entry_above);
      put(below, j, scaled_below);
      // In the order of A_{j-1, k}, k < j: what W reaches, and what the neighbour does.
      pivot = at<block>(diagonal, j - 1);
      Matrix<block, ru> next_column = at<ru>(upper_column, j - 1);
      Matrix<block, rl> next_row = at<rl>(lower_row, j - 1);
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        T reached[rl];
        CATENA_UNROLLED
        for (int s = 0; s < rl; ++s) {
          reached[s] = upper.at[a][0] * w.at[0][s];
          CATENA_UNROLLED
          for (int r = 1; r < ru; ++r)
            reached[s] = multiply_add(upper.at[a][r], w.at[r][s], reached[s]);
          next_row.at[a][s] = next_row.at[a][s] - reached[s];
          CATENA_UNROLLED
          for (int b = 0; b < block; ++b) {
            pivot.at[a][b] = negative_multiply_add(reached[s], lower.at[b][s], pivot.at[a][b]);
            next_row.at[a][s] =
                negative_multiply_add(entry_above.at[a][b], scaled_row.at[b][s], next_row.at[a][s]);
          }
        }
        CATENA_UNROLLED
        for (int b = 0; b < block; ++b) {
          CATENA_UNROLLED
          for (int c = 0; c < block; ++c)
            pivot.at[a][b] =
                negative_multiply_add(entry_above.at[a][c], scaled_below.at[c][b], pivot.at[a][b]);
        }
        CATENA_UNROLLED
        for (int r = 0; r < ru; ++r) {
          CATENA_UNROLLED
          for (int s = 0; s < rl; ++s)
            next_column.at[a][r] =
                negative_multiply_add(w.at[r][s], lower.at[a][s], next_column.at[a][r]);
          CATENA_UNROLLED
          for (int b = 0; b < block; ++b)
            next_column.at[a][r] =
                negative_multiply_add(column.at[b][r], scaled_below.at[b][a], next_column.at[a][r]);
        }
      }
      CATENA_UNROLLED
      for (int r = 0; r < ru; ++r) {
        CATENA_UNROLLED
        for (int s = 0; s < rl; ++s) {
          CATENA_UNROLLED
          for (int a = 0; a < block; ++a)
            w.at[r][s] = multiply_add(column.at[a][r], scaled_row.at[a][s], w.at[r][s]);
        }
      }
      column = next_column;
      row = next_row;
    }
  }

  /// Overwrites x, the right-hand side, with the solution. X is T, or holds several right-hand sides
  /// (directions.hpp).
  template <class X>
  void solve(X* x) const {
    X carried[ru], sum[rl], last[block], last_but_one[block], own[block];
    clear(carried), clear(sum), clear(last), clear(last_but_one);
    for (int j = links - 1; j >= 0; --j) {
      if (j + 2 < links) gather<ru>(carried, upper_column, j + 2, last_but_one);
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) own[a] = x[a * links + j];
      X rest[block];
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        rest[a] = own[0] * diagonal[a * block][j];
        CATENA_UNROLLED
        for (int b = 1; b < block; ++b)
          rest[a] = multiply_add(diagonal[a * block + b][j], own[b], rest[a]);
      }
      subtract<ru>(rest, upper_row, j, carried);
      if (j + 1 < links) subtract<block>(rest, above, j, last);
      step(x, j, rest, last, last_but_one);
    }
    for (int j = 1; j < links; ++j) {  // last is that of link 0
      if (j > 1) gather<rl>(sum, lower_column, j - 2, last_but_one);
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) own[a] = x[a * links + j];
      subtract<rl>(own, lower_row, j, sum);
      subtract<block>(own, below, j, last);
      step(x, j, own, last, last_but_one);
    }
  }

  /// The same with the transpose of the matrix.
  void solve_transposed(T* x) const {
    T carried[ru], sum[rl], last[block], last_but_one[block], own[block];
    clear(carried), clear(sum), clear(last), clear(last_but_one);
    for (int j = links - 1; j >= 0; --j) {
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) own[a] = x[a * links + j];
      if (j + 2 < links) gather<rl>(sum, lower_row, j + 2, last_but_one);
      subtract<rl>(own, lower_column, j, sum);
      if (j + 1 < links) subtract_transposed(own, below, j + 1, last);
      step(x, j, own, last, last_but_one);
    }
    // The inverse pivots come where the links after it have used a link without them.
    for (int j = 1; j < links; ++j) {
      if (j > 1) gather<ru>(carried, upper_row, j - 2, last_but_one);
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) own[a] = x[a * links + j];
      subtract<ru>(own, upper_column, j, carried);
      subtract_transposed(own, above, j - 1, last);
      step(x, j, own, last, last_but_one);
    }
    for (int j = 0; j < links; ++j) {
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) own[a] = x[a * links + j];
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) {
        T& result = x[a * links + j];
        result = diagonal[a][j] * own[0];
        CATENA_UNROLLED
        for (int b = 1; b < block; ++b)
          result = multiply_add(diagonal[b * block + a][j], own[b], result);
      }
    }
  }

  /// The whole matrix, row by row. Not after factor().
  void to_dense(T* matrix) const {
    constexpr int n = block * links;
    for (int i = 0; i < links; ++i) {
      for (int j = 0; j < links; ++j) {
        for (int a = 0; a < block; ++a) {
          for (int b = 0; b < block; ++b) {
            const int k = a * block + b;
            T entry = i == j ? diagonal[k][i] : j == i + 1 ? above[k][i] : T(0);
            if (j == i - 1) entry = below[k][i];
            for (int r = 0; j > i && r < ru; ++r)
              entry += upper_row[a * ru + r][i] * upper_column[b * ru + r][j];
            for (int r = 0; j < i && r < rl; ++r)
              entry += lower_row[a * rl + r][i] * lower_column[b * rl + r][j];
            matrix[(a * links + i) * n + b * links + j] = entry;
          }
        }
      }
    }
  }

 protected:
  template <int rows, int columns>
  struct Matrix {
    T at[rows][columns];
  };

  template <int columns>
  static Matrix<block, columns> at(const T (*array)[links], int j) {
    Matrix<block, columns> matrix;
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < columns; ++b) matrix.at[a][b] = array[a * columns + b][j];
    }
    return matrix;
  }
  template <int columns>
  static void put(T (*array)[links], int j, const Matrix<block, columns>& matrix) {
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < columns; ++b) array[a * columns + b][j] = matrix.at[a][b];
    }
  }

  template <int columns>
  static Matrix<block, columns> product(const Matrix<block, block>& left,
                                        const Matrix<block, columns>& right) {
    Matrix<block, columns> result;
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < columns; ++b) {
        result.at[a][b] = left.at[a][0] * right.at[0][b];
        CATENA_UNROLLED
        for (int c = 1; c < block; ++c)
          result.at[a][b] = multiply_add(left.at[a][c], right.at[c][b], result.at[a][b]);
      }
    }
    return result;
  }
  /// sum += left right'
  template <int rank>
  static void add(Matrix<block, block>& sum, const Matrix<block, rank>& left,
                  const Matrix<block, rank>& right) {
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < block; ++b) {
        CATENA_UNROLLED
        for (int r = 0; r < rank; ++r)
          sum.at[a][b] = multiply_add(left.at[a][r], right.at[b][r], sum.at[a][b]);
      }
    }
  }

  /// By elimination without exchanges. Returns 0, or the 1-based row whose pivot vanished.
  template <int size>
  static int invert(Matrix<size, size> matrix, Matrix<size, size>& inverse) {
    T(&m)[size][size] = matrix.at;
    T(&x)[size][size] = inverse.at;
    CATENA_UNROLLED
    for (int a = 0; a < size; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < size; ++b) x[a][b] = T(a == b ? 1 : 0);
    }
    CATENA_UNROLLED
    for (int k = 0; k < size; ++k) {
      if (!usable_pivot(m[k][k])) return k + 1;
      const T reciprocal = T(1) / m[k][k];
      CATENA_UNROLLED
      for (int b = k + 1; b < size; ++b) m[k][b] *= reciprocal;
      CATENA_UNROLLED
      for (int b = 0; b <= k; ++b) x[k][b] *= reciprocal;
      CATENA_UNROLLED
      for (int a = 0; a < size; ++a) {
        if (a == k) continue;
        CATENA_UNROLLED
        for (int b = k + 1; b < size; ++b)
          m[a][b] = negative_multiply_add(m[a][k], m[k][b], m[a][b]);
        CATENA_UNROLLED
        for (int b = 0; b <= k; ++b) x[a][b] = negative_multiply_add(m[a][k], x[k][b], x[a][b]);
      }
    }
    return 0;
  }

  template <class X, int count>
  static void clear(X (&values)[count]) {
    CATENA_UNROLLED
    for (int k = 0; k < count; ++k) values[k] = X(0);
  }
  /// sum += column_j' x
  template <int rank, class X>
  static void gather(X (&sum)[rank], const T (*column)[links], int j, const X (&x)[block]) {
    CATENA_UNROLLED
    for (int r = 0; r < rank; ++r) {
      CATENA_UNROLLED
      for (int a = 0; a < block; ++a) sum[r] = multiply_add(column[a * rank + r][j], x[a], sum[r]);
    }
  }
  /// rest -= row_j x
  template <int rank, class X>
  static void subtract(X (&rest)[block], const T (*row)[links], int j, const X (&x)[rank]) {
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int r = 0; r < rank; ++r)
        rest[a] = negative_multiply_add(row[a * rank + r][j], x[r], rest[a]);
    }
  }
  static void subtract_transposed(T (&rest)[block], const T (*matrix)[links], int j,
                                  const T (&x)[block]) {
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      CATENA_UNROLLED
      for (int b = 0; b < block; ++b)
        rest[a] = negative_multiply_add(matrix[b * block + a][j], x[b], rest[a]);
    }
  }
  template <class X>
  static void step(X* x, int j, const X (&own)[block], X (&last)[block], X (&last_but_one)[block]) {
    CATENA_UNROLLED
    for (int a = 0; a < block; ++a) {
      last_but_one[a] = last[a];
      last[a] = x[a * links + j] = own[a];
    }
  }
};

}  // namespace catena
