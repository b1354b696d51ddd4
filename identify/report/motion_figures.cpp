// SPDX-License-Identifier: BSD-3-Clause
//
// The motion itself: positions over time (figures 6.3 to 6.8, 7.5), overlaid shapes (6.10), frames
// (6.9, 7.4).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "identify/report/readable.hpp"
#include "identify/report/report_figures.hpp"

namespace catena::report {
namespace {

constexpr int kMostFramesInRow = 7;

void mark_held_out(const Experiment& experiment, const Row& time, Figure& figure) {
  if (!std::isnan(experiment.fit_until) && !time.empty() && experiment.fit_until < time.back()) {
    figure.rules.push_back({true, experiment.fit_until, "held out"});
  }
}

void add_motion_figure(std::vector<ReportFigure>& figures, const Experiment& experiment,
                       const std::string& family, const std::string& point, Figure figure) {
  figures.push_back({std::move(figure), "motion", family, experiment.name, "Point", point});
}

std::string title(std::string quantity, const std::string& point) {
  quantity.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(quantity.front())));
  return fmt::format("{} of {}", quantity, point);
}

/// Measured and predicted values of one kind, a figure per measured point.
void add_measured(const Experiment& experiment, const std::string& quantity,
                  const std::string& unit, const Rows& measured, const Rows& predicted,
                  std::vector<ReportFigure>& figures) {
  const Row& time = experiment.measured->values.time;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    const std::string& name = experiment.measured->points[p].name;
    Figure figure;
    figure.title = title(quantity, name);
    figure.x = {"time", "s"};
    figure.y = {quantity, unit};
    figure.series.push_back({"measured", time, measured[p], Mark::kPoints, 0});
    if (!predicted.empty()) {
      figure.series.push_back({"simulated", time, predicted[p], Mark::kLine, 1});
    }
    mark_held_out(experiment, time, figure);
    add_motion_figure(figures, experiment, "position_" + quantity, name, std::move(figure));
  }
}

/// Without measurements: a figure per joint.
void add_simulated(const Experiment& experiment, const std::string& quantity,
                   const std::string& unit, const Rows& rows, const std::string& point,
                   std::size_t first, bool last_is_load, std::vector<ReportFigure>& figures) {
  for (std::size_t p = first; p < rows.size(); ++p) {
    const bool load = last_is_load && p + 1 == rows.size();
    const std::string name = load ? "load" : fmt::format("{} {}", point, first == 0 ? p + 1 : p);
    Figure figure;
    figure.title = title(quantity, name);
    figure.x = {"time", "s"};
    figure.y = {quantity, unit};
    figure.series.push_back({"simulated", experiment.trajectory.time, rows[p], Mark::kLine, 1});
    add_motion_figure(figures, experiment, "position_" + quantity, name, std::move(figure));
  }
}

/// Step of 1, 2 or 5 times a power of ten that cuts `span` into about `about` pieces.
double nice_step(double span, int about) {
  const double raw = span / about;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double leading = raw / power;
  return power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
}

std::size_t nearest(const Row& time, double at) {
  const auto after = std::lower_bound(time.begin(), time.end(), at);
  if (after == time.begin()) return 0;
  if (after == time.end()) return time.size() - 1;
  const auto k = static_cast<std::size_t>(after - time.begin());
  return at - time[k - 1] < time[k] - at ? k - 1 : k;
}

/// The points of a shape at one time, shifted sideways.
Series shape(const Channels& channels, std::size_t frame, double shift, bool measured) {
  Series series{measured ? "measured" : "simulated", {}, {}, Mark::kLine, 1};
  if (measured) {
    series.mark = Mark::kPoints;
    series.colour = 0;
  }
  for (std::size_t p = 0; p < channels.side.size(); ++p) {
    series.x.push_back(channels.side[p][frame] + shift);
    series.y.push_back(channels.down[p][frame]);
  }
  return series;
}

const Channels* measured_positions(const Experiment& experiment) {
  if (!experiment.measured || experiment.measured->values.side.empty()) return nullptr;
  const Channels& values = experiment.measured->values;
  return values.time.empty() ? nullptr : &values;
}

/// Whether a recording has a frame near enough to be shown at this time.
bool seen_at(const Channels& measured, double at, double step) {
  return std::abs(measured.time[nearest(measured.time, at)] - at) < step / 2;
}

