// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "generator/checking/syntax_tree.hpp"

namespace catena::checking {

/// Reads a derivation; docs/checking.md has the grammar. `file` is its name in messages.
/// Throws InputError with file, line, column and what was expected.
Program parse_derivation(std::string_view text, const std::string& file);

}  // namespace catena::checking
