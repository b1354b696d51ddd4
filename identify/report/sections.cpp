// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/sections.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "identify/report/assets.hpp"
#include "identify/report/equations.hpp"
#include "identify/report/readable.hpp"
#include "identify/report/residuals.hpp"

namespace catena::report {
namespace {

using Cells = std::vector<Html>;
using Facts = std::vector<std::pair<std::string, Html>>;

std::string spaced(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// "4.66 mm" of metres, "3.1 mrad" of radians, else the number with its unit.
std::string length(double value, const std::string& unit) {
  if (std::isnan(value)) return "–";
  const bool small = std::abs(value) < 1;
  if (unit == "m" && small) return for_people(1e3 * value) + "\u00a0mm";
  if (unit == "rad" && small) return for_people(1e3 * value) + "\u00a0mrad";
  return unit == "1" || unit.empty() ? for_people(value) : for_people(value) + "\u00a0" + unit;
}

std::string percent(double share) {
  return std::isnan(share) ? "–" : for_people(100 * share, 3) + "\u00a0%";
}

Html experiments_table(const Result& result) {
  const auto& experiments = result.experiments;
  const bool measured = std::any_of(experiments.begin(), experiments.end(),
                                    [](const Experiment& e) { return e.measured.has_value(); });
  if (!measured) return {};
  const bool before = std::any_of(experiments.begin(), experiments.end(),
                                  [](const Experiment& e) { return e.gap_before.has_value(); });
  Cells heading = {"Experiment", "Used to", "Gap, fitted part", "Gap, held out"};
  if (before) {
    heading.insert(heading.end(), {"Fitted part, at the start", "Held out, at the start"});
  }
  std::vector<Cells> rows = {heading};
  for (const Experiment& e : experiments) {
    Cells row = {e.name, e.use};
    const auto put = [&](const Gap& gap) {
      row.push_back(length(gap.fit, gap.unit));
      row.push_back(length(gap.validate, gap.unit));
    };
    put(e.gap.value_or(Gap()));
    if (before) put(e.gap_before.value_or(Gap()));
    rows.push_back(std::move(row));
  }
  return table("Root mean square of the residuals, by experiment", rows);
}

Html warnings(const Result& result) {
  std::vector<std::string> items;
  for (const Experiment& experiment : result.experiments)
    for (const std::string& warning : experiment.warnings)
      items.push_back(experiment.name + ": " + warning);
  return list("Warnings", items);
}

std::string interval(const Parameter& parameter) {
  if (!parameter.interval) return "–";
  return fmt::format("{}\u00a0…\u00a0{}", for_people(parameter.interval->low, 5),
                     for_people(parameter.interval->high, 5));
}

/// A probability of which the decimal logarithm is given; it may be too small for a number.
Html chance(double log10_p) {
  if (std::isnan(log10_p)) return "–";
  if (log10_p >= -4) return for_people(std::pow(10.0, std::min(0.0, log10_p)), 2);
  if (std::isinf(log10_p)) return "below 10" + span("sup", {}, "−300");
  return "10" + span("sup", {}, fmt::format("−{:.0f}", -log10_p));
}

std::string estimates(const Candidate& candidate) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : candidate.refit && !candidate.refit->estimate.empty()
                                       ? candidate.refit->estimate
                                       : candidate.estimate) {
    const bool own = name.starts_with(candidate.id + ".");
    parts.push_back(fmt::format("{} = {}", own ? name.substr(candidate.id.size() + 1) : name,
                                for_people(value)));
    for (const auto& [named, unit] : candidate.units)
      if (named == name && unit != "1") parts.back() += "\u00a0" + readable_unit(unit);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

Html candidates_table(const Round& round, const std::string& unit) {
  std::vector<Candidate> candidates = round.candidates;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     return std::isnan(b.score) ? !std::isnan(a.score) : a.score > b.score;
                   });
  std::vector<Cells> rows = {{"Effect", "Score", "Chance", "Survives", "Estimate", "Refit, fitted",
                              "Refit, held out", "Chance, refit", "Note"}};
  for (const Candidate& c : candidates) {
    const Refit refit = c.refit.value_or(Refit());
    const std::string note = !c.admissible && c.note.empty() ? "not admissible" : c.note;
    rows.push_back({c.title.empty() ? c.id : c.title, percent(c.score),
                    chance(std::log10(c.significance)), percent(c.survives), estimates(c),
                    length(refit.fit, unit), length(refit.validate, unit), chance(refit.log10_p),
                    note});
  }
  return table(
      "Score: share of the squared residual the effect would remove; chance: that noise alone "
      "would remove as much from one of all candidates; survives: share of its sensitivity that "
      "the free parameters cannot imitate",
      rows);
}

/// LaTeX, which the script typesets.
Html formula_html(const std::string& title, const std::string& latex) {
  Html html;
  if (!title.empty()) html += element("p", {}, title + ":");
  return html + element("div", {{"class", "latex scrolls"}, {"tabindex", "0"}}, latex);
}

Html group_html(const EquationGroup& group) {
  Html html;
  for (const results::Formula& formula : group.formulas)
    if (!formula.latex.empty()) html += formula_html(formula.what, formula.latex);
  return html.empty() ? html : element("h3", {}, group.heading) + html;
}

/// An effect's title where some round knows it, else its id.
std::string title_of(const Diagnosis& diagnosis, const std::string& id) {
  for (const EffectEntry& effect : diagnosis.effects)
    if (effect.id == id && !effect.title.empty()) return effect.title;
  for (const Round& round : diagnosis.rounds)
    for (const Candidate& candidate : round.candidates)
      if (candidate.id == id && !candidate.title.empty()) return candidate.title;
  return spaced(id);
}

/// Files of before have no title there.
std::string other_title(const Diagnosis& diagnosis, const OtherEffect& other) {
  return other.title.empty() ? title_of(diagnosis, other.id) : other.title;
}

Html others_html(const Diagnosis& diagnosis, const std::string& caption,
                 const std::vector<OtherEffect>& others) {
  if (others.empty()) return {};
  std::vector<Cells> rows = {
      {"Effect", "In place of", "Gap, fitted part", "Gap, held out", "Predictions apart"}};
  for (const OtherEffect& other : others) {
    rows.push_back({other_title(diagnosis, other),
                    other.instead_of.empty() ? "–" : title_of(diagnosis, other.instead_of),
                    length(other.fit, diagnosis.unit), length(other.validate, diagnosis.unit),
                    std::isnan(other.difference)
                        ? "–"
                        : for_people(other.difference, 2) + " times the noise"});
  }
  return table(caption, rows);
}

/// What the data do not decide, and what would.
Html undecided_html(const Diagnosis& diagnosis) {
  Html html;
  if (!diagnosis.undecided.empty())
    html += element("h3", {}, "What the data do not decide") +
            others_html(diagnosis, "Effects that explain the same recording as well",
                        diagnosis.undecided);
  std::vector<std::string> experiments;
  for (const OtherEffect& other : diagnosis.undecided) {
    if (!other.experiment_that_tells || other.experiment_that_tells->words.empty()) continue;
    const TellingExperiment& telling = *other.experiment_that_tells;
    experiments.push_back(other_title(diagnosis, other) + ": " + telling.words);
    if (!std::isnan(telling.difference))
      experiments.back() += fmt::format("; the predictions differ by {} times the noise there",
                                        for_people(telling.difference, 3));
  }
  if (experiments.empty() && !diagnosis.experiment_that_tells.empty())
    experiments.push_back(diagnosis.experiment_that_tells);
  html += list("The experiment that would tell them apart", experiments);
  html += others_html(diagnosis, "Other laws of the effect that is named, undecided too",
                      diagnosis.forms);
  if (!diagnosis.runners_up.empty())
    html += disclosed("Effects that the data decide against",
                      others_html(diagnosis, "Refitted, and worse", diagnosis.runners_up), false);
  return html;
}

/// How far predictions are off, and how far they had to be expected to be.
Html predictions_html(const Diagnosis& diagnosis) {
  if (diagnosis.predictions.empty()) return {};
  std::vector<Cells> rows = {
      {"Part", "Predicted off by", "Expected (95 %)", "At most, laws a tenth off there"}};
  for (const PredictionError& prediction : diagnosis.predictions) {
    const auto& [low, high] = prediction.expected;
    rows.push_back({prediction.part == "sealed" ? "sealed" : "held out",
                    length(prediction.observed, diagnosis.unit),
                    length(low, diagnosis.unit) + "\u00a0…\u00a0" + length(high, diagnosis.unit),
                    length(prediction.with_errors_of_laws, diagnosis.unit)});
  }
  return table(
             "Predictions of the final model: what is left, and what noise, the misfit of the "
             "fitted part and "
             "the errors of the fitted unknowns let one expect",
             rows) +
         list("What the predictions say", diagnosis.of_predictions);
}

/// How many links were needed, and what more of them would change.
Html links_html(const Diagnosis& diagnosis) {
  if (!diagnosis.links) return {};
  const auto& [given, used] = *diagnosis.links;
  Html html =
      element("h3", {}, "Links") +
      element("p", {},
              used != given
                  ? fmt::format("The case has {} links; the final model has {}.", given, used)
                  : fmt::format("The case's {} links are those of the final model.", given));
  std::vector<Cells> rows = {
      {"Asked of", "Links", "Change of the prediction", "Refitted", "Taken", "Note"}};
  for (const Round& round : diagnosis.rounds) {
    if (!round.finer_chain) continue;
    const FinerChain& finer = *round.finer_chain;
    rows.push_back({round.model, std::to_string(finer.links),
                    length(finer.predicted_change, diagnosis.unit), finer.refitted ? "yes" : "no",
                    finer.taken ? "yes" : "no", finer.note});
  }
  if (rows.size() > 1)
    html += table("What more links would change that the free parameters cannot imitate", rows);
  return html;
}

/// The formulas of the effects that were named or are candidates for the name.
Html members_html(const Diagnosis& diagnosis) {
  Html html;
  for (const EffectEntry& effect : diagnosis.effects) html += group_html(formulas_of(effect));
  for (const std::string& member : diagnosis.members) {
    const auto named = [&](const EffectEntry& effect) { return effect.id == member; };
    if (std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), named)) continue;
    EffectEntry entry{member, "", "", {}};
    for (const Round& round : diagnosis.rounds) {
      for (const Candidate& candidate : round.candidates) {
        if (candidate.id != member) continue;
        entry.title = candidate.title;
        entry.formulas = candidate.formulas;
      }
    }
    html += group_html(formulas_of(entry));
  }
  return html;
}

}  // namespace

