// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace catena {

/// The candidate with the fewest edits (insert, delete, replace, swap of neighbours) from `word`;
/// the first of several. Empty if all take more edits than two fifths of the word's length.
std::string nearest_name(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean \"damping\"?", or "; known are a, b and c" if nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b and c"
std::string listed(const std::vector<std::string>& words);

}  // namespace catena
