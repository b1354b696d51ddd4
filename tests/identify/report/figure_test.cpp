// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "identify/report/palette.hpp"
#include "identify/report/svg_plot.hpp"
#include "identify/report/ticks.hpp"

namespace catena::plot {
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

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

/// Every start tag is closed, in order.
bool is_well_formed(const std::string& text) {
  std::vector<std::string> open;
  for (auto at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const auto end = text.find('>', at);
    if (end == std::string::npos) return false;
    if (text[end - 1] == '/') continue;
    const std::string name = text.substr(at + 1, text.find_first_of(" >", at) - at - 1);
    if (name.front() != '/') {
      open.push_back(name);
    } else {
      if (open.empty() || "/" + open.back() != name) return false;
      open.pop_back();
    }
  }
  return open.empty();
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

TEST_CASE("numbers to be read again give the same double") {
  for (const double value : {0.1, 1.0 / 3.0, 6.02214076e23, -2.3e-308, 0.0}) {
    CHECK(std::stod(exact(value)) == value);
  }
  CHECK(exact(kNaN).empty());
}

TEST_CASE("linear ticks lie inside and carry what they stand for") {
  struct Row {
    double low, high;
    std::vector<std::string> labels;
  };
  for (const Row& row : {Row{0, 1, {"0.0", "0.2", "0.4", "0.6", "0.8", "1.0"}},
                         Row{-3, 7, {"−2", "0", "2", "4", "6"}},
                         Row{0.0012, 0.0018, {"0.0012", "0.0014", "0.0016", "0.0018"}},
                         Row{2, 2, {"1.0", "1.5", "2.0", "2.5", "3.0"}}}) {
    CAPTURE(row.low);
    std::vector<std::string> labels;
    for (const Tick& tick : linear_ticks(row.low, row.high, 4)) labels.push_back(tick.label);
    CHECK(labels == row.labels);
  }
}

TEST_CASE("logarithmic ticks") {
  std::vector<std::string> labels;
  for (const Tick& tick : logarithmic_ticks(0.02, 3000, 6)) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  CHECK(labels == std::vector<std::string>{"0.1", "1", "10", "100", "1000"});
  labels.clear();
  for (const Tick& tick : logarithmic_ticks(0.002, 0.006, 6)) labels.push_back(tick.label);
  CHECK(labels == std::vector<std::string>{"0.002", "0.005"});
}

TEST_CASE("a figure becomes a drawing with its words, units and as many points as it has") {
  const std::string svg = to_svg(two_lines());
  CHECK(is_well_formed(svg));
  CHECK(svg.find("Mid &amp; load") != std::string::npos);
  CHECK(svg.find("time / s") != std::string::npos);
  CHECK(svg.find("side / m") != std::string::npos);
  CHECK(svg.find("measured, &quot;raw&quot;") != std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
  // Three circles in the plot (two arcs each; the fourth point is NaN) and one in the legend.
  CHECK(count(svg, "a3.5 3.5") == 2 * (3 + 1));
  CHECK(to_svg(two_lines()) == svg);
}

TEST_CASE("values that a logarithmic axis cannot show are left out") {
  Figure figure = two_lines();
  figure.y.logarithmic = true;
  figure.series[1].y = {-1, 0, 0.4};
  const std::string svg = to_svg(figure);
  CHECK(is_well_formed(svg));
  CHECK(svg.find("nan") == std::string::npos);
  CHECK(svg.find("inf") == std::string::npos);
}

TEST_CASE("intervals that end at infinity leave the plot and the ends of the axis stay finite") {
  Figure figure = two_lines();
  figure.series = {{"k", {1, 2}, {3, 4}, Mark::kPoints, 1, {2, -kInfinity}, {5, kInfinity}}};
  const std::string svg = to_svg(figure);
  CHECK(svg.find("inf") == std::string::npos);
  CHECK(svg.find("nan") == std::string::npos);
}

TEST_CASE("figures without a single value still draw") {
  Figure figure = two_lines();
  figure.series.clear();
  CHECK(is_well_formed(to_svg(figure)));
  figure.heat_map = HeatMap{};
  CHECK(is_well_formed(to_svg(figure)));
  figure.heat_map->x = {1};
  figure.heat_map->rows = {"a"};
  figure.heat_map->value = {{kNaN}};
  CHECK(is_well_formed(to_svg(figure)));
}

TEST_CASE("equal aspect: a circle is as wide as it is high") {
  Figure figure;
  figure.id = "circle";
  figure.equal_aspect = true;
  Series circle;
  for (int k = 0; k <= 100; ++k) {
    circle.x.push_back(3 + 2 * std::cos(0.0628318 * k));
    circle.y.push_back(2 * std::sin(0.0628318 * k));
  }
  figure.series = {circle};
  const std::string svg = to_svg(figure);
  const auto number_after = [&](const std::string& key) {
    return std::stod(svg.substr(svg.find(key, svg.find("<clipPath")) + key.size()));
  };
  CHECK(number_after(" width=\"") / number_after(" height=\"") ==
        doctest::Approx(1.08 / 1.1).epsilon(0.001));  // the margins of x and y differ
}

TEST_CASE("a heat map keeps its cells' values apart and its comma-separated values whole") {
  Figure figure;
  figure.id = "map";
  figure.x = {"time", "s"};
  HeatMap map;
  map.x = {0, 0.5};
  map.rows = {"marker 1", "marker 2"};
  map.value = {{0, 1.0 / 3.0}, {kNaN, 3}};
  map.scale = {"residual", "mm"};
  figure.heat_map = map;
  const std::string svg = to_svg(figure);
  CHECK(is_well_formed(svg));
  CHECK(svg.find(sequential_colour(0)) != std::string::npos);
  CHECK(svg.find(sequential_colour(1)) != std::string::npos);
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
      to_svg(figure);
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

TEST_CASE("the colour scales darken or lighten steadily, so that grey prints can be read") {
  const auto lightness = [](const std::string& colour) {
    const auto part = [&](std::size_t at) { return std::stoi(colour.substr(at, 2), nullptr, 16); };
    return 0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5);
  };
  for (int k = 1; k <= 20; ++k) {
    CAPTURE(k);
    CHECK(lightness(sequential_colour(k / 20.0)) < lightness(sequential_colour((k - 1) / 20.0)));
    CHECK(lightness(signed_colour(k / 20.0)) > lightness(signed_colour((k - 1) / 20.0)));
  }
}

}  // namespace
}  // namespace catena::plot
