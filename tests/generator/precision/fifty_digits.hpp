// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cln/float.h>
#include <cln/integer_io.h>
#include <cln/real.h>

namespace catena::tests {

/// A real number of at least 50 decimal digits (CLN), as a scalar for emitted models.
class FiftyDigits {
 public:
  FiftyDigits() : FiftyDigits(0) {}
  FiftyDigits(int value) : value_(cln::cl_float(cln::cl_I(value), format())) {}      // NOLINT
  FiftyDigits(double value) : value_(cln::cl_float(cln::cl_DF(value), format())) {}  // NOLINT
  explicit FiftyDigits(const cln::cl_F& value) : value_(value) {}

  [[nodiscard]] const cln::cl_F& value() const { return value_; }
  explicit operator double() const { return cln::double_approx(value_); }

  friend FiftyDigits operator+(const FiftyDigits& a, const FiftyDigits& b) {
    return FiftyDigits(a.value_ + b.value_);
  }
  friend FiftyDigits operator-(const FiftyDigits& a, const FiftyDigits& b) {
    return FiftyDigits(a.value_ - b.value_);
  }
  friend FiftyDigits operator*(const FiftyDigits& a, const FiftyDigits& b) {
    return FiftyDigits(a.value_ * b.value_);
  }
  friend FiftyDigits operator/(const FiftyDigits& a, const FiftyDigits& b) {
    return FiftyDigits(a.value_ / b.value_);
  }
  friend FiftyDigits operator-(const FiftyDigits& a) { return FiftyDigits(-a.value_); }
  FiftyDigits& operator+=(const FiftyDigits& b) { return *this = *this + b; }
  FiftyDigits& operator-=(const FiftyDigits& b) { return *this = *this - b; }
  FiftyDigits& operator*=(const FiftyDigits& b) { return *this = *this * b; }
  FiftyDigits& operator/=(const FiftyDigits& b) { return *this = *this / b; }
  friend bool operator<(const FiftyDigits& a, const FiftyDigits& b) { return a.value_ < b.value_; }
  friend bool operator>(const FiftyDigits& a, const FiftyDigits& b) { return a.value_ > b.value_; }

 private:
  static cln::float_format_t format() { return cln::float_format(50); }

  cln::cl_F value_;
};

inline FiftyDigits sin(const FiftyDigits& x) { return FiftyDigits(cln::sin(x.value())); }
inline FiftyDigits cos(const FiftyDigits& x) { return FiftyDigits(cln::cos(x.value())); }
inline FiftyDigits tan(const FiftyDigits& x) { return FiftyDigits(cln::tan(x.value())); }
inline FiftyDigits atan(const FiftyDigits& x) {
  return FiftyDigits(cln::cl_float(cln::atan(x.value()), cln::float_format(50)));
}
inline FiftyDigits sinh(const FiftyDigits& x) { return FiftyDigits(cln::sinh(x.value())); }
inline FiftyDigits cosh(const FiftyDigits& x) { return FiftyDigits(cln::cosh(x.value())); }
inline FiftyDigits tanh(const FiftyDigits& x) { return FiftyDigits(cln::tanh(x.value())); }
inline FiftyDigits exp(const FiftyDigits& x) { return FiftyDigits(cln::exp(x.value())); }
inline FiftyDigits log(const FiftyDigits& x) { return FiftyDigits(cln::ln(x.value())); }
inline FiftyDigits sqrt(const FiftyDigits& x) { return FiftyDigits(cln::sqrt(x.value())); }
inline FiftyDigits asinh(const FiftyDigits& x) { return log(x + sqrt(x * x + FiftyDigits(1))); }
inline FiftyDigits abs(const FiftyDigits& x) { return FiftyDigits(cln::abs(x.value())); }

}  // namespace catena::tests
