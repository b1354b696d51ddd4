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

void add_motion_figure(std::vector<ReportFigure>& figures, const Experiment& experiment,
                       const std::string& family, const std::string& point, Figure figure) {
  figures.push_back({std::move(figure), "motion", family, experiment.name, "Point", point});
}

std::string title(std::string quantity, const std::string& point) {
  quantity.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(quantity.front())));
  return fmt::format("{} of {}", quantity, point);
}

/// Measured and predicted values of one kind, a figure per measured point.
void add_measured(const Experiment& experiment, const Coordinate& coordinate,
                  std::vector<ReportFigure>& figures) {
  const Rows& measured = experiment.measured->values.*coordinate.rows;
  const Rows& predicted = experiment.measured->predicted.*coordinate.rows;
  const Row& time = experiment.measured->values.time;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    const std::string& name = experiment.measured->points[p].name;
    Figure figure;
    figure.title = title(coordinate.name, name);
    figure.x = {"time", "s"};
    figure.y = {experiment.measured->in_pictures()
                    ? std::string(coordinate.name) + " in the picture"
                    : coordinate.name,
                coordinate.unit};
    figure.series.push_back({"measured", time, measured[p], Mark::kPoints, 0});
    if (!predicted.empty()) {
      figure.series.push_back({"simulated", time, predicted[p], Mark::kLine, 1});
    }
    mark_parts(experiment, figure);
    add_motion_figure(figures, experiment, std::string("position_") + coordinate.name, name,
                      std::move(figure));
  }
}

