// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace catena {

/// An exact exponent: numerator over denominator, in lowest terms, denominator positive.
struct Exponent {
  int numerator = 0;
  int denominator = 1;
  bool operator==(const Exponent&) const = default;
};

/// A coherent SI unit of mechanics: m^a kg^b s^c with rational exponents and factor one. The radian
/// is dimensionless.
///
///     const Unit torque = Unit::parse("N m");
///     const bool same = torque / Unit::parse("rad") == Unit::parse("kg m^2/s^2");  // true
class Unit {
 public:
  Unit() = default;  ///< dimensionless

  /// Reads "kg/m^2", "N m s/rad", "1", "1/s", "m^0.5", "kg/(m s)". A product is written with a
  /// space or *. A / divides by the one factor or parenthesis after it. Exponents are whole,
  /// decimal or (p/q). Known: m kg s rad N J W Pa Hz 1. Throws std::invalid_argument with the text,
  /// the rule and a hint. Degrees, mm, g and the like are refused.
  static Unit parse(std::string_view text);
  /// By exponents of m, kg and s.
  static Unit of(int metre, int kilogram, int second);

  Unit operator*(const Unit& other) const;
  Unit operator/(const Unit& other) const;
  /// Every exponent multiplied by this one.
  Unit power(Exponent exponent) const;
  bool operator==(const Unit&) const = default;
  bool dimensionless() const { return *this == Unit(); }

  /// "kg/(m s^2)", "1"; the usual name where there is one: "N", "N/m". Energies are "N m" too.
  std::string text() const;

 private:
  std::array<Exponent, 3> exponents_{};  // m, kg, s
};

}  // namespace catena
