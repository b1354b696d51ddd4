// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/result_writer.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/sha256.hpp"
#include "description/description.hpp"
#include "description/formula.hpp"
#include "identify/cases/case_words.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/uncertainty/profile.hpp"

namespace catena {
namespace {

using Json = nlohmann::ordered_json;

/// null where there is no number: JSON knows neither NaN nor infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <class Range>
Json numbers(const Range& values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(number(value));
  return out;
}

/// One array per row.
Json rows(const Eigen::MatrixXd& matrix) {
  Json out = Json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) out.push_back(numbers(matrix.row(i)));
  return out;
}

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

Json head(const Problem& problem, const char* command) {
  const Case& the_case = problem.the_case();
  const std::string text = text_of(the_case.file);
  Json json;
  json["format"] = 1;
  json["kind"] = "result";
  json["command"] = command;
  json["title"] = the_case.title;
  json["status"] = "success";
  json["message"] = "";
  json["versions"] = {{"catena", CATENA_VERSION}};
  json["case"] = {
      {"file", the_case.file.filename().string()}, {"text", text}, {"sha256", sha256_hex(text)}};
  Json& model = json["model"];
  model["id"] = problem.model().table().id;
  model["links"] = problem.model().links();
  model["description_hash"] = problem.model().table().description_hash;
  model["load_mass"] = the_case.cable.load_mass;
  const std::string derived = derived_equations(the_case.description, problem.model().links());
  if (!derived.empty()) model["derived"] = Json::parse(derived);
  model["effects"] = Json::array();
  if (!the_case.description.empty()) {
    model["description"] = text_of(the_case.description);
    for (const Effect& effect : read_description(the_case.description).effects) {
      Json formulas_of = Json::array();
      for (const Formula& formula : formulas(effect))
        formulas_of.push_back(
            {{"what", formula.what}, {"latex", formula.latex}, {"mathml", formula.mathml}});
      model["effects"].push_back(
          {{"id", effect.id}, {"title", effect.title}, {"formulas", formulas_of}});
    }
  }
  return json;
}

Json energy_of(const Model& model, const Simulation& simulation) {
  static const char* const kKinds[] = {"stored", "dissipated", "supplied"};
  Json items = Json::array();
  for (int i = 0; i < model.energies(); ++i)
    items.push_back({{"name", model.table().energy_item[i].name},
                     {"kind", kKinds[model.table().energy_item[i].kind]},
                     {"value", numbers(simulation.trajectory.energy.row(i))}});
  return {{"time", numbers(simulation.trajectory.time)},
          {"items", items},
          {"imbalance", number(simulation.energy_imbalance)}};
}

Json motion_json(const Problem& problem, const Motion& motion) {
  const Simulation& simulation = motion.simulation;
  Json json;
  json["trajectory"] = {{"time", numbers(simulation.trajectory.time)},
                        {"side", rows(motion.side)},
                        {"down", rows(motion.down)},
                        {"angle", rows(simulation.trajectory.q.topRows(problem.model().links()))}};
  if (simulation.trajectory.energy.size()) json["energy"] = energy_of(problem.model(), simulation);
  const Statistics& statistics = simulation.statistics;
  json["statistics"] = {{"steps", statistics.steps},
                        {"residual_evaluations", statistics.residual_evaluations},
                        {"jacobian_evaluations", statistics.jacobian_evaluations},
                        {"newton_iterations", statistics.newton_iterations},
                        {"error_test_failures", statistics.error_test_failures},
                        {"newton_failures", statistics.newton_failures}};
  return json;
}

/// Rows of one component, one per point.
Json component_rows(const Recording& recording, const Eigen::MatrixXd& values,
                    Component component) {
  Json out = Json::array();
  for (std::size_t c = 0; c < recording.channels.size(); ++c)
    if (recording.channels[c].component == component)
      out.push_back(numbers(values.row(static_cast<Eigen::Index>(c))));
  return out;
}

void put_values(Json& json, const Recording& recording, const Eigen::MatrixXd& values) {
  if (recording.channels.front().component == Component::kAngle) {
    json["angle"] = component_rows(recording, values, Component::kAngle);
  } else {
    json["side"] = component_rows(recording, values, Component::kSide);
    json["down"] = component_rows(recording, values, Component::kDown);
  }
}

double arc_of(const Problem& problem, const PointSpec& point) {
  if (!std::isnan(point.arc_length)) return point.arc_length;
  const Model& model = problem.model();
  const Eigen::VectorXd lengths = problem.model_parameters(problem.start(), -1)
                                      .segment(model.parameter_index("length_1"), model.links());
  return point.joint ? lengths.head(point.joint).sum() : lengths.sum();
}

Json measured_json(const Problem& problem, const Recording& recording) {
  const bool angles = recording.channels.front().component == Component::kAngle;
  Json json = {{"kind", angles ? "angles" : "markers"}, {"time", numbers(recording.time)}};
  json["points"] = Json::array();
  for (const PointSpec& point : recording.points) {
    Json entry = {{"name", point.name}};
    if (angles)
      entry["link"] = point.link;
    else
      entry["arc"] = arc_of(problem, point);
    json["points"].push_back(entry);
  }
  put_values(json, recording, recording.measured);
  return json;
}

const Gap* find(const std::vector<Gap>& gaps, int experiment, Part part) {
  for (const Gap& gap : gaps)
    if (gap.experiment == experiment && gap.part == part) return &gap;
  return nullptr;
}

Json gap_json(const std::vector<Gap>& gaps, int experiment, const char* unit) {
  const auto rms = [&](Part part) {
    const Gap* gap = find(gaps, experiment, part);
    return gap ? number(gap->rms) : Json(nullptr);
  };
  return {{"fit", rms(Part::kFit)}, {"validate", rms(Part::kValidation)}, {"unit", unit}};
}

Json experiments_json(const Problem& problem, const Eigen::VectorXd& x, const Evaluation* before,
                      const Evaluation& after, const std::vector<Motion>& motions) {
  const std::vector<Gap> gaps = gaps_of(problem, after);
  const std::vector<Gap> gaps_before = before ? gaps_of(problem, *before) : std::vector<Gap>{};
  Json out = Json::array();
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    const bool angles = experiment.spec.kind == DataKind::kAngles;
    const char* unit = angles ? "rad" : "m";
    Json json = {{"name", experiment.spec.name}, {"use", experiment.fitted() ? "fit" : "validate"}};
    const auto fitted = static_cast<std::size_t>(experiment.recording.fit_frames);
    if (fitted > 0 && fitted < experiment.recording.time.size())
      json["fit_until"] = experiment.recording.time[fitted - 1];
    json.update(motion_json(problem, motions[e]));
    if (problem.model().table().observes) {
      const SeenChain seen = seen_chain(problem, x, static_cast<int>(e));
      json["seen"] = {
          {"time", numbers(seen.time)}, {"side", rows(seen.side)}, {"down", rows(seen.down)}};
    }
    json["measured"] = measured_json(problem, experiment.recording);
    put_values(json["predicted"], experiment.recording, after.predictions[e].simulated);
    json["gap"] = gap_json(gaps, static_cast<int>(e), unit);
    if (before) json["gap_before"] = gap_json(gaps_before, static_cast<int>(e), unit);
    json["warnings"] = experiment.recording.warnings;
    out.push_back(json);
  }
  return out;
}

