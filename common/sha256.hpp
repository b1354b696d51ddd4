// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace catena {

/// SHA-256 (FIPS 180-4) of the bytes of `text`, 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view text);

/// The same of what a file holds. Throws std::filesystem::filesystem_error if it cannot be read.
std::string sha256_of_file(const std::filesystem::path& file);

}  // namespace catena
