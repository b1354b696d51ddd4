// SPDX-License-Identifier: BSD-3-Clause
//
// A batch of numbers: a scalar type for the emitted templates, with which one call
// evaluates a model for as many parameter sets and states. Every element gets the bits that the same
// text gives for that set alone in double precision: the operations are the same, in the same
// order.
#pragma once

#ifdef __GNUC__

#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "scalar.hpp"

// A vector that the compiler does not look into from outside: taken to pieces, it may not be put
// together again.
#if __has_builtin(__builtin_assoc_barrier)
#define CATENA_APART __builtin_assoc_barrier
#else
#define CATENA_APART
#endif

namespace catena {

/// The compiler's vectors: two doubles fill a register of any x86-64 processor, four one of AVX2,
/// eight one of AVX-512.
template <int count>
struct BatchVectors;
template <>
struct BatchVectors<2> {
  typedef double Vector __attribute__((vector_size(16)));
  typedef std::uint64_t Bits __attribute__((vector_size(16)));
};
template <>
struct BatchVectors<4> {
  typedef double Vector __attribute__((vector_size(32)));
  typedef std::uint64_t Bits __attribute__((vector_size(32)));
};
template <>
struct BatchVectors<8> {
  typedef double Vector __attribute__((vector_size(64)));
  typedef std::uint64_t Bits __attribute__((vector_size(64)));
};

template <int count>
class alignas(count * sizeof(double)) Batch {
 public:
  using Vector = typename BatchVectors<count>::Vector;
  using Bits = typename BatchVectors<count>::Bits;

  Batch() = default;
  // Written out so that a copy is a copy of vectors: as plain memory it goes in pieces smaller than
  // the loads that follow, which then wait for the cache.
  Batch(const Batch& other) : values_(other.values_) {}
  Batch& operator=(const Batch& other) {
    values_ = other.values_;
    return *this;
  }
  explicit Batch(double value) : values_(value - Vector{}) {}
  explicit Batch(int value) : Batch(static_cast<double>(value)) {}
  explicit Batch(const Vector& values) : values_(values) {}

  /// From and to an array, at any place.
  static Batch of(const double* values) {
    Batch batch;
    std::memcpy(&batch.values_, values, sizeof batch.values_);
    return batch;
  }
  void put(double* values) const { std::memcpy(values, &values_, sizeof values_); }

  double operator[](int element) const { return values_[element]; }
  void set(int element, double value) { values_[element] = value; }
  const Vector& values() const { return values_; }

  Batch operator-() const { return Batch(-values_); }
  Batch& operator+=(const Batch& other) { return *this = *this + other; }
  Batch& operator-=(const Batch& other) { return *this = *this - other; }
  Batch& operator*=(const Batch& other) { return *this = *this * other; }
  Batch& operator/=(const Batch& other) { return *this = *this / other; }
  friend Batch operator+(const Batch& a, const Batch& b) { return Batch(a.values_ + b.values_); }
  friend Batch operator-(const Batch& a, const Batch& b) { return Batch(a.values_ - b.values_); }
  friend Batch operator*(const Batch& a, const Batch& b) { return Batch(a.values_ * b.values_); }
  friend Batch operator/(const Batch& a, const Batch& b) { return Batch(a.values_ / b.values_); }
  [[gnu::always_inline]] friend Batch multiply_add(const Batch& a, const Batch& b, const Batch& c) {
    return fused(a.values_, b.values_, c.values_, Every());
  }
  [[gnu::always_inline]] friend Batch multiply_add(double a, const Batch& b, const Batch& c) {
    return multiply_add(Batch(a), b, c);
  }
  [[gnu::always_inline]] friend Batch negative_multiply_add(const Batch& a, const Batch& b,
                                                            const Batch& c) {
    return multiply_add(-a, b, c);
  }
  [[gnu::always_inline]] friend Batch negative_multiply_add(double a, const Batch& b,
                                                            const Batch& c) {
    return multiply_add(Batch(-a), b, c);
  }
  friend Batch operator*(double a, const Batch& b) { return Batch(a * b.values_); }
  friend Batch operator*(const Batch& a, double b) { return Batch(a.values_ * b); }
  friend Batch operator/(const Batch& a, double b) { return Batch(a.values_ / b); }

