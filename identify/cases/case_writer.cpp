// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/case_writer.hpp"

#include <cmath>

#include "common/number_text.hpp"
#include "common/toml_quoted.hpp"
#include "common/toml_reader.hpp"
#include "identify/cases/case_words.hpp"

namespace catena {
namespace {

std::string list(const std::vector<double>& values) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i)
    out += (i ? ", " : "") + shortest_number(values[i]);
  return out + "]";
}

/// Lines "key = value", one table at a time; what equals its default is left out.
class Writer {
 public:
  void header(const std::string& text) { out_ += "\n" + text + "\n"; }
  void line(const std::string& key, const std::string& value) {
    out_ += key + " = " + value + "\n";
  }
  void text(const std::string& key, const std::string& value, const std::string& absent = "") {
    if (value != absent) line(key, toml_quoted(value));
  }
  void number(const std::string& key, double value, double absent = kNotGiven) {
    if (value != absent && !(std::isnan(value) && std::isnan(absent)))
      line(key, shortest_number(value));
  }
  void count(const std::string& key, long value, long absent) {
    if (value != absent) line(key, std::to_string(value));
  }
  void flag(const std::string& key, bool value, bool absent = false) {
    if (value != absent) line(key, value ? "true" : "false");
  }
  void numbers(const std::string& key, const std::vector<double>& values) {
    if (!values.empty()) line(key, list(values));
  }
  void texts(const std::string& key, const std::vector<std::string>& values) {
    std::string items;
    for (const std::string& value : values)
      items += (items.empty() ? "" : ", ") + toml_quoted(value);
    if (!values.empty()) line(key, "[" + items + "]");
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_ = "format = 1\nkind = \"case\"\n";
};

template <class Word>
const std::string& word(const std::vector<std::string>& words, Word value) {
  return words[static_cast<std::size_t>(value)];
}

std::string relative_path(const std::filesystem::path& path,
                          const std::filesystem::path& directory) {
  const std::filesystem::path base = directory.empty() ? "." : directory;
  return std::filesystem::weakly_canonical(std::filesystem::absolute(path))
      .lexically_relative(std::filesystem::weakly_canonical(std::filesystem::absolute(base)))
      .generic_string();
}

void write_parameter(Writer& out, const ParameterSpec& parameter) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  out.header("[[parameter]]");
  out.text("name", parameter.name);
  out.text("sets", parameter.sets);
  out.number("value", parameter.value);
  out.text("unit", parameter.unit);
  out.flag("free", parameter.free);
  out.number("lower", parameter.lower, -infinity);
  out.number("upper", parameter.upper, infinity);
  const Scale usual = parameter.lower > 0 ? Scale::kLogarithmic : Scale::kLinear;
  if (parameter.scale != usual) out.text("scale", word(kScaleWords, parameter.scale));
  out.number("factor", parameter.factor, 1);
  out.number("measured", parameter.measured);
  out.number("standard_deviation", parameter.standard_deviation);
  out.text("at_most", parameter.at_most);
  out.flag("per_experiment", parameter.per_experiment);
  std::string values;
  for (const auto& [experiment, value] : parameter.values)
    values +=
        (values.empty() ? "" : ", ") + toml_quoted(experiment) + " = " + shortest_number(value);
  if (!values.empty()) out.line("values", "{" + values + "}");
}

