// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/recognise.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/median.hpp"
#include "common/number_text.hpp"
#include "common/split.hpp"
#include "common/whole_file.hpp"
#include "identify/recordings/release.hpp"
#include "identify/recordings/table.hpp"
#include "identify/recordings/tracker_import.hpp"

namespace catena {
namespace {

using Eigen::Vector2d;

/// A name as lower-case words: "X1 [mm]" is x1 mm, "Marker3_x" is marker3 x.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)))
      words.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!words.back().empty())
      words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool one_of(const std::string& word, std::initializer_list<const char*> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

}  // namespace

std::string unit_in_name(const std::string& name) {
  for (const std::string& word : words_of(name)) {
    if (one_of(word, {"m", "cm", "mm", "s", "ms"})) return word;
    if (one_of(word, {"px", "pixel", "pixels"})) return "px";
    if (one_of(word, {"frame", "frames", "index", "bild"})) return "frames";
  }
  return "";
}

namespace {

/// Which axis a name tells (0: x or side, 1: y or down, -1: none), and the rest of the name.
int axis_in(const std::string& name, std::string& marker) {
  int axis = -1;
  marker.clear();
  for (std::string word : words_of(name)) {
    if (one_of(word, {"m", "cm", "mm", "px", "pixel", "pixels"})) continue;
    const auto digits =
        std::find_if(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c); });
    const std::string letters(word.begin(), digits);
    const int here = one_of(letters, {"x", "side", "horizontal"})       ? 0
                     : one_of(letters, {"y", "down", "vertical", "up"}) ? 1
                                                                        : -1;
    if (axis < 0 && here >= 0) {
      axis = here;
      word.erase(word.begin(), digits);
    } else if (axis < 0 && digits != word.begin() && (word.back() == 'x' || word.back() == 'y')) {
      axis = word.back() == 'y';  // "p1x", "ax"
      word.pop_back();
    }
    marker += word + " ";
  }
  return axis;
}

DataSource source_of(const std::filesystem::path& file) {
  const std::string text = read_whole_file(file);
  std::vector<std::string_view> lines = lines_of(text);
  lines.resize(std::max<std::size_t>(lines.size(), 2));  // empty where there are fewer
  const std::string first(lines[0]), second(lines[1]);
  if (first.starts_with("#Kinovea")) return DataSource::kKinovea;
  if (second.starts_with("bodyparts") || first.starts_with("scorer"))
    return DataSource::kDeepLabCut;
  const std::vector<std::string> words = words_of(second);
  if (words.size() > 2 && words[0] == "t" && words[1] == "x" && words[2] == "y")
    return DataSource::kTracker;
  return DataSource::kCatena;
}

std::vector<PointSpec> markers_in(const Table& table, std::vector<std::string>& passed_over) {
  std::vector<PointSpec> points;
  std::vector<std::string> keys;
  for (std::size_t i = 1; i < table.names.size(); ++i) {
    std::string key;
    const int axis = axis_in(table.names[i], key);
    if (axis < 0) {
      passed_over.push_back(table.names[i]);
      continue;
    }
    auto place = static_cast<std::size_t>(std::find(keys.begin(), keys.end(), key) - keys.begin());
    if (place == keys.size()) {
      keys.push_back(key);
      points.emplace_back();
      points.back().name = "marker " + std::to_string(keys.size());
    }
    (axis == 0 ? points[place].side_column : points[place].down_column) = table.names[i];
  }
  for (const PointSpec& point : points)
    if (point.side_column.empty() || point.down_column.empty())
      throw InputError(table.file + ": column " + in_quotes(point.side_column + point.down_column) +
                       " has no partner; every marker needs an x and a y, or a side and a down");
  if (points.empty())
    throw InputError(
        table.file +
        ": no markers; name their columns x1, y1, x2, y2, ... or side_1_m, down_1_m, ...");
  return points;
}

/// The markers of a table in its own unit and axes.
struct Tracks {
  const Table& table;
  const std::vector<PointSpec>& points;
  std::vector<const std::vector<double>*> sides, downs;  // of each point

  Tracks(const Table& of, const std::vector<PointSpec>& markers) : table(of), points(markers) {
    for (const PointSpec& point : points) {
      sides.push_back(&table.column(point.side_column));
      downs.push_back(&table.column(point.down_column));
    }
  }
  Vector2d at(std::size_t point, std::size_t row) const {
    return {(*sides[point])[row], (*downs[point])[row]};
  }
  /// The median over the rows of a function of the row, NaN left out. Throws InputError if all are.
  template <class Value>
  double typical(Value value) const {
    std::vector<double> values;
    for (std::size_t row = 0; row < table.rows(); ++row)
      if (const double v = value(row); !std::isnan(v)) values.push_back(v);
    if (values.empty())
      throw InputError(
          table.file +
          ": no frame shows a marker, or two that are neighbours together; every "
          "marker needs a frame with both of its numbers, and one with its neighbour's");
    return median(std::move(values));
  }
};

