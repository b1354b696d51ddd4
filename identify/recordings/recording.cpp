// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/recording.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/median.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "identify/cases/time_limits.hpp"
#include "identify/recordings/outliers.hpp"
#include "identify/recordings/recognise.hpp"
#include "identify/recordings/table.hpp"
#include "identify/recordings/tracker_import.hpp"

namespace catena {
namespace {

constexpr double kTimeSlack = 1e-9;  // s: times are written with finitely many digits
constexpr const char* kLookAtUnit = "; look at time_unit and frame_rate";

const std::string& time_column(const ExperimentSpec& experiment, const Table& table) {
  return experiment.time_column.empty() ? table.names.front() : experiment.time_column;
}

/// Where the name of the column of times speaks of another unit than the case.
void warn_of_time_unit(const ExperimentSpec& experiment, const Table& table, Recording& recording) {
  const std::string& name = time_column(experiment, table);
  const std::string unit = unit_in_name(name);
  if (unit != "s" && unit != "ms" && unit != "frames") return;
  if (unit == experiment.time_unit) return;
  recording.warnings.push_back("time_unit: the column is called " + in_quotes(name) +
                               ", but its times are read as " + experiment.time_unit +
                               "; time_unit = " + in_quotes(unit) + " would agree with it");
}

/// Where the times of the file are, in s.
std::vector<double> read_times(const ExperimentSpec& experiment, const Table& table) {
  const std::string& name = time_column(experiment, table);
  std::vector<double> time = table.column(name);
  const double unit = experiment.time_unit == "ms"       ? 1e-3
                      : experiment.time_unit == "frames" ? 1 / experiment.frame_rate
                                                         : 1;
  for (std::size_t i = 0; i < time.size(); ++i) {
    const auto fail = [&](const std::string& what) {
      throw InputError(table.file + ":" + std::to_string(table.lines[i]) + ": column " +
                       in_quotes(name) + ": " + what);
    };
    if (std::isnan(time[i])) fail("empty; every row needs its time");
    time[i] *= unit;
    if (!(std::abs(time[i]) <= kLongestTime))
      fail(shortest_number(time[i]) + " s; times must lie within -1e9 and 1e9 s" + kLookAtUnit);
    if (i == 0 || time[i] - time[i - 1] >= kShortestTime) continue;
    fail(shortest_number(time[i]) + " s after " + shortest_number(time[i - 1]) +
         (time[i] > time[i - 1]
              ? std::string(" s; frames must be 1e-9 s apart at least") + kLookAtUnit
              : " s; times must increase"));
  }
  return time;
}

/// "a, b and c", or the first ones and "... (30 columns)".
std::string first_names(std::vector<std::string> names) {
  constexpr std::size_t kNamed = 9;
  const std::size_t count = names.size();
  for (std::string& name : names) name = shortened(name);
  if (count <= kNamed) return listed(names);
  names.resize(kNamed);
  std::string text;
  for (const std::string& name : names) text += name + ", ";
  return text + "... (" + std::to_string(count) + " columns)";
}

using ColumnName = std::string PointSpec::*;

/// The columns of a marker in the order of its channels; the last is there in space only.
struct MarkerAxis {
  Component component;
  const char* word;
  ColumnName column;
};
constexpr MarkerAxis kMarkerAxes[] = {{Component::kSide, "side", &PointSpec::side_column},
                                      {Component::kDown, "down", &PointSpec::down_column},
                                      {Component::kAcross, "across", &PointSpec::across_column}};

std::span<const MarkerAxis> marker_axes(bool in_space) {
  return std::span(kMarkerAxes).first(in_space ? 3 : 2);
}

/// Whether a marker was measured in the picture of a camera.
bool in_pictures(const ExperimentSpec& experiment) {
  return std::any_of(experiment.points.begin(), experiment.points.end(),
                     [](const PointSpec& point) { return !point.camera.empty(); });
}

/// Refuses pictures of cameras where they cannot be read as such.
void check_pictures(const ExperimentSpec& experiment, bool in_space) {
  const auto refuse = [&](const std::string& problem) {
    throw InputError(experiment.where + ": " + problem);
  };
  if (!in_space)
    refuse(
        "markers: camera: the model moves in the plane, where a picture needs no camera; leave it "
        "out, or give a model with space = \"3d\"");
  if (experiment.length_unit != "px")
    refuse(
        "length_unit: " + in_quotes(experiment.length_unit) +
        "; the pictures of cameras are in px; say length_unit = \"px\", and give metres_per_pixel");
  if (!experiment.origin.empty())
    refuse("origin: pictures have the centre of their camera; leave it out");
  for (const PointSpec& point : experiment.points) {
    if (point.camera.empty())
      refuse("markers: " + point.name +
             " has no camera, and others have one; give it one, or an experiment of its own");
    if (!point.across_column.empty())
      refuse("markers: " + point.name +
             " has a column `across`; a picture has side and down only; leave it out");
  }
}

/// Refuses what the case says of the plane where the model moves in space, and the other way round.
void check_space(const ExperimentSpec& experiment, bool in_space) {
  const std::size_t count = marker_axes(in_space).size();
  const std::string moves = in_space ? "the model moves in space" : "the model moves in the plane";
  const auto refuse = [&](const std::string& problem) {
    throw InputError(experiment.where + ": " + problem);
  };
  if (in_space && experiment.kind == DataKind::kAngles)
    refuse("kind: \"angles\"; " + moves + ", where links have no one angle; give markers");
  if (in_space && experiment.source != DataSource::kCatena)
    refuse("source: a film of one camera; " + moves + "; give a file of side, down and across");
  if (in_pictures(experiment)) {
    check_pictures(experiment, in_space);
    return;
  }
  if (!experiment.axes.empty() && experiment.axes.size() != count)
    refuse("axes: " + std::to_string(experiment.axes.size()) + " names; " + moves + ": give " +
           std::to_string(count));
  if (!experiment.origin.empty() && experiment.origin.size() != count)
    refuse("origin: " + std::to_string(experiment.origin.size()) + " numbers; " + moves +
           ": give " + std::to_string(count));
  for (const PointSpec& point : experiment.points)
    if (point.across_column.empty() == in_space)
      refuse("markers: " + point.name + (in_space ? " has no" : " has a") + " column `across`; " +
             moves);
}

/// "side_1_m, down_1_m": the columns that a marker has where the case does not name them.
std::string default_columns(const ExperimentSpec& experiment, bool in_space,
                            const std::string& index, PointSpec& point) {
  std::string all;
  const auto axes = marker_axes(in_space);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    std::string& column = point.*axes[i].column;
    column = experiment.axes.empty() ? axes[i].word : experiment.axes[i];
    column.append("_").append(index).append("_m");
    all.append(i ? ", " : "").append(column);
  }
  return all;
}

std::vector<PointSpec> default_points(const ExperimentSpec& experiment, const Table& table,
                                      int links, double cable_length, bool in_space) {
  std::vector<PointSpec> points;
  for (int i = 1;; ++i) {
    const std::string index = std::to_string(i);
    PointSpec point;
    if (experiment.kind == DataKind::kAngles) {
      point.name = "angle " + index;
      point.angle_column = "theta_" + index + "_rad";
      point.link = i;
      if (!table.has(point.angle_column)) break;
      if (i > links)
        throw InputError(table.file + ": column " + in_quotes(point.angle_column) +
                         "; the model has " + std::to_string(links) +
                         " links; say which angles to use in [[experiment]]");
    } else if (experiment.source != DataSource::kCatena) {
      const auto column = static_cast<std::size_t>(2 * i - 1);  // after the time: x and y of each
      if (column + 1 >= table.names.size()) break;
      point.side_column = table.names[column];
      point.down_column = table.names[column + 1];
      point.name = point.side_column.substr(0, point.side_column.size() - 2);
    } else {
      point.name = "marker " + index;
      default_columns(experiment, in_space, index, point);
      const auto axes = marker_axes(in_space);
      if (!std::all_of(axes.begin(), axes.end(),
                       [&](const MarkerAxis& axis) { return table.has(point.*axis.column); }))
        break;
    }
    points.push_back(point);
  }
  if (points.empty()) {
    const bool angles = experiment.kind == DataKind::kAngles;
    PointSpec first;
    const std::string columns =
        angles ? "theta_1_rad" : default_columns(experiment, in_space, "1", first);
    throw InputError(experiment.where + ": data: " + table.file + " has no columns " + columns +
                     "; name its columns under " +
                     (angles ? "angles" : "markers, or let catena new make the case") +
                     "; it has " + first_names(table.names));
  }
  if (experiment.kind == DataKind::kMarkers)
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].share = static_cast<double>(i + 1) / static_cast<double>(points.size());
      points[i].arc_length = cable_length * points[i].share;
    }
  return points;
}

