// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/data.hpp"

#include <cstdlib>
#include <iostream>

namespace catena::tests {

std::optional<std::filesystem::path> published_data(std::string_view name) {
  const char* folder = std::getenv("CATENA_DATA");
  const std::filesystem::path path =
      (folder ? std::filesystem::path(folder) : source_folder().parent_path() / "shared" / "data") /
      name;
  if (std::filesystem::exists(path)) return path;
  std::cout << "skipped: " << path.string() << " is absent; CATENA_DATA names the folder\n";
  return std::nullopt;
}

std::filesystem::path source_folder() { return SOURCE_FOLDER; }

std::filesystem::path build_folder() { return BUILD_FOLDER; }

}  // namespace catena::tests
