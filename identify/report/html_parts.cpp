// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/html_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "identify/report/assets.hpp"
#include "identify/report/equations.hpp"
#include "identify/report/residuals.hpp"
#include "identify/report/svg_elements.hpp"
#include "identify/report/ticks.hpp"

namespace catena::report {
namespace {

using plot::escaped;
using plot::for_people;

using Cells = std::vector<std::string>;

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
  return unit == "1" || unit.empty() ? for_people(value) : for_people(value) + " " + escaped(unit);
}

std::string percent(double share) {
  return std::isnan(share) ? "–" : for_people(100 * share, 3) + " %";
}

/// A list of names and what belongs to them.
std::string definitions(const Named& entries) {
  if (entries.empty()) return "";
  std::string html = "<dl>\n";
  for (const auto& [name, value] : entries) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(spaced(name)), value);
  }
  return html + "</dl>\n";
}

std::string disclosed(const std::string& heading, const std::string& content, bool open) {
  return fmt::format("<details{}><summary>{}</summary>\n{}</details>\n", open ? " open" : "",
                     heading, content);
}

std::string experiments_table(const Result& result) {
  const auto& experiments = result.experiments;
  const bool measured = std::any_of(experiments.begin(), experiments.end(),
                                    [](const Experiment& e) { return e.measured.has_value(); });
  if (!measured) return "";
  const bool before = std::any_of(experiments.begin(), experiments.end(), [](const Experiment& e) {
    return !std::isnan(e.gap_before.fit) || !std::isnan(e.gap_before.validate);
  });
  const bool floor = std::any_of(experiments.begin(), experiments.end(),
                                 [](const Experiment& e) { return !std::isnan(e.gap.floor); });
  Cells heading = {"Experiment", "Used to", "Gap, fitted part", "Gap, held out"};
  if (before) {
    heading.insert(heading.end(), {"Fitted part, at the start", "Held out, at the start"});
  }
  if (floor) heading.emplace_back("Noise");
  std::vector<Cells> rows = {heading};
  for (const Experiment& e : experiments) {
    Cells row = {escaped(e.name), escaped(e.use), length(e.gap.fit, e.gap.unit),
                 length(e.gap.validate, e.gap.unit)};
    if (before) {
      row.push_back(length(e.gap_before.fit, e.gap_before.unit));
      row.push_back(length(e.gap_before.validate, e.gap_before.unit));
    }
    if (floor) row.push_back(length(e.gap.floor, e.gap.unit));
    rows.push_back(std::move(row));
  }
  return table("Root mean square of the residuals, by experiment", rows);
}

std::string warnings(const Result& result) {
  std::string items;
  for (const Experiment& experiment : result.experiments) {
    for (const std::string& warning : experiment.warnings) {
      items += fmt::format("<li>{}: {}</li>\n", escaped(experiment.name), escaped(warning));
    }
  }
  return items.empty() ? "" : "<h3>Warnings about the data</h3>\n<ul>\n" + items + "</ul>\n";
}

std::string interval(const Parameter& parameter) {
  if (!parameter.has_interval) return "–";
  return fmt::format("{}\u00a0…\u00a0{}", for_people(parameter.low, 5),
                     for_people(parameter.high, 5));
}

/// A probability of which the decimal logarithm is given; it may be too small for a number.
std::string chance(double log10_p) {
  if (std::isnan(log10_p)) return "–";
  if (log10_p >= -4) return for_people(std::pow(10.0, std::min(0.0, log10_p)), 2);
  if (std::isinf(log10_p)) return "below 10<sup>−300</sup>";
  return fmt::format("10<sup>−{:.0f}</sup>", -log10_p);
}