/// Rows of the experiment's window.
std::vector<std::size_t> choose_rows(const ExperimentSpec& experiment,
                                     const std::vector<double>& time, const std::string& file) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0, seen = 0; i < time.size(); ++i)
    if (time[i] >= experiment.from - kTimeSlack && time[i] <= experiment.to + kTimeSlack &&
        seen++ % static_cast<std::size_t>(experiment.every) == 0)
      rows.push_back(i);
  if (rows.size() < 2) {
    std::string text = experiment.where + ": data: " + file + " has " +
                       std::to_string(rows.size()) + (rows.size() == 1 ? " frame" : " frames");
    if (std::isfinite(experiment.from))
      text += " from " + shortest_number(experiment.from) + " s on";
    if (std::isfinite(experiment.to)) text += " until " + shortest_number(experiment.to) + " s";
    text += "; at least two are needed";
    if (!time.empty())
      text += "; its times are " + shortest_number(time.front()) + " s to " +
              shortest_number(time.back()) + " s";
    throw InputError(text);
  }
  return rows;
}

void unwrap(Eigen::Ref<Eigen::RowVectorXd> angles) {
  constexpr double turn = 2 * std::numbers::pi;
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double& angle : angles) {
    if (!std::isnan(last)) angle -= turn * std::round((angle - last) / turn);
    if (!std::isnan(angle)) last = angle;
  }
}

