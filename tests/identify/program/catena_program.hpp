// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/models/process.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

namespace catena::testing {

/// catena as a user runs it: exit status and what it printed, errors after the rest, in `output`.
inline ProcessResult run_catena(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), tests::build_folder() / "bin" / "catena");
  ProcessResult result = run_process(arguments);
  result.output += result.errors;
  return result;
}

/// Two links swing for a second.
inline const std::string kSwing = text_of(tests::source_folder() / "tests/support/swing.toml");

/// The same with k and c unknown, and swing/positions.csv as data.
inline const std::string kFit = text_of(tests::source_folder() / "tests/support/fit.toml");

}  // namespace catena::testing
