// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

/// Adds the hidden command `manual --output FOLDER` to `program`. It writes the texts of --help as
/// a manual page, FOLDER/NAME.1, and as completions for bash and zsh, FOLDER/NAME and FOLDER/_NAME,
/// where NAME is the name of the program.
///
/// A command without options of its own is one that catena-derive carries out: its completion is
/// that of catena-derive.
void add_manual_command(CLI::App& program);

}  // namespace catena
