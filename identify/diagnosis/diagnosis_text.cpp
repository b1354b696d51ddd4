// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/sha256.hpp"
#include "description/formula.hpp"
#include "identify/results/result_writer.hpp"

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

bool of_angles(const Diagnosis& d) {
  const auto& experiments = d.final.problem->the_case().experiments;
  return std::all_of(experiments.begin(), experiments.end(), [](const ExperimentSpec& experiment) {
    return experiment.kind == DataKind::kAngles;
  });
}

std::string unit_of(const Diagnosis& d) { return of_angles(d) ? "rad" : "m"; }
std::string milli_unit_of(const Diagnosis& d) { return of_angles(d) ? "mrad" : "mm"; }

std::string model_name(const Stage& stage) {
  std::string name = stage.effects.empty() ? "the case's model" : "with";
  for (std::size_t i = 0; i < stage.effects.size(); ++i)
    name += (i ? ", " : " ") + stage.effects[i];
  return name + fmt::format(", {} links", stage.links);
}

Json gap_json(const GapTest& fit, const GapTest& held_out, const std::string& unit) {
  Json gap = {{"fit", number(fit.rms)},
              {"validate", held_out.count > 0 ? number(held_out.rms) : Json(nullptr)},
              {"unit", unit},
              {"floor", number(fit.floor)},
              {"misfit", number(fit.misfit)},
              {"present", fit.present},
              {"colour", number(fit.colour)},
              {"size", number(fit.size)}};
  return gap;
}

Json candidate_json(const Explanation& explanation, const Workshop& workshop, int tried) {
  Json json = {
      {"id", explanation.id},
      {"title", explanation.title},
      {"kind", explanation.candidate < 0 ? "rival" : "effect"},
      {"score", number(explanation.score.share)},
      {"survives", number(explanation.score.survives)},
      {"admissible", explanation.score.admissible},
      {"significance",
       number(std::pow(10, std::min(0.0, explanation.log10_p + std::log10(std::max(1, tried)))))},
      {"note", explanation.note}};
  Json& estimate = json["estimate"] = Json::object();
  for (const auto& [name, value] : explanation.start) estimate[name] = number(value);
  if (explanation.refitted) {
    Json& refit = json["refit"];
    refit = {{"fit", number(explanation.fit.rms)},
             {"validate",
              explanation.held_out.count > 0 ? number(explanation.held_out.rms) : Json(nullptr)},
             {"criterion", number(explanation.comparison.criterion)},
             {"log10_p", number(explanation.comparison.log10_p + std::log10(std::max(1, tried)))},
             {"misfit_share", number(explanation.comparison.misfit_share)},
             {"colour", number(explanation.comparison.colour)}};
    Json& found = refit["estimate"] = Json::object();
    const Problem& problem = *explanation.model.problem;
    for (std::size_t j = 0; j < problem.unknowns().size(); ++j)
      if (problem.unknowns()[j].name.starts_with(explanation.id + "."))
        found[problem.unknowns()[j].name] =
            number(explanation.model.x[static_cast<Eigen::Index>(j)]);
  }
  if (explanation.candidate >= 0) {
    Json latex = Json::array(), mathml = Json::array();
    for (const Formula& formula :
         formulas(workshop.library()[static_cast<std::size_t>(explanation.candidate)].effect)) {
      latex.push_back(formula.latex);
      mathml.push_back(formula.mathml);
    }
    json["formulas"] = {{"latex", latex}, {"mathml", mathml}};
  }
  return json;
}

}  // namespace

DiagnosisFindings find_out(const Diagnosis& d) {
  DiagnosisFindings findings;
  findings.places = residual_places(d.stages.front().model, d.floors);
  if (d.stages.front().fit.present)
    findings.force = missing_force(
        d.verdict == DiagnosisVerdict::kUnexplained ? d.final : d.stages.front().model, d.floors);
  for (const Alternative& alternative : d.alternatives)
    findings.telling.push_back(
        telling_experiment(d.final, alternative.explanation.model, d.floors));
  return findings;
}

