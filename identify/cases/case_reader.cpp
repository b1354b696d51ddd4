// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/case_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "common/in_a_line.hpp"
#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "common/most_links.hpp"
#include "common/nearest_name.hpp"
#include "common/number_text.hpp"
#include "common/toml_reader.hpp"
#include "common/whole_file.hpp"
#include "identify/cases/case_numbers.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/cases/experiment_reader.hpp"
#include "identify/cases/settings_reader.hpp"
#include "identify/cases/start_reader.hpp"

namespace catena {
namespace {

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
  parameter.name = in_a_line(table.text("name"));
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
  parameter.at_most = in_a_line(table.optional_text("at_most").value_or(""));
  const bool strictly_positive = parameter.lower > 0;
  parameter.scale = strictly_positive ? Scale::kLogarithmic : Scale::kLinear;
  if (table.has("scale")) parameter.scale = static_cast<Scale>(table.choice("scale", kScaleWords));
  if (parameter.scale == Scale::kLogarithmic && parameter.free && !strictly_positive)
    table.fail("lower", shortest_number(parameter.lower) +
                            "; a logarithmic scale needs a positive lower bound");
  return parameter;
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

/// Refuses an order of two parameters that cannot be compared, or of which one stands in another order.
void check_orders(const std::vector<TomlTable>& tables, const Case& the_case) {
  const std::vector<ParameterSpec>& all = the_case.parameters;
  for (std::size_t j = 0; j < tables.size(); ++j) {
    const ParameterSpec& lesser = all[j];
    if (lesser.at_most.empty()) continue;
    const auto greater = std::find_if(all.begin(), all.end(), [&](const ParameterSpec& each) {
      return each.name == lesser.at_most;
    });
    if (greater == all.end() || greater->name == lesser.name)
      tables[j].fail("at_most", in_quotes(lesser.at_most) + " is no other parameter of this case");
    for (const ParameterSpec* each : {&lesser, &*greater})
      if (each->scale != Scale::kLinear || each->per_experiment || each->lower != lesser.lower ||
          each->factor != lesser.factor)
        tables[j].fail("at_most",
                       "goes with two parameters of linear scale, of the same lower "
                       "bound and factor, and neither per_experiment");
    if (lesser.value > greater->value)
      tables[j].fail("at_most", "value = " + shortest_number(lesser.value) +
                                    " is more than that of " + in_quotes(greater->name) + ", " +
                                    shortest_number(greater->value));
    for (const ParameterSpec& each : all)
      if (!each.at_most.empty() && each.name != lesser.name &&
          (each.name == greater->name || each.at_most == greater->name ||
           each.at_most == lesser.name))
        tables[j].fail("at_most", "a parameter stands in one order only");
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
  check_orders(parameters, the_case);
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
