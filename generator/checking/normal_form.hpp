// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace catena::checking {

/// numerator / denominator, both expanded polynomials in symbols and the generators of a
/// NormalForm; plain symbols and exponentials may also have negative exponents in the numerator.
struct Fraction {
  GiNaC::ex numerator = 0;
  GiNaC::ex denominator = 1;
};

/// Before common factors of numerator and denominator are searched: takes what that costs from the
/// account (budget.hpp).
void spend_for_division(const Fraction& fraction);

/// Rewrites expressions as fractions of polynomials in independent generators, so that an
/// expression is zero if its numerator is.
///
///   - Sines, cosines and tangents of sums of angles become polynomials in s_b and c_b of the basic
///     angles b (half angles where halves occur), modulo s_b^2 + c_b^2 = 1, with s_b at most to the
///     first power.
///   - exp, sinh, cosh and tanh become powers of exp(b).
///   - Roots of positive rational numbers become products of p^(1/d), p prime, d common to all.
///   - Other roots become generators r with r^q = radicand. Perfect powers of radicands that are
///     positive by their form are taken out of the root.
///   - Everything else (log, abs, ...) is a generator of its own.
///
/// A zero numerator always proves equality. A non-zero numerator disproves it if `decides()`: then
/// the generators are algebraically independent except for the relations above.
class NormalForm {
 public:
  enum class Role { kPlain, kSine, kCosine, kExponential, kOther };
  struct Generator {
    Role role = Role::kPlain;
    GiNaC::ex base;  ///< sine, cosine, exponential: of base / divisor
    int divisor = 1;
    std::string text;  ///< kOther: for messages
  };

  /// `expressions`: all that will be compared; half and third angles are found in them.
  explicit NormalForm(const std::vector<GiNaC::ex>& expressions);

  /// Throws std::domain_error if a denominator is identically zero.
  Fraction operator()(const GiNaC::ex& expression);

  [[nodiscard]] bool decides() const { return decides_; }

  /// What a symbol of a fraction stands for.
  [[nodiscard]] Generator generator(const GiNaC::ex& symbol) const;

 private:
  struct Angle {
    int divisor = 1;
    GiNaC::realsymbol sine, cosine;
  };
  struct Exponential {
    int divisor = 1;
    GiNaC::ex value;
  };
  struct Root {
    GiNaC::realsymbol symbol;
    Fraction radicand;
    int degree = 2;
  };
  struct Opaque {
    GiNaC::realsymbol symbol;
    std::string function;
    std::vector<Fraction> arguments;
  };

  void scan(const GiNaC::ex& expression);
  void scan_argument(const GiNaC::ex& argument, bool exponential);

  Fraction convert(const GiNaC::ex& expression);
  Fraction convert_sum(const GiNaC::ex& expression);
  Fraction convert_power(const GiNaC::ex& expression);
  Fraction convert_function(const GiNaC::ex& expression);
  Fraction sine_or_cosine(const GiNaC::ex& argument, bool sine, const GiNaC::ex& whole);
  Fraction exponential(const GiNaC::ex& argument, const GiNaC::ex& whole);
  [[nodiscard]] std::optional<GiNaC::ex> logarithm(const Fraction& argument) const;
  Fraction root(const Fraction& radicand, int degree);
  GiNaC::ex power_of_number(const GiNaC::numeric& base, const GiNaC::numeric& exponent);
  GiNaC::ex power_of_prime(const GiNaC::numeric& prime, const GiNaC::numeric& exponent);
  Fraction opaque(const std::string& function, const std::vector<GiNaC::ex>& arguments);

  GiNaC::ex reduced(const GiNaC::ex& polynomial) const;
  Fraction reduced(const Fraction& fraction) const;
  [[nodiscard]] Fraction product(const Fraction& a, const Fraction& b) const;
  [[nodiscard]] Fraction raised(const Fraction& base, int exponent) const;
  [[nodiscard]] Fraction inverse(const Fraction& fraction) const;
  [[nodiscard]] bool same(const Fraction& a, const Fraction& b) const;
  [[nodiscard]] bool is_plain(const GiNaC::ex& symbol) const;
  [[nodiscard]] bool is_plain_monomial(const GiNaC::ex& e) const;
  [[nodiscard]] bool is_positive(const GiNaC::ex& polynomial) const;

  std::map<GiNaC::ex, Angle, GiNaC::ex_is_less> angles_;
  std::map<GiNaC::ex, Exponential, GiNaC::ex_is_less> exponentials_;
  std::map<GiNaC::numeric, GiNaC::ex> prime_roots_;  // p -> p^(1/radical_degree_)
  int radical_degree_ = 1;
  std::vector<Root> roots_;
  std::vector<Opaque> opaques_;
  GiNaC::exmap cosine_of_;  // s_b -> c_b
  GiNaC::exmap prime_of_;   // p^(1/radical_degree_) -> p
  std::map<GiNaC::ex, Generator, GiNaC::ex_is_less> generators_;
  bool decides_ = true;
};

}  // namespace catena::checking
