// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/html_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "identify/report/assets.hpp"
#include "identify/report/equations.hpp"
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
  if (unit == "m" && small) return for_people(1e3 * value) + " mm";
  if (unit == "rad" && small) return for_people(1e3 * value) + " mrad";
  return unit == "1" || unit.empty() ? for_people(value) : for_people(value) + " " + escaped(unit);
}

/// "kg/m²" of "kg/m^2".
std::string readable_unit(const std::string& unit) {
  std::string text = escaped(unit);
  for (const auto& [plain, raised] :
       {std::pair("^2", "²"), std::pair("^3", "³"), std::pair("^4", "⁴")}) {
    for (auto at = text.find(plain); at != std::string::npos; at = text.find(plain)) {
      text.replace(at, 2, raised);
    }
  }
  return text;
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

std::string estimates(const Candidate& candidate) {
  std::vector<std::string> parts;
  for (const auto& [name, value] : candidate.estimate) {
    parts.push_back(fmt::format("{} = {}", escaped(name), for_people(value)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string candidates_table(const Round& round, const std::string& unit) {
  std::vector<Candidate> candidates = round.candidates;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) {
                     return std::isnan(b.score) ? !std::isnan(a.score) : a.score > b.score;
                   });
  std::vector<Cells> rows = {{"Effect", "Score", "Significance", "Survives", "Estimate",
                              "Refit, fitted", "Refit, held out", "Note"}};
  for (const Candidate& c : candidates) {
    std::string name = c.title.empty() ? escaped(c.id) : escaped(c.title);
    std::string note = escaped(c.note);
    if (!c.admissible && note.empty()) note = "not admissible";
    rows.push_back({name, percent(c.score), for_people(c.significance, 2), percent(c.survives),
                    estimates(c), length(c.refit_fit, unit), length(c.refit_validate, unit), note});
  }
  return table(
      "Score: share of the squared residual the effect would remove; survives: share of its "
      "sensitivity that the free parameters cannot imitate",
      rows);
}

std::string equation_html(const Equation& equation) {
  std::string html;
  if (!equation.title.empty()) html += fmt::format("<p>{}:</p>\n", escaped(equation.title));
  if (!equation.mathml.empty()) {
    html +=
        fmt::format("<div class=\"formula scrolls\" tabindex=\"0\">{}</div>\n", equation.mathml);
  } else if (!equation.latex.empty()) {
    html += fmt::format("<pre><code>{}</code></pre>\n", escaped(equation.latex));
  }
  return html;
}

std::string group_html(const EquationGroup& group) {
  std::string html = fmt::format("<h3>{}</h3>\n", escaped(group.heading));
  for (const Equation& equation : group.equations) html += equation_html(equation);
  return html;
}

/// The formulas of the effects that were named or are candidates for the name.
std::string members_html(const Diagnosis& diagnosis) {
  std::string html;
  for (const std::string& member : diagnosis.members) {
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

std::string parameters_html(const Result& result) {
  if (result.parameters.empty()) return "";
  std::vector<Cells> free = {{"Parameter", "Value", "Unit", "Standard error", "95 % interval",
                              "Verdict", "Start", "Bounds", "Sets"}};
  std::vector<Cells> fixed = {{"Parameter", "Value", "Unit", "Sets"}};
  for (const Parameter& p : result.parameters) {
    const std::string value = for_people(p.value, 5);
    if (!p.free) {
      fixed.push_back({escaped(p.name), value, readable_unit(p.unit), escaped(p.sets)});
      continue;
    }
    std::string verdict = p.verdict.empty() ? "–" : escaped(spaced(p.verdict));
    if (!p.note.empty()) verdict += "; " + escaped(p.note);
    const bool bounded = !std::isnan(p.lower) || !std::isnan(p.upper);
    const std::string bounds =
        bounded ? fmt::format("{}\u00a0…\u00a0{}", std::isnan(p.lower) ? "−∞" : for_people(p.lower),
                              std::isnan(p.upper) ? "∞" : for_people(p.upper))
                : "–";
    free.push_back({escaped(p.name), value, readable_unit(p.unit), for_people(p.standard_error, 3),
                    interval(p), verdict, for_people(p.start, 5), bounds, escaped(p.sets)});
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
  for (const auto& [name, value] : result.optimiser)
    facts.emplace_back(name, escaped(spaced(value)));
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
  std::string html;
  if (!diagnosis.where.empty()) {
    html += "<h3>Where the gap is</h3>\n<ul>\n";
    for (const std::string& words : diagnosis.where)
      html += fmt::format("<li>{}</li>\n", escaped(words));
    html += "</ul>\n";
  }
  if (!diagnosis.notes.empty()) {
    html += "<h3>Notes</h3>\n<ul>\n";
    for (const std::string& words : diagnosis.notes) {
      html += fmt::format("<li>{}</li>\n", escaped(words));
    }
    html += "</ul>\n";
  }
  std::vector<Cells> rows = {{"Model", "Links", "Gap, fitted part", "Gap, held out"}};
  for (const Round& round : diagnosis.rounds) {
    std::string name = escaped(round.model);
    const bool said = round.model.find(round.added) != std::string::npos;
    if (!round.added.empty() && !said) name += fmt::format(" + {}", escaped(round.added));
    if (!round.removed.empty()) name += fmt::format(" − {}", escaped(round.removed));
    rows.push_back({name, round.links > 0 ? std::to_string(round.links) : "–",
                    length(round.gap.fit, diagnosis.unit),
                    length(round.gap.validate, diagnosis.unit)});
  }
  if (rows.size() > 1) {
    const std::string floor =
        std::isnan(diagnosis.floor)
            ? ""
            : fmt::format("; noise {}", length(diagnosis.floor, diagnosis.unit));
    html += table("Gap, round by round" + floor, rows);
  }
  html += members_html(diagnosis);
  if (!diagnosis.experiment_that_tells.empty()) {
    html += fmt::format("<h3>What would tell them apart</h3>\n<p>{}</p>\n",
                        escaped(diagnosis.experiment_that_tells));
  }
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
  std::string html = "<h3>The chain</h3>\n";
  if (result.equations.empty()) {
    html += fmt::format(
        "<div class=\"scrolls\" tabindex=\"0\" role=\"region\" aria-label=\"Equations of the "
        "chain\">\n{}"
        "</div>\n",
        asset_chain_equations());
  } else {
    for (const Equation& equation : result.equations) html += equation_html(equation);
  }
  for (const EffectEntry& effect : result.effects) html += group_html(formulas_of(effect));
  return html;
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
