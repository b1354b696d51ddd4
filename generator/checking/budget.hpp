// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a statement of a derivation may cost. Powers in powers, loops in loops and functions in
// functions need only a few characters, and more time and memory than there is.
#pragma once

#include <ginac/ginac.h>

#include <stdexcept>

namespace catena::checking {

/// Operations for one statement with its loops, and again for the comparison of one entry: numbers
/// and names evaluated, products of terms expanded. Some ten seconds. The longest that is known to be
/// wanted, the equations of 60 links from their Lagrangian in one loop, needs more than a third of it.
inline constexpr double kMostOperations = 1e7;

/// Bits of a number: 30 000 decimal digits.
inline constexpr double kMostBits = 1e5;

/// The greatest degree of a root, and common denominator of roots and fractions of angles.
inline constexpr int kGreatestDivisor = 10000;

/// The greatest exponent of a power, in size: products and sums of two fit in an int.
inline constexpr int kGreatestExponent = 10000000;

/// A statement needs more than it may.
class Overlong : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The account of one statement while it lives. What is spent is taken from the accounts around it, too.
class Budget {
 public:
  /// So many operations, of whatever the accounts around it have.
  explicit Budget(double operations = kMostOperations)
      : most_(operations), left_(operations), outer_(current_) {
    current_ = this;
  }
  ~Budget() { current_ = outer_; }
  Budget(const Budget&) = delete;
  Budget& operator=(const Budget&) = delete;

  /// Throws Overlong if the current account, or one around it, has not so many operations left.
  static void spend(double operations);

 private:
  double most_, left_;
  Budget* outer_;
  static thread_local Budget* current_;
};

/// Throws Overlong if a number would have more than kMostBits.
void require_short_number(double bits);

/// Throws Overlong if functions, powers, sums and products of a value are nested deeper than
/// kDeepestNesting (common/nesting.hpp), all assignments on the way to it together, or if a number
/// in it is too long. 12 links eliminated by hand are 61 deep. Takes from the account what GiNaC
/// needs to look at the value.
void require_moderate(const GiNaC::ex& value);

/// base^exponent, or Overlong if the numbers in it would be too long.
GiNaC::ex moderate_power(const GiNaC::ex& base, const GiNaC::ex& exponent);

/// The exponent of a power that is an integer, 1 of anything else. Throws Overlong if it is beyond
/// kGreatestExponent in size.
int integer_exponent(const GiNaC::ex& factor);

/// Bits of the numerator and denominator of a rational number; 0 of others, whose length is fixed.
double bits_of(const GiNaC::numeric& number);

/// The parts of an expression as written out, each occurrence counted: what differentiation and
/// replacement visit.
double written_size(const GiNaC::ex& expression);

/// The products when sums, products and powers of expanded polynomials are expanded.
double products_in(const GiNaC::ex& expression);

}  // namespace catena::checking
