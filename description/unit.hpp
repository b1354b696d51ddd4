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

/// A coherent SI unit of mechanics: m^a kg^b s^c with rational exponents and factor one.
/// Radians are dimensionless: rad, and anything per rad, is 1 times the rest.
class Unit {
 public:
  Unit() = default;  ///< dimensionless

  /// Reads "kg/m^2", "N m s/rad", "1", "1/s", "m^0.5", "kg/(m s)": products by space or *, one
  /// level of parentheses after /, whole, decimal or (p/q) exponents. Each / divides by the one
  /// factor or parenthesis behind it. Known: m kg s rad N J W Pa Hz 1. Throws std::invalid_argument
  /// with the text, the rule and a hint; degrees, mm, g and the like are refused: SI only.
  static Unit parse(std::string_view text);
  static Unit of(int metre, int kilogram, int second);

  Unit operator*(const Unit& other) const;
  Unit operator/(const Unit& other) const;
  Unit power(Exponent exponent) const;
  bool operator==(const Unit&) const = default;
  bool dimensionless() const { return *this == Unit(); }

  /// "kg/(m s^2)", "1"; the usual name where there is one: "N", "N/m"; energies too as "N m".
  std::string text() const;

 private:
  std::array<Exponent, 3> exponents_{};  // m, kg, s
};

}  // namespace catena
