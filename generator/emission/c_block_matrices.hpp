// SPDX-License-Identifier: GPL-3.0-or-later
//
// The C of matrices in blocks, of models in space: what generator/emission/support has as
// tangent_semiseparable.hpp, from one end, and block_quasiseparable.hpp, which have the derivation.
// @Matrix: the type; @matrix: what its functions begin with; @upper, @lower: ranks; @block: rows of a block.
// With a border, of bordered.hpp: @whole is what the functions of the whole matrix begin with, @border the
// number of its rows, @members its arrays.
#pragma once

namespace catena {

inline const char* const kTangentSemiseparable = R"(
/* By two tangents of each link, component c of tangent k in array 3 k + c: M_ij = row_i column_j' for j < i, in
   blocks of 2 x 2, symmetric. Entry (k, r) of a row is in array k * @lower + r, entry (k, l) of a diagonal block
   in array k + l; if kIsotropic, rows, columns and diagonal blocks are the numbers in arrays 0 times the tangents
   and the unit matrix. `along` is the inertia of each direction along itself. */
enum { kIsotropic = @isotropic };
typedef struct {
  double row[kIsotropic ? 1 : 2 * @lower][kLinks], column[kIsotropic ? 1 : 2 * @lower][kLinks];
  double diagonal[kIsotropic ? 1 : 3][kLinks];
  double tangent[6][kLinks], size[kLinks], along[kLinks], right[2 * kLinks];
} MassMatrix;

static double part_of(const MassMatrix* matrix, const double (*rows)[kLinks], int k, int r, int i) {
  if (kIsotropic) return rows[0][i] * matrix->tangent[3 * k + r][i];
  return rows[kIsotropic ? 0 : k * @lower + r][i];
}

static double diagonal_of(const MassMatrix* matrix, int k, int l, int i) {
  if (kIsotropic) return k == l ? matrix->diagonal[0][i] : 0.0;
  return matrix->diagonal[kIsotropic ? 0 : k + l][i];
}

static double normal_of(const MassMatrix* matrix, int c, int i) {
  const int d = (c + 1) % 3, e = (c + 2) % 3;
  return matrix->tangent[d][i] * matrix->tangent[3 + e][i] -
         matrix->tangent[e][i] * matrix->tangent[3 + d][i];
}

static void to_dense(const MassMatrix* matrix, double* M) {
  for (int i = 0; i < kLinks; ++i) {
    for (int j = 0; j <= i; ++j) {
      double block[2][2];
      for (int k = 0; k < 2; ++k) {
        for (int l = 0; l < 2; ++l) {
          block[k][l] = i == j ? diagonal_of(matrix, k, l, i) : 0.0;
          for (int r = 0; j < i && r < @lower; ++r)
            block[k][l] += part_of(matrix, matrix->row, k, r, i) * part_of(matrix, matrix->column, l, r, j);
        }
      }
      for (int c = 0; c < 3; ++c) {
        for (int d = 0; d < 3; ++d) {
          const int left = c * kLinks + i, right = d * kLinks + j;
          double entry = 0.0;
          if (i == j) entry = matrix->along[i] * normal_of(matrix, c, i) * normal_of(matrix, d, i);
          for (int k = 0; k < 2; ++k) {
            for (int l = 0; l < 2; ++l)
              entry += matrix->tangent[3 * k + c][i] * block[k][l] * matrix->tangent[3 * l + d][j] /
                       (matrix->size[i] * matrix->size[j]);
          }
          M[left * kCoordinates + right] = entry;
          M[right * kCoordinates + left] = entry;
        }
      }
    }
  }
}

/* Adds to a, which has what is known, the tangents times the solution and |q|; overwrites
   `right`. Returns 0, or the 1-based number of a coordinate of the link whose pivot is not positive. */
static int32_t solve_in_place(MassMatrix* matrix, double* a) {
  double w[@lower][@lower] = {{0.0}}, carried[@lower] = {0.0}, sum[@lower] = {0.0};
  double solved[2 * @lower][kLinks];
  double* const x = matrix->right;
  const MassMatrix* const given = matrix;
  for (int j = kLinks - 1; j >= 0; --j) {
    double column[2][@lower], row[2][@lower], pivot[2][2], y[2];
    for (int k = 0; k < 2; ++k) {
      y[k] = x[k * kLinks + j];
      for (int l = 0; l < 2; ++l) pivot[k][l] = diagonal_of(given, k, l, j);
      for (int r = 0; r < @lower; ++r) {
        column[k][r] = part_of(given, given->column, k, r, j);
        row[k][r] = part_of(given, given->row, k, r, j);
      }
    }
    for (int k = 0; k < 2; ++k) {
      for (int r = 0; r < @lower; ++r) {
        double reached = 0.0;
        for (int s = 0; s < @lower; ++s) reached += w[r][s] * column[k][s];
        for (int l = 0; l < 2; ++l) pivot[k][l] -= reached * column[l][r];
        y[k] -= column[k][r] * carried[r];
        row[k][r] -= reached;
      }
    }
    /* pivot = L D L', row and y become L^-1 row and L^-1 y */
    const double factor = pivot[1][0] / pivot[0][0], second = pivot[1][1] - factor * pivot[0][1];
    if (!(pivot[0][0] > 0.0)) return j + 1;
    if (!(second > 0.0)) return kLinks + j + 1;
    y[1] -= factor * y[0];
    for (int r = 0; r < @lower; ++r) row[1][r] -= factor * row[0][r];
    for (int r = 0; r < @lower; ++r) {
      const double scaled[2] = {row[0][r] / pivot[0][0], row[1][r] / second};
      carried[r] += scaled[0] * y[0] + scaled[1] * y[1];
      for (int s = 0; s < @lower; ++s) w[r][s] += scaled[0] * row[0][s] + scaled[1] * row[1][s];
      solved[@lower + r][j] = scaled[1];
      solved[r][j] = scaled[0] - factor * scaled[1];
    }
    x[kLinks + j] = y[1] / second;
    x[j] = y[0] / pivot[0][0] - factor * x[kLinks + j];
  }
  for (int j = 0; j < kLinks; ++j) {
    for (int k = 0; k < 2; ++k) {
      for (int r = 0; r < @lower; ++r)
        x[k * kLinks + j] -= solved[k * @lower + r][j] * sum[r];
      for (int c = 0; c < 3; ++c)
        a[c * kLinks + j] += matrix->size[j] * matrix->tangent[3 * k + c][j] * x[k * kLinks + j];
    }
    for (int k = 0; k < 2; ++k) {
      for (int r = 0; r < @lower; ++r)
        sum[r] += part_of(given, given->column, k, r, j) * x[k * kLinks + j];
    }
  }
  return 0;
}
)";

