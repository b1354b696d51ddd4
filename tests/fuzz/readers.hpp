// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>

namespace catena::tests {

/// A reader of files that others may have written.
struct Reader {
  const char* name;  ///< its inputs are in corpora/NAME/
  /// Reads `text` as the reader's kind of file. Throws only what is no refusal: a fault.
  void (*read)(const std::string& text);
};

std::span<const Reader> readers();

/// The path of a file with this text, in a folder of the program's own.
std::filesystem::path written(const std::string& name, const std::string& text);

/// Apart: the results of a fit and those of a file have the same names.
void read_a_run_log(const std::string& text);

}  // namespace catena::tests
