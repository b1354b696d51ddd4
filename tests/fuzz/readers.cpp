// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/fuzz/readers.hpp"

#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace catena::tests {

std::filesystem::path written(const std::string& name, const std::string& text) {
  static const testing::TemporaryFolder folder;
  return folder.write(name, text);
}

/// A message quotes some values, lists some names and has a few names of files.
void require_short(std::string_view message) {
  constexpr std::size_t kLongestMessage = 20'000;
  if (message.size() > kLongestMessage)
    throw std::logic_error("a message of " + std::to_string(message.size()) + " bytes");
}

}  // namespace catena::tests