Html summary_section(const Document& document) {
  const Result& result = document.result;
  Html html;
  if (document.diagnosis) {
    const Diagnosis& diagnosis = *document.diagnosis;
    html += element("p", {{"class", "verdict"}},
                    span("strong", {}, diagnosis.verdict) + " " + diagnosis.sentence);
  }
  if (!result.message.empty()) html += element("p", {}, result.message);
  Facts facts;
  if (!result.status.empty() && result.status != "success")
    facts.emplace_back("Status", spaced(result.status));
  if (result.model && result.model->links > 0)
    facts.emplace_back("Links", std::to_string(result.model->links));
  if (result.model && !std::isnan(result.model->load_mass))
    facts.emplace_back("Load", for_people(result.model->load_mass) + " kg");
  const Measure measure = result.measure.value_or(Measure());
  if (!std::isnan(measure.value))
    facts.emplace_back("Error, " + spaced(measure.name), length(measure.value, measure.unit));
  if (!std::isnan(measure.validation))
    facts.emplace_back("The same, held out", length(measure.validation, measure.unit));
  html += definitions(facts);
  html += experiments_table(result);
  html += warnings(result);
  if (!measure.parts.empty()) {
    std::vector<Cells> rows = {{"Part", "Value"}};
    for (const MeasurePart& part : measure.parts)
      rows.push_back({part.name, length(part.value, measure.unit)});
    html += disclosed("Error by parts", table("The error and its parts", rows),
                      measure.parts.size() <= 8);
  }
  return html;
}