inline const char* const kBlockQuasiseparable = R"(
/* In blocks of @block x @block: M_ij = upper_row_i upper_column_j' for j > i,
   lower_row_i lower_column_j' for j < i, and above_i (j = i + 1), below_i (j = i - 1) besides; diagonal_i
   is the whole block. Entry (a, r) is in array a * rank + r, (a, b) in array a * @block + b. */
typedef struct {
  double upper_row[@block * @upper][kLinks], upper_column[@block * @upper][kLinks];
  double lower_row[@block * @lower][kLinks], lower_column[@block * @lower][kLinks];
  double diagonal[@block * @block][kLinks], below[@block * @block][kLinks];
  double above[@block * @block][kLinks];
@members} @Matrix;

/* sum += sign * left right, of @block x middle and middle x columns. */
static void @matrix_add(int middle, int columns, double sign, const double* left,
                        const double* right, double* sum) {
  for (int a = 0; a < @block; ++a) {
    for (int c = 0; c < middle; ++c) {
      for (int b = 0; b < columns; ++b)
        sum[a * columns + b] += sign * left[a * middle + c] * right[c * columns + b];
    }
  }
}

static void @matrix_take(int entries, double (*const array)[kLinks], int j, double* entry) {
  for (int k = 0; k < entries; ++k) entry[k] = array[k][j];
}

static void @matrix_put(int entries, double (*array)[kLinks], int j, const double* entry) {
  for (int k = 0; k < entries; ++k) array[k][j] = entry[k];
}

/* array_j = inverse * matrix, columns many. */
static void @matrix_put_scaled(int columns, const double* inverse, const double* matrix,
                               double (*array)[kLinks], int j) {
  double product[@block * (@block + @upper + @lower)] = {0.0};
  @matrix_add(@block, columns, 1.0, inverse, matrix, product);
  @matrix_put(@block * columns, array, j, product);
}

/* Of n rows. Returns 0, or the 1-based row whose pivot vanished; uses m up. */
static int32_t @matrix_invert(int n, double* m, double* inverse) {
  for (int k = 0; k < n * n; ++k) inverse[k] = k % (n + 1) == 0 ? 1.0 : 0.0;
  for (int k = 0; k < n; ++k) {
    const double pivot = m[k * n + k];
    if (!(pivot > 0.0 || pivot < 0.0)) return k + 1;
    for (int b = 0; b < n; ++b) {
      m[k * n + b] /= pivot;
      inverse[k * n + b] /= pivot;
    }
    for (int a = 0; a < n; ++a) {
      const double factor = m[a * n + k];
      if (a == k) continue;
      for (int b = 0; b < n; ++b) {
        m[a * n + b] -= factor * m[k * n + b];
        inverse[a * n + b] -= factor * inverse[k * n + b];
      }
    }
  }
  return 0;
}

