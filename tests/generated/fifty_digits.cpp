// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/generated/fifty_digits.hpp"

#include <cln/integer.h>
#include <cln/real.h>

namespace catena::tests {
namespace {

cln::float_format_t format() { return cln::float_format(50); }

}  // namespace

FiftyDigits::FiftyDigits() noexcept : FiftyDigits(0) {}
FiftyDigits::FiftyDigits(int value) noexcept : value_(cln::cl_float(cln::cl_I(value), format())) {}
FiftyDigits::FiftyDigits(double value) noexcept
    : value_(cln::cl_float(cln::cl_DF(value), format())) {}
FiftyDigits::FiftyDigits(const cln::cl_F& value) noexcept : value_(value) {}
FiftyDigits::FiftyDigits(const FiftyDigits& other) noexcept = default;
FiftyDigits& FiftyDigits::operator=(const FiftyDigits& other) noexcept = default;
FiftyDigits::~FiftyDigits() noexcept = default;

FiftyDigits::operator double() const noexcept { return cln::double_approx(value_); }

FiftyDigits& FiftyDigits::operator+=(const FiftyDigits& other) noexcept {
  return *this = *this + other;
}
FiftyDigits& FiftyDigits::operator-=(const FiftyDigits& other) noexcept {
  return *this = *this - other;
}

FiftyDigits operator+(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return FiftyDigits(a.value() + b.value());
}
FiftyDigits operator-(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return FiftyDigits(a.value() - b.value());
}
FiftyDigits operator*(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return FiftyDigits(a.value() * b.value());
}
FiftyDigits operator/(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return FiftyDigits(a.value() / b.value());
}
FiftyDigits operator-(const FiftyDigits& a) noexcept { return FiftyDigits(-a.value()); }
bool operator<(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return a.value() < b.value();
}
bool operator>(const FiftyDigits& a, const FiftyDigits& b) noexcept {
  return a.value() > b.value();
}

FiftyDigits sin(const FiftyDigits& x) noexcept { return FiftyDigits(cln::sin(x.value())); }
FiftyDigits cos(const FiftyDigits& x) noexcept { return FiftyDigits(cln::cos(x.value())); }
FiftyDigits exp(const FiftyDigits& x) noexcept { return FiftyDigits(cln::exp(x.value())); }
FiftyDigits log(const FiftyDigits& x) noexcept { return FiftyDigits(cln::ln(x.value())); }
FiftyDigits sqrt(const FiftyDigits& x) noexcept { return FiftyDigits(cln::sqrt(x.value())); }
FiftyDigits tanh(const FiftyDigits& x) noexcept { return FiftyDigits(cln::tanh(x.value())); }
FiftyDigits abs(const FiftyDigits& x) noexcept { return FiftyDigits(cln::abs(x.value())); }

}  // namespace catena::tests
