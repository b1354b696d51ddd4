// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "generator/checking/syntax_tree.hpp"

namespace catena::checking {

/// Reads a derivation; the grammar stands in docs/checking.md. `file` is what messages call it.
/// Throws InputError with file, line, column and what was expected.
Program parse_derivation(std::string_view text, const std::string& file);

}  // namespace catena::checking
