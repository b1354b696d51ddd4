// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

/// Adds the command `catena cache` to the program. When the command has run, its exit status is in
/// `exit_status`. What it throws goes to main, which prints it.
void add_cache_command(CLI::App& program, int& exit_status);

}  // namespace catena
