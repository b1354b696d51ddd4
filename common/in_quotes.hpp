// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace catena {

/// How many characters of a value of the input a message repeats at most. More would hide its rule.
inline constexpr std::size_t kMostQuoted = 120;
/// The same for the name of a file: what Linux opens is not longer.
inline constexpr std::size_t kLongestPath = 4096;

/// A text (UTF-8) as a message repeats it. Of a text that is longer than `most` characters, the first
/// ones and how many there are: aaaa... (40000 characters). What a user gave gets into messages through
/// this or in_quotes().
std::string shortened(std::string_view text, std::size_t most = kMostQuoted);

/// The same in quotes: "kg", "aaaa..." (40000 characters). Quotes, backslashes and control characters
/// stand as TOML writes them.
std::string in_quotes(std::string_view text);

}  // namespace catena
