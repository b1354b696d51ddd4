// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/settings_reader.hpp"

#include <cmath>
#include <locale>
#include <map>
#include <numbers>
#include <sstream>
#include <string>

#include "common/in_quotes.hpp"
#include "common/number_text.hpp"
#include "identify/cases/case_numbers.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_words.hpp"

namespace catena {
namespace {

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

}  // namespace

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

DiagnosisSpec read_diagnosis(const TomlTable& table) {
  DiagnosisSpec diagnosis;
  if (table.has("good_enough")) diagnosis.good_enough = read_tolerance(table, "good_enough");
  diagnosis.possible = table.texts("possible");
  diagnosis.impossible = table.texts("impossible");
  diagnosis.doubtful = table.texts("doubtful");
  return diagnosis;
}

}  // namespace catena
