// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/input_error.hpp"
#include "generator/checking/syntax_tree.hpp"

namespace catena::checking {

struct Token {
  enum class Kind { kNumber, kName, kText, kSign, kEndOfStatement, kEndOfFile };
  Kind kind = Kind::kEndOfFile;
  std::string text;
  Location at;
};

/// An InputError "FILE:LINE:COLUMN: error: MESSAGE".
[[nodiscard]] InputError error_at(const std::string& file, Location at, const std::string& message);

/// How a message names a token: 'x', end of line, end of file.
std::string described(const Token& token);

/// Cuts a derivation into tokens; the last one is kEndOfFile. A statement ends at the end of its
/// line or at a semicolon, except inside brackets, after an operator or comma, and before a line
/// that starts with one. Throws InputError at a character that belongs to no token.
std::vector<Token> tokenize(std::string_view text, const std::string& file);

}  // namespace catena::checking
