// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "identify/results/result_file.hpp"

namespace catena::report {

using namespace results;

/// Where to write; empty: not at all.
struct ReportFiles {
  std::filesystem::path html;  ///< one self-contained file
  std::filesystem::path csv;   ///< folder: <figure>.csv for each figure, parameters.csv
};

struct Written {
  std::size_t figures = 0;
  std::size_t html_bytes = 0;
};

/// Writes the report, each file whole or not at all; folders are made. Throws InputError naming the
/// path that cannot be written.
Written write_report(const Document& document, const ReportFiles& files);

/// The data of all figures as JSON (payload.hpp), nothing thinned.
std::string report_json(const Document& document);

}  // namespace catena::report
