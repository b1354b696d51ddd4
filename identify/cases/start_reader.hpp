// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/toml_reader.hpp"
#include "identify/cases/case.hpp"

namespace catena {

/// Reads and checks a table [initial], of a case or of an experiment, for a chain of `links`. Throws
/// InputError with file, line, key, value and rule.
InitialSpec read_initial(const TomlTable& table, int links);

}  // namespace catena