double in_seconds(const ExperimentSpec& spec) {
  return spec.time_unit == "ms" ? 1e-3 : spec.time_unit == "frames" ? 1 / spec.frame_rate : 1;
}

/// The mean step between frames; steps over frames that are missing are left out.
double frame_step(const std::vector<double>& steps, double median_step) {
  double sum = 0;
  int count = 0;
  for (const double step : steps)
    if (step < 1.5 * median_step) sum += step, ++count;
  return sum / count;
}

void recognise_time(const Table& table, const KnownOfRecording& known, RecognisedRecording& found) {
  const std::vector<double>& time = table.columns.front();
  std::vector<double> steps;
  for (std::size_t i = 1; i < time.size(); ++i) steps.push_back(time[i] - time[i - 1]);
  const double step = median(steps);
  if (!(step > 0))
    throw InputError(table.file + ": column " + in_quotes(table.names.front()) +
                     ": the first column is to be the time, which increases");
  std::string unit = unit_in_name(table.names.front());
  if (found.spec.source == DataSource::kDeepLabCut) unit = "frames";
  if (!one_of(unit, {"s", "ms", "frames"}))
    // Whole numbers one apart count frames; no film has a second from frame to frame.
    unit = step == 1 ? "frames" : step > 1 ? "ms" : "s";
  found.spec.time_unit = unit;
  if (unit != "frames" && !std::isnan(known.frame_rate))
    throw InputError("--frame-rate: " + number_text(known.frame_rate) + "; column " +
                     in_quotes(table.names.front()) + " of " + table.file + " is a time in " +
                     unit + ", not a count of frames");
  if (unit == "frames") {
    found.spec.frame_rate = known.frame_rate;
    if (std::isnan(known.frame_rate))
      throw InputError(table.file + ": column " + in_quotes(table.names.front()) +
                       " counts frames; give the frames per second by --frame-rate");
  }
  found.understood.push_back("time: column " + in_quotes(table.names.front()) + " in " + unit +
                             ", " +
                             number_text(1 / (frame_step(steps, step) * in_seconds(found.spec))) +
                             " frames per second, " + std::to_string(table.rows()) + " frames");
}

void recognise_places(const KnownOfRecording& known, RecognisedRecording& found) {
  std::vector<PointSpec>& points = found.spec.points;
  if (!known.arc_lengths.empty() && known.arc_lengths.size() != points.size())
    throw InputError("--markers: " + std::to_string(known.arc_lengths.size()) +
                     " places; the recording has " + std::to_string(points.size()) + " markers");
  for (std::size_t p = 0; p < points.size(); ++p)
    points[p].arc_length = known.arc_lengths.empty() ? known.length * static_cast<double>(p + 1) /
                                                           static_cast<double>(points.size())
                                                     : known.arc_lengths[p];
  found.understood.push_back(
      "markers: " + std::to_string(points.size()) +
      (known.arc_lengths.empty() ? ", evenly spaced along the cable, the last at its end" : ""));
}

/// Metres in a unit of the file, from the distances between markers (or from the first to the
/// origin), which are nearly as long as the cable between them.
double metres_per_unit(const Tracks& tracks, const KnownOfRecording& known) {
  std::vector<double> ratios;
  const std::vector<PointSpec>& points = tracks.points;
  for (std::size_t p = 1; p < points.size(); ++p)
    ratios.push_back(std::abs(points[p].arc_length - points[p - 1].arc_length) /
                     tracks.typical([&](std::size_t row) {
                       return (tracks.at(p, row) - tracks.at(p - 1, row)).norm();
                     }));
  if (ratios.empty()) {
    const Vector2d origin =
        known.origin.empty() ? Vector2d(0, 0) : Vector2d(known.origin[0], known.origin[1]);
    ratios.push_back(points[0].arc_length / tracks.typical([&](std::size_t row) {
      return (tracks.at(0, row) - origin).norm();
    }));
  }
  return median(ratios);
}

void recognise_lengths(const Tracks& tracks, const KnownOfRecording& known,
                       RecognisedRecording& found) {
  ExperimentSpec& spec = found.spec;
  const double measured = metres_per_unit(tracks, known);
  std::string unit = unit_in_name(spec.points.front().side_column);
  if (!std::isnan(known.metres_per_pixel)) unit = "px";
  if (!one_of(unit, {"m", "cm", "mm", "px"})) {
    unit = "px";  // unless a unit makes the markers as far apart as the cable between them is long
    const std::pair<const char*, double> units[] = {{"m", 1}, {"cm", 1e-2}, {"mm", 1e-3}};
    for (const auto& [name, metres] : units)
      if (measured / metres > 0.85 && measured / metres < 1.4) unit = name;
  }
  spec.length_unit = unit;
  if (unit == "px") {
    spec.metres_per_pixel = known.metres_per_pixel;
    if (std::isnan(spec.metres_per_pixel)) {
      spec.metres_per_pixel = std::strtod(number_text(measured).c_str(), nullptr);
      found.estimated.emplace_back("metres_per_pixel");
    }
  }
  found.understood.push_back(
      "lengths: in " + unit +
      (unit == "px" ? ", " + number_text(spec.metres_per_pixel) + " m each" : ""));
}

