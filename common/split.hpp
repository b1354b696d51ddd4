// SPDX-License-Identifier: BSD-3-Clause
//
// std::getline ends a text unsaid where memory is refused. These throw.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace catena {

/// What stands between the separators: one part more than there are separators. Views of the text.
///
///     const std::vector<std::string_view> cells = split("0.1,,0.3", ',');  // three, the second empty
inline std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    parts.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// The lines of a text, without what ends them; nothing follows the last end. Views of the text.
inline std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines = split(text, '\n');
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

}  // namespace catena
