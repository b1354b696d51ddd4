// SPDX-License-Identifier: BSD-3-Clause
//
// How the fit went: error against step (figure 7.3), waterfall of a multi-start, profile
// likelihoods, correlations, and the error against the number of links.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/report/readable.hpp"
#include "identify/report/report_figures.hpp"

namespace catena::report {
namespace {

void add_fit_figure(std::vector<ReportFigure>& figures, const std::string& family, Figure figure,
                    const std::string& parameter = "") {
  const std::string kind = parameter.empty() ? "" : "Parameter";
  figures.push_back({std::move(figure), "fit", family, "", kind, parameter});
}

/// Worth a logarithmic axis: positive and over more than a decade.
bool spans_decade(const Row& row) {
  double least = INFINITY;
  double most = 0;
  for (const double value : row) {
    if (std::isnan(value)) continue;
    least = std::min(least, value);
    most = std::max(most, value);
  }
  return least > 0 && most > 10 * least;
}

Row running_least(const Row& row) {
  Row least = row;
  for (std::size_t k = 1; k < least.size(); ++k) least[k] = std::fmin(least[k], least[k - 1]);
  return least;
}

std::vector<const Parameter*> free_parameters(const Result& result) {
  std::vector<const Parameter*> free;
  for (const Parameter& parameter : result.parameters) {
    if (parameter.free) free.push_back(&parameter);
  }
  return free;
}

void add_history(const Result& result, std::vector<ReportFigure>& figures) {
  if (!result.optimiser || result.optimiser->history.step.empty()) return;
  const History& history = result.optimiser->history;
  const std::string unit = result.measure ? result.measure->unit : "";
  Figure figure;
  figure.title = "Error against step of the optimiser";
  figure.x = {"step", "1"};
  figure.y = {result.measure ? result.measure->name : "error", unit, spans_decade(history.error)};
  std::replace(figure.y.label.begin(), figure.y.label.end(), '_', ' ');
  const Row least = running_least(history.error);
  if (least != history.error) {
    figure.series.push_back({"this step", history.step, history.error, Mark::kPoints, 1});
  }
  figure.series.push_back({"best so far", history.step, least, Mark::kLine, 0});
  add_fit_figure(figures, "error_by_step", std::move(figure));

  const auto free = free_parameters(result);
  for (std::size_t k = 0; k < std::min(free.size(), history.parameters.size()); ++k) {
    Figure path;
    path.title = fmt::format("{} against step of the optimiser", free[k]->name);
    path.x = {"step", "1"};
    path.y = {free[k]->name, readable_unit(free[k]->unit), spans_decade(history.parameters[k])};
    path.series.push_back({free[k]->name, history.step, history.parameters[k], Mark::kLine, 1});
    add_fit_figure(figures, "parameter_by_step", std::move(path), free[k]->name);
  }
}

void add_waterfall(const Result& result, std::vector<ReportFigure>& figures) {
  if (result.starts.size() < 2) return;
  Row errors;
  std::size_t failed = 0;
  for (const Start& start : result.starts) {
    if (std::isfinite(start.error)) {
      errors.push_back(start.error);
    } else {
      ++failed;
    }
  }
  std::sort(errors.begin(), errors.end());
  Row rank(errors.size());
  for (std::size_t k = 0; k < rank.size(); ++k) rank[k] = static_cast<double>(k + 1);
  Figure figure;
  figure.title = "Waterfall: where each start ended";
  figure.caption = fmt::format(
      "{} starts in the order of their errors{}. A flat beginning says that many starts found the "
      "same answer.",
      result.starts.size(),
      failed == 0 ? "" : fmt::format(", {} failed and are not shown", failed));
  figure.x = {"rank of the start", "1"};
  figure.y = {"error", result.measure ? result.measure->unit : "", spans_decade(errors)};
  figure.series.push_back({"starts", rank, errors, Mark::kLineWithPoints, 1});
  add_fit_figure(figures, "waterfall", std::move(figure));
}

void add_profiles(const Result& result, std::vector<ReportFigure>& figures) {
  for (const Profile& profile : result.profiles) {
    const auto parameter =
        std::find_if(result.parameters.begin(), result.parameters.end(),
                     [&](const Parameter& p) { return p.name == profile.parameter; });
    const bool known = parameter != result.parameters.end();
    Figure figure;
    figure.title = fmt::format("Profile likelihood of {}", profile.parameter);
    std::string verdict = profile.verdict;
    std::replace(verdict.begin(), verdict.end(), '_', ' ');
    figure.caption = fmt::format(
        "Twice what the log likelihood loses when the parameter is held and the others are "
        "refitted{}.",
        verdict.empty() ? "" : "; verdict: " + verdict);
    figure.x = {profile.parameter, known ? readable_unit(parameter->unit) : "",
                spans_decade(profile.value)};
    figure.y = {"−2 Δ log likelihood", "1"};
    figure.series.push_back({"profile", profile.value, profile.cost, Mark::kLineWithPoints, 1});
    if (!std::isnan(profile.threshold)) {
      figure.rules.push_back({false, profile.threshold, "95 %"});
    }
    if (known && std::isfinite(parameter->value)) {
      figure.rules.push_back({true, parameter->value, "estimate"});
    }
    add_fit_figure(figures, "profile", std::move(figure), profile.parameter);
  }
}

void add_correlation(const Result& result, std::vector<ReportFigure>& figures) {
  const auto free = free_parameters(result);
  if (result.correlation.size() < 2 || result.correlation.size() != free.size()) return;
  Figure figure;
  figure.title = "Correlation of the estimates";
  HeatMap map;
  for (std::size_t k = 0; k < free.size(); ++k) {
    map.x.push_back(static_cast<double>(k + 1));
    map.rows.push_back(free[k]->name);
  }
  figure.x.label = "parameter";
  figure.x.categories = map.rows;
  map.value = result.correlation;
  map.scale = {"correlation", "1"};
  map.is_signed = true;
  map.maximum = 1;
  figure.heat_map = std::move(map);
  add_fit_figure(figures, "correlation", std::move(figure));
}

void add_links_study(const Result& result, std::vector<ReportFigure>& figures) {
  if (result.links_study.size() < 2) return;
  Row links;
  Row errors;
  for (const LinksRow& row : result.links_study) {
    links.push_back(row.links);
    errors.push_back(row.error);
  }
  Figure figure;
  figure.title = "Error against number of links";
  figure.x = {"links", "1", true};
  figure.y = {"error", result.measure ? result.measure->unit : "", spans_decade(errors)};
  figure.series.push_back({"refitted", links, errors, Mark::kLineWithPoints, 1});
  add_fit_figure(figures, "error_by_links", std::move(figure));
}

}  // namespace

void add_fit_figures(const Result& result, std::vector<ReportFigure>& figures) {
  add_history(result, figures);
  add_waterfall(result, figures);
  add_profiles(result, figures);
  add_correlation(result, figures);
  add_links_study(result, figures);
}

}  // namespace catena::report
