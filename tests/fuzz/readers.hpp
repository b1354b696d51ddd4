// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/input_error.hpp"

namespace catena::tests {

/// A reader of files that others may have written.
struct Reader {
  const char* name;  ///< its inputs are in corpora/NAME/
  /// Reads `text` as the reader's kind of file. Throws only what is no refusal: a fault.
  void (*read)(const std::string& text);
};

// Apart, as libFuzzer looks at all code of a program after each input.
std::span<const Reader> description_readers();
std::span<const Reader> recording_readers();
std::span<const Reader> run_log_readers();
std::span<const Reader> result_readers();
std::span<const Reader> derivation_readers();

/// The path of a file with this text, in a folder of the program's own.
std::filesystem::path written(const std::string& name, const std::string& text);

/// Throws what is a fault if a message is longer than some quoted values, listed names and names of
/// files are.
void require_short(std::string_view message);

template <void (*read)(const std::string&)>
void refused_or_read(const std::string& text) {
  try {
    read(text);
  } catch (const InputError& error) {
    require_short(error.what());
  }
}

}  // namespace catena::tests
