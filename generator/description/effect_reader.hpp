// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "generator/description/effect.hpp"
#include "generator/description/toml_reader.hpp"

namespace catena {

/// read_effect for a file that is parsed already.
Effect read_effect(const TomlTable& file);

}  // namespace catena