std::string diagnosis_table(const Diagnosis& d, const DiagnosisFindings& findings) {
  const std::string unit = milli_unit_of(d);
  std::string text = fmt::format("verdict: {}\n{}\n\n", name_of(d.verdict), d.sentence);
  text += fmt::format("{:44} {:>12} {:>12} {:>10}\n", "gap (RMS, " + unit + ")", "fitted",
                      "held out", "/ noise");
  const auto row = [&](const std::string& name, const GapTest& fit, const GapTest& held) {
    text += fmt::format("{:44} {:>12.4g} {:>12} {:>10.3g}\n", name, 1e3 * fit.rms,
                        held.count > 0 ? fmt::format("{:.4g}", 1e3 * held.rms) : std::string("-"),
                        fit.ratio());
  };
  for (const Stage& stage : d.stages) {
    std::string change =
        stage.added.empty() && stage.removed.empty() ? "baseline"
        : stage.removed == kTooFewLinks ? fmt::format("{} links after all", stage.links)
        : stage.added.empty()           ? "without " + stage.removed
        : stage.added == kTooFewLinks   ? fmt::format("{} links instead", stage.links)
        : stage.removed.empty()         ? "+ " + stage.added
                                        : "+ " + stage.added + " for " + stage.removed;
    row(change, stage.fit, stage.held_out);
  }
  if (!d.effects.empty())
    row("the new model, compiled and refitted", d.final_fit, d.final_held_out);
  text += fmt::format("{:44} {:>12.4g}\n", "noise", 1e3 * d.final_fit.floor);
  if (d.noise.size() == 1 && d.noise.front().coloured)
    text += "  the residuals are smoother than white noise: this floor says little\n";
  for (const std::string& note : d.notes) text += "  note: " + note + "\n";

  if (d.stages.front().fit.present && !findings.places.words.empty()) {
    text += "\nwhere: ";
    for (std::size_t i = 0; i < findings.places.words.size(); ++i)
      text += (i ? ", " : "") + findings.places.words[i];
    text += "\n";
    for (const std::string& words : findings.force.words) text += "  " + words + "\n";
  }
  text += fmt::format("\n{:34} {:>14} {:>26}  {}\n", "parameter", "value", "95 % interval", "unit");
  for (const FinalParameter& parameter : d.parameters) {
    const double half = 1.96 * parameter.standard_error;
    text += fmt::format(
        "{:34} {:>14.6g} {:>26}  {}\n", parameter.name, parameter.value,
        std::isfinite(half)
            ? fmt::format("{:.5g} to {:.5g}", parameter.value - half, parameter.value + half)
            : std::string("undetermined"),
        parameter.unit);
  }
  if (!d.effects.empty())
    text +=
        fmt::format("at the neutral values the new model equals the old one to {:.1g} (relative)\n",
                    d.equality);
  const auto rival = [&](const char* what, const Alternative& alternative) {
    text += fmt::format("  {} {}: {:.4g} {} fitted, predictions {:.2g} times the noise apart\n",
                        what, alternative.explanation.id, 1e3 * alternative.explanation.fit.rms,
                        unit, alternative.decision.difference);
  };
  if (!d.alternatives.empty() || !d.forms.empty() || !d.runners_up.empty()) text += "\n";
  for (std::size_t i = 0; i < d.alternatives.size(); ++i) {
    rival("undecided:", d.alternatives[i]);
    if (i < findings.telling.size() && !findings.telling[i].words.empty())
      text +=
          fmt::format("    to tell them apart: {}; they differ by {:.3g} times the noise there\n",
                      findings.telling[i].words, findings.telling[i].difference);
  }
  for (const Alternative& alternative : d.forms) rival("form:", alternative);
  for (const Alternative& alternative : d.runners_up) rival("runner-up:", alternative);
  text += fmt::format("\n{} candidates, {:.1f} s\n", d.tried, d.seconds);
  return text;
}

