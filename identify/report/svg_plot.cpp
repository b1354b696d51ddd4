// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "identify/report/palette.hpp"
#include "identify/report/svg_elements.hpp"
#include "identify/report/ticks.hpp"

namespace catena::plot {
namespace {

constexpr double kTitleSize = 14;

constexpr double kLegendSample = 30;

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void include(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  bool empty() const { return low > high; }
  double span() const { return high - low; }
};

/// One axis: from values to places on the paper.
struct Scale {
  Range range;
  bool logarithmic = false;
  double from = 0, to = 0;  // on the paper

  bool shows(double value) const { return std::isfinite(value) && (!logarithmic || value > 0); }
  double operator()(double value) const {
    const double fraction = logarithmic
                                ? std::log(value / range.low) / std::log(range.high / range.low)
                                : (value - range.low) / range.span();
    return from + fraction * (to - from);
  }
};

void widen(Range& range, const Axis& axis, double margin) {
  if (range.empty()) {
    range.low = axis.logarithmic ? 1 : 0;
    range.high = axis.logarithmic ? 10 : 1;
  }
  if (!axis.categories.empty()) {
    range.low = 0.5;
    range.high = static_cast<double>(axis.categories.size()) + 0.5;
  } else if (axis.logarithmic) {
    const double factor = range.low == range.high ? 2 : std::pow(range.high / range.low, margin);
    range.low /= factor;
    range.high *= factor;
  } else {
    const double size = std::max(std::abs(range.low), std::abs(range.high));
    const double extra = range.span() > 1e-12 * size ? margin * range.span()
                         : size > 0                  ? size / 2
                                                     : 1;
    range.low -= extra;
    range.high += extra;
  }
}

std::vector<Tick> ticks_of(const Axis& axis, const Range& range, int about) {
  if (!axis.categories.empty()) {
    std::vector<Tick> ticks;
    for (std::size_t k = 0; k < axis.categories.size(); ++k) {
      ticks.push_back({static_cast<double>(k + 1), axis.categories[k]});
    }
    return ticks;
  }
  if (!axis.ticks.empty()) return axis.ticks;
  return axis.logarithmic ? logarithmic_ticks(range.low, range.high, about)
                          : linear_ticks(range.low, range.high, about);
}

/// The drawing of one figure.
class Drawing {
 public:
  Drawing(const Figure& figure, const SvgOptions& options)
      : figure_(figure), width_(options.width), height_(options.height) {}

  std::string text() {
    top_ = 12;
    heading();
    legend();
    scales();
    std::string body;
    std::swap(body, body_);
    if (figure_.heat_map) {
      heat_map();
    } else {
      grid();
      curves();
    }
    axes();
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{0}\" "
        "viewBox=\"0 0 {1} {2}\" width=\"{1}\" height=\"{2}\" "
        "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"{3}\">\n"
        "<rect class=\"paper\" width=\"{1}\" height=\"{2}\" fill=\"#ffffff\"/>\n{4}{5}</svg>\n",
        escaped(figure_.title), place(width_), place(height_), place(kFontSize), body, body_);
  }

 private:
  void heading() {
    if (figure_.title.empty()) return;
    top_ += kTitleSize;
    body_ += text_at(12, top_, "start", figure_.title,
                     fmt::format(" font-weight=\"bold\" font-size=\"{}\"", place(kTitleSize)));
    top_ += 10;
  }

  void legend() {
    double x = 12;
    bool any = false;
    for (const Series& series : figure_.series) {
      if (series.name.empty()) continue;
      const double needed = kLegendSample + 8 + text_width(series.name) + 16;
      if (!any) top_ += kFontSize;
      if (any && x + needed > width_) {
        x = 12;
        top_ += 1.5 * kFontSize;
      }
      any = true;
      const double y = top_ - 4;
      if (has_line(series)) {
        body_ += line(x, y, x + kLegendSample, y, stroke(series.colour, 1.6, dash_of(series)));
      }
      if (has_points(series)) {
        body_ += path(marker(series.colour, x + kLegendSample / 2, y, 3.5),
                      stroke(series.colour, 1.2, ""));
      }
      body_ += text_at(x + kLegendSample + 8, top_, "start", series.name);
      x += needed;
    }
    if (any) top_ += 8;
  }

