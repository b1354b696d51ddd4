// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/start_reader.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "common/number_text.hpp"
#include "identify/cases/case_numbers.hpp"
#include "identify/cases/case_words.hpp"

namespace catena {
namespace {

/// Angles in rad, or rates in rad/s. Sines of greater angles have fewer digits.
constexpr double kGreatestAngle = 1e6;

void check_sizes(const TomlTable& table, std::string_view key, const std::vector<double>& values) {
  for (const double value : values)
    if (!(std::abs(value) <= kGreatestAngle))
      table.fail(key, shortest_number(value) + "; must lie within -1e6 and 1e6");
}

void check_coefficients(const TomlTable& table, std::string_view key, Shape shape, int links,
                        int terms, const std::vector<double>& values) {
  check_sizes(table, key, values);
  const std::size_t given = values.size();
  const int expected = shape == Shape::kStraight ? 1
                       : shape == Shape::kAngles ? links
                       : shape == Shape::kSmooth ? terms
                                                 : 0;
  if (given != 0 && given != static_cast<std::size_t>(expected))
    table.fail(key, std::to_string(given) + " numbers; this shape has " + std::to_string(expected));
}

/// One number for all links, under `key`, or one per link, under `key` + "s"; empty if neither is there.
std::vector<double> read_of_links(const TomlTable& table, const std::string& key, int links) {
  const std::string list = key + "s";
  if (table.has(key) && table.has(list)) table.fail_choice({key, list});
  std::vector<double> values = table.numbers(list);
  if (const auto one = table.optional_number(key))
    values.assign(static_cast<std::size_t>(links), *one);
  check_coefficients(table, table.has(key) ? key : list, Shape::kAngles, links, 0, values);
  return values;
}

/// A list beside that of the angles (or rates) in the plane, which has the key `beside`.
std::vector<double> read_out_of_plane(const TomlTable& table, const std::string& key,
                                      const std::vector<double>& in_plane,
                                      const std::string& beside) {
  std::vector<double> values = table.numbers(key);
  check_sizes(table, key, values);
  if (!values.empty() && values.size() != in_plane.size())
    table.fail(key, std::to_string(values.size()) + " numbers; must be as many as in `" + beside +
                        "`, " + std::to_string(in_plane.size()));
  return values;
}

}  // namespace

InitialSpec read_initial(const TomlTable& table, int links) {
  InitialSpec initial;
  initial.shape = static_cast<Shape>(table.choice("shape", kShapeWords));
  const bool linear = initial.shape == Shape::kStraight || initial.shape == Shape::kAngles ||
                      initial.shape == Shape::kSmooth;
  if (initial.shape == Shape::kSmooth) initial.terms = count(table, "terms", initial.terms, 1);
  if (initial.shape == Shape::kStraight && table.has("angle"))
    initial.coefficients = {table.number("angle")};
  if (initial.shape == Shape::kAngles) initial.coefficients = table.numbers("angles");
  if (initial.shape == Shape::kSmooth) initial.coefficients = table.numbers("coefficients");
  const char* const coefficients = initial.shape == Shape::kAngles     ? "angles"
                                   : initial.shape == Shape::kStraight ? "angle"
                                                                       : "coefficients";
  check_coefficients(table, coefficients, initial.shape, links, initial.terms,
                     initial.coefficients);
  if (linear) initial.free = table.optional_flag("free").value_or(false);
  if (initial.shape == Shape::kCatenary) {
    const TomlTable held = table.table("held");
    initial.held = {held.number("side"), held.number("down")};
    if (!std::isfinite(initial.held[0]) || !std::isfinite(initial.held[1]))
      held.fail("not finite; side and down of the held point are wanted, in m");
    initial.ends_at_held = table.optional_flag("ends_at_held").value_or(false);
  }
  if (const auto velocity = table.optional_table("velocity")) {
    initial.at_rest = false;
    initial.velocity_shape =
        static_cast<Shape>(velocity->choice("shape", {"straight", "angles", "smooth"}));
    if (initial.velocity_shape == Shape::kSmooth)
      initial.velocity_terms = count(*velocity, "terms", initial.velocity_terms, 1);
    initial.velocity_coefficients = velocity->numbers("rates");
    check_coefficients(*velocity, "rates", initial.velocity_shape, links, initial.velocity_terms,
                       initial.velocity_coefficients);
    initial.velocity_free = velocity->optional_flag("free").value_or(false);
    initial.azimuth_rates = read_of_links(*velocity, "azimuth_rate", links);
    initial.out_of_plane_rates =
        read_out_of_plane(*velocity, "out_of_plane_rates", initial.velocity_coefficients, "rates");
  }
  initial.azimuths = read_of_links(table, "azimuth", links);
  if (linear)
    initial.out_of_plane =
        read_out_of_plane(table, "out_of_plane", initial.coefficients, coefficients);
  for (const TomlTable& entry : table.tables("load")) {
    LoadStart start{entry.text("coordinate"), entry.number("value"),
                    entry.optional_number("rate").value_or(0)};
    for (const LoadStart& other : initial.load)
      if (other.coordinate == start.coordinate)
        entry.fail("coordinate",
                   in_quotes(start.coordinate) + " stands there twice; leave one away");
    if (!std::isfinite(start.value) || !std::isfinite(start.rate))
      entry.fail("value and rate must be finite");
    initial.load.push_back(std::move(start));
  }
  return initial;
}

}  // namespace catena
