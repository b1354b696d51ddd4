// SPDX-License-Identifier: GPL-3.0-or-later
//
// Derived expressions as LaTeX, in the notation of chapter 3 and in an order that is ours: masses
// collected before what they multiply, sines and cosines of differences put together again.
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <string>
#include <vector>

#include "generator/derivation/definitions.hpp"

namespace catena {

struct LatexStyle {
  enum Order { kMassesFirst, kLengthsFirst };
  Order order = kMassesFirst;  ///< (m_2/2 + m_c) l_1 l_2 ..., or l_1 l_2 (m_2/2 + m_c) ...
  bool inertia_last = false;   ///< ... + I_R, as on the diagonal of the inertia matrix
  bool by_coefficient =
      false;              ///< c_1 (w_1 - w_2): collected by c and k, not by what they multiply
  int leading_link = -1;  ///< within a sum, what belongs to this link stands first
};

/// Names of the symbols of effects: family -> LaTeX ("\mathrm{coefficient}").
using LatexNames = std::map<std::string, std::string>;

/// A term of a sum; the sign stands apart.
struct LatexTerm {
  bool negative = false;
  std::string text;  ///< "(m_1/2 + m_c) g l_1 \sin\theta_1"

  bool operator==(const LatexTerm&) const = default;
};

/// R_1, R_2, ...: what is too long to stand in a term. One list for all expressions of a text, so
/// that equal ones have one name.
struct LatexAbbreviations {
  struct Entry {
    std::string name;  ///< "R_{1}"
    bool squared;      ///< a root: the terms are those of its square
    std::vector<LatexTerm> terms;
  };
  std::vector<Entry> entries;
};

class LatexPolynomial {
 public:
  /// `abbreviations` gets those of its terms.
  LatexPolynomial(const Definitions& definitions, LatexNames effect_names,
                  LatexAbbreviations& abbreviations);

  /// The terms of an expression. Empty for zero. All definitions are written out but functions, roots and
  /// divisors, which are shown with their arguments written out.
  std::vector<LatexTerm> terms(const GiNaC::ex& expression, const LatexStyle& style = {}) const;

  /// The terms one after the other, without a leading plus; "0" if there are none.
  std::string of(const GiNaC::ex& expression, const LatexStyle& style = {}) const;

  /// The expression with its definitions written out as for terms(), expanded.
  GiNaC::ex written_out(const GiNaC::ex& expression) const;

 private:
  std::string symbol(int number, int power) const;
  std::string abbreviation(const GiNaC::ex& value) const;

  friend class LatexTerms;
  const Definitions& definitions_;
  LatexNames effect_names_;
  mutable std::map<int, GiNaC::ex> known_;
  LatexAbbreviations& abbreviations_;
  mutable std::map<int, std::string> abbreviated_;  // number of a definition -> "R_{1}"
};

/// "+ a", "- a"
std::string with_sign(const LatexTerm& term);

/// "a + b - c", without a leading plus; "0" if there are none.
std::string joined_terms(const std::vector<LatexTerm>& terms);

/// How many letters wide LaTeX is in print, about.
std::size_t latex_width(const std::string& latex);

}  // namespace catena
