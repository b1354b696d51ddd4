// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

namespace catena {

struct ProcessResult {
  int exit_status = 0;  ///< 128 + number of the signal if one ended it
  std::string output;   ///< what it wrote to standard output
  std::string errors;   ///< what it wrote to standard error
};

/// Runs a program with arguments (no shell) and waits for it. Throws std::runtime_error naming the
/// program if it cannot be started. Once `stop` is true, the program and those that it started are
/// ended within about a second.
ProcessResult run_process(const std::vector<std::string>& command,
                          const std::atomic<bool>* stop = nullptr);

/// Replaces this process by the program. Returns only by std::runtime_error.
[[noreturn]] void become_process(const std::vector<std::string>& command);

/// The folder of the running program.
std::filesystem::path program_directory();

/// Its value; nullptr where it is not set, or empty.
const char* environment_variable(const char* name);

}  // namespace catena
