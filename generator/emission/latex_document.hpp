// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "description/description.hpp"

namespace catena {

/// The most links whose equations are written out; beyond it nobody reads them.
inline constexpr int kMostLatexLinks = 20;

/// What the derivation found, as one reads it.
struct LatexEquations {
  std::string words;    ///< LaTeX that leads to them: "The Lagrangian is"
  std::string latex;    ///< amsmath
  bool aligned = true;  ///< an environment align*; else what stands between \[ and \]
};

/// For so many links the Lagrangian, the equations of Euler and Lagrange and the matrices of (3.4),
/// derived, in the order and notation of chapter 3; then the generalised forces of each effect.
std::vector<LatexEquations> derived_equations(const Description& description, int links);

/// A whole LaTeX document (article, amsmath): for each link count all that derived_equations()
/// gives, and the formulas of each effect. The same text on every run.
std::string latex_document(const Description& description, const std::vector<int>& links);

}  // namespace catena
