// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string_view>

namespace catena {

/// One file of description/effects/, compiled in.
struct BuiltInEffect {
  std::string_view id;
  std::string_view text;
};

/// All built-in effects, sorted by id. CMake writes the source of this function from the files.
std::span<const BuiltInEffect> built_in_effects();

}  // namespace catena
