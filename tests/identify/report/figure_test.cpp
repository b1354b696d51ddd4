// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/figure.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "identify/report/readable.hpp"

namespace catena::report {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Figure two_lines() {
  Figure figure;
  figure.id = "two_lines";
  figure.title = "Mid & load";
  figure.x = {"time", "s"};
  figure.y = {"side", "m"};
  figure.series = {{"measured, \"raw\"", {0, 1, 2, 3}, {0.1, 0.2, kNaN, 0.4}, Mark::kPoints, 0},
                   {"simulated", {0, 1.5, 3}, {0.1, 0.25, 0.4}, Mark::kLine, 1}};
  return figure;
}

TEST_CASE("numbers for people") {
  struct Row {
    double value;
    int digits;
    const char* text;
  };
  for (const Row& row :
       {Row{0, 4, "0"}, Row{1, 4, "1"}, Row{-0.25, 4, "−0.25"}, Row{9.99996, 4, "10"},
        Row{0.00012345, 3, "0.000123"}, Row{1.2e-7, 4, "1.2×10⁻⁷"}, Row{1e-9, 4, "10⁻⁹"},
        Row{-1e12, 4, "−10¹²"}, Row{123456, 3, "123456"}, Row{kNaN, 4, "–"}, Row{kInfinity, 4, "∞"},
        Row{-kInfinity, 4, "−∞"}}) {
    CAPTURE(row.value);
    CHECK(for_people(row.value, row.digits) == row.text);
  }
}

TEST_CASE("a heat map has a line of comma-separated values for each cell") {
  Figure figure;
  figure.id = "map";
  figure.x = {"time", "s"};
  HeatMap map;
  map.x = {0, 0.5};
  map.rows = {"marker 1", "marker 2"};
  map.value = {{0, 1.0 / 3.0}, {kNaN, 3}};
  map.scale = {"residual", "mm"};
  figure.heat_map = map;
  CHECK(to_csv(figure) ==
        "row,time / s,residual / mm\n"
        "marker 1,0,0\nmarker 1,0.5,0.3333333333333333\nmarker 2,0,\nmarker 2,0.5,3\n");
}

TEST_CASE("comma-separated values quote what needs it") {
  CHECK(to_csv(two_lines()) ==
        "series,time / s,side / m\n"
        "\"measured, \"\"raw\"\"\",0,0.1\n\"measured, \"\"raw\"\"\",1,0.2\n"
        "\"measured, \"\"raw\"\"\",2,\n\"measured, \"\"raw\"\"\",3,0.4\n"
        "simulated,0,0.1\nsimulated,1.5,0.25\nsimulated,3,0.4\n");
}

TEST_CASE("what cannot be drawn is refused by name") {
  const auto message = [](const Figure& figure) -> std::string {
    try {
      check(figure);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  Figure uneven = two_lines();
  uneven.series[1].y.pop_back();
  CHECK(
      message(uneven) ==
      "figure \"two_lines\": series \"simulated\" has 3 x and 2 y; there must be as many of each");
  Figure unnamed = two_lines();
  unnamed.id = "a/b";
  CHECK(message(unnamed) == "figure \"a/b\": the id must be letters, digits, - and _");
  Figure both = two_lines();
  both.heat_map = HeatMap{};
  CHECK(message(both).find("cannot share") != std::string::npos);
  both.series.clear();
  both.heat_map->rows = {"a"};
  CHECK(message(both).find("one row of values per name") != std::string::npos);
}

}  // namespace
}  // namespace catena::report
