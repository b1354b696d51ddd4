// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string_view>

namespace catena {

/// Writes a file whole or not at all: to a temporary name in the same folder, then renamed.
/// Throws InputError naming the path if it cannot be written.
void write_whole_file(const std::filesystem::path& path, std::string_view text);

}  // namespace catena
