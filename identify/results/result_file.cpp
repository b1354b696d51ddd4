// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/result_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "common/input_error.hpp"
#include "identify/report/readable.hpp"

namespace catena::report {
namespace {

using nlohmann::json;

/// A place in the file: its value and the way to it, for messages.
class Node {
 public:
  Node(const json& value, std::string where) : value_(&value), where_(std::move(where)) {}

  [[noreturn]] void fail(const std::string& rule) const {
    std::string text = value_->dump();
    if (text.size() > 60) text = text.substr(0, 57) + "...";
    throw InputError(fmt::format("{} is {}; {}", where_, text, rule));
  }

  bool has(const std::string& key) const {
    return value_->is_object() && value_->contains(key) && !value_->at(key).is_null();
  }

  Node operator[](const std::string& key) const {
    if (!value_->is_object()) fail("it must be a table of keys and values");
    static const json kNull;
    const auto found = value_->find(key);
    return {found == value_->end() ? kNull : *found, fmt::format("{}.{}", where_, key)};
  }

  std::vector<Node> list() const {
    if (value_->is_null()) return {};
    if (!value_->is_array()) fail("it must be a list");
    std::vector<Node> nodes;
    for (std::size_t k = 0; k < value_->size(); ++k) {
      nodes.emplace_back((*value_)[k], fmt::format("{}[{}]", where_, k));
    }
    return nodes;
  }

  std::vector<std::pair<std::string, Node>> entries() const {
    if (value_->is_null()) return {};
    if (!value_->is_object()) fail("it must be a table of keys and values");
    std::vector<std::pair<std::string, Node>> nodes;
    for (const auto& [key, value] : value_->items()) {
      nodes.emplace_back(key, Node(value, fmt::format("{}.{}", where_, key)));
    }
    return nodes;
  }

  double number(double otherwise = kAbsent) const {
    if (value_->is_null()) return otherwise;
    if (!value_->is_number()) fail("it must be a number or null");
    return value_->get<double>();
  }

  std::string text() const {
    if (value_->is_null()) return "";
    if (!value_->is_string()) fail("it must be text");
    return value_->get<std::string>();
  }

  bool flag(bool otherwise) const {
    if (value_->is_null()) return otherwise;
    if (!value_->is_boolean()) fail("it must be true or false");
    return value_->get<bool>();
  }

  int count() const {
    if (value_->is_null()) return 0;
    if (!value_->is_number_integer()) fail("it must be a whole number");
    return value_->get<int>();
  }

  Row row() const {
    if (value_->is_null()) return {};
    if (!value_->is_array()) fail("it must be a list of numbers");
    Row numbers;
    numbers.reserve(value_->size());
    for (const json& value : *value_) {
      if (!value.is_number() && !value.is_null()) fail("it must hold numbers or null only");
      numbers.push_back(value.is_null() ? kAbsent : value.get<double>());
    }
    return numbers;
  }

  /// Rows of `columns` numbers each.
  Rows rows(std::size_t columns) const {
    Rows all;
    for (const Node& node : list()) {
      all.push_back(node.row());
      if (all.back().size() != columns) {
        node.fail(fmt::format("it has {} entries where {} are due", all.back().size(), columns));
      }
    }
    return all;
  }

  /// Whatever is there, in words.
  std::string words() const {
    if (value_->is_string()) return value_->get<std::string>();
    if (value_->is_number_float()) return for_people(value_->get<double>(), 5);
    return value_->dump();
  }

  bool is_object() const { return value_->is_object(); }
  bool is_text() const { return value_->is_string(); }
  const json& value() const { return *value_; }
  const std::string& where() const { return where_; }

