// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cln/float.h>

namespace catena::tests {

/// A real number of at least 50 decimal digits (CLN), as a scalar for emitted models. Nothing is
/// inline: emitted functions are long, and expanding CLN in each operation takes a minute to
/// compile.
class FiftyDigits {
 public:
  FiftyDigits() noexcept;              // 0
  FiftyDigits(int value) noexcept;     // NOLINT(google-explicit-constructor): emitted text converts
  FiftyDigits(double value) noexcept;  // NOLINT(google-explicit-constructor): exact
  explicit FiftyDigits(const cln::cl_F& value) noexcept;
  FiftyDigits(const FiftyDigits& other) noexcept;
  FiftyDigits& operator=(const FiftyDigits& other) noexcept;
  ~FiftyDigits() noexcept;

  [[nodiscard]] const cln::cl_F& value() const { return value_; }
  explicit operator double() const noexcept;

  FiftyDigits& operator+=(const FiftyDigits& other) noexcept;
  FiftyDigits& operator-=(const FiftyDigits& other) noexcept;

 private:
  cln::cl_F value_;
};

FiftyDigits operator+(const FiftyDigits& a, const FiftyDigits& b) noexcept;
FiftyDigits operator-(const FiftyDigits& a, const FiftyDigits& b) noexcept;
FiftyDigits operator*(const FiftyDigits& a, const FiftyDigits& b) noexcept;
FiftyDigits operator/(const FiftyDigits& a, const FiftyDigits& b) noexcept;
FiftyDigits operator-(const FiftyDigits& a) noexcept;
bool operator<(const FiftyDigits& a, const FiftyDigits& b) noexcept;
bool operator>(const FiftyDigits& a, const FiftyDigits& b) noexcept;

FiftyDigits sin(const FiftyDigits& x) noexcept;
FiftyDigits cos(const FiftyDigits& x) noexcept;
FiftyDigits exp(const FiftyDigits& x) noexcept;
FiftyDigits log(const FiftyDigits& x) noexcept;
FiftyDigits sqrt(const FiftyDigits& x) noexcept;
FiftyDigits tanh(const FiftyDigits& x) noexcept;
FiftyDigits abs(const FiftyDigits& x) noexcept;

}  // namespace catena::tests