/// The chosen measure of the fitted part, and the mean absolute difference of every channel.
Json measure_json(const Problem& problem, const Evaluation& evaluation) {
  const Residuals residuals = residuals_of(problem, evaluation, Part::kFit);
  Json parts = Json::array();
  for (std::size_t e = 0; e < problem.experiments().size(); ++e) {
    const Recording& recording = problem.experiments()[e].recording;
    std::vector<double> sum(recording.channels.size(), 0), count(recording.channels.size(), 0);
    for (std::size_t i = 0; i < residuals.index.size(); ++i) {
      if (residuals.index[i].experiment != static_cast<int>(e)) continue;
      const auto c = static_cast<std::size_t>(residuals.index[i].channel);
      sum[c] += std::abs(residuals.value[static_cast<Eigen::Index>(i)]);
      ++count[c];
    }
    for (std::size_t c = 0; c < sum.size(); ++c)
      if (count[c] > 0)
        parts.push_back(
            {{"name", (problem.experiments().size() > 1 ? problem.experiments()[e].spec.name + ": "
                                                        : std::string()) +
                          recording.channels[c].name},
             {"value", sum[c] / count[c]}});
  }
  bool noise_given = false, angles = false;
  for (const Experiment& experiment : problem.experiments()) {
    noise_given |= !std::isnan(experiment.spec.noise);
    angles |= experiment.spec.kind == DataKind::kAngles;
  }
  const Measure measure = problem.the_case().error.measure;
  const bool in_noise = noise_given && measure == Measure::kLeastSquares;
  return {{"name", kMeasureWords[static_cast<std::size_t>(measure)]},
          {"unit", in_noise ? "1"
                   : angles ? "rad"
                            : "m"},
          {"value", number(error_of(problem, evaluation, Part::kFit))},
          {"validation", residuals_of(problem, evaluation, Part::kValidation).value.size()
                             ? number(error_of(problem, evaluation, Part::kValidation))
                             : Json(nullptr)},
          {"parts", parts}};
}

