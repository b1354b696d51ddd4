// SPDX-License-Identifier: BSD-3-Clause
#include "identify/program/recording_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/in_a_line.hpp"
#include "identify/report/html.hpp"

namespace catena {
namespace {

using Eigen::Index;

constexpr double kLongest = 640, kMargin = 70;  // of the drawing, its border
// The palette of the reports, distinct for readers who do not see all colours.
constexpr const char* kColours[] = {"#0072b2", "#e69f00", "#009e73",
                                    "#cc79a7", "#56b4e9", "#d55e00"};

/// A step of 1, 2 or 5 times a power of ten, some five of which make `range`.
double tick_step(double range) {
  const double rough = range / 5, unit = std::pow(10, std::floor(std::log10(rough)));
  return rough > 5 * unit   ? 10 * unit
         : rough > 2 * unit ? 5 * unit
         : rough > unit     ? 2 * unit
                            : unit;
}

/// Where the recording is in the picture.
struct Frame {
  double left = 0, right = 0, top = 0, bottom = 0;  // m: side and down
  double scale = 1;                                 // pixels per m

  explicit Frame(const Recording& recording) {
    const auto& measured = recording.measured;
    for (Index c = 0; c < measured.rows(); ++c)
      for (const double value : measured.row(c)) {
        if (std::isnan(value)) continue;
        double &low = c % 2 ? top : left, &high = c % 2 ? bottom : right;
        low = std::min(low, value);
        high = std::max(high, value);
      }
    const double longest = std::max({right - left, bottom - top, 1e-9});
    scale = kLongest / longest;
  }
  double x(double side) const { return kMargin + scale * (side - left); }
  double y(double down) const { return kMargin + scale * (down - top); }
  double width() const { return 2 * kMargin + scale * (right - left); }
  double height() const { return 2 * kMargin + scale * (bottom - top); }
};

std::string axes_of(const Frame& frame) {
  std::string out;
  const double step = tick_step(std::max(frame.right - frame.left, frame.bottom - frame.top));
  const double low = frame.height() - kMargin + 12, near = kMargin - 12;
  const auto number = [&](double value) {
    return fmt::format("{:.6g}", std::round(value / step) * step + 0.0);
  };
  const double some = 1e-9 * step;  // which rounding takes from a tick at the end
  for (double side = std::ceil(frame.left / step) * step; side <= frame.right + some; side += step)
    out += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4}</text>\n",
        frame.x(side), near, low, low + 16, number(side));
  for (double down = std::ceil(frame.top / step) * step; down <= frame.bottom + some; down += step)
    out += fmt::format(
        "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5}</text>\n",
        near, frame.y(down), frame.width() - kMargin + 12, near - 6, frame.y(down) + 4,
        number(down));
  out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">side, m</text>\n",
                     frame.width() - kMargin + 12, low + 34);
  out += fmt::format(
      "<text x=\"16\" y=\"{0:.1f}\" transform=\"rotate(-90 16 {0:.1f})\" "
      "text-anchor=\"end\">down (gravity), m</text>\n",
      near);
  return fmt::format("<g stroke=\"#ddd\" fill=\"none\" font-size=\"12\">{}</g>\n", out);
}

}  // namespace

std::string recording_picture(const Recording& recording, const std::vector<Outlier>& outliers,
                              const std::string& title, double length) {
  const Frame frame(recording);
  const auto points = static_cast<Index>(recording.points.size());
  const auto& measured = recording.measured;
  const double width = std::max(frame.width(), 420.0);
  std::string out = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" font-family=\"sans-serif\">\n"
      "<style>text {{ fill: #222; stroke: none }}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<text x=\"16\" y=\"24\" font-size=\"15\">{2}</text>\n"
      "<text x=\"16\" y=\"42\" font-size=\"12\">Black: the first sight of each marker, from the "
      "support, with its place along the cable of {3:.3g} m. Coloured: the tracks. {4}</text>\n",
      width, frame.height(), report::Html(in_a_line(title)).str(), length,
      outliers.empty() ? "No outliers." : fmt::format("Rings: {} outliers.", outliers.size()));
  out += axes_of(frame);
  const auto at = [&](Index p, Index k) {
    return fmt::format("{:.1f} {:.1f}", frame.x(measured(2 * p, k)),
                       frame.y(measured(2 * p + 1, k)));
  };
  const auto seen = [&](Index p, Index k) { return !measured.block<2, 1>(2 * p, k).hasNaN(); };
  for (Index p = 0; p < points; ++p) {
    std::string track;
    bool drawing = false;
    for (Index k = 0; k < measured.cols(); ++k) {
      if (seen(p, k)) track += fmt::format("{}{}", drawing ? 'L' : 'M', at(p, k));
      drawing = seen(p, k);
    }
    out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1\"/>\n", track,
                       kColours[p % static_cast<Index>(std::size(kColours))]);
  }
  std::string cable = fmt::format("M{:.1f} {:.1f}", frame.x(0), frame.y(0)), dots;
  for (Index p = 0; p < points; ++p) {
    Index first = 0;  // frame in which the marker is seen
    while (first + 1 < measured.cols() && !seen(p, first)) ++first;
    if (!seen(p, first)) continue;
    cable += fmt::format("L{}", at(p, first));
    const double x = frame.x(measured(2 * p, first)), y = frame.y(measured(2 * p + 1, first));
    dots += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\"/><text x=\"{:.1f}\" y=\"{:.1f}\" "
        "font-size=\"12\">{}: {:.3g} m</text>\n",
        x, y, x + 7, y + 4, p + 1, recording.points[static_cast<std::size_t>(p)].arc_length);
  }
  out += fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"black\" stroke-width=\"2\"/>\n{}",
                     cable, dots);
  out += fmt::format("<path d=\"M{0:.1f} {1:.1f}l-9 -14h18z\"/>\n", frame.x(0), frame.y(0));
  for (const Outlier& outlier : outliers)
    out += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\" fill=\"none\" stroke=\"#c00\" "
        "stroke-width=\"2\"/>\n",
        frame.x(measured(2 * outlier.point, outlier.frame)),
        frame.y(measured(2 * outlier.point + 1, outlier.frame)));
  return out + "</svg>\n";
}

}  // namespace catena
