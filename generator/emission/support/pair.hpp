// SPDX-License-Identifier: BSD-3-Clause
//
// Two numbers that go through the same operations: for double one vector of two, which every x86-64
// processor computes with at the price of one number.
#pragma once

#include "batch.hpp"
#include "multiply_add.hpp"

namespace catena {

template <class T>
class Pair {
 public:
  Pair() = default;
  Pair(const T& first, const T& second) : first_(first), second_(second) {}
  const T& first() const { return first_; }
  const T& second() const { return second_; }

  friend Pair operator+(const Pair& a, const Pair& b) {
    return {a.first_ + b.first_, a.second_ + b.second_};
  }
  friend Pair operator-(const Pair& a, const Pair& b) {
    return {a.first_ - b.first_, a.second_ - b.second_};
  }
  friend Pair operator*(const Pair& a, const Pair& b) {
    return {a.first_ * b.first_, a.second_ * b.second_};
  }
  friend Pair operator/(const Pair& a, const Pair& b) {
    return {a.first_ / b.first_, a.second_ / b.second_};
  }
  [[gnu::always_inline]] friend Pair multiply_add(const Pair& a, const Pair& b, const Pair& c) {
    return {multiply_add(a.first_, b.first_, c.first_),
            multiply_add(a.second_, b.second_, c.second_)};
  }
  [[gnu::always_inline]] friend Pair negative_multiply_add(const Pair& a, const Pair& b,
                                                           const Pair& c) {
    return {negative_multiply_add(a.first_, b.first_, c.first_),
            negative_multiply_add(a.second_, b.second_, c.second_)};
  }
  /// Of two pivots.
  static bool all_positive(const Pair& a, const Pair& b) {
    return positive_pivot(a.first_) && positive_pivot(a.second_) && positive_pivot(b.first_) &&
           positive_pivot(b.second_);
  }

 private:
  T first_, second_;
};

#ifdef __GNUC__
template <>
class Pair<double> {
 public:
  Pair() = default;
  Pair(double first, double second) : values_(CATENA_APART(Batch<2>::Vector{first, second})) {}
  double first() const { return values_[0]; }
  double second() const { return values_[1]; }

  friend Pair operator+(const Pair& a, const Pair& b) { return Pair(a.values_ + b.values_); }
  friend Pair operator-(const Pair& a, const Pair& b) { return Pair(a.values_ - b.values_); }
  friend Pair operator*(const Pair& a, const Pair& b) { return Pair(a.values_ * b.values_); }
  friend Pair operator/(const Pair& a, const Pair& b) { return Pair(a.values_ / b.values_); }
  [[gnu::always_inline]] friend Pair multiply_add(const Pair& a, const Pair& b, const Pair& c) {
    return Pair(multiply_add(a.values_, b.values_, c.values_));
  }
  [[gnu::always_inline]] friend Pair negative_multiply_add(const Pair& a, const Pair& b,
                                                           const Pair& c) {
    return Pair(negative_multiply_add(a.values_, b.values_, c.values_));
  }
  static bool all_positive(const Pair& a, const Pair& b) {
    return Batch<2>::all_positive(a.values_, b.values_);
  }

 private:
  explicit Pair(const Batch<2>& values) : values_(values) {}

  Batch<2> values_;
};
#endif

}  // namespace catena
