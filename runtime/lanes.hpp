// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>

#include "generated/scalar.hpp"

namespace catena {

/// The compiler's vectors of four and of eight.
template <int count>
struct LaneVectors;
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

/// Several numbers at once, one a lane: a scalar type for the emitted templates, with which one
/// call evaluates a model for as many parameter sets and states. Four fill a register of AVX2. Every lane gets the bits that the
/// same text gives for that set alone in double precision: the operations are the same, in the same
/// order.
///
/// `Target` keeps apart what is compiled for different processors: template functions of the same
/// name compiled with different flags would be merged into one.
template <class Target, int count>
class Lanes {
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

  /// Comparisons are of all lanes: a pivot is good if it is good in every set.
  friend bool operator>(const Lanes& a, const Lanes& b) { return all(a.values_ > b.values_); }
  friend bool operator<(const Lanes& a, const Lanes& b) { return all(a.values_ < b.values_); }

  friend void sine_cosine(const Lanes& angle, Lanes& sine, Lanes& cosine) {
    sine_cosine_of<Vector, Bits>(angle.values_, sine.values_, cosine.values_);
  }

 private:
  template <class Mask>
  static bool all(const Mask& mask) {
    bool result = true;
    for (int lane = 0; lane < count; ++lane) result = result && mask[lane] != 0;
    return result;
  }

  Vector values_;
};

}  // namespace catena
