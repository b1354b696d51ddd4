// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "common/number_text.hpp"

namespace catena::report {
namespace {

/// "time / s"; the label alone where there is no unit.
std::string axis_title(const Axis& axis) {
  if (axis.unit.empty() || axis.unit == "1") return axis.label;
  return axis.label.empty() ? axis.unit : fmt::format("{} / {}", axis.label, axis.unit);
}

std::string csv_heading(const Axis& axis, const std::string& otherwise) {
  const std::string title = axis_title(axis);
  return csv_field(title.empty() ? otherwise : title);
}

/// The category a value stands for, or the value.
std::string csv_value(const Axis& axis, double value) {
  const auto index = static_cast<std::size_t>(value);
  if (value >= 1 && index <= axis.categories.size()) return csv_field(axis.categories[index - 1]);
  return csv_field(value);
}

}  // namespace

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string csv_field(double value) { return std::isnan(value) ? "" : shortest_number(value); }

void check(const Figure& figure) {
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("figure \"" + figure.id + "\": " + what);
  };
  const auto in_file_names = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
           c == '_';
  };
  if (figure.id.empty() || !std::all_of(figure.id.begin(), figure.id.end(), in_file_names)) {
    fail("the id must be letters, digits, - and _");
  }
  for (const Series& series : figure.series) {
    if (series.x.size() != series.y.size()) {
      fail("series \"" + series.name + "\" has " + std::to_string(series.x.size()) + " x and " +
           std::to_string(series.y.size()) + " y; there must be as many of each");
    }
  }
  if (!figure.heat_map) return;
  if (!figure.series.empty()) fail("a heat map and series cannot share a figure");
  const HeatMap& map = *figure.heat_map;
  if (map.value.size() != map.rows.size())
    fail("the heat map must have one row of values per name");
  for (const auto& row : map.value) {
    if (row.size() != map.x.size()) fail("each row of the heat map must have one value per x");
  }
}

std::string to_csv(const Figure& figure) {
  check(figure);
  const std::string x = csv_heading(figure.x, "x");
  if (figure.heat_map) {
    const HeatMap& map = *figure.heat_map;
    std::string text = fmt::format("row,{},{}\n", x, csv_heading(map.scale, "value"));
    for (std::size_t row = 0; row < map.rows.size(); ++row) {
      for (std::size_t k = 0; k < map.x.size(); ++k) {
        text += fmt::format("{},{},{}\n", csv_field(map.rows[row]), csv_value(figure.x, map.x[k]),
                            csv_field(map.value[row][k]));
      }
    }
    return text;
  }
  std::string text = fmt::format("series,{},{}\n", x, csv_heading(figure.y, "y"));
  for (const Series& series : figure.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      text += fmt::format("{},{},{}\n", csv_field(series.name), csv_value(figure.x, series.x[i]),
                          csv_value(figure.y, series.y[i]));
    }
  }
  return text;
}

}  // namespace catena::report
