// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/report_figures.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace catena::report {
namespace {

/// Letters and digits of a name, the rest as single underscores.
std::string slug(const std::string& name) {
  std::string text;
  for (const char c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0) {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    } else if (!text.empty() && text.back() != '_') {
      text += '_';
    }
  }
  while (!text.empty() && text.back() == '_') text.pop_back();
  return text;
}

void name_files(std::vector<ReportFigure>& figures, bool several_experiments) {
  std::set<std::string> taken;
  std::map<std::string, int> last;  // of the numbers that a name was given: many may have it
  for (ReportFigure& entry : figures) {
    std::string id = entry.family;
    if (several_experiments && !entry.experiment.empty()) id += "-" + slug(entry.experiment);
    if (!entry.variant.empty()) id += "-" + slug(entry.variant);
    std::string distinct = id;
    while (!taken.insert(distinct).second)
      distinct = fmt::format("{}-{}", id, ++last.try_emplace(id, 1).first->second);
    entry.figure.id = distinct;
  }
}

}  // namespace

void mark_parts(const Experiment& experiment, Figure& figure) {
  if (!std::isnan(experiment.fit_until))
    figure.rules.push_back({true, experiment.fit_until, "held out"});
  if (!std::isnan(experiment.sealed_from))
    figure.rules.push_back({true, experiment.sealed_from, "sealed"});
}

std::vector<ReportFigure> report_figures(const Document& document) {
  std::vector<ReportFigure> figures;
  if (document.diagnosis) add_diagnosis_figures(*document.diagnosis, figures);
  for (const Experiment& experiment : document.result.experiments) {
    add_motion_figures(experiment, figures);
  }
  for (const Experiment& experiment : document.result.experiments) {
    add_force_figures(experiment, figures);
  }
  for (const Experiment& experiment : document.result.experiments) {
    add_residual_figures(experiment, figures);
    add_noise_figures(experiment, figures);
  }
  add_fit_figures(document.result, figures);
  for (const Experiment& experiment : document.result.experiments) {
    add_energy_figures(experiment, figures);
  }
  name_files(figures, document.result.experiments.size() > 1);
  return figures;
}

}  // namespace catena::report
