// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

/// What a figure shows, apart from how it is drawn: the page (web/source/chart.js) and the script for
/// papers (scripts/figures.py) draw it.
namespace catena::report {

struct Tick {
  double at;
  std::string label;
};

struct Axis {
  std::string label;                         ///< "time", "residual"
  std::string unit;                          ///< "s", "mm"; "1" or empty: no unit is written
  bool logarithmic = false;                  ///< values that are not positive are left out
  std::vector<std::string> categories = {};  ///< if given, the value k + 1 stands for categories[k]
  std::vector<Tick> ticks = {};  ///< if given, in place of round numbers; all are in sight
};

/// kBars: lying ones, from x = 0, for a y axis with categories.
enum class Mark { kLine, kPoints, kLineWithPoints, kBars };
inline constexpr double kBarThickness =
    0.3;  // of a row; web/source/marks.js and scripts/figures.py have it, too

/// Points (x[i], y[i]), in units of the axes. NaN interrupts a line.
struct Series {
  std::string name;
  std::vector<double> x, y;
  Mark mark = Mark::kLine;
  /// 0 is the ink (measured data), 1 .. 6 colours that colour-blind readers can tell apart, each
  /// with its own dash and marker; larger numbers start again at 1.
  int colour = 0;
};

/// A straight line across the figure at one value of x (vertical) or y, with a few words.
struct Rule {
  bool vertical = false;
  double at = 0;
  std::string label;
};

/// A value for each row and each x; rows go downwards. NaN is left blank.
struct HeatMap {
  std::vector<double> x;                   ///< centres of the cells, ascending
  std::vector<std::string> rows;           ///< names of the rows
  std::vector<std::vector<double>> value;  ///< [row][x]
  Axis scale;                              ///< what the colours mean; linear
  bool is_signed = false;         ///< colours run from -max to +max, else from 0 (or low) to max
  std::optional<double> maximum;  ///< end of the colour scale; absent: largest size of a value
};

/// Either series or a heat map (whose rows take the place of the y axis).
struct Figure {
  std::string id;       ///< file name without extension: letters, digits, - and _
  std::string title;    ///< a few words
  std::string caption;  ///< a sentence or two; may be empty
  Axis x, y;
  std::vector<Series> series;
  std::vector<Rule> rules;
  std::optional<HeatMap> heat_map;
  bool equal_aspect = false;  ///< one unit of x is as long as one of y
  bool y_downwards = false;   ///< y grows downwards, as "down" does
};

/// Throws std::invalid_argument, naming figure and series, where x and y differ in length, a heat
/// map is not rows by x, or the id is no file name.
void check(const Figure& figure);

/// A field of comma-separated values: a text, quoted where it has commas, quotes or line ends; a
/// number, empty where NaN.
std::string csv_field(const std::string& text);
std::string csv_field(double value);

/// The figure's numbers as comma-separated values (RFC 4180, digits that give back the same double, empty
/// where NaN): columns series, x, y; a heat map: row, x, value. The heading line names quantities with units.
/// Throws as check.
std::string to_csv(const Figure& figure);

}  // namespace catena::report
