// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

/// Adds the hidden command `manual --output FOLDER`. It writes what --help says of the program and
/// its commands as a manual page, FOLDER/NAME.1, and as completions for bash and zsh, FOLDER/NAME
/// and FOLDER/_NAME, where NAME is the program's. Call it last: the commands are read when it runs.
///
/// A command without options of its own is one that the program hands over to catena-derive: its
/// completion is that program's.
void add_manual_command(CLI::App& program);

}  // namespace catena
