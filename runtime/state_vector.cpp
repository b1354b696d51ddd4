// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/state_vector.hpp"

#include <algorithm>
#include <cmath>
#include <new>

// The loops are compiled twice, for any x86-64 and for one with AVX2, and chosen when the program
// starts. Sums are kept in four fixed partial sums, so that both give the same bits. The thread
// sanitiser is not ready at the time of that choice.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__SANITIZE_THREAD__)
#define CATENA_VECTOR_LOOP __attribute__((target_clones("avx2", "default")))
#else
#define CATENA_VECTOR_LOOP
#endif

namespace catena {
namespace {

using Index = sunindextype;

struct Content {
  Index size;
  double* data;
};

Content& content(N_Vector x) { return *static_cast<Content*>(x->content); }
Index size(N_Vector x) { return content(x).size; }
double* data(N_Vector x) { return content(x).data; }

N_Vector clone(N_Vector x) { return new_state_vector(size(x), x->sunctx); }

void destroy(N_Vector x) {
  ::operator delete[](data(x), std::align_val_t(64));
  delete static_cast<Content*>(x->content);
  N_VFreeEmpty(x);
}

void space(N_Vector x, Index* reals, Index* integers) {
  *reals = size(x);
  *integers = 1;
}

// z = a x + b y
CATENA_VECTOR_LOOP void linear_sum(double a, const double* x, double b, const double* y, double* z,
                                   Index n) {
  if (a == 1.0 && b == 1.0) {
    for (Index i = 0; i < n; ++i) z[i] = x[i] + y[i];
  } else if (a == 1.0 && b == -1.0) {
    for (Index i = 0; i < n; ++i) z[i] = x[i] - y[i];
  } else {
    for (Index i = 0; i < n; ++i) z[i] = a * x[i] + b * y[i];
  }
}

CATENA_VECTOR_LOOP void add_scaled(double a, const double* x, double* z, Index n) {
  for (Index i = 0; i < n; ++i) z[i] += a * x[i];
}

CATENA_VECTOR_LOOP void scale(double a, const double* x, double* z, Index n) {
  for (Index i = 0; i < n; ++i) z[i] = a * x[i];
}

// sum of (x_i w_i)^2
CATENA_VECTOR_LOOP double weighted_square_sum(const double* x, const double* w, Index n) {
  double partial[4] = {};
  Index i = 0;
  for (; i + 4 <= n; i += 4)
    for (Index k = 0; k < 4; ++k) partial[k] += x[i + k] * w[i + k] * (x[i + k] * w[i + k]);
  for (Index k = 0; i < n; ++i, ++k) partial[k] += x[i] * w[i] * (x[i] * w[i]);
  return (partial[0] + partial[1]) + (partial[2] + partial[3]);
}

void linear_sum_op(double a, N_Vector x, double b, N_Vector y, N_Vector z) {
  linear_sum(a, data(x), b, data(y), data(z), size(x));
}

void scale_op(double a, N_Vector x, N_Vector z) { scale(a, data(x), data(z), size(x)); }

void constant_op(double c, N_Vector z) { std::fill_n(data(z), size(z), c); }

double weighted_norm_op(N_Vector x, N_Vector w) {
  return std::sqrt(weighted_square_sum(data(x), data(w), size(x)) / static_cast<double>(size(x)));
}

double max_norm_op(N_Vector x) {
  double result = 0.0;
  for (Index i = 0; i < size(x); ++i) result = std::max(result, std::abs(data(x)[i]));
  return result;
}

double min_op(N_Vector x) { return *std::min_element(data(x), data(x) + size(x)); }

void product_op(N_Vector x, N_Vector y, N_Vector z) {
  for (Index i = 0; i < size(x); ++i) data(z)[i] = data(x)[i] * data(y)[i];
}

void quotient_op(N_Vector x, N_Vector y, N_Vector z) {
  for (Index i = 0; i < size(x); ++i) data(z)[i] = data(x)[i] / data(y)[i];
}

void absolute_op(N_Vector x, N_Vector z) {
  for (Index i = 0; i < size(x); ++i) data(z)[i] = std::abs(data(x)[i]);
}

void inverse_op(N_Vector x, N_Vector z) {
  for (Index i = 0; i < size(x); ++i) data(z)[i] = 1.0 / data(x)[i];
}

void add_constant_op(N_Vector x, double b, N_Vector z) {
  for (Index i = 0; i < size(x); ++i) data(z)[i] = data(x)[i] + b;
}

// z = sum_k c_k x_k; z may be x_0
int linear_combination_op(int count, double* c, N_Vector* x, N_Vector z) {
  const Index n = size(z);
  if (x[0] != z || c[0] != 1.0) scale(c[0], data(x[0]), data(z), n);
  for (int k = 1; k < count; ++k) add_scaled(c[k], data(x[k]), data(z), n);
  return 0;
}

// z_k = a_k x + y_k
int scale_add_multi_op(int count, double* a, N_Vector x, N_Vector* y, N_Vector* z) {
  for (int k = 0; k < count; ++k) linear_sum(a[k], data(x), 1.0, data(y[k]), data(z[k]), size(x));
  return 0;
}

// For arrays of vectors CVODES would otherwise allocate in every step.

// z_i = sum_k c_k x_ki; z may be x_0
int linear_combination_array_op(int vectors, int count, double* c, N_Vector** x, N_Vector* z) {
  for (int i = 0; i < vectors; ++i) {
    const Index n = size(z[i]);
    if (x[0][i] != z[i] || c[0] != 1.0) scale(c[0], data(x[0][i]), data(z[i]), n);
    for (int k = 1; k < count; ++k) add_scaled(c[k], data(x[k][i]), data(z[i]), n);
  }
  return 0;
}

// z_ki = a_k x_i + y_ki
int scale_add_multi_array_op(int vectors, int count, double* a, N_Vector* x, N_Vector** y,
                             N_Vector** z) {
  for (int k = 0; k < count; ++k)
    for (int i = 0; i < vectors; ++i)
      linear_sum(a[k], data(x[i]), 1.0, data(y[k][i]), data(z[k][i]), size(x[i]));
  return 0;
}

_generic_N_Vector_Ops make_operations() {
  _generic_N_Vector_Ops ops{};
  ops.nvgetvectorid = [](N_Vector) { return SUNDIALS_NVEC_CUSTOM; };
  ops.nvclone = &clone;
  ops.nvdestroy = &destroy;
  ops.nvspace = &space;
  ops.nvgetarraypointer = &data;
  ops.nvgetlength = &size;
  ops.nvlinearsum = &linear_sum_op;
  ops.nvconst = &constant_op;
  ops.nvprod = &product_op;
  ops.nvdiv = &quotient_op;
  ops.nvscale = &scale_op;
  ops.nvabs = &absolute_op;
  ops.nvinv = &inverse_op;
  ops.nvaddconst = &add_constant_op;
  ops.nvmaxnorm = &max_norm_op;
  ops.nvwrmsnorm = &weighted_norm_op;
  ops.nvmin = &min_op;
  ops.nvlinearcombination = &linear_combination_op;
  ops.nvscaleaddmulti = &scale_add_multi_op;
  ops.nvlinearcombinationvectorarray = &linear_combination_array_op;
  ops.nvscaleaddmultivectorarray = &scale_add_multi_array_op;
  return ops;
}

}  // namespace

N_Vector new_state_vector(sunindextype size, SUNContext context) {
  static const _generic_N_Vector_Ops operations = make_operations();
  const auto bytes = static_cast<std::size_t>(std::max<Index>(size, 1)) * sizeof(double);
  const N_Vector vector = N_VNewEmpty(context);
  void* const values = ::operator new[](bytes, std::align_val_t(64), std::nothrow);
  auto* const content = new (std::nothrow) Content{size, static_cast<double*>(values)};
  if (vector == nullptr || values == nullptr || content == nullptr) {
    ::operator delete[](values, std::align_val_t(64));
    delete content;
    N_VFreeEmpty(vector);
    throw std::bad_alloc();
  }
  *vector->ops = operations;
  vector->content = content;
  return vector;
}

double* elements(N_Vector vector) { return data(vector); }

}  // namespace catena