 private:
  const json* value_;
  std::string where_;
};

Named words_of(const Node& node) {
  Named named;
  for (const auto& [key, value] : node.entries()) {
    if (value.value().is_primitive() && !value.value().is_null())
      named.emplace_back(key, value.words());
  }
  return named;
}

void read_positions(const Node& node, Channels& channels) {
  channels.side = node["side"].rows(channels.time.size());
  channels.down = node["down"].rows(channels.time.size());
  channels.angle = node["angle"].rows(channels.time.size());
  if (channels.side.size() != channels.down.size()) {
    node["down"].fail(fmt::format("it has {} rows where side has {}", channels.down.size(),
                                  channels.side.size()));
  }
}

Measured read_measured(const Node& node, const Node& predicted) {
  Measured measured;
  for (const Node& point : node["points"].list()) {
    measured.points.push_back({point["name"].text(), point["arc"].number()});
  }
  measured.values.time = node["time"].row();
  measured.predicted.time = measured.values.time;
  read_positions(node, measured.values);
  read_positions(predicted, measured.predicted);
  const bool angles = measured.values.side.empty();
  const auto due = measured.points.size();
  for (const auto& [rows, key] :
       {std::pair(angles ? &measured.values.angle : &measured.values.side, "measured"),
        std::pair(angles ? &measured.predicted.angle : &measured.predicted.side, "predicted")}) {
    if (rows->size() != due && !(rows->empty() && std::string(key) == "predicted")) {
      node.fail(fmt::format("{} has {} rows for {} points", key, rows->size(), due));
    }
  }
  return measured;
}

Gap read_gap(const Node& node) {
  if (!node.is_object()) return {};
  return {node["fit"].number(), node["validate"].number(), node["floor"].number(),
          node["unit"].text()};
}

Experiment read_experiment(const Node& node) {
  Experiment experiment;
  experiment.name = node["name"].text();
  experiment.use = node["use"].text();
  experiment.fit_until = node["fit_until"].number();
  if (node.has("trajectory")) {
    experiment.trajectory.time = node["trajectory"]["time"].row();
    read_positions(node["trajectory"], experiment.trajectory);
  }
  if (node.has("seen")) {
    experiment.seen.time = node["seen"]["time"].row();
    read_positions(node["seen"], experiment.seen);
  }
  if (node.has("measured")) {
    static const json kNothing = json::object();
    const Node predicted = node.has("predicted") ? node["predicted"] : Node(kNothing, "predicted");
    experiment.measured = read_measured(node["measured"], predicted);
  }
  experiment.error = node["error"].number();
  experiment.gap = read_gap(node["gap"]);
  experiment.gap_before = read_gap(node["gap_before"]);
  for (const Node& words : node["warnings"].list()) experiment.warnings.push_back(words.text());
  if (node.has("energy")) {
    const Node energy = node["energy"];
    experiment.energy_time = energy["time"].row();
    for (const Node& item : energy["items"].list()) {
      experiment.energy.push_back({item["name"].text(), item["kind"].text(), item["value"].row()});
      if (experiment.energy.back().value.size() != experiment.energy_time.size()) {
        item["value"].fail("it must have one number per time of the energy");
      }
    }
    experiment.energy_imbalance = energy["imbalance"].number();
  }
  experiment.statistics = words_of(node["statistics"]);
  return experiment;
}

Parameter read_parameter(const Node& node) {
  Parameter parameter;
  parameter.name = node["name"].text();
  parameter.sets = node["sets"].text();
  parameter.unit = node["unit"].text();
  parameter.verdict = node["verdict"].text();
  parameter.note = node["note"].text();
  parameter.free = node["free"].flag(false);
  parameter.value = node["value"].number();
  parameter.start = node["start"].number();
  parameter.lower = node["lower"].number();
  parameter.upper = node["upper"].number();
  parameter.standard_error = node["standard_error"].number();
  if (node.has("interval")) {
    const Row ends = node["interval"].row();
    if (ends.size() != 2) node["interval"].fail("it must have two ends");
    parameter.has_interval = true;
    parameter.low = std::isnan(ends[0]) ? -std::numeric_limits<double>::infinity() : ends[0];
    parameter.high = std::isnan(ends[1]) ? std::numeric_limits<double>::infinity() : ends[1];
  }
  return parameter;
}

void read_fit(const Node& node, Result& result) {
  for (const Node& parameter : node["parameters"].list()) {
    result.parameters.push_back(read_parameter(parameter));
  }
  const auto correlations = node["correlation"].list();
  result.correlation = node["correlation"].rows(correlations.size());
  if (node.has("optimiser")) {
    result.optimiser = words_of(node["optimiser"]);
    if (node["optimiser"].has("history")) {
      const Node history = node["optimiser"]["history"];
      result.history_error = history["error"].row();
      result.history_step = history["step"].row();
      if (result.history_step.size() != result.history_error.size()) {
        history["step"].fail("it must have one number per error");
      }
      result.history_parameters = history["parameters"].rows(result.history_step.size());
    }
  }
  for (const Node& start : node["starts"].list()) {
    result.starts.push_back({start["error"].number(), start["status"].text()});
  }
  for (const Node& profile : node["profiles"].list()) {
    result.profiles.push_back({profile["parameter"].text(), profile["verdict"].text(),
                               profile["value"].row(), profile["cost"].row(),
                               profile["threshold"].number()});
    if (result.profiles.back().value.size() != result.profiles.back().cost.size()) {
      profile["cost"].fail("it must have one number per value");
    }
  }
  for (const Node& row : node["links_study"].list()) {
    result.links_study.push_back({row["links"].count(), row["error"].number(), row["gap"].number(),
                                  row["seconds"].number()});
  }
}

/// Texts under a key: a list, one, or none.
std::vector<std::string> read_texts(const Node& node) {
  if (node.is_text()) return {node.text()};
  std::vector<std::string> texts;
  for (const Node& one : node.list()) texts.push_back(one.text());
  return texts;
}

/// MathML and LaTeX of the same formulas, either of which may be missing: under "formulas", one by
/// one or as two lists, or as two lists of the node itself.
std::vector<Equation> read_formulas(const Node& node) {
  if (node.has("formulas")) {
    if (node["formulas"].is_object()) return read_formulas(node["formulas"]);
    std::vector<Equation> formulas;
    for (const Node& formula : node["formulas"].list()) {
      formulas.push_back(
          {formula["what"].text(), formula["mathml"].text(), formula["latex"].text()});
    }
    return formulas;
  }
  const auto mathml = read_texts(node["mathml"]);
  const auto latex = read_texts(node["latex"]);
  std::vector<Equation> formulas(std::max(mathml.size(), latex.size()));
  for (std::size_t k = 0; k < mathml.size(); ++k) formulas[k].mathml = mathml[k];
  for (std::size_t k = 0; k < latex.size(); ++k) formulas[k].latex = latex[k];
  return formulas;
}

Equation read_equation(const Node& node) {
  return {node["title"].text(), node["mathml"].text(), node["latex"].text()};
}

Result read_result(const Node& node) {
  Result result;
  result.command = node["command"].text();
  result.title = node["title"].text();
  result.status = node["status"].text();
  result.message = node["message"].text();
  result.versions = words_of(node["versions"]);
  if (node.has("case")) {
    result.case_file = node["case"]["file"].text();
    result.case_text = node["case"]["text"].text();
  }
  if (node.has("model")) {
    const Node model = node["model"];
    result.model_id = model["id"].text();
    result.description_hash = model["description_hash"].text();
    result.description = model["description"].text();
    result.links = model["links"].count();
    result.load_mass = model["load_mass"].number();
    if (model.has("derived")) {
      result.derived_links = model["derived"]["links"].count();
      for (const Node& equation : model["derived"]["equations"].list()) {
        result.derived.push_back(read_equation(equation));
      }
    }
    for (const Node& effect : model["effects"].list()) {
      result.effects.push_back({effect["id"].text(), effect["title"].text(), effect["text"].text(),
                                read_formulas(effect)});
    }
  }
  for (const Node& experiment : node["experiments"].list()) {
    result.experiments.push_back(read_experiment(experiment));
  }
  if (node.has("measure")) {
    const Node measure = node["measure"];
    result.measure = measure["name"].text();
    result.measure_unit = measure["unit"].text();
    result.measure_value = measure["value"].number();
    result.measure_validation = measure["validation"].number();
    for (const Node& part : measure["parts"].list()) {
      result.measure_parts.emplace_back(part["name"].text(), part["value"].number());
    }
  }
  read_fit(node, result);
  return result;
}

Candidate read_candidate(const Node& node) {
  Candidate candidate;
  candidate.id = node["id"].text();
  candidate.title = node["title"].text();
  candidate.note = node["note"].text();
  candidate.admissible = node["admissible"].flag(true);
  candidate.score = node["score"].number();
  candidate.significance = node["significance"].number();
  candidate.survives = node["survives"].number();
  const bool refitted = node.has("refit") && node["refit"].has("estimate");
  const Node estimate = refitted ? node["refit"]["estimate"] : node["estimate"];
  for (const auto& [name, value] : estimate.entries()) {
    candidate.estimate.emplace_back(name, value.number());
  }
  if (node.has("refit")) {
    candidate.refit_fit = node["refit"]["fit"].number();
    candidate.refit_validate = node["refit"]["validate"].number();
    candidate.criterion = node["refit"]["criterion"].number();
    candidate.log10_p = node["refit"]["log10_p"].number();
  }
  candidate.formulas = read_formulas(node);
  return candidate;
}

json parse(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) {
    throw InputError(
        fmt::format("{}: cannot be opened; give a result.json, diagnosis.json or links_study.json, "
                    "or its folder",
                    file.string()));
  }
  try {
    return json::parse(stream);
  } catch (const json::parse_error& error) {
    throw InputError(fmt::format("{}: not JSON, at byte {}; was it written by catena and whole?",
                                 file.string(), error.byte));
  }
}

void check_format(const Node& node) {
  if (!node.is_object()) node.fail("it must be a result or a diagnosis written by catena");
  const std::string kind = node["kind"].is_text() ? node["kind"].text() : "";
  if (kind != "result" && kind != "diagnosis") {
    node["kind"].fail("it must be \"result\" or \"diagnosis\"");
  }
  if (node["format"].count() != 1) node["format"].fail("this program reads format 1");
}

Round read_round(const Node& node, const std::filesystem::path& folder) {
  Round round;
  round.model = node["model"].text();
  round.added = node["added"].text();
  round.removed = node["removed"].text();
  round.links = node["links"].count();
  round.gap = read_gap(node["gap"]);
  if (node.has("finer_chain")) {
    const Node finer = node["finer_chain"];
    round.finer_chain = {finer["links"].count(), finer["predicted_change"].number(),
                         finer["refitted"].flag(false), finer["taken"].flag(false),
                         finer["note"].text()};
  }
  for (const Node& candidate : node["candidates"].list()) {
    round.candidates.push_back(read_candidate(candidate));
  }
  const Node result = node["result"];
  if (result.is_object()) {
    round.result = std::make_shared<Result>(read_result(result));
  } else if (result.is_text()) {
    const std::filesystem::path file = folder / result.text();
    const json value = parse(file);
    const Node root(value, file.string() + ": result");
    check_format(root);
    round.result = std::make_shared<Result>(read_result(root));
  }
  return round;
}

std::vector<OtherEffect> read_others(const Node& node) {
  std::vector<OtherEffect> others;
  for (const Node& entry : node.list()) {
    OtherEffect other{entry["id"].text(),
                      entry["instead_of"].text(),
                      entry["fit"].number(),
                      entry["validate"].number(),
                      entry["difference"].number(),
                      "",
                      kAbsent};
    if (entry.has("experiment_that_tells")) {
      other.experiment_that_tells = entry["experiment_that_tells"]["words"].text();
      other.difference_there = entry["experiment_that_tells"]["difference"].number();
    }
    others.push_back(std::move(other));
  }
  return others;
}

Diagnosis read_diagnosis(const Node& node, const std::filesystem::path& folder) {
  Diagnosis diagnosis;
  diagnosis.verdict = node["verdict"].text();
  diagnosis.sentence = node["sentence"].text();
  diagnosis.experiment_that_tells = node["experiment_that_tells"].text();
  diagnosis.floor = node["floor"].number();
  diagnosis.unit = node["unit"].text();
  for (const Node& words : node["where"].list()) diagnosis.where.push_back(words.text());
  for (const Node& words : node["notes"].list()) diagnosis.notes.push_back(words.text());
  for (const Node& member : node["members"].list()) diagnosis.members.push_back(member.text());
  if (node.has("links")) {
    diagnosis.links_given = node["links"]["given"].count();
    diagnosis.links_used = node["links"]["used"].count();
  }
  diagnosis.equality_at_neutral = node["equality_at_neutral"].number();
  for (const Node& effect : node["effects"].list()) {
    diagnosis.effects.push_back(
        {effect["id"].text(), effect["title"].text(), "", read_formulas(effect)});
  }
  diagnosis.undecided = read_others(node["undecided"]);
  diagnosis.forms = read_others(node["forms"]);
  diagnosis.runners_up = read_others(node["runners_up"]);
  if (node.has("missing_force")) {
    const Node force = node["missing_force"];
    MissingForce missing;
    missing.unit = force["unit"].text();
    for (const Node& words : force["words"].list()) missing.words.push_back(words.text());
    missing.time = force["time"].row();
    for (const Node& row : force["rows"].list()) missing.rows.push_back(row.text());
    missing.value = force["value"].rows(missing.time.size());
    if (missing.value.size() != missing.rows.size()) {
      force["value"].fail("it must have one row of numbers per name in rows");
    }
    diagnosis.missing_force = std::move(missing);
  }
  for (const Node& round : node["rounds"].list()) {
    diagnosis.rounds.push_back(read_round(round, folder));
  }
  return diagnosis;
}

/// The diagnosis has the errors of the estimates, the last round's result the rest.
void use_estimates(const std::vector<Parameter>& estimates, std::vector<Parameter>& parameters) {
  for (const Parameter& estimate : estimates) {
    auto same = std::find_if(parameters.begin(), parameters.end(),
                             [&](const Parameter& p) { return p.name == estimate.name; });
    if (same == parameters.end()) same = parameters.insert(parameters.end(), estimate);
    same->free = true;
    same->value = estimate.value;
    same->standard_error = estimate.standard_error;
    same->has_interval = estimate.has_interval;
    same->low = estimate.low;
    same->high = estimate.high;
  }
}

}  // namespace

