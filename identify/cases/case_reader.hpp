// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "identify/cases/case.hpp"

namespace catena {

/// The most starts of a multi-start, and refits of a bootstrap. More make nothing surer: an end of a
/// bootstrap's interval is then known to 2 % of a standard error.
inline constexpr int kMostFits = 100'000;

/// Recordings that a caller hands in, by the name of their experiment: as tables, with the columns,
/// units and axes that the file named by the case would have.
using HandedIn = std::map<std::string, std::shared_ptr<const Table>>;

/// Reads and checks a case file. Paths in it are relative to the folder of the file. Throws
/// InputError that names file, line, key, value and the rule that the value broke. A recording that is
/// handed in needs no file.
Case read_case(const std::filesystem::path& path, const HandedIn& recordings = {});

/// The same from the text of a case file. `name` stands for the file in messages; relative paths in
/// the text are relative to `directory`.
Case parse_case(const std::string& text, const std::string& name,
                const std::filesystem::path& directory, const HandedIn& recordings = {});

}  // namespace catena