Html residuals_section(const Result& result) {
  Html html;
  for (const Experiment& experiment : result.experiments) {
    const Residuals residuals = residuals_of(experiment);
    if (residuals.points.empty()) continue;
    std::vector<Cells> rows = {
        residuals.angles ? Cells{"Point", "Angle"}
                         : Cells{"Point", "Down", "Side", "Radial (6.7)–(6.10)", "Distance (6.5)"}};
    const auto mean = [](const Row& row) { return for_people(mean_absolute(row), 4); };
    for (std::size_t p = 0; p < residuals.points.size(); ++p) {
      Cells cells = {residuals.points[p].name};
      if (residuals.angles) {
        cells.push_back(mean(residuals.angle[p]));
      } else {
        for (const Rows* part :
             {&residuals.down, &residuals.side, &residuals.radial, &residuals.size})
          cells.push_back(mean((*part)[p]));
      }
      rows.push_back(std::move(cells));
    }
    html += disclosed("Mean differences, " + experiment.name,
                      table(fmt::format("Mean over all frames of the size of measured minus "
                                        "simulated, {}; radial: of the distance from the support",
                                        residuals.unit),
                            rows),
                      result.experiments.size() == 1 && rows.size() <= 14);
  }
  return html;
}

Html parameters_section(const Result& result) {
  if (result.parameters.empty()) return {};
  std::vector<Cells> free = {{"Parameter", "Value", "Unit", "Standard error", "95 % interval",
                              "Verdict", "Start", "Bounds", "Sets"}};
  std::vector<Cells> fixed = {{"Parameter", "Value", "Unit", "Sets"}};
  for (const Parameter& p : result.parameters) {
    const std::string value = for_people(p.value, 5);
    if (!p.free) {
      fixed.push_back({p.name, value, readable_unit(p.unit), p.sets});
      continue;
    }
    std::string verdict = p.verdict.empty() ? "–" : spaced(p.verdict);
    if (!p.note.empty()) verdict += "; " + p.note;
    const bool bounded = !std::isnan(p.lower) || !std::isnan(p.upper);
    const std::string bounds =
        bounded ? fmt::format("{}\u00a0…\u00a0{}", std::isnan(p.lower) ? "−∞" : for_people(p.lower),
                              std::isnan(p.upper) ? "∞" : for_people(p.upper))
                : "–";
    free.push_back({p.name, value, readable_unit(p.unit), for_people(p.standard_error, 3),
                    interval(p), verdict, for_people(p.start, 5), bounds, p.sets});
  }
  Html html;
  if (free.size() > 1) html += table("Fitted parameters", free);
  if (fixed.size() > 1) {
    const Html all = table("Parameters that were held fixed", fixed);
    html += free.size() > 1 ? disclosed("Fixed parameters", all, false) : all;
  }
  return html;
}

