// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "generator/checking/comparison.hpp"
#include "generator/checking/derivation.hpp"

namespace catena::tests {

using namespace catena::checking;

/// The text of examples/derivations/NAME.
std::string example(const std::string& name);

/// The left sides E[i] of the equations of motion E[i] = 0, from the Lagrangian of an example of
/// chapter 3.
std::string left_sides(const std::string& lagrangian);

/// A derivation and what is found about it.
struct Checked {
  Derivation derivation;
  std::vector<Finding> findings;

  [[nodiscard]] int count(Verdict verdict) const;
  /// The finding about the entry with this label; fails the test if there is none.
  [[nodiscard]] const Finding& of(const std::string& label) const;
};
Checked checked(const std::string& text, std::optional<int> links = std::nullopt,
                const std::vector<Effect>& effects = {});

}  // namespace catena::tests
