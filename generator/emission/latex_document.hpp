// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "generator/description/description.hpp"

namespace catena {

/// The most links whose equations are written out; beyond it nobody reads them.
inline constexpr int kMostLatexLinks = 20;

/// A whole LaTeX document (article, amsmath): for each link count the Lagrangian, the equations of
/// Euler and Lagrange and the matrices of (3.4), derived, in the order and notation of chapter 3;
/// then what each effect adds. The same text on every run.
std::string latex_document(const Description& description, const std::vector<int>& links);

}  // namespace catena
