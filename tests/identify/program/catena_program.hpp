// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "identify/models/process.hpp"
#include "tests/support/data.hpp"
#include "tests/support/temporary_folder.hpp"

namespace catena::testing {

/// catena as a user runs it: exit status and what it printed, errors after the rest, in `output`.
inline ProcessResult run_catena(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), tests::build_folder() / "bin" / "catena");
  ProcessResult result = run_process(arguments);
  result.output += result.errors;
  return result;
}

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error("the text lacks \"" + from + "\"");
  return text.replace(at, from.size(), to);
}

/// Two links swing for a second.
inline const char* const kSwing = R"(format = 1
kind = "case"

[model]
links = 2

[cable]
length = 1.0
density = 0.3
load_mass = 0.2

[[parameter]]
name = "k"
sets = "stiffness"
value = 0.1
unit = "N m/rad"

[[parameter]]
name = "c"
sets = "damping"
value = 0.005
unit = "N m s/rad"

[initial]
shape = "straight"
angle = 0.6

[simulation]
duration = 1.0
step = 0.02
)";

/// The same with k and c unknown, and swing/positions.csv as data.
inline const char* const kFit = R"(format = 1
kind = "case"

[model]
links = 2

[cable]
length = 1.0
density = 0.3
load_mass = 0.2

[[parameter]]
name = "k"
sets = "stiffness"
value = 0.05
unit = "N m/rad"
free = true
lower = 0.001
upper = 1.0

[[parameter]]
name = "c"
sets = "damping"
value = 0.002
unit = "N m s/rad"
free = true
lower = 0.0001
upper = 1.0

[initial]
shape = "straight"
angle = 0.6

[[experiment]]
name = "swing"
data = "swing/positions.csv"
kind = "markers"
fit_until = 0.6

[error]
measure = "mean_distance"
)";

}  // namespace catena::testing
