// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/experiment_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "common/in_a_line.hpp"
#include "common/in_quotes.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_numbers.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/cases/start_reader.hpp"
#include "identify/cases/time_limits.hpp"

namespace catena {
namespace {

PointSpec read_point(const TomlTable& table, DataKind kind, int number, int links,
                     const std::vector<CameraSpec>& cameras) {
  PointSpec point;
  const std::string index = std::to_string(number);
  if (kind == DataKind::kAngles) {
    point.name = in_a_line(table.optional_text("name").value_or("angle " + index));
    point.angle_column = table.text("column");
    point.link = count(table, "link", number, 1);
    if (point.link > links)
      table.fail("link", std::to_string(point.link) + "; there are " + std::to_string(links));
    return point;
  }
  point.name = in_a_line(table.optional_text("name").value_or("marker " + index));
  point.side_column = table.text("side");
  point.down_column = table.text("down");
  point.across_column = table.optional_text("across").value_or("");
  point.camera = table.optional_text("camera").value_or("");
  if (!point.camera.empty()) {
    std::vector<std::string> names;
    for (const CameraSpec& camera : cameras) {
      names.push_back(camera.name);
      if (camera.name == point.camera) point.centre = camera.centre;
    }
    if (std::find(names.begin(), names.end(), point.camera) == names.end())
      table.fail("camera", in_quotes(point.camera) + " is no [[camera]] of this case" +
                               suggestion(point.camera, names));
  }
  const int places = table.has("arc_length") + table.has("joint") + table.has("load");
  if (places != 1)
    table.fail("arc_length", "say where the marker is by one of arc_length, joint and load");
  if (table.has("arc_length")) point.arc_length = not_negative(table, "arc_length", 0);
  if (table.has("joint")) {
    point.joint = count(table, "joint", 0, 1);
    if (point.joint > links)
      table.fail("joint", std::to_string(point.joint) + "; there are " + std::to_string(links));
  }
  point.load = table.optional_flag("load").value_or(false);
  if (table.has("load") && !point.load) table.fail("load", "false; leave it out or say true");
  return point;
}

void read_conventions(const TomlTable& table, ExperimentSpec& experiment) {
  experiment.source = static_cast<DataSource>(table.choice("source", kSourceWords, false));
  experiment.time_column = table.optional_text("time_column").value_or("");
  experiment.time_unit = kTimeUnits[table.choice("time_unit", kTimeUnits, false)];
  experiment.frame_rate = optional_positive(table, "frame_rate", kNotGiven);
  experiment.length_unit = kLengthUnits[table.choice("length_unit", kLengthUnits, false)];
  experiment.metres_per_pixel = optional_positive(table, "metres_per_pixel", kNotGiven);
  experiment.angle_unit = kAngleUnits[table.choice("angle_unit", kAngleUnits, false)];
  experiment.wrapped = table.optional_flag("wrapped").value_or(false);
  experiment.upward = table.choice("vertical", {"down", "up"}, false) == 1;
  experiment.mirrored = table.optional_flag("mirrored").value_or(false);
  experiment.likelihood_floor = not_negative(table, "likelihood_floor", 0.6);
  experiment.axes = table.texts("axes");
  if (table.has("axes") && (table.has("markers") || table.has("angles")))
    table.fail("axes", "names columns, and so does the list of points; leave one out");
  if (table.has("axes") && experiment.axes.size() != 2 && experiment.axes.size() != 3)
    table.fail("axes", "must be two names, in space three: of side, down and across");
  experiment.origin = table.numbers("origin");
  const std::size_t places = experiment.origin.size();
  if (table.has("origin") && ((places != 2 && places != 3) ||
                              !std::all_of(experiment.origin.begin(), experiment.origin.end(),
                                           [](double v) { return std::isfinite(v); })))
    table.fail("origin",
               "must be two numbers, in space three: the fixed point in the axes of the file");
  if (experiment.time_unit == "frames" && std::isnan(experiment.frame_rate))
    table.fail_missing("frame_rate", "the frames per second, which times in frames need");
  if (experiment.length_unit == "px" && std::isnan(experiment.metres_per_pixel))
    table.fail_missing("metres_per_pixel", "it; lengths in px need it");
}

}  // namespace

std::vector<SignalSpec> read_signals(const TomlTable& table,
                                     const std::filesystem::path& directory) {
  std::vector<SignalSpec> signals;
  for (const TomlTable& entry : table.tables("signal")) {
    SignalSpec signal;
    signal.name = entry.text("name");
    signal.data = directory / entry.text("data");
    if (!is_file(signal.data))
      entry.fail("data", shortened(signal.data.string(), kLongestPath) + "; there is no such file");
    signal.time_column = entry.optional_text("time").value_or("time_s");
    signal.column = entry.text("column");
    signals.push_back(signal);
  }
  return signals;
}

CameraSpec read_camera(const TomlTable& table) {
  CameraSpec camera;
  camera.where = table.file() + ":" + std::to_string(table.line());
  camera.name = table.text("name");
  const auto inner = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; };
  if (camera.name.empty() || !std::all_of(camera.name.begin(), camera.name.end(), inner))
    table.fail("name", in_quotes(camera.name) + "; give one of letters, digits and _");
  const std::vector<double> centre = table.numbers("centre");
  constexpr double kWidest = 1e6;  // px, as the greatest focal length
  if (centre.size() != 2 || !(std::abs(centre[0]) <= kWidest) || !(std::abs(centre[1]) <= kWidest))
    table.fail("centre",
               "must be two numbers of at most 1e6, px: the place in the picture that the camera's "
               "axis meets");
  camera.centre = {centre[0], centre[1]};
  return camera;
}