void write_initial(Writer& out, const InitialSpec& initial, const std::string& table) {
  out.header("[" + table + "]");
  out.text("shape", word(kShapeWords, initial.shape));
  switch (initial.shape) {
    case Shape::kStraight:
      if (!initial.coefficients.empty()) out.number("angle", initial.coefficients[0]);
      break;
    case Shape::kAngles:
      out.numbers("angles", initial.coefficients);
      break;
    case Shape::kSmooth:
      out.line("terms", std::to_string(initial.terms));
      out.numbers("coefficients", initial.coefficients);
      break;
    case Shape::kCatenary:
      out.line("held", "{side = " + shortest_number(initial.held[0]) +
                           ", down = " + shortest_number(initial.held[1]) + "}");
      out.flag("ends_at_held", initial.ends_at_held);
      break;
    case Shape::kHanging:
      break;
  }
  out.flag("free", initial.free);
  out.numbers("azimuths", initial.azimuths);
  out.numbers("out_of_plane", initial.out_of_plane);
  for (const LoadStart& start : initial.load) {
    out.header("[[" + table + ".load]]");
    out.text("coordinate", start.coordinate);
    out.number("value", start.value);
    out.number("rate", start.rate);
  }
  if (initial.at_rest) return;
  out.header("[" + table + ".velocity]");
  out.text("shape", word(kShapeWords, initial.velocity_shape));
  if (initial.velocity_shape == Shape::kSmooth)
    out.line("terms", std::to_string(initial.velocity_terms));
  out.numbers("rates", initial.velocity_coefficients);
  out.flag("free", initial.velocity_free);
  out.numbers("azimuth_rates", initial.azimuth_rates);
  out.numbers("out_of_plane_rates", initial.out_of_plane_rates);
}

std::string point_text(const PointSpec& point, DataKind kind) {
  std::string out = "  {name = " + toml_quoted(point.name);
  if (kind == DataKind::kAngles)
    return out + ", column = " + toml_quoted(point.angle_column) +
           ", link = " + std::to_string(point.link) + "},\n";
  out +=
      ", side = " + toml_quoted(point.side_column) + ", down = " + toml_quoted(point.down_column);
  if (!point.across_column.empty()) out += ", across = " + toml_quoted(point.across_column);
  if (!point.camera.empty()) out += ", camera = " + toml_quoted(point.camera);
  if (point.load)
    out += ", load = true";
  else if (point.joint)
    out += ", joint = " + std::to_string(point.joint);
  else
    out += ", arc_length = " + shortest_number(point.arc_length);
  return out + "},\n";
}

void write_signals(Writer& out, const std::vector<SignalSpec>& signals, const std::string& table,
                   const std::filesystem::path& directory) {
  for (const SignalSpec& signal : signals) {
    out.header("[[" + table + "]]");
    out.text("name", signal.name);
    out.text("data", relative_path(signal.data, directory));
    out.text("time", signal.time_column, "time_s");
    out.text("column", signal.column);
  }
}

void write_experiment(Writer& out, const ExperimentSpec& experiment,
                      const std::filesystem::path& directory) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  out.header("[[experiment]]");
  out.text("name", experiment.name);
  out.text("data", relative_path(experiment.data, directory));
  out.text("kind", word(kDataKindWords, experiment.kind));
  out.text("use", word(kUseWords, experiment.use), "fit");
  out.number("from", experiment.from, -infinity);
  out.number("to", experiment.to, infinity);
  out.number("fit_until", experiment.fit_until, infinity);
  out.number("start", experiment.start);
  out.number("window", experiment.window);
  out.flag("joined", experiment.joined);
  out.count("every", experiment.every, 1);
  out.number("noise", experiment.noise);
  if (experiment.keep_outliers) out.text("outliers", "keep");
  out.text("source", word(kSourceWords, experiment.source), "catena");
  out.text("time_column", experiment.time_column);
  out.text("time_unit", experiment.time_unit, "s");
  out.number("frame_rate", experiment.frame_rate);
  out.text("length_unit", experiment.length_unit, "m");
  out.number("metres_per_pixel", experiment.metres_per_pixel);
  out.text("angle_unit", experiment.angle_unit, "rad");
  out.flag("wrapped", experiment.wrapped);
  if (experiment.upward) out.text("vertical", "up");
  out.flag("mirrored", experiment.mirrored);
  out.texts("axes", experiment.axes);
  out.numbers("origin", experiment.origin);
  out.number("likelihood_floor", experiment.likelihood_floor, 0.6);
  if (!experiment.points.empty()) {
    std::string points = "[\n";
    for (const PointSpec& point : experiment.points) points += point_text(point, experiment.kind);
    out.line(experiment.kind == DataKind::kMarkers ? "markers" : "angles", points + "]");
  }
  if (experiment.initial) write_initial(out, *experiment.initial, "experiment.initial");
  write_signals(out, experiment.signals, "experiment.signal", directory);
}

