// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace catena {

/// SHA-256 (FIPS 180-4) of the bytes of `text`, 64 lower-case hexadecimal digits.
std::string sha256_hex(std::string_view text);

}  // namespace catena
