// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <ginac/ginac.h>

#include <string>
#include <vector>

#include "generator/checking/normal_form.hpp"

namespace catena::checking {

/// The order of names in text: parameters, angles, rates; then by index, then by name. GiNaC's own
/// order changes from run to run.
struct SymbolOrder {
  explicit SymbolOrder(const std::string& name);
  int family;
  int index = 0;
  std::string name;
  auto operator<=>(const SymbolOrder&) const = default;
  /// Angles, rates and accelerations.
  [[nodiscard]] bool is_state() const;
};

/// An expanded polynomial as a sum of products for readers: products of sines and cosines become
/// sines and cosines of sums of angles, and parameters with the same factor are collected in
/// brackets. Each part starts with its sign unless that is +; parts are in a fixed order.
std::vector<std::string> readable_parts(const GiNaC::ex& numerator, const NormalForm& form);

/// The whole fraction as one line.
std::string text_of(const Fraction& fraction, const NormalForm& form);

/// A number as written by hand: 3, -1/2.
std::string text_of(const GiNaC::numeric& number);

/// Parts joined by their signs.
std::string joined_by_signs(const std::vector<std::string>& parts);

}  // namespace catena::checking