void recognise_axes(const Tracks& tracks, const KnownOfRecording& known,
                    RecognisedRecording& found) {
  ExperimentSpec& spec = found.spec;
  const std::size_t last = spec.points.size() - 1;
  const Vector2d origin =
      known.origin.empty() ? Vector2d(0, 0) : Vector2d(known.origin[0], known.origin[1]);
  const double down = tracks.typical([&](std::size_t row) {
    return last > 0 ? (tracks.at(last, row) - tracks.at(0, row))[1]
                    : (tracks.at(0, row) - origin)[1];
  });
  spec.upward = down < 0;
  found.understood.push_back("axes: " + in_quotes(spec.points[0].side_column) + " to the side, " +
                             in_quotes(spec.points[0].down_column) + " grows " +
                             (spec.upward ? "upwards" : "downwards"));
  if (!known.origin.empty()) {
    spec.origin = {known.origin[0], known.origin[1]};
    return;
  }
  const double unit = spec.length_unit == "px"   ? spec.metres_per_pixel
                      : spec.length_unit == "mm" ? 1e-3
                      : spec.length_unit == "cm" ? 1e-2
                                                 : 1;
  if (last == 0) return;
  spec.origin = {0, 0};
  const double share =
      spec.points[0].arc_length / (spec.points[1].arc_length - spec.points[0].arc_length);
  for (const int axis : {0, 1}) {
    const double there = tracks.typical([&](std::size_t row) {
      return ((1 + share) * tracks.at(0, row) - share * tracks.at(1, row))[axis];
    });
    spec.origin[static_cast<std::size_t>(axis)] = std::strtod(number_text(there).c_str(), nullptr);
  }
  // A file whose numbers begin at the support: the estimate is no better than that.
  constexpr double kAtZero = 0.05;  // of the length of the cable
  if (std::hypot(spec.origin[0], spec.origin[1]) * unit < kAtZero * known.length)
    spec.origin.clear();
  else
    found.estimated.emplace_back("origin");
}

/// When the cable is let go, and whether it is at rest then.
void recognise_start(const KnownOfRecording& known, RecognisedRecording& found) {
  const Recording recording = read_recording(found.spec, 1, known.length);
  constexpr std::size_t kShort = 2;  // frames: the noise of the first ones is as much
  const double release = release_time(recording);
  if (recording.time.size() > kShort && release > recording.time[kShort]) {
    found.spec.from = release;
    found.estimated.emplace_back("from");
    const auto next = std::upper_bound(recording.time.begin(), recording.time.end(), release);
    found.understood.push_back("start: nothing moves until " + number_text(release) +
                               " s; the release, before the next frame at " + number_text(*next) +
                               " s");
    return;
  }
  // While a fall from rest goes some way, its first half goes a quarter as far; any other, half.
  const auto& measured = recording.measured;
  const auto moved = [&](Eigen::Index frame) {
    double largest = 0;
    for (Eigen::Index p = 0; p < measured.rows(); p += 2)
      largest =
          std::fmax(largest, (measured.block<2, 1>(p, frame) - measured.block<2, 1>(p, 0)).norm());
    return largest;
  };
  double range = 0;
  for (Eigen::Index k = 0; k < measured.cols(); ++k) range = std::max(range, moved(k));
  Eigen::Index later = 4;
  while (later + 1 < measured.cols() && moved(later) < 0.05 * range) ++later;
  found.at_rest = later >= measured.cols() || moved(later / 2) < 0.375 * moved(later);
  found.understood.emplace_back(found.at_rest ? "start: at rest in the first frame"
                                              : "start: the cable moves in the first frame");
}

}  // namespace

RecognisedRecording recognise_recording(const std::filesystem::path& file,
                                        const KnownOfRecording& known) {
  RecognisedRecording found;
  found.spec.data = file;
  found.spec.name = file.stem().string();
  found.spec.where = file.string();
  found.spec.source = source_of(file);
  const Table table = import_tracker_table(found.spec.source, file, found.spec.likelihood_floor);
  if (table.rows() < 2) throw InputError(file.string() + ": fewer than two frames");
  std::vector<std::string> passed_over;
  found.spec.points = markers_in(table, passed_over);
  recognise_time(table, known, found);
  recognise_places(known, found);
  const Tracks tracks{table, found.spec.points};
  recognise_lengths(tracks, known, found);
  recognise_axes(tracks, known, found);
  recognise_start(known, found);
  for (const std::string& name : passed_over)
    found.understood.push_back("column " + in_quotes(name) + " is not used");
  return found;
}

}  // namespace catena
