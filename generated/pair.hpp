// SPDX-License-Identifier: BSD-3-Clause
//
// Two numbers that go through the same operations: for double one vector of two, which every x86-64
// processor computes with at the price of one number.
#pragma once

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

 private:
  T first_, second_;
};

#ifdef __GNUC__
template <>
class Pair<double> {
 public:
  typedef double Vector __attribute__((vector_size(16)));

  Pair() = default;
  Pair(double first, double second) : values_{first, second} {}
  double first() const { return values_[0]; }
  double second() const { return values_[1]; }

  friend Pair operator+(const Pair& a, const Pair& b) { return Pair(a.values_ + b.values_); }
  friend Pair operator-(const Pair& a, const Pair& b) { return Pair(a.values_ - b.values_); }
  friend Pair operator*(const Pair& a, const Pair& b) { return Pair(a.values_ * b.values_); }
  friend Pair operator/(const Pair& a, const Pair& b) { return Pair(a.values_ / b.values_); }

 private:
  explicit Pair(const Vector& values) : values_(values) {}

  Vector values_;
};
#endif

}  // namespace catena