  /// Comparisons are of all elements: a pivot is good if it is good in every element.
  friend bool operator>(const Batch& a, const Batch& b) { return every(a.values_ > b.values_); }
  friend bool operator<(const Batch& a, const Batch& b) { return every(b.values_ > a.values_); }
  /// Of two pivots, in every element.
  static bool all_positive(const Batch& a, const Batch& b) {
    return every((a.values_ > Vector{}) & (b.values_ > Vector{}));
  }

  friend void sine_cosine(const Batch& angle, Batch& sine, Batch& cosine) {
    Batch shifted;
    sine_cosine_reduced(angle, sine, cosine, shifted);
    turn_by_quarters<Vector, Bits>(shifted.values_, sine.values_, cosine.values_);
  }

#define CATENA_ELEMENTWISE(function)                                                    \
  friend Batch function(const Batch& x) {                                               \
    Batch y;                                                                            \
    for (int k = 0; k < count; ++k) y.values_[k] = std::function(double(x.values_[k])); \
    return y;                                                                           \
  }
  CATENA_ELEMENTWISE(acos)
  CATENA_ELEMENTWISE(asin)
  CATENA_ELEMENTWISE(asinh)
  CATENA_ELEMENTWISE(atan)
  CATENA_ELEMENTWISE(cos)
  CATENA_ELEMENTWISE(cosh)
  CATENA_ELEMENTWISE(exp)
  CATENA_ELEMENTWISE(log)
  CATENA_ELEMENTWISE(sin)
  CATENA_ELEMENTWISE(sinh)
  CATENA_ELEMENTWISE(sqrt)
  CATENA_ELEMENTWISE(tan)
  CATENA_ELEMENTWISE(tanh)
#undef CATENA_ELEMENTWISE

 private:
  using Every = std::make_integer_sequence<int, count>;
  // One instruction: named where the compiler has a name for it, for it does not find every one in elements.
  template <int... element>
  [[gnu::always_inline]] static Batch fused(const Vector& a, const Vector& b, const Vector& c,
                                            std::integer_sequence<int, element...>) {
#if defined(__FMA__) && __has_builtin(__builtin_ia32_vfmaddpd256)
    if constexpr (count == 2)
      return Batch(Vector(__builtin_ia32_vfmaddpd(a, b, c)));
    else if constexpr (count == 4)
      return Batch(Vector(__builtin_ia32_vfmaddpd256(a, b, c)));
    else
#endif
      return Batch(CATENA_APART(Vector{std::fma(a[element], b[element], c[element])...}));
  }

  // Masks of all bits or none, halved until two are left.
  template <class Masks>
  static bool every(const Masks& masks) {
    typedef std::int64_t Two __attribute__((vector_size(16)));
    Two parts[count / 2];
    std::memcpy(parts, &masks, sizeof parts);
    for (int half = count / 4; half > 0; half /= 2) {
      for (int k = 0; k < half; ++k) parts[k] &= parts[k + half];
    }
    return (parts[0][0] & parts[0][1]) != 0;
  }

  Vector values_;
};

/// Sines and cosines of n angles, four at a time.
[[gnu::always_inline]] inline void sines_and_cosines(int n, const double* angle, double* sine,
                                                     double* cosine) {
  using Four = Batch<4>;
  using Two = Batch<2>;
  const int whole = n - n % 4, rest = n % 4;
  for (int i = 0; i < whole; i += 4) {
    Four s, c;
    sine_cosine(Four::of(angle + i), s, c);
    s.put(sine + i);
    c.put(cosine + i);
  }
  if (rest == 3) {
    const double last[4] = {angle[whole], angle[whole + 1], angle[whole + 2], angle[whole + 2]};
    Four s, c;
    sine_cosine(Four::of(last), s, c);
    for (int k = 0; k < 3; ++k) {
      sine[whole + k] = s[k];
      cosine[whole + k] = c[k];
    }
  } else if (rest == 2) {
    Two s, c;
    sine_cosine(Two::of(angle + whole), s, c);
    s.put(sine + whole);
    c.put(cosine + whole);
  } else if (rest == 1) {
    sine_cosine(angle[whole], sine[whole], cosine[whole]);
  }
}
template <int n>
inline void sines_and_cosines(const double* angle, double* sine, double* cosine) {
  sines_and_cosines(n, angle, sine, cosine);
}

}  // namespace catena

#endif