/* Factors in place: diagonal holds the inverse pivots then, rows are multiplied by them. Returns 0, or
   the 1-based number of an unknown whose pivot vanished. */
static int32_t @matrix_factor_in_place(@Matrix* m) {
  enum { block = @block, bb = block * block, up = block * @upper, low = block * @lower };
  double w[@upper][@lower] = {{0.0}}, pivot[bb], inverse[bb], column[up], row[low];
  @matrix_take(bb, m->diagonal, kLinks - 1, pivot);
  @matrix_take(up, m->upper_column, kLinks - 1, column);
  @matrix_take(low, m->lower_row, kLinks - 1, row);
  for (int k = 0; k < bb; ++k) m->above[k][kLinks - 1] = 0.0;
  for (int j = kLinks - 1;; --j) {
    double own_upper[up], above[bb], below[bb], upper[up], lower[low], scaled_row[low];
    double scaled_below[bb], next_column[up], next_row[low];
    const int32_t failed = @matrix_invert(block, pivot, inverse);
    if (failed != 0) return (failed - 1) * kLinks + j + 1;
    @matrix_put(bb, m->diagonal, j, inverse);
    @matrix_take(bb, m->above, j, above);
    @matrix_put_scaled(block, inverse, above, m->above, j);
    @matrix_take(up, m->upper_row, j, own_upper);
    @matrix_put_scaled(@upper, inverse, own_upper, m->upper_row, j);
    @matrix_put(up, m->upper_column, j, column);
    @matrix_put_scaled(@lower, inverse, row, m->lower_row, j);
    if (j == 0) return 0;
    @matrix_take(low, m->lower_row, j, scaled_row);
    @matrix_take(up, m->upper_row, j - 1, upper);
    @matrix_take(low, m->lower_column, j - 1, lower);
    @matrix_take(bb, m->above, j - 1, above);
    @matrix_take(bb, m->below, j, below);
    for (int a = 0; a < block; ++a) {
      for (int b = 0; b < block; ++b) {
        for (int r = 0; r < @upper; ++r)
          above[a * block + b] += upper[a * @upper + r] * column[b * @upper + r];
        for (int s = 0; s < @lower; ++s)
          below[a * block + b] += row[a * @lower + s] * lower[b * @lower + s];
      }
    }
    @matrix_put(bb, m->above, j - 1, above);
    @matrix_put_scaled(block, inverse, below, m->below, j);
    @matrix_take(bb, m->below, j, scaled_below);
    @matrix_take(bb, m->diagonal, j - 1, pivot);
    @matrix_take(up, m->upper_column, j - 1, next_column);
    @matrix_take(low, m->lower_row, j - 1, next_row);
    @matrix_add(block, block, -1.0, above, scaled_below, pivot);
    @matrix_add(@upper, @lower, -1.0, upper, &w[0][0], next_row);
    @matrix_add(block, @lower, -1.0, above, scaled_row, next_row);
    for (int a = 0; a < block; ++a) {
      for (int s = 0; s < @lower; ++s) {
        double reached = 0.0;
        for (int r = 0; r < @upper; ++r) reached += upper[a * @upper + r] * w[r][s];
        for (int b = 0; b < block; ++b) pivot[a * block + b] -= reached * lower[b * @lower + s];
      }
      for (int r = 0; r < @upper; ++r) {
        for (int s = 0; s < @lower; ++s)
          next_column[a * @upper + r] -= w[r][s] * lower[a * @lower + s];
        for (int b = 0; b < block; ++b)
          next_column[a * @upper + r] -= column[b * @upper + r] * scaled_below[b * block + a];
      }
    }
    for (int r = 0; r < @upper; ++r) {
      for (int s = 0; s < @lower; ++s) {
        for (int a = 0; a < block; ++a)
          w[r][s] += column[a * @upper + r] * scaled_row[a * @lower + s];
      }
    }
    memcpy(column, next_column, sizeof column);
    memcpy(row, next_row, sizeof row);
  }
}

/* sum_r += sum over a of array_(a, r) x_a, of link j */
static void @matrix_gather(int rank, double (*const array)[kLinks], int j, const double* x,
                           double* sum) {
  for (int a = 0; a < @block; ++a) {
    for (int r = 0; r < rank; ++r) sum[r] += array[a * rank + r][j] * x[a * kLinks + j];
  }
}

