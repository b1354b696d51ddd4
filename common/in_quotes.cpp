// SPDX-License-Identifier: BSD-3-Clause
#include "common/in_quotes.hpp"

#include <algorithm>

#include "common/toml_quoted.hpp"

namespace catena {
namespace {

bool begins_a_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }

struct Excerpt {
  std::string text;
  std::string count;  // " (40000 characters)", or nothing
};

Excerpt excerpt_of(std::string_view text, std::size_t most) {
  const auto characters =
      static_cast<std::size_t>(std::count_if(text.begin(), text.end(), begins_a_character));
  if (characters <= most) return {std::string(text), ""};
  std::size_t begun = 0;
  const auto end = std::find_if(text.begin(), text.end(),
                                [&](char c) { return begins_a_character(c) && begun++ == most; });
  return {std::string(text.begin(), end) + "...",
          " (" + std::to_string(characters) + " characters)"};
}

}  // namespace

std::string in_quotes(std::string_view text) {
  const Excerpt excerpt = excerpt_of(text, kMostQuoted);
  return toml_quoted(excerpt.text) + excerpt.count;
}

std::string shortened(std::string_view text, std::size_t most) {
  const Excerpt excerpt = excerpt_of(text, most);
  return excerpt.text + excerpt.count;
}

}  // namespace catena