double length_factor(const ExperimentSpec& experiment) {
  if (experiment.length_unit == "cm") return 1e-2;
  if (experiment.length_unit == "mm") return 1e-3;
  if (experiment.length_unit == "px") return experiment.metres_per_pixel;
  return 1;
}

/// The rows of one column of a point, in SI units and the model's axes, or those of its picture.
Eigen::RowVectorXd convert(const ExperimentSpec& experiment, const PointSpec& point,
                           const std::vector<double>& column, const std::vector<std::size_t>& rows,
                           Component component) {
  const bool picture = !point.camera.empty();
  double origin = 0, factor = 1;
  switch (component) {
    case Component::kSide:
      origin = picture ? point.centre[0] : experiment.origin_of(0);
      factor = length_factor(experiment) * (experiment.mirrored ? -1 : 1);
      break;
    case Component::kDown:
      origin = picture ? point.centre[1] : experiment.origin_of(1);
      factor = length_factor(experiment) * (experiment.upward ? -1 : 1);
      break;
    case Component::kAcross:
      origin = experiment.origin_of(2);
      factor = length_factor(experiment);
      break;
    case Component::kAngle:
      factor = (experiment.angle_unit == "deg" ? std::numbers::pi / 180 : 1) *
               (experiment.mirrored ? -1 : 1);
      break;
  }
  Eigen::RowVectorXd out(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t k = 0; k < rows.size(); ++k)
    out[static_cast<Eigen::Index>(k)] = factor * (column[rows[k]] - origin);
  if (component == Component::kAngle && experiment.wrapped) unwrap(out);
  return out;
}

