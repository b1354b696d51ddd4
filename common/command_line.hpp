// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>

namespace catena {

/// Checks that the first argument names a command or an option of `program`. Throws InputError that
/// names the nearest one. Call it before program.parse, which would only say that a command is
/// required.
void check_first_argument(const CLI::App& program, int argc, const char* const* argv);

/// Prints the help that was asked for, or what is wrong with the command line: with the command, the
/// option and the nearest one that exists. Returns the exit status, 0 or 2.
int status_of(const CLI::App& program, const CLI::ParseError& error);

/// Checks for options whose value is a number above zero, or not below zero. The message names the
/// option, the value and the rule.
CLI::Validator positive_number();
CLI::Validator non_negative_number();

/// --yes, with which a command begins work above kMostUnasked (large_work.hpp), too.
void add_yes_option(CLI::App& command, bool& yes);

/// Some functions of libraries that must not throw ask for memory: where there is none, the program
/// ends with status 1 and says so, instead of by a signal.
void end_where_memory_is_short(const char* program);

/// The first refusal of memory ends the program with status 1, and it says so. For programs that use
/// libraries which cannot be used any more, nor even destroyed, after an exception within them.
void end_at_first_memory_shortage(const char* program);

/// What end_at_first_memory_shortage does, for libraries that do not allocate by operator new.
[[noreturn]] void end_without_memory();

/// To be asked last: `status`, or 1 after a message on standard error where something that was
/// printed could not be written (a full disk).
int status_after_output(const char* program, int status);

}  // namespace catena
