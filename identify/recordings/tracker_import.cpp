// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/tracker_import.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <sstream>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"
#include "identify/recordings/table.hpp"

namespace catena {
namespace {

constexpr double kNotSeen = std::numeric_limits<double>::quiet_NaN();

[[noreturn]] void fail(const std::filesystem::path& file, int line, const std::string& problem) {
  throw InputError(file.string() + ":" + std::to_string(line) + ": " + problem);
}

std::vector<std::string> read_lines(const std::filesystem::path& path) {
  const std::string text = read_whole_file(path);
  std::vector<std::string> lines;
  for (std::string_view line : lines_of(text)) {
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.emplace_back(line);
  }
  return lines;
}

std::vector<std::string> split_cells(const std::string& line, char separator) {
  std::vector<std::string> cells;
  if (line.empty()) return cells;
  for (const std::string_view cell : split(line, separator)) {
    const auto first = cell.find_first_not_of(" \"");
    const auto last = cell.find_last_not_of(" \"");
    cells.emplace_back(first == std::string_view::npos ? "" : cell.substr(first, last - first + 1));
  }
  return cells;
}

double to_number(std::string text, bool decimal_comma, const std::filesystem::path& file,
                 int line) {
  if (text.empty() || text == "NaN" || text == "nan") return kNotSeen;
  if (decimal_comma) std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    fail(file, line, in_quotes(text) + " is not a number");
  return value;
}

/// Seconds from a number or h:mm:ss:cc.
double to_time(const std::string& text, const std::filesystem::path& file, int line) {
  if (text.find(':') == std::string::npos) return to_number(text, true, file, line);
  const std::vector<std::string> parts = split_cells(text, ':');
  if (parts.size() != 4) fail(file, line, in_quotes(text) + " is no time h:mm:ss:cc");
  const auto part = [&](std::size_t i) { return to_number(parts[i], false, file, line); };
  return 3600 * part(0) + 60 * part(1) + part(2) + 0.01 * part(3);
}

Table import_tracker(const std::filesystem::path& path) {
  const std::vector<std::string> lines = read_lines(path);
  if (lines.size() < 3) fail(path, 1, "too short for an export of Tracker");
  const char separator = lines[1].find('\t') != std::string::npos  ? '\t'
                         : lines[1].find(';') != std::string::npos ? ';'
                                                                   : ',';
  std::vector<std::string> tracks = split_cells(lines[0], separator),
                           columns = split_cells(lines[1], separator);
  if (columns.empty() || columns[0] != "t")
    fail(path, 2, "the second line of an export of Tracker begins with t");
  if (tracks.size() == 1) tracks = {"", tracks[0]};  // one track: its name stands alone
  tracks.resize(columns.size());
  Table table;
  table.file = path.string();
  table.names = {"time"};
  std::vector<std::size_t> used = {0};
  std::string track;
  for (std::size_t i = 1; i < columns.size(); ++i) {
    if (!tracks[i].empty()) track = tracks[i];
    if (columns[i] != "x" && columns[i] != "y") continue;
    table.names.push_back(track + " " + columns[i]);
    used.push_back(i);
  }
  table.columns.resize(used.size());
  for (std::size_t l = 2; l < lines.size(); ++l) {
    if (lines[l].empty()) continue;
    std::vector<std::string> cells = split_cells(lines[l], separator);
    cells.resize(std::max(cells.size(), columns.size()));
    for (std::size_t i = 0; i < used.size(); ++i)
      table.columns[i].push_back(
          to_number(cells[used[i]], separator != ',', path, static_cast<int>(l) + 1));
    table.lines.push_back(static_cast<int>(l) + 1);
  }
  return table;
}

Table import_kinovea(const std::filesystem::path& path) {
  const std::vector<std::string> lines = read_lines(path);
  if (lines.empty() || !lines[0].starts_with("#Kinovea"))
    fail(path, 1, "a text export of Kinovea begins with #Kinovea Trajectory data export");
  Table table;
  table.file = path.string();
  table.names = {"time"};
  std::map<double, std::vector<double>> rows;  // by time: tracks need not begin together
  std::map<double, int> line_of;
  std::size_t tracks = 0;
  bool inside = false;
  for (std::size_t l = 1; l < lines.size(); ++l) {
    const int number = static_cast<int>(l) + 1;
    std::istringstream in(lines[l]);
    in.exceptions(std::ios::badbit);  // where memory is refused
    std::vector<std::string> cells;
    for (std::string cell; in >> cell;) cells.push_back(cell);
    if (cells.empty()) {
      inside = false;
      continue;
    }
    const bool title = lines[l][0] == '#';
    if (title && cells.size() >= 2 && cells[0] == "#T") continue;  // "#T X Y"
    if (title || !inside) {
      const std::string name =
          title ? lines[l].substr(std::min(lines[l].size(), lines[l].find_first_not_of("# ")))
                : "track " + std::to_string(tracks + 1);
      table.names.push_back(name + " x");
      table.names.push_back(name + " y");
      ++tracks;
      inside = true;
      if (title) continue;
    }
    if (cells.size() != 3) fail(path, number, "time, x and y are wanted, separated by spaces");
    const double time = to_time(cells[0], path, number);
    std::vector<double>& row = rows[time];
    line_of.emplace(time, number);
    row.resize(2 * tracks, kNotSeen);
    row[2 * tracks - 2] = to_number(cells[1], true, path, number);
    row[2 * tracks - 1] = to_number(cells[2], true, path, number);
  }
  table.columns.resize(table.names.size());
  for (auto& [time, row] : rows) {
    row.resize(2 * tracks, kNotSeen);
    table.columns[0].push_back(time);
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i + 1].push_back(row[i]);
    table.lines.push_back(line_of[time]);
  }
  return table;
}

Table import_deeplabcut(const std::filesystem::path& path, double likelihood_floor) {
  const std::vector<std::string> lines = read_lines(path);
  std::vector<std::string> parts, coordinates;
  std::size_t first = 0;
  for (; first < lines.size(); ++first) {
    const std::vector<std::string> cells = split_cells(lines[first], ',');
    if (cells.empty()) continue;
    if (cells[0] == "bodyparts") parts = cells;
    if (cells[0] == "coords") {
      coordinates = cells;
      ++first;
      break;
    }
    if (cells[0] == "individuals")
      fail(path, static_cast<int>(first) + 1, "several individuals; export one of them");
  }
  if (parts.empty() || coordinates.size() != parts.size())
    fail(path, 1, "an export of DeepLabCut has lines scorer, bodyparts and coords");
  Table table;
  table.file = path.string();
  table.names = {"time"};
  for (std::size_t i = 1; i + 2 < coordinates.size(); i += 3) {
    if (coordinates[i] != "x" || coordinates[i + 1] != "y" || coordinates[i + 2] != "likelihood")
      fail(path, static_cast<int>(first), "columns x, y, likelihood of each body part are wanted");
    table.names.push_back(parts[i] + " x");
    table.names.push_back(parts[i] + " y");
  }
  table.columns.resize(table.names.size());
  for (std::size_t l = first; l < lines.size(); ++l) {
    if (lines[l].empty()) continue;
    const int number = static_cast<int>(l) + 1;
    const std::vector<std::string> cells = split_cells(lines[l], ',');
    if (cells.size() != coordinates.size())
      fail(path, number,
           std::to_string(cells.size()) + " fields; " + std::to_string(coordinates.size()) +
               " are wanted");
    table.columns[0].push_back(to_number(cells[0], false, path, number));
    for (std::size_t i = 1; i + 2 < cells.size(); i += 3) {
      const double likelihood = to_number(cells[i + 2], false, path, number);
      const bool seen = likelihood >= likelihood_floor;
      const std::size_t column = 1 + 2 * (i / 3);
      table.columns[column].push_back(seen ? to_number(cells[i], false, path, number) : kNotSeen);
      table.columns[column + 1].push_back(seen ? to_number(cells[i + 1], false, path, number)
                                               : kNotSeen);
    }
    table.lines.push_back(number);
  }
  return table;
}

}  // namespace

Table import_tracker_table(DataSource source, const std::filesystem::path& path,
                           double likelihood_floor) {
  switch (source) {
    case DataSource::kTracker:
      return import_tracker(path);
    case DataSource::kKinovea:
      return import_kinovea(path);
    case DataSource::kDeepLabCut:
      return import_deeplabcut(path, likelihood_floor);
    case DataSource::kCatena:
      break;
  }
  return read_table(path);
}

}  // namespace catena