ExperimentSpec read_experiment(const TomlTable& table, int number, int links,
                               const std::vector<CameraSpec>& cameras,
                               const std::filesystem::path& directory, const HandedIn& recordings) {
  ExperimentSpec experiment;
  experiment.where = table.file() + ":" + std::to_string(table.line());
  experiment.name =
      in_a_line(table.optional_text("name").value_or("experiment " + std::to_string(number)));
  if (const auto handed_in = recordings.find(experiment.name); handed_in != recordings.end()) {
    experiment.table = handed_in->second;
    experiment.data = directory / table.optional_text("data").value_or(experiment.name + ".csv");
  } else {
    experiment.data = directory / table.text("data");
  }
  if (!experiment.table && !is_file(experiment.data))
    table.fail("data",
               shortened(experiment.data.string(), kLongestPath) + "; there is no such file");
  experiment.kind = static_cast<DataKind>(table.choice("kind", kDataKindWords));
  experiment.use = static_cast<Use>(table.choice("use", kUseWords, false));
  experiment.from = table.optional_number("from").value_or(experiment.from);
  experiment.to = table.optional_number("to").value_or(experiment.to);
  experiment.fit_until = table.optional_number("fit_until").value_or(experiment.fit_until);
  experiment.start = table.optional_number("start").value_or(kNotGiven);
  if (std::abs(experiment.start) > kLongestTime)
    table.fail("start", shortest_number(experiment.start) + " s; must lie within -1e9 and 1e9");
  experiment.window = optional_duration(table, "window", kNotGiven);
  experiment.joined = table.optional_flag("joined").value_or(false);
  if (experiment.joined && std::isnan(experiment.window))
    table.fail("joined", "true; say in window how long the pieces are, in s");
  experiment.every = count(table, "every", 1, 1);
  experiment.noise = optional_positive(table, "noise", kNotGiven);
  experiment.keep_outliers = table.choice("outliers", kOutlierWords, false) == 1;
  if (!(experiment.from < experiment.to))
    table.fail("to", shortest_number(experiment.to) +
                         "; must be after from = " + shortest_number(experiment.from));
  if (experiment.fit_until <= experiment.from)
    table.fail("fit_until", shortest_number(experiment.fit_until) +
                                "; must be after from = " + shortest_number(experiment.from));
  read_conventions(table, experiment);
  const std::string_view key = experiment.kind == DataKind::kMarkers ? "markers" : "angles";
  for (const TomlTable& point : table.tables(key))
    experiment.points.push_back(read_point(
        point, experiment.kind, static_cast<int>(experiment.points.size()) + 1, links, cameras));
  if (const auto initial = table.optional_table("initial"))
    experiment.initial = read_initial(*initial, links);
  experiment.signals = read_signals(table, directory);
  return experiment;
}

}  // namespace catena
