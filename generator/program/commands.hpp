// SPDX-License-Identifier: GPL-3.0-or-later
//
// The commands of catena-derive. Each adds itself to the parser; its callback throws InputError
// (exit status 2) or any other exception (1), and sets `status` otherwise.
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

void add_certify_command(CLI::App& app, int& status);
void add_check_command(CLI::App& app, int& status);
void add_derive_command(CLI::App& app, int& status);
void add_verify_command(CLI::App& app, int& status);

}  // namespace catena
