// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

/// Checks that the first argument, unless it is an option, names a command of `program`.
/// Throws InputError that names the nearest command. Call it before program.parse, which would only
/// say that a command is required.
void check_command_name(const CLI::App& program, int argc, const char* const* argv);

/// Checks for options whose value is a number above zero, or not below zero. The message names the
/// option, the value and the rule.
CLI::Validator positive_number();
CLI::Validator non_negative_number();

/// To be asked last: `status`, or 1 after a message on standard error where something that was
/// printed could not be written (a full disk).
int status_after_output(const char* program, int status);

}  // namespace catena