std::vector<std::pair<std::string, std::string>> diagnosis_files(const Diagnosis& d,
                                                                 const DiagnosisFindings& findings,
                                                                 const Workshop& workshop) {
  std::vector<std::pair<std::string, std::string>> files;
  const std::string unit = unit_of(d);
  const Case& the_case = d.stages.front().model.problem->the_case();
  Json json;
  json["format"] = 1;
  json["kind"] = "diagnosis";
  json["title"] = the_case.title;
  json["versions"] = {{"catena", CATENA_VERSION}};
  std::ifstream in(the_case.file, std::ios::binary);
  std::ostringstream case_text;
  case_text << in.rdbuf();
  json["case"] = {{"file", the_case.file.filename().string()},
                  {"text", case_text.str()},
                  {"sha256", sha256_hex(case_text.str())}};
  json["verdict"] = name_of(d.verdict);
  json["sentence"] = d.sentence;
  json["notes"] = d.notes;
  json["floor"] = number(d.final_fit.floor);
  json["unit"] = unit;
  Json& noise = json["noise"] = Json::array();
  for (std::size_t e = 0; e < d.noise.size(); ++e)
    noise.push_back({{"experiment", d.final.problem->experiments()[e].spec.name},
                     {"floor", number(d.floors[e])},
                     {"coloured", d.noise[e].coloured}});
  json["links"] = {{"given", d.stages.front().links}, {"used", d.stages.back().links}};
  json["where"] = findings.places.words;
  json["points"] = {{"name", findings.places.points}, {"rms", numbers(findings.places.point_rms)}};
  if (findings.force.moment.size() > 0) {
    Json rows = Json::array(), values = Json::array(), depends = Json::array();
    for (Eigen::Index i = 0; i < findings.force.moment.rows(); ++i) {
      rows.push_back(fmt::format("joint {}", i + 1));
      values.push_back(numbers(findings.force.moment.row(i)));
    }
    for (const auto& dependence : findings.force.dependence)
      depends.push_back({{"on", dependence.on}, {"share", number(dependence.share)}});
    json["missing_force"] = {
        {"experiment",
         d.final.problem->experiments()[static_cast<std::size_t>(findings.force.experiment)]
             .spec.name},
        {"time", numbers(findings.force.time)},
        {"unit", "N m"},
        {"rows", rows},
        {"value", values},
        {"noise", number(findings.force.noise)},
        {"resolution", number(findings.force.resolution)},
        {"depends", depends},
        {"words", findings.force.words}};
  }
  Json& rounds = json["rounds"] = Json::array();
  for (std::size_t s = 0; s < d.stages.size(); ++s) {
    const bool last = s + 1 == d.stages.size();
    const Stage& stage = d.stages[s];
    Json round = {{"model", model_name(stage)},
                  {"added", stage.added.empty() ? Json(nullptr) : Json(stage.added)},
                  {"removed", stage.removed.empty() ? Json(nullptr) : Json(stage.removed)},
                  {"links", stage.links},
                  {"effects", stage.effects},
                  {"gap", last ? gap_json(d.final_fit, d.final_held_out, unit)
                               : gap_json(stage.fit, stage.held_out, unit)}};
    const FittedModel& model = last ? d.final : stage.model;
    const std::string name = fmt::format("round_{}/result.json", s);
    std::vector<Motion> motions;
    for (std::size_t e = 0; e < model.problem->experiments().size(); ++e)
      motions.push_back(motion_of(*model.problem, model.x, static_cast<int>(e)));
    files.emplace_back(
        name, comparison_result_text(*model.problem, model.x,
                                     evaluate(*model.problem, model.x, true, false), motions));
    round["result"] = name;
    if (stage.finer.links > 0)
      round["finer_chain"] = {{"links", stage.finer.links},
                              {"predicted_change", number(stage.finer.predicted)},
                              {"refitted", stage.finer.refitted},
                              {"taken", stage.finer.taken},
                              {"note", stage.finer.note}};
    Json& candidates = round["candidates"] = Json::array();
    for (const Explanation& explanation : stage.explanations)
      candidates.push_back(candidate_json(explanation, workshop, d.tried));
    rounds.push_back(std::move(round));
  }
  Json& effects = json["effects"] = Json::array();
  for (const std::string& id : d.effects) {
    const Candidate& candidate = *workshop.find(id);
    Json formula = Json::array();
    for (const Formula& each : formulas(candidate.effect))
      formula.push_back({{"what", each.what}, {"latex", each.latex}, {"mathml", each.mathml}});
    effects.push_back({{"id", id}, {"title", candidate.title}, {"formulas", formula}});
  }
  Json& parameters = json["parameters"] = Json::array();
  for (const FinalParameter& parameter : d.parameters) {
    const double half = 1.96 * parameter.standard_error;
    parameters.push_back(
        {{"name", parameter.name},
         {"unit", parameter.unit},
         {"effect", parameter.effect.empty() ? Json(nullptr) : Json(parameter.effect)},
         {"value", number(parameter.value)},
         {"standard_error", number(parameter.standard_error)},
         {"interval", {number(parameter.value - half), number(parameter.value + half)}}});
  }
  Json members = d.effects;
  const auto others = [&](const std::vector<Alternative>& list, bool telling) {
    Json out = Json::array();
    for (std::size_t i = 0; i < list.size(); ++i) {
      Json entry = {{"id", list[i].explanation.id},
                    {"instead_of", list[i].instead_of},
                    {"fit", number(list[i].explanation.fit.rms)},
                    {"validate", number(list[i].explanation.held_out.rms)},
                    {"difference", number(list[i].decision.difference)},
                    {"behind", number(list[i].decision.lead)}};
      if (telling && i < findings.telling.size())
        entry["experiment_that_tells"] = {{"words", findings.telling[i].words},
                                          {"difference", number(findings.telling[i].difference)}};
      out.push_back(std::move(entry));
    }
    return out;
  };
  for (const Alternative& alternative : d.alternatives)
    members.push_back(alternative.explanation.id);
  json["members"] = members;
  json["undecided"] = others(d.alternatives, true);
  json["forms"] = others(d.forms, false);
  json["runners_up"] = others(d.runners_up, false);
  if (!findings.telling.empty()) json["experiment_that_tells"] = findings.telling.front().words;
  json["equality_at_neutral"] = number(d.equality);
  json["candidates_tried"] = d.tried;
  json["seconds"] = number(d.seconds);
  files.emplace_back("diagnosis.json", json.dump(1) + "\n");
  return files;
}

}  // namespace catena
