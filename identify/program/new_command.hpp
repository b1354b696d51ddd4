// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace CLI {
class App;
}

namespace catena {

/// Adds the command `catena new` to the program. When the command has run, its exit status is in
/// `exit_status`. What it throws goes to main, which prints it.
void add_new_command(CLI::App& program, int& exit_status);

}  // namespace catena