Html fit_section(const Result& result) {
  Facts facts;
  if (result.optimiser) {
    const Optimiser& optimiser = *result.optimiser;
    const std::string unit = result.measure ? result.measure->unit : "";
    for (const auto& [name, words] :
         {std::pair("Method", &optimiser.method), std::pair("Strategy", &optimiser.strategy),
          std::pair("Status", &optimiser.status), std::pair("Message", &optimiser.message)})
      if (!words->empty()) facts.emplace_back(name, spaced(*words));
    facts.emplace_back("Evaluations", std::to_string(optimiser.evaluations));
    facts.emplace_back("Simulations worth", for_people(optimiser.simulations_worth));
    facts.emplace_back("Failures", std::to_string(optimiser.failures));
    facts.emplace_back("Seed", std::to_string(optimiser.seed));
    facts.emplace_back("Error at the start", length(optimiser.start_error, unit));
    facts.emplace_back("Error", length(optimiser.error, unit));
  }
  Html html = definitions(facts);
  if (!result.links_study.empty()) {
    std::vector<Cells> rows = {{"Links", "Error", "Error, held out", "Evaluations", "Status"}};
    const std::string unit = result.measure ? result.measure->unit : "";
    for (const LinksRow& row : result.links_study)
      rows.push_back({std::to_string(row.links), length(row.error, unit),
                      length(row.validation_error, unit), std::to_string(row.evaluations),
                      spaced(row.status)});
    html += table("Refitted with other numbers of links", rows);
  }
  return html;
}

