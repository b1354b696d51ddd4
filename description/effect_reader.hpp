// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/toml_reader.hpp"
#include "description/effect.hpp"

namespace catena {

/// read_effect (effect.hpp) for a TOML table that is parsed already.
Effect read_effect(const TomlTable& file);

}  // namespace catena
