// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "identify/cases/case.hpp"

namespace catena {

/// Reads and checks a case file. Paths in it are relative to the folder of the file. Throws
/// InputError that names file, line, key, value and the rule that the value broke.
Case read_case(const std::filesystem::path& path);

/// The same from the text of a case file. `name` stands for the file in messages; relative paths in
/// the text are relative to `directory`.
Case parse_case(const std::string& text, const std::string& name,
                const std::filesystem::path& directory);

}  // namespace catena
