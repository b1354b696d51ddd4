// SPDX-License-Identifier: BSD-3-Clause
//
// Several numbers at once, one a lane: a scalar type for the emitted templates, with which one call
// evaluates a model for as many parameter sets and states. Every lane gets the bits that the same
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
struct LaneVectors;
template <>
struct LaneVectors<2> {
  typedef double Vector __attribute__((vector_size(16)));
  typedef std::uint64_t Bits __attribute__((vector_size(16)));
};
template <>
struct LaneVectors<4> {
  typedef double Vector __attribute__((vector_size(32)));
  typedef std::uint64_t Bits __attribute__((vector_size(32)));
};
template <>
struct LaneVectors<8> {
  typedef double Vector __attribute__((vector_size(64)));
  typedef std::uint64_t Bits __attribute__((vector_size(64)));
};

template <int count>
class alignas(count * sizeof(double)) Lanes {
 public:
  using Vector = typename LaneVectors<count>::Vector;
  using Bits = typename LaneVectors<count>::Bits;

  Lanes() = default;
  // Written out so that a copy is a copy of vectors: as plain memory it goes in pieces smaller than
  // the loads that follow, which then wait for the cache.
  Lanes(const Lanes& other) : values_(other.values_) {}
  Lanes& operator=(const Lanes& other) {
    values_ = other.values_;
    return *this;
  }
  explicit Lanes(double value) : values_(value - Vector{}) {}
  explicit Lanes(int value) : Lanes(static_cast<double>(value)) {}
  explicit Lanes(const Vector& values) : values_(values) {}

  /// From and to an array, at any place.
  static Lanes of(const double* values) {
    Lanes lanes;
    std::memcpy(&lanes.values_, values, sizeof lanes.values_);
    return lanes;
  }
  void put(double* values) const { std::memcpy(values, &values_, sizeof values_); }

  double operator[](int lane) const { return values_[lane]; }
  void set(int lane, double value) { values_[lane] = value; }
  const Vector& values() const { return values_; }

  Lanes operator-() const { return Lanes(-values_); }
  Lanes& operator+=(const Lanes& other) { return *this = *this + other; }
  Lanes& operator-=(const Lanes& other) { return *this = *this - other; }
  Lanes& operator*=(const Lanes& other) { return *this = *this * other; }
  Lanes& operator/=(const Lanes& other) { return *this = *this / other; }
  friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.values_ + b.values_); }
  friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.values_ - b.values_); }
  friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.values_ * b.values_); }
  friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.values_ / b.values_); }
  [[gnu::always_inline]] friend Lanes multiply_add(const Lanes& a, const Lanes& b, const Lanes& c) {
    return fused(a.values_, b.values_, c.values_, Every());
  }
  [[gnu::always_inline]] friend Lanes multiply_add(double a, const Lanes& b, const Lanes& c) {
    return multiply_add(Lanes(a), b, c);
  }
  [[gnu::always_inline]] friend Lanes negative_multiply_add(const Lanes& a, const Lanes& b,
                                                            const Lanes& c) {
    return multiply_add(-a, b, c);
  }
  [[gnu::always_inline]] friend Lanes negative_multiply_add(double a, const Lanes& b,
                                                            const Lanes& c) {
    return multiply_add(Lanes(-a), b, c);
  }
  friend Lanes operator*(double a, const Lanes& b) { return Lanes(a * b.values_); }
  friend Lanes operator*(const Lanes& a, double b) { return Lanes(a.values_ * b); }
  friend Lanes operator/(const Lanes& a, double b) { return Lanes(a.values_ / b); }

  /// Comparisons are of all lanes: a pivot is good if it is good in every set.
  friend bool operator>(const Lanes& a, const Lanes& b) {
    return all_greater(a.values_, b.values_);
  }
  friend bool operator<(const Lanes& a, const Lanes& b) {
    return all_greater(b.values_, a.values_);
  }

  friend void sine_cosine(const Lanes& angle, Lanes& sine, Lanes& cosine) {
    Lanes shifted;
    sine_cosine_reduced(angle, sine, cosine, shifted);
    turn_by_quarters<Vector, Bits>(shifted.values_, sine.values_, cosine.values_);
  }

#define CATENA_LANE_BY_LANE(function)                                                   \
  friend Lanes function(const Lanes& x) {                                               \
    Lanes y;                                                                            \
    for (int k = 0; k < count; ++k) y.values_[k] = std::function(double(x.values_[k])); \
    return y;                                                                           \
  }
  CATENA_LANE_BY_LANE(acos)
  CATENA_LANE_BY_LANE(asin)
  CATENA_LANE_BY_LANE(asinh)
  CATENA_LANE_BY_LANE(atan)
  CATENA_LANE_BY_LANE(cos)
  CATENA_LANE_BY_LANE(cosh)
  CATENA_LANE_BY_LANE(exp)
  CATENA_LANE_BY_LANE(log)
  CATENA_LANE_BY_LANE(sin)
  CATENA_LANE_BY_LANE(sinh)
  CATENA_LANE_BY_LANE(sqrt)
  CATENA_LANE_BY_LANE(tan)
  CATENA_LANE_BY_LANE(tanh)
#undef CATENA_LANE_BY_LANE

 private:
  using Every = std::make_integer_sequence<int, count>;
  // The compiler makes one instruction of all lanes.
  template <int... lane>
  [[gnu::always_inline]] static Lanes fused(const Vector& a, const Vector& b, const Vector& c,
                                            std::integer_sequence<int, lane...>) {
    return Lanes(CATENA_APART(Vector{std::fma(a[lane], b[lane], c[lane])...}));
  }

  // Masks of all bits or none, halved until two are left.
  static bool all_greater(const Vector& a, const Vector& b) {
    typedef std::int64_t Two __attribute__((vector_size(16)));
    const auto greater = a > b;
    Two parts[count / 2];
    std::memcpy(parts, &greater, sizeof parts);
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
  using Four = Lanes<4>;
  using Two = Lanes<2>;
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
