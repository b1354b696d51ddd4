// SPDX-License-Identifier: GPL-3.0-or-later
//
// Decides whether an expression that is too long to be expanded is zero, by its exact value at a
// random point (Schwartz 1980, Zippel 1979). A polynomial of degree d that is not identically zero
// vanishes with a probability of d/|S| at most, if each coordinate is drawn from a set S of
// integers. Sines and cosines are rational in t = tan(x/2). S is so large that the probability is
// below 2^-kCertainty.
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

/// How many bits the integers of a point need for a fraction of these degrees; nothing if the
/// degrees are too large. A multiple of the word size, so that expressions share their points.
std::optional<int> bits_for(const Degree& degree);

/// Expressions as rational functions of independent generators: symbols, tangents of half angles,
/// exponentials.
class ExactForm {
 public:
  /// `expressions`: all that will be converted.
  explicit ExactForm(const std::vector<GiNaC::ex>& expressions);

  /// The expression in generators; nothing if it is not rational in independent generators.
  std::optional<GiNaC::ex> operator()(const GiNaC::ex& expression);

  /// The degrees of an expression in generators; `known`: those of some of its symbols.
  using Degrees = std::map<GiNaC::ex, Degree, GiNaC::ex_is_less>;
  [[nodiscard]] Degree degree(const GiNaC::ex& rational, Degrees known = {}) const;

  /// Rational values for the symbols of these expressions in generators, from integers of `bits`
  /// bits. The same seed gives a symbol the same value.
  [[nodiscard]] GiNaC::exmap point(const std::vector<GiNaC::ex>& rationals, int bits,
                                   std::uint64_t seed) const;

 private:
  NormalForm form_;
  bool is_independent_;
};

/// Whether an expression is zero for all values of its symbols, by its exact value at a random
/// point. Nothing if it is not rational in independent quantities.
std::optional<bool> vanishes(const GiNaC::ex& expression, std::uint64_t seed);

}  // namespace catena::checking
