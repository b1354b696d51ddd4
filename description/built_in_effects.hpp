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

/// All of them, by id. Defined in a source that CMake writes from the files (CMakeLists.txt).
std::span<const BuiltInEffect> built_in_effects();

}  // namespace catena