Html diagnosis_section(const Diagnosis& diagnosis) {
  Html html = list("Where the gap is", diagnosis.where);
  if (diagnosis.missing_force)
    html += list("The force that is missing", diagnosis.missing_force->words);
  html += list("Notes", diagnosis.notes);
  std::vector<Cells> rows = {
      {"Model", "Links", "Gap, fitted part", "Gap, held out", "Gap, sealed", "Fitted / noise"}};
  for (const Round& round : diagnosis.rounds) {
    std::string name = round.model;
    const bool said = round.model.find(round.added) != std::string::npos;
    if (!round.added.empty() && !said && round.added != kTooFewLinks) name += " + " + round.added;
    if (!round.removed.empty() && round.removed != kTooFewLinks)
      name += ", no longer " + round.removed;
    const double noise = std::isnan(round.gap.noise) ? diagnosis.noise : round.gap.noise;
    rows.push_back(
        {name, round.links > 0 ? std::to_string(round.links) : "–",
         length(round.gap.fit, diagnosis.unit), length(round.gap.validate, diagnosis.unit),
         length(round.gap.sealed, diagnosis.unit), for_people(round.gap.fit / noise, 3)});
  }
  if (rows.size() > 1) {
    const std::string level =
        std::isnan(diagnosis.noise) ? "" : "; noise " + length(diagnosis.noise, diagnosis.unit);
    html += table("Gap, round by round" + level, rows);
  }
  html += predictions_html(diagnosis);
  html += links_html(diagnosis);
  html += members_html(diagnosis);
  if (!std::isnan(diagnosis.equality_at_neutral) && !diagnosis.effects.empty())
    html += element(
        "p", {},
        "At the neutral values the new model equals the case's" +
            (diagnosis.equality_at_neutral == 0
                 ? std::string(" exactly")
                 : fmt::format(" to {} (relative)", for_people(diagnosis.equality_at_neutral, 1))) +
            ".");
  html += undecided_html(diagnosis);
  for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k) {
    const Round& round = diagnosis.rounds[k];
    if (round.candidates.empty()) continue;
    const std::string heading = fmt::format("Candidates of round {}: what {} leaves unexplained",
                                            k + 1, round.model.empty() ? "the model" : round.model);
    html += disclosed(heading, candidates_table(round, diagnosis.unit), k == 0);
  }
  return html;
}

Html equations_section(const Result& result) {
  Html html =
      element("h3", {}, "The chain, in sums") + element("div",
                                                        {{"class", "scrolls"},
                                                         {"tabindex", "0"},
                                                         {"role", "region"},
                                                         {"aria-label", "Equations of the chain"}},
                                                        Html::markup(asset_chain_equations()));
  if (!result.model) return html;
  const ModelEntry& model = *result.model;
  for (const EffectEntry& effect : model.effects) html += group_html(formulas_of(effect));
  if (!model.derived)
    return model.not_derived.empty()
               ? html
               : html +
                     element("p", {}, "The equations could not be derived: " + model.not_derived);
  Html derived;
  for (const DerivedEquation& equation : model.derived->equations)
    derived += formula_html(equation.title, equation.latex);
  return html + disclosed(fmt::format("As derived from the Lagrangian{}, with {} link{}",
                                      model.effects.empty() ? "" : " and the effects",
                                      model.derived->links, model.derived->links == 1 ? "" : "s"),
                          derived, true);
}

Html provenance_section(const Result& result) {
  Facts facts;
  for (const auto& [name, value] : result.versions) facts.emplace_back(name, value);
  const ModelEntry model = result.model.value_or(ModelEntry());
  if (!model.description_hash.empty())
    facts.emplace_back("model", Html(fmt::format("{}, {} links, SHA-256 ", model.id, model.links)) +
                                    span("code", {}, model.description_hash));
  Html html = definitions(facts);
  const auto code = [](const std::string& text) {
    return element("pre", {{"tabindex", "0"}}, span("code", {}, text));
  };
  if (result.the_case)
    html += disclosed("Case " + result.the_case->file, code(result.the_case->text), true);
  if (!model.description.empty())
    html += disclosed("Model description", code(model.description), false);
  for (const Experiment& experiment : result.experiments) {
    Facts numbers;
    for (const auto& [name, count] : experiment.statistics)
      numbers.emplace_back(spaced(name), std::to_string(count));
    if (!numbers.empty())
      html += disclosed("Integration of " + experiment.name, definitions(numbers), false);
  }
  return html;
}

}  // namespace catena::report