/* x_a -= sum over r of array_(a, r) of link i times given_r, stride apart */
static void @matrix_subtract(int rank, double (*const array)[kLinks], int i, const double* given,
                             int stride, double* x) {
  for (int a = 0; a < @block; ++a) {
    for (int r = 0; r < rank; ++r) x[a * kLinks] -= array[a * rank + r][i] * given[r * stride];
  }
}

/* Overwrites x, the right-hand side, with the solution; after @matrix_factor_in_place. */
static void @matrix_solve_in_place(@Matrix* m, double* x) {
  double carried[@upper] = {0.0}, sum[@lower] = {0.0};
  for (int j = kLinks - 1; j >= 0; --j) {
    double own[@block];
    if (j + 2 < kLinks) @matrix_gather(@upper, m->upper_column, j + 2, x, carried);
    for (int a = 0; a < @block; ++a) own[a] = x[a * kLinks + j];
    for (int a = 0; a < @block; ++a) {
      x[a * kLinks + j] = 0.0;
      for (int b = 0; b < @block; ++b) x[a * kLinks + j] += m->diagonal[a * @block + b][j] * own[b];
    }
    @matrix_subtract(@upper, m->upper_row, j, carried, 1, x + j);
    if (j + 1 < kLinks) @matrix_subtract(@block, m->above, j, x + j + 1, kLinks, x + j);
  }
  for (int j = 1; j < kLinks; ++j) {
    if (j > 1) @matrix_gather(@lower, m->lower_column, j - 2, x, sum);
    @matrix_subtract(@lower, m->lower_row, j, sum, 1, x + j);
    @matrix_subtract(@block, m->below, j, x + j - 1, kLinks, x + j);
  }
}
)";

inline const char* const kBlockSolveTransposed = R"(
/* The same with the transpose of the matrix. */
static void @matrix_solve_transposed_in_place(@Matrix* m, double* x) {
  double carried[@upper] = {0.0}, sum[@lower] = {0.0};
  for (int j = kLinks - 2; j >= 0; --j) {
    if (j + 2 < kLinks) @matrix_gather(@lower, m->lower_row, j + 2, x, sum);
    @matrix_subtract(@lower, m->lower_column, j, sum, 1, x + j);
    for (int b = 0; b < @block; ++b) {
      for (int a = 0; a < @block; ++a)
        x[a * kLinks + j] -= m->below[b * @block + a][j + 1] * x[b * kLinks + j + 1];
    }
  }
  for (int j = 1; j < kLinks; ++j) {
    if (j > 1) @matrix_gather(@upper, m->upper_row, j - 2, x, carried);
    @matrix_subtract(@upper, m->upper_column, j, carried, 1, x + j);
    for (int b = 0; b < @block; ++b) {
      for (int a = 0; a < @block; ++a)
        x[a * kLinks + j] -= m->above[b * @block + a][j - 1] * x[b * kLinks + j - 1];
    }
  }
  for (int j = 0; j < kLinks; ++j) {
    double own[@block];
    for (int a = 0; a < @block; ++a) own[a] = x[a * kLinks + j];
    for (int a = 0; a < @block; ++a) {
      x[a * kLinks + j] = 0.0;
      for (int b = 0; b < @block; ++b) x[a * kLinks + j] += m->diagonal[b * @block + a][j] * own[b];
    }
  }
}
)";

inline const char* const kBorderMembers =
    "  double border_column[@block * @border][kLinks], border_row[@block * @border][kLinks];\n"
    "  double corner[@border * @border], schur[@border * @border];\n";

inline const char* const kBordered = R"(
/* x of the rows beyond the links -= left' x of the links: all (a, k) of left in array a * @border + k. */
static void @whole_border_rest(double (*const left)[kLinks], double* x) {
  for (int k = 0; k < @border; ++k) {
    for (int a = 0; a < @block; ++a) {
      for (int i = 0; i < kLinks; ++i)
        x[@block * kLinks + k] -= left[a * @border + k][i] * x[a * kLinks + i];
    }
  }
}

/* Unknowns beyond the links from what is left of their rows, entries of schur stride and other apart; then x of the
   links -= right times these. */
static void @whole_border_solve(const double* schur, int stride, int other,
                                double (*const right)[kLinks], double* x) {
  double rest[@border];
  memcpy(rest, x + @block * kLinks, sizeof rest);
  for (int k = 0; k < @border; ++k) {
    double multiplier = 0.0;
    for (int l = 0; l < @border; ++l) multiplier += schur[k * stride + l * other] * rest[l];
    x[@block * kLinks + k] = multiplier;
    for (int a = 0; a < @block; ++a) {
      for (int i = 0; i < kLinks; ++i)
        x[a * kLinks + i] -= right[a * @border + k][i] * multiplier;
    }
  }
}

