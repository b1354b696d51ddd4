// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/normal_quantile.hpp"
#include "common/whole_file.hpp"
#include "identify/diagnosis/sealed_part.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/forces/force_pattern.hpp"
#include "identify/results/result_file.hpp"
#include "identify/results/result_writer.hpp"

namespace catena {
namespace {

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

std::string in_milli(double rms) {
  return std::isnan(rms) ? "-" : fmt::format("{:.4g}", 1e3 * rms);
}

/// Root mean square; NaN where nothing was held out.
double rms_of(const GapTest& held_out) { return held_out.count > 0 ? held_out.rms : kNotGiven; }

results::Gap gap_of(const GapTest& fit, const GapTest& held_out, const FittedModel& model,
                    const std::string& unit) {
  return {fit.rms,    rms_of(held_out), sealed_rms(model),   unit,    fit.noise,
          fit.misfit, fit.present,      fit.autocorrelation, fit.size};
}

results::Candidate candidate_of(const Explanation& explanation, const DiagnosisContext& context,
                                int tried) {
  const double log10_tried = std::log10(std::max(1, tried));
  results::Candidate entry;
  entry.id = explanation.id;
  entry.title = explanation.title;
  entry.kind = explanation.candidate < 0 ? "rival" : "effect";
  entry.score = explanation.score.share;
  entry.survives = explanation.score.survives;
  entry.admissible = explanation.score.admissible;
  entry.significance = std::pow(10, std::min(0.0, explanation.log10_p + log10_tried));
  entry.note = explanation.note;
  entry.estimate = explanation.start.of_effect;
  if (explanation.refitted) {
    results::Refit& refit = entry.refit.emplace();
    refit.fit = explanation.fit.rms;
    refit.validate = rms_of(explanation.held_out);
    refit.criterion = explanation.comparison.criterion;
    refit.log10_p = std::log10(explanation.chance);
    refit.misfit_share = explanation.comparison.misfit_share;
    refit.autocorrelation = explanation.comparison.autocorrelation;
    const auto& unknowns = explanation.model.problem->unknowns();
    for (std::size_t j = 0; j < unknowns.size(); ++j)
      if (belongs_to(unknowns[j].name, explanation.id))
        refit.estimate.emplace_back(unknowns[j].name,
                                    explanation.model.x[static_cast<Eigen::Index>(j)]);
  }
  if (explanation.candidate >= 0) {
    const Candidate& candidate = context.library()[static_cast<std::size_t>(explanation.candidate)];
    for (const CandidateParameter& parameter : candidate.parameters)
      entry.units.emplace_back(parameter.name, parameter.unit);
    entry.formulas = formula_entries(candidate.effect);
  }
  return entry;
}

/// Four digits: more than the bands leave, and a file a third as long.
double rounded(double value) {
  if (value == 0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10, std::floor(std::log10(std::abs(value))) - 3);
  return std::round(value / unit) * unit;
}

results::ForceHistory history_entry(const MissingForce::History& history, std::string quantity,
                                    std::string unit, std::vector<std::string> rows,
                                    const Eigen::MatrixXd& value,
                                    const Eigen::MatrixXd& deviation) {
  results::ForceHistory entry{
      history.experiment, std::move(quantity), std::move(unit), {}, std::move(rows), {}, {}};
  entry.time.assign(history.time.begin(), history.time.end());
  for (Eigen::Index i = 0; i < value.rows(); ++i)
    for (const auto& [matrix, list] :
         {std::pair{&value, &entry.value}, std::pair{&deviation, &entry.deviation}}) {
      auto& row = list->emplace_back();
      for (Eigen::Index k = 0; k < matrix->cols(); ++k) row.push_back(rounded((*matrix)(i, k)));
    }
  return entry;
}

results::MissingForce entry_of(const MissingForce& force) {
  results::MissingForce entry;
  entry.found = force.found;
  entry.log_evidence = force.log_evidence;
  entry.share = force.share;
  entry.words = force.words;
  entry.one_place = force.one_place;
  if (force.law) {
    const ForceLaw& law = *force.law;
    results::ForceLaw& found = entry.law.emplace();
    found.found = law.found;
    found.force = law.force;
    found.variable = law.variable;
    found.formula = law.formula.text;
    for (const CandidateLaw::Constant& constant : law.formula.constants)
      found.constants.push_back(
          {constant.name, constant.unit, "", constant.value, constant.deviation, std::nullopt});
    found.candidates = law.candidates;
    found.confirmed = law.confirmed;
    found.chance = law.chance;
    for (const ForceLaw& rival : law.rivals)
      found.rivals.push_back(rival.formula.text + site_in_words(rival.site));
  }
  entry.seconds = force.seconds;
  for (const MissingForce::Place& place : force.places)
    entry.places.push_back({place.name, place.arc_length, place.log_evidence});
  if (force.best)
    entry.best =
        results::ForcePlace{force.best->name, force.best->arc_length, force.best->log_evidence};
  for (const MissingForce::Pattern& pattern : force.patterns)
    entry.patterns.push_back(
        {pattern.name, pattern.unit, pattern.prior_deviation, pattern.resolved});
  std::vector<std::string> places;
  for (const double s : force.arc_length) places.push_back(fmt::format("{:.3g} m", s));
  for (const MissingForce::History& history : force.everywhere) {
    for (std::size_t i = 0; i < history.densities.size(); ++i)
      entry.densities.push_back(
          history_entry(history, fmt::format("{} density", word_of(static_cast<ForceDirection>(i))),
                        "N/m", places, history.densities[i].value, history.densities[i].deviation));
    entry.patterns_over_time.push_back(
        history_entry(history, "patterns", "", history.rows, history.size, history.deviation));
  }
  for (const MissingForce::History& history : force.at_best) {
    const bool torque = force.best->joint >= 0;
    entry.at_best.push_back(history_entry(history, force.best->name, torque ? "N m" : "N",
                                          history.rows, history.size, history.deviation));
  }
  for (const MissingForce::Parameter& parameter : force.parameters) {
    const double half = kNormalQuantile95 * parameter.deviation;
    entry.parameters.push_back({parameter.name, parameter.unit, "", parameter.value,
                                parameter.deviation,
                                results::Interval{parameter.value - half, parameter.value + half}});
  }
  return entry;
}

std::string force_text(const MissingForce& force) {
  std::string text = "\nmissing force\n";
  for (const std::string& words : force.words) text += "  " + words + "\n";
  if (!force.found) return text;
  text += fmt::format("  {:34} {:>14}\n", "a force at one place alone", "log evidence");
  for (const MissingForce::Place& place : force.places)
    text += fmt::format("  {:34} {:>14.5g}\n", place.name, place.log_evidence);
  text += fmt::format("  {:34} {:>14.5g}\n", "best: " + force.best->name, force.best->log_evidence);
  for (const MissingForce::Parameter& parameter : force.parameters)
    text += fmt::format("  with it {} is {:.4g} {} (before {:.4g})\n", parameter.name,
                        parameter.value, parameter.unit, parameter.before);
  return text;
}

/// The model of a stage; of the last one as it was fitted in the end.
const FittedModel& model_of_round(const Diagnosis& d, std::size_t s) {
  return s + 1 == d.stages.size() ? d.final : d.stages[s].model;
}

results::Round round_of(const Diagnosis& d, std::size_t s, const DiagnosisContext& context) {
  const bool last = s + 1 == d.stages.size();
  const Stage& stage = d.stages[s];
  results::Round round;
  round.model = model_name(stage);
  round.added = stage.added;
  round.removed = stage.removed;
  round.links = stage.links;
  round.effects = stage.effects;
  round.result_file = fmt::format("round_{}/result.json", s);
  round.gap = last ? gap_of(d.final_fit, d.final_held_out, d.final, unit_of(d))
                   : gap_of(stage.fit, stage.held_out, stage.model, unit_of(d));
  if (stage.finer.links > 0)
    round.finer_chain = {stage.finer.links, stage.finer.predicted, stage.finer.refitted,
                         stage.finer.taken, stage.finer.note};
  for (const Explanation& explanation : stage.explanations)
    round.candidates.push_back(candidate_of(explanation, context, d.tried));
  return round;
}

/// The text of a result file that compares the model of a stage with all recordings, sealed parts too.
std::string fit_of_round(const Diagnosis& d, std::size_t s) {
  const FittedModel& model = model_of_round(d, s);
  const Problem shown = with_opened_seals(*model.problem);
  std::vector<Motion> motions;
  for (std::size_t e = 0; e < shown.experiments().size(); ++e)
    motions.push_back(motion_of(shown, model.x, static_cast<int>(e)));
  return comparison_result_text(shown, model.x, evaluate(shown, model.x, true, false), motions);
}

std::vector<results::Share> share_entries(const Shares& shares) {
  std::vector<results::Share> entries;
  const auto add = [&](const std::string& name, const ShareInterval& fitted,
                       const ShareInterval& held_out) {
    results::Share& share = entries.emplace_back();
    share.name = name;
    share.fit = fitted.share;
    share.fit_interval = {fitted.lower, fitted.upper};
    if (!shares.has_held_out) return;
    share.validate = held_out.share;
    share.validate_interval = {held_out.lower, held_out.upper};
  };
  for (const EffectShare& effect : shares.effects)
    add(effect.effect, effect.fitted, effect.held_out);
  if (!shares.empty()) add("left", shares.left_fitted, shares.left_held_out);
  return entries;
}

std::vector<results::OtherEffect> other_effects(const std::vector<Alternative>& alternatives) {
  std::vector<results::OtherEffect> entries;
  entries.reserve(alternatives.size());
  for (const Alternative& other : alternatives)
    entries.push_back({other.explanation.id, other.instead_of, other.explanation.fit.rms,
                       other.explanation.held_out.rms, other.decision.difference,
                       other.decision.lead, std::nullopt, other.explanation.title});
  return entries;
}

}  // namespace

std::string progress_line(const DiagnosisProgress& progress) {
  std::string line = progress.doing;
  if (progress.of > 0) line += fmt::format(", {} of {} done", progress.done, progress.of);
  if (std::isfinite(progress.seconds_left))
    line += fmt::format(", about {:.0f} s left of this", progress.seconds_left);
  if (!progress.best.empty()) line += "; best so far: " + progress.best;
  return line;
}

DiagnosisFindings find_out(const Diagnosis& d) {
  DiagnosisFindings findings;
  findings.places = residual_places(d.stages.front().model, levels(d.noise));
  for (const Alternative& alternative : d.alternatives)
    findings.telling.push_back(
        telling_experiment(d.final, alternative.explanation.model, levels(d.noise)));
  return findings;
}

std::string diagnosis_table(const Diagnosis& d, const DiagnosisFindings& findings) {
  const std::string unit = milli_unit_of(d);
  std::string text = fmt::format("verdict: {}\n{}\n\n", name_of(d.verdict), d.sentence);
  text += fmt::format("{:44} {:>9} {:>9} {:>9} {:>9}\n", "gap (RMS, " + unit + ")", "fitted",
                      "held out", "sealed", "/ noise");
  const auto row = [&](const std::string& name, const GapTest& fit, const GapTest& held,
                       const FittedModel& model) {
    text += fmt::format("{:44} {:>9} {:>9} {:>9} {:>9.3g}\n", name, in_milli(fit.rms),
                        in_milli(rms_of(held)), in_milli(sealed_rms(model)), fit.ratio());
  };
  for (const Stage& stage : d.stages) {
    std::string change = stage.added.empty() && stage.removed.empty() ? "baseline"
                         : stage.removed == kTooFewLinks
                             ? fmt::format("back to {} links", stage.links)
                         : stage.added.empty() ? "without " + stage.removed
                         : stage.added == kTooFewLinks
                             ? fmt::format("{} links{}", stage.links,
                                           stage.removed.empty() ? "" : " for " + stage.removed)
                         : stage.removed.empty() ? "+ " + stage.added
                                                 : "+ " + stage.added + " for " + stage.removed;
    row(change, stage.fit, stage.held_out, stage.model);
  }
  if (!d.effects.empty())
    row("the new model, compiled and refitted", d.final_fit, d.final_held_out, d.final);
  text += fmt::format("{:44} {:>9.4g}\n", "noise", 1e3 * d.final_fit.noise);
  const PredictionErrors& predictions = d.predictions;
  if (predictions.known()) {
    const auto ends = [&](const std::string& name, const auto& end) {
      text += fmt::format("{:44} {:>9} {:>9} {:>9}\n", name, "",
                          in_milli(end(predictions.held_out)), in_milli(end(predictions.sealed)));
    };
    ends("expected of the predictions, at least", [](const PredictionError& of) { return of.low; });
    ends(fmt::format("at most ({:.0f} %)", 100 * kThresholds.prediction_level),
         [](const PredictionError& of) { return of.high; });
    if (predictions.held_out.explained > 0 || predictions.sealed.explained > 0)
      ends(fmt::format("at most, laws {:.0f} % off there", 100 * kThresholds.law_error),
           [](const PredictionError& of) { return of.high_with_errors_of_laws(); });
  }
  for (const std::string& words : words_of(predictions, d.final_fit.rms, unit))
    text += "  " + words + "\n";
  for (const std::string& note : d.notes) text += "  note: " + note + "\n";

  if (!d.shares.empty()) {
    const auto share = [](const ShareInterval& of) {
      return fmt::format("{:.0f} % ({:.0f} to {:.0f})", 100 * of.share, 100 * of.lower,
                         100 * of.upper);
    };
    const auto line = [&](const std::string& name, const ShareInterval& fitted,
                          const ShareInterval& held_out) {
      text += fmt::format("{:34} {:>24} {:>24}\n", name, share(fitted),
                          d.shares.has_held_out ? share(held_out) : "-");
    };
    text +=
        fmt::format("\n{:34} {:>24} {:>24}\n", "share of the squared misfit", "fitted", "held out");
    for (const EffectShare& effect : d.shares.effects)
      line(effect.effect, effect.fitted, effect.held_out);
    line("left", d.shares.left_fitted, d.shares.left_held_out);
  }
  if (d.stages.front().fit.present && !findings.places.words.empty()) {
    text += "\nwhere: ";
    for (std::size_t i = 0; i < findings.places.words.size(); ++i)
      text += (i ? ", " : "") + findings.places.words[i];
    text += "\n";
  }
  if (d.force) text += force_text(*d.force);
  text += fmt::format("\n{:34} {:>14} {:>26}  {}\n", "parameter", "value", "95 % interval", "unit");
  for (const FinalParameter& parameter : d.parameters) {
    const double half = parameter.half_width();
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
    text +=
        fmt::format("  {} {}{}: {:.4g} {} fitted, predictions {:.2g} times the noise apart\n", what,
                    alternative.explanation.id,
                    !d.law.empty() && alternative.instead_of == d.law
                        ? fmt::format(" ({})", alternative.explanation.title)
                        : "",
                    1e3 * alternative.explanation.fit.rms, unit, alternative.decision.difference);
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
                                                                 const DiagnosisContext& context) {
  std::vector<std::pair<std::string, std::string>> files;
  const std::string unit = unit_of(d);
  const Case& the_case = d.stages.front().model.problem->the_case();
  const auto& experiments = d.final.problem->experiments();
  results::Diagnosis result;
  result.title = the_case.title;
  result.versions = {{"catena", CATENA_VERSION}};
  result.the_case = case_entry(the_case);
  result.verdict = name_of(d.verdict);
  result.sentence = d.sentence;
  result.notes = d.notes;
  result.noise = d.final_fit.noise;
  result.unit = unit;
  for (std::size_t e = 0; e < d.noise.size(); ++e)
    result.experiment_noise.push_back({experiments[e].spec.name, d.noise[e].level});
  result.links = {d.stages.front().links, d.stages.back().links};
  result.where = findings.places.words;
  result.points.name = findings.places.points;
  for (const double rms : findings.places.point_rms) result.points.rms.push_back(rms);
  if (d.force) result.missing_force = entry_of(*d.force);
  for (std::size_t s = 0; s < d.stages.size(); ++s) {
    result.rounds.push_back(round_of(d, s, context));
    files.emplace_back(result.rounds.back().result_file, fit_of_round(d, s));
  }
  for (const std::string& id : d.effects) {
    const Candidate& candidate = *context.find(id);
    result.effects.push_back({id, candidate.title, "", formula_entries(candidate.effect)});
  }
  for (const FinalParameter& parameter : d.parameters) {
    const double half = parameter.half_width();
    result.parameters.push_back(
        {parameter.name, parameter.unit, parameter.effect, parameter.value,
         parameter.standard_error,
         results::Interval{parameter.value - half, parameter.value + half}});
  }
  result.shares = share_entries(d.shares);
  result.certain = d.certain;
  for (const auto& [part, error] :
       {std::pair("validate", &d.predictions.held_out), std::pair("sealed", &d.predictions.sealed)})
    if (!std::isnan(error->observed))
      result.predictions.push_back(
          {part, error->observed, {error->low, error->high}, error->high_with_errors_of_laws()});
  result.of_predictions = words_of(d.predictions, d.final_fit.rms, milli_unit_of(d));
  result.members = d.effects;
  for (const Alternative& alternative : d.alternatives)
    result.members.push_back(alternative.explanation.id);
  result.undecided = other_effects(d.alternatives);
  for (std::size_t i = 0; i < std::min(result.undecided.size(), findings.telling.size()); ++i)
    result.undecided[i].experiment_that_tells = {findings.telling[i].words,
                                                 findings.telling[i].difference};
  result.forms = other_effects(d.forms);
  result.runners_up = other_effects(d.runners_up);
  if (!findings.telling.empty()) result.experiment_that_tells = findings.telling.front().words;
  result.equality_at_neutral = d.equality;
  result.candidates_tried = d.tried;
  result.seconds = d.seconds;
  const auto add_law = [&](const std::string& id) {
    files.emplace_back(id + ".toml", read_whole_file(context.find(id)->effect.source_file));
  };
  if (!d.law.empty()) add_law(d.law);
  for (const Alternative& alternative : d.alternatives)
    if (!d.law.empty() && alternative.instead_of == d.law) add_law(alternative.explanation.id);
  files.emplace_back("diagnosis.json", results::text_of(result));
  return files;
}

}  // namespace catena
