// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace catena {

/// Columns of numbers under their names, from a CSV file or handed in. An empty field is NaN, and so
/// is "NaN".
struct Table {
  std::string file;
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;
  std::vector<int> lines;  ///< of the file, one per row; of what is handed in, the rows from 0

  /// Lines of numbers; whether there is a column of this name.
  std::size_t rows() const { return lines.size(); }
  bool has(std::string_view name) const;
  /// Throws InputError naming the file and the nearest column.
  const std::vector<double>& column(std::string_view name) const;
};

/// Reads a CSV file with one line of names. The fields are separated by semicolons or tabulators if
/// the line of names has any; then numbers may have decimal commas. Else they are separated by commas.
/// Throws InputError naming file, line and column for a field that is not a number (inf is not), and
/// for rows that are too short or too long.
Table read_table(const std::filesystem::path& path);

}  // namespace catena
