// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace catena {

/// Adds the commands `catena identify` and `catena merge` to the program. When a command has run, its
/// exit status is in `exit_status`. What it throws goes to main, which prints it.
void add_identify_command(CLI::App& program, int& exit_status);

}  // namespace catena