/* Factors in place: border_column is multiplied by the inverse of the links' matrix, schur is the inverse
   of the complement. Returns 0, or the 1-based number of an unknown whose pivot vanished. */
static int32_t @whole_factor_in_place(@Matrix* m) {
  double complement[@border * @border];
  int32_t failed = @matrix_factor_in_place(m);
  if (failed != 0) return failed;
  for (int k = 0; k < @border; ++k) {
    double column[@block * kLinks];
    for (int a = 0; a < @block; ++a) {
      for (int i = 0; i < kLinks; ++i) column[a * kLinks + i] = m->border_column[a * @border + k][i];
    }
    @matrix_solve_in_place(m, column);
    for (int a = 0; a < @block; ++a) {
      for (int i = 0; i < kLinks; ++i) m->border_column[a * @border + k][i] = column[a * kLinks + i];
    }
  }
  for (int k = 0; k < @border; ++k) {
    for (int l = 0; l < @border; ++l) {
      complement[k * @border + l] = m->corner[k * @border + l];
      for (int a = 0; a < @block; ++a) {
        for (int i = 0; i < kLinks; ++i)
          complement[k * @border + l] -=
              m->border_row[a * @border + k][i] * m->border_column[a * @border + l][i];
      }
    }
  }
  failed = @matrix_invert(@border, complement, m->schur);
  return failed == 0 ? 0 : @block * kLinks + failed;
}

/* Overwrites x, the right-hand side, with the solution; after @whole_factor_in_place. */
static void @whole_solve_in_place(@Matrix* m, double* x) {
  double right[@border], found[@border] = {0.0};
  double* const beyond = x + @block * kLinks;
  memcpy(right, beyond, sizeof right);
  @matrix_solve_in_place(m, x);
  /* The second time solves for what rounding leaves of these rows after the first time. */
  for (int time = 0; time < 2; ++time) {
    for (int k = 0; k < @border; ++k) {
      beyond[k] = right[k];
      for (int l = 0; l < @border; ++l) beyond[k] -= m->corner[k * @border + l] * found[l];
    }
    @whole_border_rest(m->border_row, x);
    @whole_border_solve(m->schur, @border, 1, m->border_column, x);
    for (int k = 0; k < @border; ++k) found[k] += beyond[k];
  }
  memcpy(beyond, found, sizeof found);
}
)";

inline const char* const kBorderedTransposed = R"(
/* The same with the transpose of the matrix. */
static void @whole_solve_transposed_in_place(@Matrix* m, double* x) {
  @whole_border_rest(m->border_column, x);
  @whole_border_solve(m->schur, 1, @border, m->border_row, x);
  @matrix_solve_transposed_in_place(m, x);
}
)";

inline const char* const kBorderedDense = R"(
static void to_dense(const MassMatrix* m, double* M) {
  for (int i = 0; i < kCoordinates * kCoordinates; ++i) M[i] = 0.0;
  for (int a = 0; a < @block; ++a) {
    for (int i = 0; i < kLinks; ++i) {
      double* const row = M + (a * kLinks + i) * kCoordinates;
      for (int b = 0; b < @block; ++b) {
        for (int j = 0; j < kLinks; ++j) {
          double entry = i == j ? m->diagonal[a * @block + b][i] : 0.0;
          if (j > i) {
            for (int r = 0; r < @upper; ++r)
              entry += m->upper_row[a * @upper + r][i] * m->upper_column[b * @upper + r][j];
            if (j == i + 1) entry += m->above[a * @block + b][i];
          } else if (j < i) {
            for (int s = 0; s < @lower; ++s)
              entry += m->lower_row[a * @lower + s][i] * m->lower_column[b * @lower + s][j];
            if (j == i - 1) entry += m->below[a * @block + b][i];
          }
          row[b * kLinks + j] = entry;
        }
      }
      for (int k = 0; k < @border; ++k) {
        row[@block * kLinks + k] = m->border_column[a * @border + k][i];
        M[(@block * kLinks + k) * kCoordinates + a * kLinks + i] = m->border_row[a * @border + k][i];
      }
    }
  }
  for (int k = 0; k < @border; ++k) {
    for (int l = 0; l < @border; ++l)
      M[(@block * kLinks + k) * kCoordinates + @block * kLinks + l] = m->corner[k * @border + l];
  }
}
)";

}  // namespace catena