std::string estimates(const Candidate& candidate) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : candidate.estimate) {
    const bool own = name.starts_with(candidate.id + ".");
    parts.push_back(fmt::format(
        "{} = {}", escaped(own ? name.substr(candidate.id.size() + 1) : name), for_people(value)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string candidates_table(const Round& round, const std::string& unit) {
  std::vector<Candidate> candidates = round.candidates;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     return std::isnan(b.score) ? !std::isnan(a.score) : a.score > b.score;
                   });
  std::vector<Cells> rows = {{"Effect", "Score", "Chance", "Survives", "Estimate", "Refit, fitted",
                              "Refit, held out", "Chance, refit", "Note"}};
  for (const Candidate& c : candidates) {
    std::string name = c.title.empty() ? escaped(c.id) : escaped(c.title);
    std::string note = escaped(c.note);
    if (!c.admissible && note.empty()) note = "not admissible";
    rows.push_back({name, percent(c.score), chance(std::log10(c.significance)), percent(c.survives),
                    estimates(c), length(c.refit_fit, unit), length(c.refit_validate, unit),
                    chance(c.log10_p), note});
  }
  return table(
      "Score: share of the squared residual the effect would remove; chance: that noise alone "
      "would remove as much from one of all candidates; survives: share of its sensitivity that "
      "the free parameters cannot imitate",
      rows);
}

std::string equation_html(const Equation& equation) {
  std::string html;
  if (!equation.title.empty()) html += fmt::format("<p>{}:</p>\n", escaped(equation.title));
  if (!equation.mathml.empty()) {
    html +=
        fmt::format("<div class=\"formula scrolls\" tabindex=\"0\">{}</div>\n", equation.mathml);
  } else if (!equation.latex.empty()) {
    html += fmt::format("<div class=\"latex scrolls\" tabindex=\"0\">{}</div>\n",
                        escaped(equation.latex));
  }
  return html;
}

std::string group_html(const EquationGroup& group) {
  std::string html = fmt::format("<h3>{}</h3>\n", escaped(group.heading));
  for (const Equation& equation : group.equations) html += equation_html(equation);
  return html;
}

std::string list_html(const std::string& heading, const std::vector<std::string>& items) {
  if (items.empty()) return "";
  std::string html = fmt::format("<h3>{}</h3>\n<ul>\n", heading);
  for (const std::string& item : items) html += fmt::format("<li>{}</li>\n", escaped(item));
  return html + "</ul>\n";
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

std::string others_html(const Diagnosis& diagnosis, const std::string& caption,
                        const std::vector<OtherEffect>& others) {
  if (others.empty()) return "";
  std::vector<Cells> rows = {
      {"Effect", "In place of", "Gap, fitted part", "Gap, held out", "Predictions apart"}};
  for (const OtherEffect& other : others) {
    rows.push_back({escaped(title_of(diagnosis, other.id)),
                    other.instead_of.empty() ? "–" : escaped(title_of(diagnosis, other.instead_of)),
                    length(other.fit, diagnosis.unit), length(other.validate, diagnosis.unit),
                    std::isnan(other.difference)
                        ? "–"
                        : for_people(other.difference, 2) + " times the noise"});
  }
  return table(caption, rows);
}

/// What the data do not decide, and what would.
std::string undecided_html(const Diagnosis& diagnosis) {
  const std::vector<OtherEffect>& undecided = diagnosis.undecided;
  std::string html;
  if (!undecided.empty())
    html += "<h3>What the data do not decide</h3>\n" +
            others_html(diagnosis, "Effects that explain the same recording as well", undecided);
  std::string items;
  for (const OtherEffect& other : undecided) {
    if (other.experiment_that_tells.empty()) continue;
    items += fmt::format("<li>{}: {}", escaped(title_of(diagnosis, other.id)),
                         escaped(other.experiment_that_tells));
    if (!std::isnan(other.difference_there))
      items += fmt::format("; the predictions differ by {} times the noise there",
                           for_people(other.difference_there, 3));
    items += "</li>\n";
  }
  if (items.empty() && !diagnosis.experiment_that_tells.empty())
    items = fmt::format("<li>{}</li>\n", escaped(diagnosis.experiment_that_tells));
  if (!items.empty())
    html += "<h3>The experiment that would tell them apart</h3>\n<ul>\n" + items + "</ul>\n";
  html += others_html(diagnosis, "Other laws of the effect that is named, undecided too",
                      diagnosis.forms);
  if (!diagnosis.runners_up.empty())
    html += disclosed("Effects that the data decide against",
                      others_html(diagnosis, "Refitted, and worse", diagnosis.runners_up), false);
  return html;
}

/// How many links were needed, and what more of them would change.
std::string links_html(const Diagnosis& diagnosis) {
  if (diagnosis.links_used == 0) return "";
  const bool more = diagnosis.links_used != diagnosis.links_given;
  std::string html =
      fmt::format("<h3>Links</h3>\n<p>{}</p>\n",
                  more ? fmt::format("The case has {} links; the final model has {}.",
                                     diagnosis.links_given, diagnosis.links_used)
                       : fmt::format("The case's {} links are those of the final model.",
                                     diagnosis.links_given));
  std::vector<Cells> rows = {
      {"Asked of", "Links", "Change of the prediction", "Refitted", "Taken", "Note"}};
  for (const Round& round : diagnosis.rounds) {
    if (!round.finer_chain) continue;
    const FinerChain& finer = *round.finer_chain;
    rows.push_back({escaped(round.model), std::to_string(finer.links),
                    length(finer.predicted_change, diagnosis.unit), finer.refitted ? "yes" : "no",
                    finer.taken ? "yes" : "no", escaped(finer.note)});
  }
  if (rows.size() > 1)
    html += table("What more links would change that the free parameters cannot imitate", rows);
  return html;
}

/// The formulas of the effects that were named or are candidates for the name.
std::string members_html(const Diagnosis& diagnosis) {
  std::string html;
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

std::string table(const std::string& caption, const std::vector<Cells>& rows) {
  std::string html = fmt::format(
      "<div class=\"table\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\">\n"
      "<table>\n<caption>{0}</caption>\n<thead><tr>",
      escaped(caption));
  for (const std::string& cell : rows.front())
    html += fmt::format("<th scope=\"col\">{}</th>", cell);
  html += "</tr></thead>\n<tbody>\n";
  for (std::size_t r = 1; r < rows.size(); ++r) {
    html += "<tr>";
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      html += c == 0 ? fmt::format("<th scope=\"row\">{}</th>", rows[r][c])
                     : fmt::format("<td>{}</td>", rows[r][c]);
    }
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n</div>\n";
}

std::string summary_html(const Document& document) {
  const Result& result = document.result;
  std::string html;
  if (document.diagnosis) {
    const Diagnosis& diagnosis = *document.diagnosis;
    html += fmt::format("<p class=\"verdict\"><strong>{}</strong> {}</p>\n",
                        escaped(diagnosis.verdict), escaped(diagnosis.sentence));
  }
  if (!result.message.empty()) html += fmt::format("<p>{}</p>\n", escaped(result.message));
  Named facts;
  if (!result.status.empty()) facts.emplace_back("Status", escaped(spaced(result.status)));
  if (result.links > 0) facts.emplace_back("Links", std::to_string(result.links));
  if (!std::isnan(result.load_mass)) {
    facts.emplace_back("Load", for_people(result.load_mass) + " kg");
  }
  if (!std::isnan(result.measure_value)) {
    facts.emplace_back(result.measure.empty() ? "Error" : "Error, " + result.measure,
                       length(result.measure_value, result.measure_unit));
  }
  if (!std::isnan(result.measure_validation)) {
    facts.emplace_back("The same, held out",
                       length(result.measure_validation, result.measure_unit));
  }
  html += definitions(facts);
  html += experiments_table(result);
  html += warnings(result);
  if (!result.measure_parts.empty()) {
    std::vector<Cells> rows = {{"Part", "Value"}};
    for (const auto& [name, value] : result.measure_parts) {
      rows.push_back({escaped(name), length(value, result.measure_unit)});
    }
    html += disclosed("Error by parts", table("The error and its parts", rows),
                      result.measure_parts.size() <= 8);
  }
  return html;
}

std::string residuals_html(const Result& result) {
  std::string html;
  for (const Experiment& experiment : result.experiments) {
    const Residuals residuals = residuals_of(experiment);
    if (residuals.points.empty()) continue;
    std::vector<Cells> rows = {
        residuals.angles ? Cells{"Point", "Angle"}
                         : Cells{"Point", "Down", "Side", "Radial (6.7)–(6.10)", "Distance (6.5)"}};
    const auto mean = [](const Row& row) { return for_people(mean_absolute(row), 4); };
    for (std::size_t p = 0; p < residuals.points.size(); ++p) {
      Cells cells = {escaped(residuals.points[p].name)};
      if (residuals.angles) {
        cells.push_back(mean(residuals.angle[p]));
      } else {
        for (const Rows* part :
             {&residuals.down, &residuals.side, &residuals.radial, &residuals.size})
          cells.push_back(mean((*part)[p]));
      }
      rows.push_back(std::move(cells));
    }
    html += disclosed(fmt::format("Mean differences, {}", escaped(experiment.name)),
                      table(fmt::format("Mean over all frames of the size of measured minus "
                                        "simulated, {}; radial: of the distance from the support",
                                        residuals.unit),
                            rows),
                      result.experiments.size() == 1 && rows.size() <= 14);
  }
  return html;
}

std::string parameters_html(const Result& result) {
  if (result.parameters.empty()) return "";
  std::vector<Cells> free = {{"Parameter", "Value", "Unit", "Standard error", "95 % interval",
                              "Verdict", "Start", "Bounds", "Sets"}};
  std::vector<Cells> fixed = {{"Parameter", "Value", "Unit", "Sets"}};
  for (const Parameter& p : result.parameters) {
    const std::string value = for_people(p.value, 5);
    if (!p.free) {
      fixed.push_back(
          {escaped(p.name), value, escaped(plot::readable_unit(p.unit)), escaped(p.sets)});
      continue;
    }
    std::string verdict = p.verdict.empty() ? "–" : escaped(spaced(p.verdict));
    if (!p.note.empty()) verdict += "; " + escaped(p.note);
    const bool bounded = !std::isnan(p.lower) || !std::isnan(p.upper);
    const std::string bounds =
        bounded ? fmt::format("{}\u00a0…\u00a0{}", std::isnan(p.lower) ? "−∞" : for_people(p.lower),
                              std::isnan(p.upper) ? "∞" : for_people(p.upper))
                : "–";
    free.push_back({escaped(p.name), value, escaped(plot::readable_unit(p.unit)),
                    for_people(p.standard_error, 3), interval(p), verdict, for_people(p.start, 5),
                    bounds, escaped(p.sets)});
  }
  std::string html;
  if (free.size() > 1) html += table("Fitted parameters", free);
  if (fixed.size() > 1) {
    const std::string all = table("Parameters that were held fixed", fixed);
    html += free.size() > 1 ? disclosed("Fixed parameters", all, false) : all;
  }
  return html;
}

std::string fit_html(const Result& result) {
  Named facts;
  for (const auto& [name, value] : result.optimiser) {
    if (!value.empty()) facts.emplace_back(name, escaped(spaced(value)));
  }
  std::string html = definitions(facts);
  if (!result.links_study.empty()) {
    std::vector<Cells> rows = {{"Links", "Error", "Gap", "Time"}};
    for (const LinksRow& row : result.links_study) {
      rows.push_back({std::to_string(row.links), length(row.error, result.measure_unit),
                      length(row.gap, result.measure_unit),
                      std::isnan(row.seconds) ? "–" : for_people(row.seconds, 3) + " s"});
    }
    html += table("Refitted with other numbers of links", rows);
  }
  return html;
}

std::string diagnosis_html(const Diagnosis& diagnosis) {
  std::string html = list_html("Where the gap is", diagnosis.where);
  if (diagnosis.missing_force)
    html += list_html("The force that is missing", diagnosis.missing_force->words);
  html += list_html("Notes", diagnosis.notes);
  std::vector<Cells> rows = {
      {"Model", "Links", "Gap, fitted part", "Gap, held out", "Fitted / noise"}};
  for (const Round& round : diagnosis.rounds) {
    std::string name = escaped(round.model);
    const bool said = round.model.find(round.added) != std::string::npos;
    if (!round.added.empty() && !said && round.added != kTooFewLinks)
      name += fmt::format(" + {}", escaped(round.added));
    if (!round.removed.empty() && round.removed != kTooFewLinks)
      name += fmt::format(", no longer {}", escaped(round.removed));
    const double noise = std::isnan(round.gap.floor) ? diagnosis.floor : round.gap.floor;
    rows.push_back({name, round.links > 0 ? std::to_string(round.links) : "–",
                    length(round.gap.fit, diagnosis.unit),
                    length(round.gap.validate, diagnosis.unit),
                    for_people(round.gap.fit / noise, 3)});
  }
  if (rows.size() > 1) {
    const std::string floor =
        std::isnan(diagnosis.floor)
            ? ""
            : fmt::format("; noise {}", length(diagnosis.floor, diagnosis.unit));
    html += table("Gap, round by round" + floor, rows);
  }
  html += links_html(diagnosis);
  html += members_html(diagnosis);
  if (!std::isnan(diagnosis.equality_at_neutral) && !diagnosis.effects.empty())
    html += fmt::format(
        "<p>At the neutral values the new model equals the case's{}.</p>\n",
        diagnosis.equality_at_neutral == 0
            ? " exactly"
            : fmt::format(" to {} (relative)", for_people(diagnosis.equality_at_neutral, 1)));
  html += undecided_html(diagnosis);
  for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k) {
    const Round& round = diagnosis.rounds[k];
    if (round.candidates.empty()) continue;
    const std::string heading =
        fmt::format("Candidates of round {}: what {} leaves unexplained", k + 1,
                    round.model.empty() ? "the model" : escaped(round.model));
    html += disclosed(heading, candidates_table(round, diagnosis.unit), k == 0);
  }
  return html;
}

std::string equations_html(const Result& result) {
  std::string html = fmt::format(
      "<h3>The chain, in sums</h3>\n"
      "<div class=\"scrolls\" tabindex=\"0\" role=\"region\" aria-label=\"Equations of the "
      "chain\">\n{}"
      "</div>\n",
      asset_chain_equations());
  for (const EffectEntry& effect : result.effects) html += group_html(formulas_of(effect));
  if (result.derived.empty()) return html;
  std::string derived;
  for (const Equation& equation : result.derived) derived += equation_html(equation);
  return html + disclosed(fmt::format("As derived from the Lagrangian{}, with {} link{}",
                                      result.effects.empty() ? "" : " and the effects",
                                      result.derived_links, result.derived_links == 1 ? "" : "s"),
                          derived, true);
}

std::string provenance_html(const Result& result) {
  Named facts;
  for (const auto& [name, value] : result.versions) facts.emplace_back(name, escaped(value));
  if (!result.description_hash.empty()) {
    facts.emplace_back(
        "model", fmt::format("{}, {} links, SHA-256 <code>{}</code>", escaped(result.model_id),
                             result.links, escaped(result.description_hash)));
  }
  std::string html = definitions(facts);
  const auto code = [](const std::string& text) {
    return fmt::format("<pre tabindex=\"0\"><code>{}</code></pre>\n", escaped(text));
  };
  if (!result.case_text.empty()) {
    html += disclosed("Case " + escaped(result.case_file), code(result.case_text), true);
  }
  if (!result.description.empty()) {
    html += disclosed("Model description", code(result.description), false);
  }
  for (const Experiment& experiment : result.experiments) {
    if (experiment.statistics.empty()) continue;
    Named numbers;
    for (const auto& [name, value] : experiment.statistics)
      numbers.emplace_back(name, escaped(value));
    html += disclosed("Integration of " + escaped(experiment.name), definitions(numbers), false);
  }
  return html;
}

}  // namespace catena::report
