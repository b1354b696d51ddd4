// SPDX-License-Identifier: GPL-3.0-or-later
//
// Whether expressions too long to be expanded are zero: by their exact value at a random point
// (Schwartz 1980, Zippel 1979). A polynomial of degree d that is not zero everywhere is zero at one
// in |S|/d points at most, if every coordinate is drawn from a set S of integers; sines and cosines
// are rational in t = tan(x/2). S is chosen so large that the chance is below 2^-kCertainty.
#pragma once

#include <ginac/ginac.h>

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "generator/checking/normal_form.hpp"

namespace catena::checking {

inline constexpr int kCertainty = 100;

/// Bounds of the degrees of a fraction in all its variables together.
struct Degree {
  double numerator = 0;
  double denominator = 0;
};

/// The bits of the integers of a point that are enough for a fraction of such degrees; nothing if
/// the degrees are beyond all numbers. Whole words, so that expressions share their points.
std::optional<int> bits_for(const Degree& degree);

/// Expressions as rational functions of independent generators: symbols, tangents of half angles,
/// exponentials.
class ExactForm {
 public:
  /// All expressions that will be looked at.
  explicit ExactForm(const std::vector<GiNaC::ex>& expressions);

  /// The expression in generators, or nothing where it is not rational in independent ones.
  std::optional<GiNaC::ex> operator()(const GiNaC::ex& expression);

  /// Of an expression in generators; `known` says more about some symbols.
  using Degrees = std::map<GiNaC::ex, Degree, GiNaC::ex_is_less>;
  [[nodiscard]] Degree degree(const GiNaC::ex& rational, Degrees known = {}) const;

  /// Rational values for the symbols of these expressions in generators, from integers of so many
  /// bits. The same seed gives a symbol the same value.
  [[nodiscard]] GiNaC::exmap point(const std::vector<GiNaC::ex>& rationals, int bits,
                                   std::uint64_t seed) const;

 private:
  NormalForm form_;
  bool is_independent_;
};

/// Whether an expression is zero for all values of its symbols, by its exact value at a random
/// point. Nothing where it is not rational in independent quantities.
std::optional<bool> vanishes(const GiNaC::ex& expression, std::uint64_t seed);

}  // namespace catena::checking