  /// Thin where many lines lie over one another.
  double line_width() const { return figure_.series.size() > 20 ? 0.9 : 1.6; }

  static bool has_line(const Series& series) { return series.mark != Mark::kPoints; }
  static bool has_points(const Series& series) {
    return series.mark == Mark::kPoints || series.mark == Mark::kLineWithPoints;
  }

  static std::string_view dash_of(const Series& series) {
    const auto index = static_cast<std::size_t>(colour_index(series.colour));
    if (series.mark == Mark::kDashes && kSeriesDashes[index].empty()) return kSeriesDashes[2];
    return kSeriesDashes[index];
  }

  void scales() {
    x_.logarithmic = figure_.x.logarithmic;
    y_.logarithmic = figure_.y.logarithmic;
    if (figure_.heat_map) {
      heat_map_ranges();
    } else {
      for (const Series& series : figure_.series) include(series);
      for (const Tick& tick : figure_.x.ticks) x_.range.include(tick.at);
      for (const Tick& tick : figure_.y.ticks) y_.range.include(tick.at);
      for (const Rule& rule : figure_.rules) {
        Scale& scale = rule.vertical ? x_ : y_;
        if (scale.shows(rule.at)) scale.range.include(rule.at);
      }
      widen(x_.range, figure_.x, figure_.equal_aspect ? 0.04 : figure_.x.logarithmic ? 0.03 : 0.0);
      widen(y_.range, figure_.y, 0.05);
    }
    const double right = figure_.heat_map ? 92 : 20;
    const double bottom = 46;
    y_.from = height_ - bottom;
    y_.to = top_ + 6;
    x_.to = width_ - right;
    double labels = 0;
    for (const Tick& tick : y_ticks()) labels = std::max(labels, text_width(tick.label));
    x_.from = labels + (axis_title(figure_.y).empty() ? 18 : 40);
    if (figure_.equal_aspect) make_aspect_equal();
    if (figure_.y_downwards) std::swap(y_.from, y_.to);
  }

