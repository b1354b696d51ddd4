// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <locale>
#include <map>
#include <numbers>
#include <set>
#include <sstream>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/cases/time_limits.hpp"

namespace catena {
namespace {

/// Squares of what is beyond are no numbers of a computer, and products of several are none soon. A model has the same
/// limit for its parameters.
constexpr double kLeastPositive = 1e-50, kGreatestPositive = 1e50;

double optional_positive(const TomlTable& table, std::string_view key, double absent,
                         double least = kLeastPositive, double greatest = kGreatestPositive) {
  const double value = table.optional_number(key).value_or(absent);
  if (table.has(key) && !(value >= least && value <= greatest))
    table.fail(key, shortest_number(value) +
                        (value > 0 ? "; must lie between " : "; must be positive, between ") +
                        shortest_number(least) + " and " + shortest_number(greatest));
  return value;
}

double optional_duration(const TomlTable& table, std::string_view key, double absent) {
  return optional_positive(table, key, absent, kShortestTime, kLongestTime);
}

double not_negative(const TomlTable& table, std::string_view key, double absent) {
  const double value = table.optional_number(key).value_or(absent);
  if (!(value >= 0) || !std::isfinite(value))
    table.fail(key, shortest_number(value) + "; must not be negative, and finite");
  return value;
}

int count(const TomlTable& table, std::string_view key, long absent, long least,
          long most = 1'000'000'000) {
  const long value = table.optional_integer(key).value_or(absent);
  if (value < least || value > most)
    table.fail(key, std::to_string(value) + "; must be a whole number from " +
                        std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

/// A list with one number per link, or none.
std::vector<double> per_link(const TomlTable& table, std::string_view key, int links,
                             bool zero_allowed) {
  std::vector<double> values = table.numbers(key);
  if (values.empty()) return values;
  if (values.size() != static_cast<std::size_t>(links))
    table.fail(key, std::to_string(values.size()) + " numbers; must be one per link, " +
                        std::to_string(links));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || values[i] < 0 || (values[i] == 0 && !zero_allowed))
      table.fail(key, "number " + std::to_string(i + 1) + " is " + shortest_number(values[i]) +
                          (zero_allowed ? "; must not be negative" : "; must be positive"));
  return values;
}

CableGeometry read_cable(const TomlTable& table, int links) {
  CableGeometry cable;
  cable.length = optional_positive(table, "length", kNotGiven);
  cable.density = optional_positive(table, "density", kNotGiven);
  cable.link_lengths = per_link(table, "link_lengths", links, false);
  cable.link_masses = per_link(table, "link_masses", links, true);
  cable.link_inertias = per_link(table, "link_inertias", links, true);
  cable.load_mass = not_negative(table, "load_mass", 0);
  cable.gravity = not_negative(table, "gravity", cable.gravity);
  if (std::isnan(cable.length) == cable.link_lengths.empty())
    table.fail_choice({"length", "link_lengths"});
  if (std::isnan(cable.density) == cable.link_masses.empty())
    table.fail_choice({"density", "link_masses"});
  return cable;
}

ParameterSpec read_parameter(const TomlTable& table) {
  ParameterSpec parameter;
  parameter.where = table.file() + ":" + std::to_string(table.line());
  parameter.name = table.text("name");
  if (parameter.name.empty()) table.fail("name", "empty; a name is needed as label in the results");
  parameter.sets = table.text("sets");
  parameter.unit = table.optional_text("unit").value_or("");
  parameter.value = table.number("value");
  parameter.lower = table.optional_number("lower").value_or(parameter.lower);
  parameter.upper = table.optional_number("upper").value_or(parameter.upper);
  parameter.factor = table.optional_number("factor").value_or(1);
  parameter.free = table.optional_flag("free").value_or(false);
  parameter.per_experiment = table.optional_flag("per_experiment").value_or(false);
  if (!std::isfinite(parameter.factor) || parameter.factor == 0)
    table.fail("factor", shortest_number(parameter.factor) + "; must be finite and not zero");
  if (!std::isfinite(parameter.value))
    table.fail("value", shortest_number(parameter.value) + "; must be finite");
  if (parameter.lower > parameter.upper)
    table.fail("lower", shortest_number(parameter.lower) +
                            "; must not exceed upper = " + shortest_number(parameter.upper));
  if (parameter.free && parameter.lower == parameter.upper)
    table.fail("lower", shortest_number(parameter.lower) +
                            "; a free parameter needs room: lower must be below upper");
  const auto check_within = [&](const TomlTable& at, const std::string& key, double value) {
    if (value < parameter.lower || value > parameter.upper)
      at.fail(key, shortest_number(value) +
                       "; must lie within lower = " + shortest_number(parameter.lower) +
                       " and upper = " + shortest_number(parameter.upper));
  };
  check_within(table, "value", parameter.value);
  if (const auto values = table.optional_table("values")) {
    if (!parameter.per_experiment)
      table.fail("values", "needs per_experiment = true; else the parameter has but one value");
    for (const std::string& experiment : values->keys()) {
      const double value = values->number(experiment);
      if (!std::isfinite(value))
        values->fail(experiment, shortest_number(value) + "; must be finite");
      check_within(*values, experiment, value);
      parameter.values[experiment] = value;
    }
  }
  parameter.standard_deviation = optional_positive(table, "standard_deviation", kNotGiven);
  if (!std::isnan(parameter.standard_deviation) && !parameter.free)
    table.fail("standard_deviation",
               shortest_number(parameter.standard_deviation) +
                   "; what is not known exactly is fitted: say free = true, too");
  if (!std::isnan(parameter.standard_deviation))
    parameter.measured = table.optional_number("measured").value_or(parameter.value);
  const bool strictly_positive = parameter.lower > 0;
  parameter.scale = strictly_positive ? Scale::kLogarithmic : Scale::kLinear;
  if (table.has("scale")) parameter.scale = static_cast<Scale>(table.choice("scale", kScaleWords));
  if (parameter.scale == Scale::kLogarithmic && parameter.free && !strictly_positive)
    table.fail("lower", shortest_number(parameter.lower) +
                            "; a logarithmic scale needs a positive lower bound");
  return parameter;
}

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

PointSpec read_point(const TomlTable& table, DataKind kind, int number, int links,
                     const std::vector<CameraSpec>& cameras) {
  PointSpec point;
  const std::string index = std::to_string(number);
  if (kind == DataKind::kAngles) {
    point.name = table.optional_text("name").value_or("angle " + index);
    point.angle_column = table.text("column");
    point.link = count(table, "link", number, 1);
    if (point.link > links)
      table.fail("link", std::to_string(point.link) + "; there are " + std::to_string(links));
    return point;
  }
  point.name = table.optional_text("name").value_or("marker " + index);
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

ExperimentSpec read_experiment(const TomlTable& table, int number, int links,
                               const std::vector<CameraSpec>& cameras,
                               const std::filesystem::path& directory, const HandedIn& recordings) {
  ExperimentSpec experiment;
  experiment.where = table.file() + ":" + std::to_string(table.line());
  experiment.name = table.optional_text("name").value_or("experiment " + std::to_string(number));
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

ErrorSpec read_error(const TomlTable& table) {
  ErrorSpec error;
  error.measure = static_cast<Measure>(table.choice("measure", kMeasureWords));
  if (table.has("loss")) {
    if (error.measure != Measure::kLeastSquares)
      table.fail("loss", "only the measure least_squares takes a loss");
    error.loss = static_cast<Loss>(table.choice("loss", kLossWords));
  }
  error.loss_scale = optional_positive(table, "loss_scale", error.loss_scale);
  if (table.has("noise")) {
    error.noise_estimated = table.choice("noise", kNoiseWords) == 1;
    if (error.noise_estimated && error.measure != Measure::kLeastSquares)
      table.fail("noise", "\"estimated\"; only the measure least_squares takes it");
  }
  return error;
}

OptimiserSpec read_optimiser(const TomlTable& table) {
  OptimiserSpec optimiser;
  optimiser.method = static_cast<FitMethod>(table.choice("method", kMethodWords, false));
  optimiser.max_evaluations = count(table, "max_evaluations", optimiser.max_evaluations, 1);
  optimiser.tolerance = optional_positive(table, "tolerance", optimiser.tolerance);
  optimiser.initial_step = optional_positive(table, "initial_step", optimiser.initial_step);
  optimiser.starts = count(table, "starts", optimiser.starts, 1, kMostFits);
  optimiser.seed = static_cast<unsigned>(count(table, "seed", optimiser.seed, 0));
  optimiser.growing_windows = table.numbers("growing_windows");
  for (std::size_t i = 0; i < optimiser.growing_windows.size(); ++i)
    if (!(optimiser.growing_windows[i] > (i ? optimiser.growing_windows[i - 1] : 0)))
      table.fail("growing_windows", "must be positive times in s, each longer than the one before");
  return optimiser;
}

SimulationSpec read_simulation(const TomlTable& table) {
  SimulationSpec simulation;
  simulation.duration = optional_duration(table, "duration", kNotGiven);
  simulation.step = optional_duration(table, "step", simulation.step);
  simulation.relative_tolerance =
      optional_positive(table, "relative_tolerance", simulation.relative_tolerance);
  simulation.absolute_tolerance_position = optional_positive(
      table, "absolute_tolerance_position", simulation.absolute_tolerance_position);
  simulation.absolute_tolerance_velocity = optional_positive(
      table, "absolute_tolerance_velocity", simulation.absolute_tolerance_velocity);
  simulation.max_steps = count(table, "max_steps", simulation.max_steps, 1);
  if (!std::isnan(simulation.duration) && simulation.duration / simulation.step > 1e7)
    table.fail("step", shortest_number(simulation.step) +
                           "; more than ten million outputs in the duration");
  return simulation;
}

/// "2 mm" in m, "3 mrad" in rad.
double read_tolerance(const TomlTable& table, std::string_view key) {
  const std::string text = table.text(key);
  static const std::map<std::string, double> units = {{"m", 1},
                                                      {"cm", 1e-2},
                                                      {"mm", 1e-3},
                                                      {"um", 1e-6},
                                                      {"rad", 1},
                                                      {"mrad", 1e-3},
                                                      {"deg", std::numbers::pi / 180}};
  std::istringstream words(text);
  words.imbue(std::locale::classic());
  words.exceptions(std::ios::badbit);  // where memory is refused
  double value = 0;
  std::string unit, rest;
  if (!(words >> value >> unit) || words >> rest || !units.contains(unit) || !(value > 0))
    table.fail(key, in_quotes(text) +
                        "; must be a positive number and one of m, cm, mm, um, rad, "
                        "mrad and deg, such as \"2 mm\"");
  return value * units.at(unit);
}

DiagnosisSpec read_diagnosis(const TomlTable& table) {
  DiagnosisSpec diagnosis;
  if (table.has("good_enough")) diagnosis.good_enough = read_tolerance(table, "good_enough");
  diagnosis.possible = table.texts("possible");
  diagnosis.impossible = table.texts("impossible");
  return diagnosis;
}

/// Refuses a value for an experiment that the case does not have. Windows are called
/// "NAME from 0.5 s".
void check_value_names(const TomlTable& table, const ParameterSpec& parameter,
                       const std::vector<ExperimentSpec>& experiments) {
  std::vector<std::string> names;
  for (const ExperimentSpec& experiment : experiments) names.push_back(experiment.name);
  for (const auto& [name, value] : parameter.values) {
    bool known = false;
    for (const ExperimentSpec& experiment : experiments)
      known |= name == experiment.name ||
               (!std::isnan(experiment.window) && name.starts_with(experiment.name + " from "));
    if (!known)
      table.fail("values",
                 in_quotes(name) + " is no experiment of this case" + suggestion(name, names));
  }
}

/// Whether residuals of a fitted experiment cannot be counted in units of their noise.
bool lacks_noise(const Case& the_case, const ExperimentSpec& experiment) {
  return experiment.use == Use::kFit && std::isnan(experiment.noise) &&
         !the_case.error.noise_estimated;
}

/// A standard deviation weighs a parameter against residuals, which then must be in units of theirs.
void check_priors(const std::vector<TomlTable>& tables, const Case& the_case) {
  for (std::size_t j = 0; j < tables.size(); ++j) {
    const double deviation = the_case.parameters[j].standard_deviation;
    if (std::isnan(deviation)) continue;
    if (the_case.error.measure != Measure::kLeastSquares)
      tables[j].fail("standard_deviation",
                     shortest_number(deviation) + "; only the measure least_squares takes it");
    for (const ExperimentSpec& experiment : the_case.experiments)
      if (lacks_noise(the_case, experiment))
        tables[j].fail("standard_deviation",
                       shortest_number(deviation) +
                           "; it is weighed against the noise, and experiment " +
                           in_quotes(experiment.name) +
                           " states none; give its noise, or noise = \"estimated\" in [error]");
  }
}

/// Refuses recordings of experiments that the case does not have.
void check_names(const HandedIn& recordings, const Case& the_case) {
  std::vector<std::string> names;
  for (const ExperimentSpec& experiment : the_case.experiments) names.push_back(experiment.name);
  for (const auto& [name, table] : recordings)
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw InputError("recordings: " + in_quotes(name) + " is no [[experiment]] of " +
                       the_case.file.string() + suggestion(name, names));
}

Case read(const TomlTable& file, const std::filesystem::path& path,
          const std::filesystem::path& directory, const HandedIn& recordings) {
  Case the_case;
  the_case.file = path;
  the_case.text = file.source();
  the_case.title = file.optional_text("title").value_or("");
  const TomlTable model = file.table("model");
  the_case.links = count(model, "links", 0, 1, kMostLinks);
  if (const auto description = model.optional_text("description")) {
    the_case.description = directory / *description;
    if (!is_file(the_case.description))
      model.fail("description", shortened(the_case.description.string(), kLongestPath) +
                                    "; there is no such file");
  }
  the_case.cable = read_cable(file.table("cable"), the_case.links);
  std::set<std::string> names;
  for (const TomlTable& table : file.tables("parameter")) {
    the_case.parameters.push_back(read_parameter(table));
    if (!names.insert(the_case.parameters.back().name).second)
      table.fail("name", in_quotes(the_case.parameters.back().name) + "; names must differ");
  }
  if (const auto initial = file.optional_table("initial"))
    the_case.initial = read_initial(*initial, the_case.links);
  the_case.signals = read_signals(file, directory);
  names.clear();
  for (const TomlTable& table : file.tables("camera")) {
    the_case.cameras.push_back(read_camera(table));
    if (!names.insert(the_case.cameras.back().name).second)
      table.fail("name", in_quotes(the_case.cameras.back().name) + "; names must differ");
  }
  names.clear();
  for (const TomlTable& table : file.tables("experiment")) {
    the_case.experiments.push_back(
        read_experiment(table, static_cast<int>(the_case.experiments.size()) + 1, the_case.links,
                        the_case.cameras, directory, recordings));
    if (!names.insert(the_case.experiments.back().name).second)
      table.fail("name", in_quotes(the_case.experiments.back().name) + "; names must differ");
  }
  check_names(recordings, the_case);
  const std::vector<TomlTable> parameters = file.tables("parameter");
  for (std::size_t j = 0; j < parameters.size(); ++j)
    check_value_names(parameters[j], the_case.parameters[j], the_case.experiments);
  if (const auto table = file.optional_table("error")) {
    the_case.error = read_error(*table);
    for (const ExperimentSpec& experiment : the_case.experiments)
      if (the_case.error.loss != Loss::kNone && lacks_noise(the_case, experiment))
        table->fail("loss",
                    "\"" + table->text("loss") +
                        "\" counts residuals in units of the noise, and experiment " +
                        in_quotes(experiment.name) +
                        " states none; give its noise, or noise = \"estimated\" in [error]");
  }
  check_priors(parameters, the_case);
  if (const auto table = file.optional_table("optimiser"))
    the_case.optimiser = read_optimiser(*table);
  if (const auto table = file.optional_table("simulation"))
    the_case.simulation = read_simulation(*table);
  if (const auto table = file.optional_table("diagnosis"))
    the_case.diagnosis = read_diagnosis(*table);
  file.finish();
  return the_case;
}

}  // namespace

Case read_case(const std::filesystem::path& path, const HandedIn& recordings) {
  return read(TomlTable::read(path, "case"), path, path.parent_path(), recordings);
}

Case parse_case(const std::string& text, const std::string& name,
                const std::filesystem::path& directory, const HandedIn& recordings) {
  return read(TomlTable::parse(text, name, "case"), name, directory, recordings);
}

}  // namespace catena
