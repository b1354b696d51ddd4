// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/svg_elements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/report/palette.hpp"
#include "identify/report/ticks.hpp"

namespace catena::plot {

/// Two decimals, no trailing zeros: a hundredth of a pixel.
std::string place(double value) {
  const double rounded = std::round(value * 100) / 100;
  return exact(rounded == 0 ? 0 : rounded);
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::size_t characters(const std::string& text) {  // of UTF-8
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

double text_width(const std::string& text) {
  constexpr double kWidth = 0.56 * kFontSize;  // of a character of a sans-serif face
  return kWidth * static_cast<double>(characters(text));
}

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more_attributes) {
  return fmt::format(
      "<text class=\"ink\" x=\"{}\" y=\"{}\" text-anchor=\"{}\" fill=\"#1a1a1a\"{}>{}</text>\n",
      place(x), place(y), anchor, more_attributes, escaped(text));
}

std::string upright_text(double x, double y, const std::string& text) {
  if (text.empty()) return "";
  return text_at(x, y, "middle", text,
                 fmt::format(" transform=\"rotate(-90 {} {})\"", place(x), place(y)));
}

std::string path(const std::string& outline, const std::string& attributes) {
  if (outline.empty()) return "";
  return fmt::format("<path d=\"{}\" {}/>\n", outline, attributes);
}

std::string line(double x1, double y1, double x2, double y2, const std::string& attributes) {
  return fmt::format("<path d=\"M{} {}L{} {}\" {}/>\n", place(x1), place(y1), place(x2), place(y2),
                     attributes);
}

std::string stroke(int colour, double width, std::string_view dash) {
  const auto index = static_cast<std::size_t>(colour_index(colour));
  const std::string dashes = dash.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", dash);
  return fmt::format("class=\"c{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\"{}", index,
                     kSeriesColours[index], place(width), dashes);
}

std::string marker(int colour, double x, double y, double r) {
  const auto at = [&](double dx, double dy) {
    return fmt::format("{} {}", place(x + dx), place(y + dy));
  };
  switch (colour_index(colour)) {
    case 0:  // circle
      return fmt::format("M{0}a{1} {1} 0 1 0 {2} 0a{1} {1} 0 1 0 {3} 0", at(-r, 0), place(r),
                         place(2 * r), place(-2 * r));
    case 1:  // upright cross
      return fmt::format("M{}L{}M{}L{}", at(-r, 0), at(r, 0), at(0, -r), at(0, r));
    case 2:  // diagonal cross
      return fmt::format("M{}L{}M{}L{}", at(-r, -r), at(r, r), at(-r, r), at(r, -r));
    case 3:  // square
      return fmt::format("M{}L{}L{}L{}Z", at(-r, -r), at(r, -r), at(r, r), at(-r, r));
    case 4:  // triangle
      return fmt::format("M{}L{}L{}Z", at(0, -r), at(r, r), at(-r, r));
    case 5:  // diamond
      return fmt::format("M{}L{}L{}L{}Z", at(0, -r), at(r, 0), at(0, r), at(-r, 0));
    default:  // triangle on its head
      return fmt::format("M{}L{}L{}Z", at(0, r), at(r, -r), at(-r, -r));
  }
}

}  // namespace catena::plot
