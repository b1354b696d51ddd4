// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/table.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <optional>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"

namespace catena {
namespace {

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1));
}

std::vector<std::string> trimmed_fields(std::string_view line, char separator) {
  std::vector<std::string> fields;
  for (const std::string_view field : split(line, separator)) fields.push_back(trimmed(field));
  return fields;
}

/// Of the line of names.
char separator_of(std::string_view line) {
  for (const char separator : {';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ',';
}

/// NaN if the field says that there is no number; nothing if it cannot be read.
std::optional<double> number_of(std::string field, char separator) {
  if (field.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (separator != ',') std::replace(field.begin(), field.end(), ',', '.');
  double value = 0;
  const char* begin = field.data() + (field[0] == '+');
  const char* end = field.data() + field.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end || std::isinf(value)) return {};
  return value;
}

}  // namespace

bool Table::has(std::string_view name) const {
  return std::find(names.begin(), names.end(), name) != names.end();
}

const std::vector<double>& Table::column(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    throw InputError(file + ": there is no column " + in_quotes(name) + suggestion(name, names));
  if (std::find(found + 1, names.end(), name) != names.end())
    throw InputError(file + ": two columns are called " + in_quotes(name) + "; rename one");
  return columns[static_cast<std::size_t>(found - names.begin())];
}

Table read_table(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  Table table;
  table.file = path.string();
  char separator = ',';
  int number = 0;
  for (std::string_view line : lines_of(text)) {
    if (++number == 1 && line.starts_with("\xEF\xBB\xBF"))
      line.remove_prefix(3);  // a byte order mark
    if (trimmed(line).empty()) continue;
    if (table.names.empty()) separator = separator_of(line);
    const std::vector<std::string> fields = trimmed_fields(line, separator);
    const std::string where = table.file + ":" + std::to_string(number);
    if (table.names.empty()) {
      const auto is_number = [&](const std::string& field) {
        return !field.empty() && number_of(field, separator).has_value();
      };
      if (std::all_of(fields.begin(), fields.end(), is_number))
        throw InputError(where + ": numbers, where the names of the columns are wanted, such as " +
                         "time_s,side_1_m,down_1_m; write that line above them");
      table.names = fields;
      table.columns.resize(fields.size());
      continue;
    }
    if (fields.size() != table.names.size())
      throw InputError(where + ": " + std::to_string(fields.size()) +
                       " fields; the first line names " + std::to_string(table.names.size()));
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const std::optional<double> value = number_of(fields[i], separator);
      if (!value)
        throw InputError(where + ": column " + in_quotes(table.names[i]) + ": " +
                         in_quotes(fields[i]) +
                         " is not a number; leave a field empty where nothing was seen");
      table.columns[i].push_back(*value);
    }
    table.lines.push_back(number);
  }
  if (table.names.empty())
    throw InputError(table.file + ": empty; a line of column names is wanted");
  return table;
}

}  // namespace catena
