// SPDX-License-Identifier: GPL-3.0-or-later
//
// Statements (program.hpp) as text in C++ or C.
#pragma once

#include <string>

#include "generator/emission/program.hpp"

namespace catena {

/// kCpp: a template on the scalar type T and the type D of differentials. kC: C99, both are double.
enum class Language { kCpp, kC };

/// "12", "6 * links + 1".
std::string affine_text(const Affine& affine);

/// How a function's own arrays are declared in C++: as such, or as LinkArray (link_array.hpp).
enum class Arrays { kPlain, kAligned };

/// Indented by 2 * depth spaces; lines are broken before an operator where they are longer than 100
/// characters. What depends on the number of links is an expression in `links`.
std::string statements_text(const Statements& statements, Language language, int depth,
                            Arrays arrays = Arrays::kPlain);

}  // namespace catena
