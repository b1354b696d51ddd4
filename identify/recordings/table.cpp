// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <sstream>

#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/whole_file.hpp"

namespace catena {
namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> fields;
  std::size_t begin = 0;
  for (std::size_t end; (end = line.find(',', begin)) != std::string::npos; begin = end + 1)
    fields.push_back(trimmed(std::string_view(line).substr(begin, end - begin)));
  fields.push_back(trimmed(std::string_view(line).substr(begin)));
  return fields;
}

}  // namespace

bool Table::has(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double>& Table::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(file + ": there is no column \"" + std::string(name) + "\"" +
                     suggestion(name, names));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const std::filesystem::path& path) {
  std::istringstream in(read_whole_file(path));
  Table table;
  table.file = path.string();
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (trimmed(line).empty()) continue;
    const std::vector<std::string> fields = split(line);
    const std::string where = table.file + ":" + std::to_string(number);
    if (table.names.empty()) {
      table.names = fields;
      table.columns.resize(fields.size());
      continue;
    }
    if (fields.size() != table.names.size())
      throw InputError(where + ": " + std::to_string(fields.size()) +
                       " fields; the first line names " + std::to_string(table.names.size()));
    for (std::size_t i = 0; i < fields.size(); ++i) {
      double value = std::numeric_limits<double>::quiet_NaN();
      if (!fields[i].empty()) {
        const char* begin = fields[i].data() + (fields[i][0] == '+');
        const char* end = fields[i].data() + fields[i].size();
        const auto [stop, error] = std::from_chars(begin, end, value);
        if (error != std::errc() || stop != end || !std::isfinite(value))
          throw InputError(where + ": column \"" + table.names[i] + "\": \"" + fields[i] +
                           "\" is not a number; leave a field empty where nothing was seen");
      }
      table.columns[i].push_back(value);
    }
    table.lines.push_back(number);
  }
  if (table.names.empty())
    throw InputError(table.file + ": empty; a line of column names is wanted");
  return table;
}

}  // namespace catena