void write_diagnosis(Writer& out, const DiagnosisSpec& diagnosis) {
  if (std::isnan(diagnosis.good_enough) && diagnosis.possible.empty() &&
      diagnosis.impossible.empty() && diagnosis.doubtful.empty())
    return;
  out.header("[diagnosis]");
  if (!std::isnan(diagnosis.good_enough))
    out.text("good_enough", shortest_number(diagnosis.good_enough) + " m");
  out.texts("possible", diagnosis.possible);
  out.texts("impossible", diagnosis.impossible);
  out.texts("doubtful", diagnosis.doubtful);
}

}  // namespace

std::string case_text(const Case& the_case, const std::filesystem::path& directory) {
  Writer out;
  out.text("title", the_case.title);
  out.header("[model]");
  if (!the_case.description.empty())
    out.text("description", relative_path(the_case.description, directory));
  out.line("links", std::to_string(the_case.links));
  out.header("[cable]");
  out.number("length", the_case.cable.length);
  out.number("density", the_case.cable.density);
  out.numbers("link_lengths", the_case.cable.link_lengths);
  out.numbers("link_masses", the_case.cable.link_masses);
  out.numbers("link_inertias", the_case.cable.link_inertias);
  out.number("load_mass", the_case.cable.load_mass, 0);
  out.number("gravity", the_case.cable.gravity);
  for (const ParameterSpec& parameter : the_case.parameters) write_parameter(out, parameter);
  for (const CameraSpec& camera : the_case.cameras) {
    out.header("[[camera]]");
    out.text("name", camera.name);
    out.numbers("centre", {camera.centre[0], camera.centre[1]});
  }
  write_initial(out, the_case.initial, "initial");
  write_signals(out, the_case.signals, "signal", directory);
  for (const ExperimentSpec& experiment : the_case.experiments)
    write_experiment(out, experiment, directory);

  out.header("[error]");
  out.text("measure", word(kMeasureWords, the_case.error.measure));
  if (the_case.error.loss != Loss::kNone) {
    out.text("loss", word(kLossWords, the_case.error.loss));
    out.number("loss_scale", the_case.error.loss_scale);
  }
  if (the_case.error.noise_estimated) out.text("noise", "estimated");
  const OptimiserSpec optimiser, &chosen = the_case.optimiser;
  out.header("[optimiser]");
  out.text("method", word(kMethodWords, chosen.method));
  out.count("max_evaluations", chosen.max_evaluations, optimiser.max_evaluations);
  out.number("tolerance", chosen.tolerance, optimiser.tolerance);
  out.number("initial_step", chosen.initial_step, optimiser.initial_step);
  out.count("starts", chosen.starts, 1);
  out.count("seed", chosen.seed, optimiser.seed);
  out.numbers("growing_windows", chosen.growing_windows);
  const SimulationSpec simulation, &wanted = the_case.simulation;
  out.header("[simulation]");
  out.number("duration", wanted.duration);
  out.number("step", wanted.step, simulation.step);
  out.number("relative_tolerance", wanted.relative_tolerance, simulation.relative_tolerance);
  out.number("absolute_tolerance_position", wanted.absolute_tolerance_position,
             simulation.absolute_tolerance_position);
  out.number("absolute_tolerance_velocity", wanted.absolute_tolerance_velocity,
             simulation.absolute_tolerance_velocity);
  out.count("max_steps", wanted.max_steps, simulation.max_steps);
  write_diagnosis(out, the_case.diagnosis);
  return out.take();
}

}  // namespace catena