Json unknown_json(const Unknown& unknown, const std::string& sets, double value) {
  static const char* const kGroups[] = {"physics", "initial", "sensor"};
  return {{"name", unknown.name},
          {"sets", sets},
          {"unit", unknown.unit},
          {"free", true},
          {"group", kGroups[static_cast<int>(unknown.group)]},
          {"scale", kScaleWords[static_cast<std::size_t>(unknown.scale)]},
          {"value", number(value)},
          {"start", number(unknown.start)},
          {"lower", number(unknown.lower)},
          {"upper", number(unknown.upper)}};
}

Json parameters_json(const Problem& problem, const Eigen::VectorXd& x) {
  const Case& the_case = problem.the_case();
  Json out = Json::array();
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    const std::string sets =
        unknown.parameter >= 0
            ? the_case.parameters[static_cast<std::size_t>(unknown.parameter)].sets
            : "initial";
    out.push_back(unknown_json(unknown, sets, x[static_cast<Eigen::Index>(j)]));
  }
  for (const ParameterSpec& parameter : the_case.parameters)
    if (!parameter.free)
      out.push_back({{"name", parameter.name},
                     {"sets", parameter.sets},
                     {"unit", parameter.unit},
                     {"free", false},
                     {"value", number(parameter.value)},
                     {"verdict", "fixed"}});
  return out;
}

void put_uncertainty(Json& json, const Problem& problem, const Identification& found) {
  const Uncertainty& uncertainty = *found.uncertainty;
  Json& parameters = json["parameters"];
  for (std::size_t j = 0; j < uncertainty.estimates.size(); ++j) {
    const Estimate& estimate = uncertainty.estimates[j];
    parameters[j]["standard_error"] = number(estimate.standard_error);
    parameters[j]["interval"] = {number(estimate.lower), number(estimate.upper)};
    parameters[j]["verdict"] = name_of(estimate.verdict);
  }
  if (found.bootstrap.rows() > 0)
    for (Eigen::Index j = 0; j < found.bootstrap.cols(); ++j) {
      Eigen::VectorXd column = found.bootstrap.col(j);
      std::sort(column.begin(), column.end());
      const auto at = [&](double share) {
        return column[static_cast<Eigen::Index>(share * static_cast<double>(column.size() - 1) +
                                                0.5)];
      };
      parameters[static_cast<std::size_t>(j)]["bootstrap_interval"] = {at(0.025), at(0.975)};
    }
  json["correlation"] = rows(uncertainty.correlation);
  Json& noise = json["residuals"];
  noise = {{"deviation", number(uncertainty.noise)},
           {"lag_one_correlation", number(uncertainty.autocorrelation)},
           {"coloured", uncertainty.autocorrelated},
           {"singular_values", numbers(uncertainty.singular_values)}};
  noise["channels"] = Json::array();
  const Residuals residuals = residuals_of(problem, found.after, Part::kFit);
  for (const ChannelNoise& channel : channels_of(problem, residuals)) {
    const Estimate estimate = noise_estimate(channel, uncertainty);
    noise["channels"].push_back({{"name", channel.name},
                                 {"noise", number(channel.deviation)},
                                 {"interval", {number(estimate.lower), number(estimate.upper)}}});
  }
  noise["weak_directions"] = Json::array();
  for (const WeakDirection& weak : uncertainty.weak)
    noise["weak_directions"].push_back(
        {{"deviation", number(weak.deviation)}, {"direction", weak.text}});
  json["profiles"] = Json::array();
  for (const Profile& profile : found.profiles)
    json["profiles"].push_back(
        {{"parameter", problem.unknowns()[static_cast<std::size_t>(profile.unknown)].name},
         {"value", numbers(profile.value)},
         {"cost", numbers(profile.cost)},
         {"threshold", profile.threshold},
         {"verdict", name_of(profile.verdict)}});
}