/// Standard deviation of what is not smooth in a series of at least three values, from its second differences.
double scatter(const std::vector<double>& series) {
  std::vector<double> sizes;
  for (std::size_t k = 1; k + 1 < series.size(); ++k)
    sizes.push_back(std::abs(series[k - 1] - 2 * series[k] + series[k + 1]));
  constexpr double kMedianOfNormal = 0.6745;  // of its size, in standard deviations
  return median(std::move(sizes)) / (kMedianOfNormal * std::sqrt(6));
}

/// A cable neither stretches nor leaves its plane: the chord between neighbouring markers is what
/// its bending leaves of the arc. Where it is much shorter for long, beyond noise, it points out of the plane.
void warn_of_motion_out_of_plane(Recording& recording) {
  constexpr double kShort = 0.95, kOften = 0.2;
  constexpr double kFull = 1.2816;    // quantile of 90 %, in standard deviations
  constexpr double kBeyondNoise = 2;  // standard deviations; one frame of 40 is below by chance
  for (std::size_t p = 1; p + 1 < recording.points.size(); ++p) {
    const auto row = static_cast<Eigen::Index>(2 * p);
    const auto& m = recording.measured;
    std::vector<double> straightened;  // chord, with the bending between the neighbours undone
    for (Eigen::Index k = 0; k < m.cols(); ++k) {
      const Eigen::Vector2d before = m.block<2, 1>(row, k) - m.block<2, 1>(row - 2, k);
      const Eigen::Vector2d after = m.block<2, 1>(row + 2, k) - m.block<2, 1>(row, k);
      if (before.hasNaN() || after.hasNaN()) continue;
      const double cross = before[0] * after[1] - before[1] * after[0];
      const double half = 0.5 * std::atan2(cross, before.dot(after));
      const double bend = std::abs(half) < 1e-6 ? 1 : std::sin(half) / half;
      straightened.push_back(before.norm() / bend);
    }
    if (straightened.size() < 5) continue;
    std::vector<double> sorted = straightened;
    std::sort(sorted.begin(), sorted.end());
    const double noise = scatter(straightened);
    const double full = sorted[sorted.size() * 9 / 10] - kFull * noise;
    const auto shorter = std::count_if(sorted.begin(), sorted.end(), [&](double chord) {
      return chord < kShort * full - kBeyondNoise * noise;
    });
    if (static_cast<double>(shorter) > kOften * static_cast<double>(sorted.size()))
      recording.warnings.push_back(
          "the distance from " + recording.points[p - 1].name + " to " + recording.points[p].name +
          " is more than 5 % short of its full length in " + std::to_string(shorter) + " of " +
          std::to_string(sorted.size()) + " frames: motion out of the plane?");
  }
}

/// Points beside the motion of their marker are not seen; a warning names them.
void leave_out_outliers(Recording& recording, const ExperimentSpec& experiment, double cable_length,
                        const Table& table, const std::vector<std::size_t>& rows) {
  constexpr std::size_t kNamed = 12;  // one by one; more are counted
  const bool angles = experiment.kind == DataKind::kAngles;
  const std::vector<Outlier> outliers = find_outliers(recording, angles ? 1 : cable_length);
  if (outliers.empty()) return;
  const Eigen::Index per_point = recording.components();
  std::string named;
  for (std::size_t i = 0; i < outliers.size(); ++i) {
    const Outlier& outlier = outliers[i];
    recording.measured.block(outlier.point * per_point, outlier.frame, per_point, 1)
        .setConstant(std::numeric_limits<double>::quiet_NaN());
    if (i >= kNamed) continue;
    const auto frame = static_cast<std::size_t>(outlier.frame);
    named += (i ? ", " : "") + recording.points[static_cast<std::size_t>(outlier.point)].name +
             " at " + number_text(recording.time[frame]) +
             (experiment.table ? " s (row " : " s (line ") +
             std::to_string(table.lines[rows[frame]]) + ", off by " +
             number_text(std::round(1e4 * outlier.size) / 10) + (angles ? " mrad)" : " mm)");
  }
  if (outliers.size() > kNamed) named += ", ...";
  recording.warnings.push_back(
      std::to_string(outliers.size()) + (outliers.size() == 1 ? " outlier is" : " outliers are") +
      " left out of " + table.file + ": " + named + "; outliers = \"keep\" uses them");
}