void add_shapes(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  const Channels& motion = experiment.drawn();
  const Channels* measured = measured_positions(experiment);
  // Figure 6.10 lays a shape every 0.02 s over the others, for the first 1.75 s.
  const double span = motion.time.back() - motion.time.front();
  const double shown = std::min(span, 1.75);
  const double frame = span / static_cast<double>(motion.time.size() - 1);
  const double step = std::max(1.0, std::round(shown / 88 / frame)) * frame;
  Figure figure;
  figure.title = "Shapes laid over one another";
  figure.caption = fmt::format("A shape every {} s, for the first {} s.", for_people(step, 3),
                               for_people(shown, 3));
  figure.x = {"side", "m"};
  figure.y = {"down", "m"};
  figure.equal_aspect = figure.y_downwards = true;
  const int count = static_cast<int>(std::floor(shown / step + 1e-9));
  for (const Channels* drawn : {&motion, measured}) {
    if (drawn == nullptr) continue;
    for (int k = 0; k <= count; ++k) {
      const double at = motion.time.front() + k * step;
      if (drawn == measured && !seen_at(*measured, at, step)) continue;
      figure.series.push_back(shape(*drawn, nearest(drawn->time, at), 0, drawn == measured));
    }
  }
  figures.push_back({std::move(figure), "motion", "shapes", experiment.name, "", ""});
}

void add_frames(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  const Channels& motion = experiment.drawn();
  const Channels* measured = measured_positions(experiment);
  const double span = motion.time.back() - motion.time.front();
  const double step = nice_step(span, 13);  // 0.25 s of 3 s in figure 6.9
  double left = 0;
  double right = 0;
  for (const Row& row : motion.side) {
    for (const double side : row) {
      if (!std::isfinite(side)) continue;
      left = std::min(left, side);
      right = std::max(right, side);
    }
  }
  const double spacing = 1.1 * std::max(right - left, 1e-3);
  const int count = static_cast<int>(std::floor(span / step + 1e-9));
  const int rows = count / kMostFramesInRow + 1;
  const int in_row = (count + rows) / rows;
  for (int first = 0; first <= count; first += in_row) {
    Figure figure;
    const int last = std::min(count, first + in_row - 1);
    figure.title =
        fmt::format("Frames from {} s to {} s", for_people(motion.time.front() + first * step, 4),
                    for_people(motion.time.front() + last * step, 4));
    figure.caption =
        fmt::format("A frame every {} s; side and down to the same scale.", for_people(step, 3));
    figure.x = {"time of the frame", "s"};
    figure.y = {"down", "m"};
    figure.equal_aspect = figure.y_downwards = true;
    for (int k = first; k <= last; ++k) {
      const double at = motion.time.front() + k * step;
      const double shift = (k - first) * spacing;
      figure.x.ticks.push_back({shift, for_people(at, 4)});
      figure.series.push_back(shape(motion, nearest(motion.time, at), shift, false));
      if (measured == nullptr || !seen_at(*measured, at, step)) continue;
      figure.series.push_back(shape(*measured, nearest(measured->time, at), shift, true));
    }
    for (int k = last + 1; k < first + in_row; ++k) {
      figure.x.ticks.push_back({(k - first) * spacing, ""});  // rows to one scale
    }
    const std::string family = first == 0 ? "frames" : fmt::format("frames-{}", first / in_row + 1);
    figures.push_back({std::move(figure), "motion", family, experiment.name, "", ""});
  }
}

}  // namespace

void add_motion_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  const Channels& motion = experiment.drawn();
  const double span = motion.time.empty() ? 0 : motion.time.back() - motion.time.front();
  if (std::isnormal(span) && span > 0 && !motion.side.empty()) {
    add_shapes(experiment, figures);
    add_frames(experiment, figures);
  }
  if (experiment.measured) {
    const Measured& measured = *experiment.measured;
    add_measured(experiment, "side", "m", measured.values.side, measured.predicted.side, figures);
    add_measured(experiment, "down", "m", measured.values.down, measured.predicted.down, figures);
    add_measured(experiment, "angle", "rad", measured.values.angle, measured.predicted.angle,
                 figures);
    return;
  }
  add_simulated(experiment, "side", "m", motion.side, "joint", 1, true, figures);
  add_simulated(experiment, "down", "m", motion.down, "joint", 1, true, figures);
  add_simulated(experiment, "angle", "rad", motion.angle, "link", 0, false, figures);
}

}  // namespace catena::report
