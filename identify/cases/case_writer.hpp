// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "identify/cases/case.hpp"

namespace catena {

/// The case as text that parse_case reads back to the same case. Paths are written relative to
/// `directory`; numbers read back to the same doubles.
std::string case_text(const Case& the_case, const std::filesystem::path& directory);

}  // namespace catena