/// Moves what was measured after a time, s, to `sealed`.
void seal(Recording& recording, double from) {
  const auto open =
      std::upper_bound(recording.time.begin(), recording.time.end(), from) - recording.time.begin();
  const Eigen::Index sealed = recording.measured.cols() - open;
  if (sealed == 0) return;
  recording.sealed = recording.measured;
  recording.sealed.leftCols(open).setConstant(kNotGiven);
  recording.measured.rightCols(sealed).setConstant(kNotGiven);
}

}  // namespace

Recording read_recording(const ExperimentSpec& experiment, int links, double cable_length,
                         bool in_space) {
  check_space(experiment, in_space);
  const Table table = experiment.table ? *experiment.table
                                       : import_tracker_table(experiment.source, experiment.data,
                                                              experiment.likelihood_floor);
  Recording recording;
  recording.points = experiment.points.empty()
                         ? default_points(experiment, table, links, cable_length, in_space)
                         : experiment.points;
  const std::vector<double> time = read_times(experiment, table);
  warn_of_time_unit(experiment, table, recording);
  const std::vector<std::size_t> rows = choose_rows(experiment, time, table.file);
  for (const std::size_t row : rows) {
    recording.time.push_back(time[row]);
    if (experiment.use == Use::kFit && time[row] <= experiment.fit_until + kTimeSlack)
      ++recording.fit_frames;
  }
  const bool markers = experiment.kind == DataKind::kMarkers;
  const std::span<const MarkerAxis> axes = marker_axes(in_space && !in_pictures(experiment));
  const std::size_t per_point = markers ? axes.size() : 1;
  recording.measured.resize(static_cast<Eigen::Index>(per_point * recording.points.size()),
                            static_cast<Eigen::Index>(rows.size()));
  for (std::size_t p = 0; p < recording.points.size(); ++p) {
    const PointSpec& point = recording.points[p];
    if (point.arc_length > cable_length * (1 + 1e-9))
      throw InputError(experiment.where + ": markers: " + point.name + " at " +
                       shortest_number(point.arc_length) + " m; the cable is " +
                       shortest_number(cable_length) + " m long");
    const auto add = [&](Component component, const std::string& column,
                         const std::string& suffix) {
      recording.measured.row(static_cast<Eigen::Index>(recording.channels.size())) =
          convert(experiment, point, table.column(column), rows, component);
      recording.channels.push_back({static_cast<int>(p), component, point.name + suffix});
    };
    if (markers)
      for (const MarkerAxis& axis : axes)
        add(axis.component, point.*axis.column, std::string(" ") + axis.word);
    else
      add(Component::kAngle, point.angle_column, "");
  }
  if (recording.measured.array().isNaN().all())
    throw InputError(experiment.where + ": data: " + table.file +
                     " holds no measurement between from and to");
  if (!experiment.keep_outliers)
    leave_out_outliers(recording, experiment, cable_length, table, rows);
  if (markers && !in_space) warn_of_motion_out_of_plane(recording);
  seal(recording, experiment.sealed_from);
  return recording;
}

void open_seal(Recording& recording) {
  if (recording.sealed.size() == 0) return;
  recording.measured =
      recording.sealed.array().isNaN().select(recording.measured, recording.sealed);
  recording.sealed.resize(0, 0);
}

}  // namespace catena