  void include(const Series& series) {
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) continue;
      x_.range.include(series.x[i]);
      y_.range.include(series.y[i]);
      if (series.low.empty()) continue;
      // An interval may end at infinity, or below zero on a logarithmic axis: it then leaves the
      // plot.
      if (y_.shows(series.low[i])) y_.range.include(series.low[i]);
      if (y_.shows(series.high[i])) y_.range.include(series.high[i]);
    }
  }

  void heat_map_ranges() {
    const HeatMap& map = *figure_.heat_map;
    for (const double x : map.x) x_.range.include(x);
    if (x_.range.empty()) x_.range = {0, 1};
    const double step =
        map.x.size() > 1 ? x_.range.span() / static_cast<double>(map.x.size() - 1) : 1;
    x_.range.low -= step / 2;
    x_.range.high += step / 2;
    y_.range = {0.5, static_cast<double>(std::max<std::size_t>(1, map.rows.size())) + 0.5};
  }

  std::vector<Tick> y_ticks() const {
    if (!figure_.heat_map) {
      return ticks_of(figure_.y, y_.range,
                      std::max(2, static_cast<int>((height_ - top_ - 46) / 45)));
    }
    std::vector<Tick> ticks;
    const auto& rows = figure_.heat_map->rows;
    const auto most = static_cast<std::size_t>((height_ - top_ - 46) / (1.2 * kFontSize));
    const std::size_t stride =
        std::max<std::size_t>(1, (rows.size() + most - 1) / std::max<std::size_t>(1, most));
    for (std::size_t k = 0; k < rows.size(); k += stride) {
      ticks.push_back({static_cast<double>(k + 1), rows[k]});
    }
    return ticks;
  }

  void make_aspect_equal() {
    const double across = (x_.to - x_.from) / x_.range.span();
    const double along = (y_.from - y_.to) / y_.range.span();
    const double scale = std::min(across, along);
    x_.to = x_.from + scale * x_.range.span();
    y_.from = y_.to + scale * y_.range.span();
    width_ = std::max(x_.to + 20, 20 + longest_text());
    height_ = y_.from + 46;
  }

  double longest_text() const {
    double longest = kTitleSize / kFontSize * text_width(figure_.title);
    for (const Series& series : figure_.series) {
      if (!series.name.empty())
        longest = std::max(longest, kLegendSample + 30 + text_width(series.name));
    }
    return longest;
  }

  double bottom() const { return std::max(y_.from, y_.to); }
  double top() const { return std::min(y_.from, y_.to); }

  std::vector<Tick> x_ticks() const {
    return ticks_of(figure_.x, x_.range, std::max(2, static_cast<int>((x_.to - x_.from) / 80)));
  }

  void grid() {
    const std::string style = "class=\"grid\" stroke=\"#dddddd\" stroke-width=\"1\"";
    for (const Tick& tick : x_ticks()) {
      body_ += line(x_(tick.at), top(), x_(tick.at), bottom(), style);
    }
    for (const Tick& tick : y_ticks()) {
      body_ += line(x_.from, y_(tick.at), x_.to, y_(tick.at), style);
    }
  }

  void curves() {
    const std::string clip = "clip-" + figure_.id;
    body_ += fmt::format(
        "<clipPath id=\"{0}\"><rect x=\"{1}\" y=\"{2}\" width=\"{3}\" height=\"{4}\"/></clipPath>\n"
        "<g clip-path=\"url(#{0})\">\n",
        clip, place(x_.from), place(top()), place(x_.to - x_.from), place(bottom() - top()));
    for (const Series& series : figure_.series) draw(series);
    for (const Rule& rule : figure_.rules) {
      const Scale& scale = rule.vertical ? x_ : y_;
      if (!scale.shows(rule.at)) continue;
      const double at = scale(rule.at);
      body_ += rule.vertical ? line(at, top(), at, bottom(), stroke(0, 1, "4 4"))
                             : line(x_.from, at, x_.to, at, stroke(0, 1, "4 4"));
      body_ += rule.vertical ? text_at(at + 4, top() + kFontSize, "start", rule.label)
                             : text_at(x_.to - 4, at - 4, "end", rule.label);
    }
    body_ += "</g>\n";
  }

  void draw(const Series& series) {
    std::string curve;
    std::string points;
    std::string bars;
    bool drawing = false;
    double last_x = -100;
    double last_y = -100;
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!x_.shows(series.x[i]) || !y_.shows(series.y[i])) {
        drawing = false;
        continue;
      }
      const double x = x_(series.x[i]);
      const double y = y_(series.y[i]);
      curve += fmt::format("{}{} {}", drawing ? 'L' : 'M', place(x), place(y));
      drawing = true;
      if (std::hypot(x - last_x, y - last_y) >= 4) {  // else it would cover the marker before
        points += marker(series.colour, x, y, 3.5);
        last_x = x;
        last_y = y;
      }
      if (!series.low.empty()) {
        const double low = y_.shows(series.low[i]) ? y_(series.low[i]) : y_.from;
        const double high = y_.shows(series.high[i]) ? y_(series.high[i]) : y_.to;
        bars += fmt::format("M{0} {1}L{0} {2}", place(x), place(low), place(high));
      }
    }
    body_ += path(bars, stroke(series.colour, 1, ""));
    if (has_line(series))
      body_ += path(curve, stroke(series.colour, line_width(), dash_of(series)));
    if (has_points(series)) body_ += path(points, stroke(series.colour, 1.2, ""));
  }

  /// Cells of like colour share one path; columns are averaged down to what the paper can show.
  void heat_map() {
    constexpr int kColours = 48;
    const HeatMap& map = *figure_.heat_map;
    const double maximum = largest(map);
    const std::size_t count = map.x.size();
    const std::size_t stride = std::max<std::size_t>(1, count / 300);
    std::map<int, std::string> paths;
    for (std::size_t row = 0; row < map.rows.size(); ++row) {
      const double y = row_edge(static_cast<double>(row));
      const double height = row_edge(static_cast<double>(row) + 1) - y;
      for (std::size_t first = 0; first < count; first += stride) {
        const std::size_t last = std::min(first + stride, count);
        double sum = 0;
        int present = 0;
        for (std::size_t k = first; k < last; ++k) {
          if (std::isnan(map.value[row][k])) continue;
          sum += map.value[row][k];
          ++present;
        }
        if (present == 0) continue;
        const double fraction = fraction_of(map, sum / present, maximum);
        const double left = x_(edge(map.x, first));
        const double width = x_(edge(map.x, last)) - left;
        paths[static_cast<int>(std::lround(fraction * (kColours - 1)))] += fmt::format(
            "M{} {}h{}v{}h{}z", place(left), place(y), place(width), place(height), place(-width));
      }
    }
    for (const auto& [colour, cells] : paths) {
      const double fraction = static_cast<double>(colour) / (kColours - 1);
      body_ += path(cells, fmt::format("shape-rendering=\"crispEdges\" fill=\"{}\"",
                                       colour_of(map, fraction)));
    }
    colour_bar(map, maximum);
  }

  double row_edge(double row) const {
    return top() +
           row / static_cast<double>(std::max<std::size_t>(1, figure_.heat_map->rows.size())) *
               (bottom() - top());
  }

  /// The border between cells k - 1 and k.
  static double edge(const std::vector<double>& x, std::size_t k) {
    if (x.size() == 1) return x[0] + (k == 0 ? -0.5 : 0.5);
    if (k == 0) return x[0] - (x[1] - x[0]) / 2;
    if (k == x.size()) return x[k - 1] + (x[k - 1] - x[k - 2]) / 2;
    return (x[k - 1] + x[k]) / 2;
  }

  static double largest(const HeatMap& map) {
    if (map.maximum) return *map.maximum;
    double maximum = 0;
    for (const auto& row : map.value) {
      for (const double value : row) {
        if (std::isfinite(value)) maximum = std::max(maximum, std::abs(value));
      }
    }
    return maximum > 0 ? maximum : 1;
  }

  static double fraction_of(const HeatMap& map, double value, double maximum) {
    const double fraction = map.is_signed ? (value / maximum + 1) / 2 : value / maximum;
    return std::clamp(fraction, 0.0, 1.0);
  }

  static std::string colour_of(const HeatMap& map, double fraction) {
    return map.is_signed ? signed_colour(fraction) : sequential_colour(fraction);
  }

  void colour_bar(const HeatMap& map, double maximum) {
    constexpr int kSteps = 48;
    const double left = x_.to + 14;
    const double height = (bottom() - top()) / kSteps;
    for (int k = 0; k < kSteps; ++k) {
      body_ += fmt::format(
          "<rect shape-rendering=\"crispEdges\" x=\"{}\" y=\"{}\" width=\"12\" height=\"{}\" "
          "fill=\"{}\"/>\n",
          place(left), place(bottom() - (k + 1) * height), place(height + 0.3),
          colour_of(map, (k + 0.5) / kSteps));
    }
    const double low = map.is_signed ? -maximum : 0;
    for (const Tick& tick : linear_ticks(low, maximum, 4)) {
      const double y = bottom() - (tick.at - low) / (maximum - low) * (bottom() - top());
      body_ += text_at(left + 16, y + 4, "start", tick.label);
    }
    body_ += upright_text(width_ - 8, (top() + bottom()) / 2, axis_title(map.scale));
  }

  void axes() {
    const std::string frame = "class=\"c0\" fill=\"none\" stroke=\"#1a1a1a\" stroke-width=\"1\"";
    body_ += path(fmt::format("M{0} {1}H{2}V{3}H{0}Z", place(x_.from), place(top()), place(x_.to),
                              place(bottom())),
                  frame);
    for (const Tick& tick : x_ticks()) {
      body_ += line(x_(tick.at), bottom(), x_(tick.at), bottom() + 4, frame);
      if (!tick.label.empty()) {
        body_ += text_at(x_(tick.at), bottom() + 5 + kFontSize, "middle", tick.label);
      }
    }
    for (const Tick& tick : y_ticks()) {
      const double y = figure_.heat_map ? row_edge(tick.at - 0.5) : y_(tick.at);
      body_ += line(x_.from - 4, y, x_.from, y, frame);
      if (!tick.label.empty()) body_ += text_at(x_.from - 7, y + 4, "end", tick.label);
    }
    body_ += text_at((x_.from + x_.to) / 2, bottom() + 40, "middle", axis_title(figure_.x));
    body_ += upright_text(16, (top() + bottom()) / 2, axis_title(figure_.y));
  }

  const Figure& figure_;
  double width_, height_;
  double top_ = 0;
  Scale x_, y_;
  std::string body_;
};

}  // namespace

std::string to_svg(const Figure& figure, const SvgOptions& options) {
  check(figure);
  return Drawing(figure, options).text();
}

}  // namespace catena::plot