/// Without measurements: a figure per joint, of angles per link.
void add_simulated(const Experiment& experiment, const Coordinate& coordinate,
                   std::vector<ReportFigure>& figures) {
  const Rows& rows = experiment.drawn().*coordinate.rows;
  const bool angles = coordinate.rows == &Channels::angle;
  for (std::size_t p = angles ? 0 : 1; p < rows.size(); ++p) {
    const bool load = !angles && p + 1 == rows.size();
    const std::string name = load     ? "load"
                             : angles ? fmt::format("link {}", p + 1)
                                      : fmt::format("joint {}", p);
    Figure figure;
    figure.title = title(coordinate.name, name);
    figure.x = {"time", "s"};
    figure.y = {coordinate.name, coordinate.unit};
    figure.series.push_back({"simulated", experiment.trajectory.time, rows[p], Mark::kLine, 1});
    add_motion_figure(figures, experiment, std::string("position_") + coordinate.name, name,
                      std::move(figure));
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

/// A projection of the motion: what is drawn to the right, and what downwards.
struct View {
  Coordinate right, downwards;

  std::string name() const { return fmt::format("{} and {}", right.name, downwards.name); }
};

/// In the plane there is one; in space they are from the front, from the side and from above.
std::vector<View> views_of(const Channels& motion) {
  const auto& [side, down, across, angle] = kCoordinates;
  if (motion.across.empty()) return {{side, down}};
  return {{side, down}, {across, down}, {side, across}};
}

/// Adds a figure of the whole shape; in space a reader chooses the view.
void add_shape_figure(std::vector<ReportFigure>& figures, const Experiment& experiment,
                      const std::string& family, const View& view, Figure figure) {
  const bool in_space = !experiment.drawn().across.empty();
  figures.push_back({std::move(figure), "motion", family, experiment.name, in_space ? "View" : "",
                     in_space ? view.name() : ""});
}

/// The points of a shape at one time, shifted to the right.
Series shape(const Channels& channels, const View& view, std::size_t frame, double shift,
             bool measured) {
  Series series{measured ? "measured" : "simulated", {}, {}, Mark::kLine, 1};
  if (measured) {
    series.mark = Mark::kPoints;
    series.colour = 0;
  }
  const Rows& right = channels.*view.right.rows;
  const Rows& downwards = channels.*view.downwards.rows;
  for (std::size_t p = 0; p < right.size(); ++p) {
    series.x.push_back(right[p][frame] + shift);
    series.y.push_back(downwards[p][frame]);
  }
  return series;
}

const Channels* measured_positions(const Experiment& experiment) {
  if (!experiment.measured || experiment.measured->values.side.empty() ||
      experiment.measured->in_pictures())
    return nullptr;
  const Channels& values = experiment.measured->values;
  return values.time.empty() ? nullptr : &values;
}

/// Whether a recording has a frame near enough to be shown at this time.
bool seen_at(const Channels& measured, double at, double step) {
  return std::abs(measured.time[nearest(measured.time, at)] - at) < step / 2;
}

void add_shapes(const Experiment& experiment, const View& view,
                std::vector<ReportFigure>& figures) {
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
  figure.x = {view.right.name, "m"};
  figure.y = {view.downwards.name, "m"};
  figure.equal_aspect = figure.y_downwards = true;
  const int count = static_cast<int>(std::floor(shown / step + 1e-9));
  for (const Channels* drawn : {&motion, measured}) {
    if (drawn == nullptr) continue;
    for (int k = 0; k <= count; ++k) {
      const double at = motion.time.front() + k * step;
      if (drawn == measured && !seen_at(*measured, at, step)) continue;
      figure.series.push_back(shape(*drawn, view, nearest(drawn->time, at), 0, drawn == measured));
    }
  }
  add_shape_figure(figures, experiment, "shapes", view, std::move(figure));
}

/// So far apart that frames side by side do not touch.
double spacing_of(const Rows& right) {
  double least = 0, most = 0;
  for (const Row& row : right) {
    for (const double place : row) {
      if (!std::isfinite(place)) continue;
      least = std::min(least, place);
      most = std::max(most, place);
    }
  }
  return 1.1 * std::max(most - least, 1e-3);
}

/// Frames `first` to `last` of those `step` apart, in a row that has room for `in_row`.
Figure row_of_frames(const Experiment& experiment, const View& view, double step, int first,
                     int last, int in_row) {
  const Channels& motion = experiment.drawn();
  const Channels* measured = measured_positions(experiment);
  const double spacing = spacing_of(motion.*view.right.rows);
  Figure figure;
  figure.title =
      fmt::format("Frames from {} s to {} s", for_people(motion.time.front() + first * step, 4),
                  for_people(motion.time.front() + last * step, 4));
  figure.caption =
      fmt::format("A frame every {} s; {} to the same scale.", for_people(step, 3), view.name());
  figure.x = {"time of the frame", "s"};
  figure.y = {view.downwards.name, "m"};
  figure.equal_aspect = figure.y_downwards = true;
  for (int k = first; k <= last; ++k) {
    const double at = motion.time.front() + k * step;
    const double shift = (k - first) * spacing;
    figure.x.ticks.push_back({shift, for_people(at, 4)});
    figure.series.push_back(shape(motion, view, nearest(motion.time, at), shift, false));
    if (measured == nullptr || !seen_at(*measured, at, step)) continue;
    figure.series.push_back(shape(*measured, view, nearest(measured->time, at), shift, true));
  }
  for (int k = last + 1; k < first + in_row; ++k)
    figure.x.ticks.push_back({(k - first) * spacing, ""});  // rows to one scale
  return figure;
}

void add_frames(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  const Channels& motion = experiment.drawn();
  const double span = motion.time.back() - motion.time.front();
  const double step = nice_step(span, 13);  // 0.25 s of 3 s in figure 6.9
  const int count = static_cast<int>(std::floor(span / step + 1e-9));
  const int rows = count / kMostFramesInRow + 1;
  const int in_row = (count + rows) / rows;
  for (int first = 0; first <= count; first += in_row) {
    const int last = std::min(count, first + in_row - 1);
    const std::string family = first == 0 ? "frames" : fmt::format("frames-{}", first / in_row + 1);
    for (const View& view : views_of(motion))
      add_shape_figure(figures, experiment, family, view,
                       row_of_frames(experiment, view, step, first, last, in_row));
  }
}

}  // namespace

void add_motion_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  const Channels& motion = experiment.drawn();
  const double span = motion.time.empty() ? 0 : motion.time.back() - motion.time.front();
  if (std::isnormal(span) && span > 0 && !motion.side.empty()) {
    for (const View& view : views_of(motion)) add_shapes(experiment, view, figures);
    add_frames(experiment, figures);
  }
  for (const Coordinate& coordinate : kCoordinates) {
    if (experiment.measured)
      add_measured(experiment, coordinate, figures);
    else
      add_simulated(experiment, coordinate, figures);
  }
}

}  // namespace catena::report