Document read_document(const std::filesystem::path& path) {
  std::filesystem::path file = path;
  if (std::filesystem::is_directory(path)) {
    file = path / "result.json";
    for (const char* name : {"links_study.json", "result.json", "diagnosis.json"}) {
      if (std::filesystem::exists(path / name)) file = path / name;
    }
  }
  const json value = parse(file);
  const Node root(value, fmt::format("{}: result", file.string()));
  check_format(root);
  Document document;
  if (root["kind"].text() == "result") {
    document.result = read_result(root);
    return document;
  }
  document.diagnosis = read_diagnosis(root, file.parent_path());
  for (const Round& round : document.diagnosis->rounds) {
    if (round.result) document.result = *round.result;
  }
  const Result outer = read_result(root);  // title, case, versions, parameters with intervals
  document.result.command = "diagnose";
  if (!outer.title.empty()) document.result.title = outer.title;
  if (!outer.versions.empty()) document.result.versions = outer.versions;
  if (!outer.case_text.empty()) {
    document.result.case_text = outer.case_text;
    document.result.case_file = outer.case_file;
  }
  if (document.result.effects.empty()) document.result.effects = document.diagnosis->effects;
  use_estimates(outer.parameters, document.result.parameters);
  return document;
}

}  // namespace catena::report