Json starts_json(const std::vector<FitResult>& starts) {
  Json out = Json::array();
  for (const FitResult& start : starts)
    out.push_back(
        {{"error", number(start.error)},
         {"status", name_of(start.status)},
         {"start", start.history.empty() ? Json::array() : numbers(start.history.front().x)},
         {"start_error", number(start.start_error)},
         {"evaluations", start.evaluations},
         {"parameters", numbers(start.x)}});
  return out;
}

Json optimiser_json(const Problem& problem, const FitResult& fit) {
  const OptimiserSpec& spec = problem.the_case().optimiser;
  Json history;
  Json step = Json::array(), error = Json::array();
  std::vector<Json> parameters(problem.unknowns().size(), Json::array());
  for (std::size_t k = 0; k < fit.history.size(); ++k) {
    step.push_back(k + 1);
    error.push_back(number(fit.history[k].error));
    for (std::size_t j = 0; j < parameters.size(); ++j)
      parameters[j].push_back(number(fit.history[k].x[static_cast<Eigen::Index>(j)]));
  }
  history["step"] = step;
  history["error"] = error;
  history["parameters"] = parameters;
  Json failed = Json::array();
  for (const Failure& failure : fit.failed)
    failed.push_back({{"parameters", numbers(failure.x)}, {"message", failure.message}});
  return {{"method", kMethodWords[static_cast<std::size_t>(spec.method)]},
          {"strategy", strategy_of(problem)},
          {"status", name_of(fit.status)},
          {"message", fit.message},
          {"evaluations", fit.evaluations},
          {"simulations_worth", fit.work},
          {"failures", fit.failures},
          {"failed", failed},
          {"seed", spec.seed},
          {"start_error", number(fit.start_error)},
          {"error", number(fit.error)},
          {"history", history}};
}

std::string text(const Json& json) { return json.dump(1) + "\n"; }

}  // namespace

std::string simulation_result_text(const Problem& problem, const Motion& motion) {
  Json json = head(problem, "simulate");
  Json experiment = {{"name", "simulation"}};
  experiment.update(motion_json(problem, motion));
  json["experiments"] = Json::array({experiment});
  json["parameters"] = parameters_json(problem, problem.start());
  return text(json);
}

std::string comparison_result_text(const Problem& problem, const Eigen::VectorXd& x,
                                   const Evaluation& evaluation,
                                   const std::vector<Motion>& motions) {
  Json json = head(problem, "simulate");
  json["experiments"] = experiments_json(problem, x, nullptr, evaluation, motions);
  json["measure"] = measure_json(problem, evaluation);
  json["parameters"] = parameters_json(problem, x);
  return text(json);
}

std::string links_study_result_text(const Case& the_case, const std::vector<LinksResult>& results) {
  Json json = {
      {"format", 1}, {"kind", "result"}, {"command", "identify"}, {"title", the_case.title}};
  json["links_study"] = Json::array();
  for (const LinksResult& result : results) {
    Json parameters;
    for (std::size_t j = 0; j < result.names.size(); ++j)
      parameters[result.names[j]] = number(result.fit.x[static_cast<Eigen::Index>(j)]);
    json["links_study"].push_back({{"links", result.links},
                                   {"status", name_of(result.fit.status)},
                                   {"error", number(result.fit.error)},
                                   {"validation_error", number(result.validation_error)},
                                   {"evaluations", result.fit.evaluations},
                                   {"parameters", parameters}});
  }
  return text(json);
}

std::string identification_result_text(const Problem& problem, const Identification& found) {
  Json json = head(problem, "identify");
  json["status"] =
      found.fit.status == FitStatus::kConverged ? "success" : name_of(found.fit.status);
  json["message"] = found.fit.message;
  json["experiments"] =
      experiments_json(problem, found.fit.x, &found.before, found.after, found.motions);
  json["measure"] = measure_json(problem, found.after);
  json["parameters"] = parameters_json(problem, found.fit.x);
  json["optimiser"] = optimiser_json(problem, found.fit);
  if (found.starts.size() > 1) json["starts"] = starts_json(found.starts);
  if (found.uncertainty) put_uncertainty(json, problem, found);
  return text(json);
}

}  // namespace catena
