// SPDX-License-Identifier: BSD-3-Clause
//
// The gap closing: its size round by round, how the candidates scored, before and after each
// effect, and the force that would close what is left.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/normal_quantile.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/report/residuals.hpp"
#include "identify/report/spectrum.hpp"

namespace catena::report {
namespace {

void add_diagnosis_figure(std::vector<ReportFigure>& figures, const std::string& family,
                          Figure figure, const std::string& kind = "",
                          const std::string& variant = "", const std::string& experiment = "") {
  figures.push_back({std::move(figure), "diagnosis", family, experiment, kind, variant});
}

std::string milli(const std::string& unit) { return unit == "rad" ? "mrad" : "mm"; }

std::string name_of(const Diagnosis& diagnosis, std::size_t round) {
  const Round& at = diagnosis.rounds[round];
  if (at.added == kTooFewLinks || at.removed == kTooFewLinks)
    return fmt::format("{} links", at.links);
  if (!at.added.empty()) return fmt::format("with {}", at.added);
  if (!at.removed.empty()) return fmt::format("without {}", at.removed);
  return round == 0 ? "baseline" : at.model;
}

void add_gap(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  if (diagnosis.rounds.empty()) return;
  Figure figure;
  figure.title = "Gap, round by round";
  figure.caption =
      "Root mean square of the residuals on the part that was fitted, on the part held out, by "
      "which "
      "effects were chosen, and on the sealed part, which no choice has seen.";
  figure.x.label = "model";
  figure.y = {"gap", milli(diagnosis.unit)};
  for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k)
    figure.x.categories.push_back(name_of(diagnosis, k));
  int colour = 0;
  for (const auto& [name, part] : {std::pair{"fitted part", &Gap::fit},
                                   {"held out", &Gap::validate},
                                   {"sealed", &Gap::sealed}}) {
    Series series{name, {}, {}, Mark::kLineWithPoints, ++colour};
    for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k) {
      series.x.push_back(static_cast<double>(k + 1));
      series.y.push_back(1e3 * (diagnosis.rounds[k].gap.*part));
    }
    const bool known = std::any_of(series.y.begin(), series.y.end(),
                                   [](double value) { return !std::isnan(value); });
    if (known) figure.series.push_back(std::move(series));
  }
  figure.rules.push_back({false, 0, ""});
  if (!std::isnan(diagnosis.noise)) figure.rules.push_back({false, 1e3 * diagnosis.noise, "noise"});
  add_diagnosis_figure(figures, "gap", std::move(figure));
}

/// A bar for what is left in each part that was not fitted, and what was expected as lines.
void add_predictions(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  if (diagnosis.predictions.empty()) return;
  Figure figure;
  figure.title = "Predictions of the final model";
  figure.caption =
      "Root mean square of what is left where nothing was fitted, and what noise, the misfit of "
      "the fitted part and the errors of the fitted unknowns let one expect. Laws that are a "
      "tenth off there may leave more.";
  figure.x = {"gap", milli(diagnosis.unit)};
  figure.y.label = "";
  figure.y_downwards = true;
  Series left{"left", {}, {}, Mark::kBars, 1};
  Series expected{"expected, interval of 95 %", {}, {}, Mark::kLine, 0};
  Series of_laws{"with laws a tenth off", {}, {}, Mark::kLine, 2};
  for (const PredictionError& prediction : diagnosis.predictions) {
    figure.y.categories.push_back(prediction.part == "sealed" ? "sealed" : "held out");
    const auto row = static_cast<double>(figure.y.categories.size());
    left.x.push_back(1e3 * prediction.observed);
    left.y.push_back(row);
    const auto& [low, high] = prediction.expected;
    for (const auto& [line, from, to] :
         {std::tuple{&expected, low, high},
          std::tuple{&of_laws, high, prediction.with_errors_of_laws}}) {
      if (!(from < to)) continue;
      for (const double end : {from, to, kAbsent}) {
        line->x.push_back(1e3 * end);
        line->y.push_back(row);
      }
    }
  }
  figure.rules = {{true, 0, ""}};
  for (Series* series : {&left, &expected, &of_laws})
    if (!series->x.empty()) figure.series.push_back(std::move(*series));
  add_diagnosis_figure(figures, "predictions", std::move(figure));
}

/// "Root mean square without effects: 44.4 mrad fitted, 313 mrad held out; with them: ..."
std::string sizes_in_words(const Diagnosis& diagnosis) {
  const Round* without = nullptr;
  for (const Round& round : diagnosis.rounds)
    if (round.effects.empty()) without = &round;
  if (without == nullptr) return "";
  const auto size = [&](const Gap& gap) {
    std::string words = fmt::format("{:.3g} {} fitted", 1e3 * gap.fit, milli(diagnosis.unit));
    if (!std::isnan(gap.validate))
      words += fmt::format(", {:.3g} {} held out", 1e3 * gap.validate, milli(diagnosis.unit));
    return words;
  };
  return fmt::format(" Root mean square without effects: {}; with them: {}.", size(without->gap),
                     size(diagnosis.rounds.back().gap));
}

/// A bar for each share, its interval as a line; that of the held-out part below.
void add_shares(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  if (diagnosis.shares.empty()) return;
  Figure figure;
  figure.title = "Shares of the misfit";
  figure.caption =
      "What each effect explains of the squared misfit that the model without effects leaves, "
      "averaged over the orders in which effects may be added, and what is left with all of them." +
      sizes_in_words(diagnosis);
  figure.x = {"share", "%"};
  figure.y.label = "";
  figure.y_downwards = true;
  Series fitted{"fitted part", {}, {}, Mark::kBars, 1};
  Series held_out{"held out", {}, {}, Mark::kBars, 2};
  Series intervals{"interval of 95 %", {}, {}, Mark::kLine, 0};
  const auto draw = [&](Series& bars, double row, double share,
                        const std::optional<Interval>& interval) {
    bars.x.push_back(100 * share);
    bars.y.push_back(row);
    if (!interval) return;
    for (const double end : {interval->low, interval->high, kAbsent}) {
      intervals.x.push_back(100 * end);
      intervals.y.push_back(row);
    }
  };
  for (std::size_t i = 0; i < diagnosis.shares.size(); ++i) {
    const Share& share = diagnosis.shares[i];
    const double row = static_cast<double>(i + 1);
    figure.y.categories.push_back(share.name);
    draw(fitted, row - kBarThickness / 2, share.fit, share.fit_interval);
    if (share.validate_interval)
      draw(held_out, row + kBarThickness / 2, share.validate, share.validate_interval);
  }
  figure.rules = {{true, 0, ""}, {true, 100, ""}};
  for (Series* series : {&fitted, &held_out, &intervals})
    if (!series->x.empty()) figure.series.push_back(std::move(*series));
  add_diagnosis_figure(figures, "shares", std::move(figure));
}

void add_scores(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  constexpr std::size_t kShown = 12;
  for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k) {
    std::vector<Candidate> best;
    for (const Candidate& candidate : diagnosis.rounds[k].candidates) {
      if (!std::isnan(candidate.score)) best.push_back(candidate);
    }
    if (best.empty()) continue;
    std::stable_sort(best.begin(), best.end(),
                     [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
    if (best.size() > kShown) best.resize(kShown);
    Figure figure;
    figure.title = fmt::format("Candidates: {}", name_of(diagnosis, k));
    figure.caption = "Share of the squared residual that each would remove, by the score test.";
    figure.x = {"score", "%"};
    figure.y.label = "";
    figure.y_downwards = true;
    Series admissible{"admissible", {}, {}, Mark::kPoints, 3};
    Series refused{"estimate on the wrong side of a bound", {}, {}, Mark::kPoints, 2};
    for (std::size_t c = 0; c < best.size(); ++c) {
      figure.y.categories.push_back(best[c].id);
      Series& series = best[c].admissible ? admissible : refused;
      series.x.push_back(100 * best[c].score);
      series.y.push_back(static_cast<double>(c + 1));
    }
    figure.rules.push_back({true, 0, ""});
    figure.rules.push_back({true, 100, ""});
    if (!admissible.x.empty()) figure.series.push_back(std::move(admissible));
    if (!refused.x.empty()) figure.series.push_back(std::move(refused));
    add_diagnosis_figure(figures, "scores", std::move(figure), "Round", name_of(diagnosis, k));
  }
}

double largest(const Rows& rows) {
  double most = 0;
  for (const Row& row : rows) {
    for (const double value : row) {
      if (std::isfinite(value)) most = std::max(most, value);
    }
  }
  return most;
}

/// Root mean square over the points of the residuals' spectra.
Spectrum mean_spectrum(const Residuals& residuals) {
  Spectrum mean;
  int count = 0;
  for (const Rows* rows : {&residuals.side, &residuals.down, &residuals.angle}) {
    for (const Row& row : *rows) {
      const Spectrum one = amplitude_spectrum(residuals.time, row);
      if (mean.frequency.empty()) mean = {one.frequency, Row(one.frequency.size(), 0.0)};
      if (one.frequency.size() != mean.frequency.size()) continue;  // seen for a shorter time
      for (std::size_t k = 0; k < one.amplitude.size(); ++k) {
        mean.amplitude[k] += one.amplitude[k] * one.amplitude[k];
      }
      ++count;
    }
  }
  for (double& value : mean.amplitude) value = std::sqrt(value / std::max(1, count));
  return mean;
}

/// Before and after one change, for one experiment.
class BeforeAfter {
 public:
  BeforeAfter(std::string change, const Experiment& before, const Experiment& after,
              std::vector<ReportFigure>& figures)
      : change_(std::move(change)),
        experiment_(after),
        before_(residuals_of(before)),
        after_(residuals_of(after)),
        predicted_before_(before.measured->predicted),
        figures_(figures) {}

  void add_all() {
    if (before_.points.empty() || before_.points.size() != after_.points.size()) return;
    add_error();
    add_position();
    add_map("before", before_);
    add_map("after", after_);
    add_spectrum();
  }

 private:
  void put(const std::string& family, Figure figure) {
    add_diagnosis_figure(figures_, family, std::move(figure), "Change", change_, experiment_.name);
  }

  std::string quantity() const { return after_.angles ? "size of residual" : "distance"; }

  void add_error() {
    Figure figure;
    figure.title = "Error over time, before and after";
    figure.caption = fmt::format("Mean over the points; after: {}.", change_);
    figure.x = {"time", "s"};
    figure.y = {quantity(), after_.unit};
    figure.series.push_back({"before", before_.time,
                             mean_over_points(before_.size, before_.time.size()), Mark::kLine, 2});
    figure.series.push_back(
        {"after", after_.time, mean_over_points(after_.size, after_.time.size()), Mark::kLine, 1});
    mark_parts(experiment_, figure);
    put("before_after_error", std::move(figure));
  }

  /// The point that was worst before.
  void add_position() {
    std::size_t worst = 0;
    double most = -1;
    for (std::size_t p = 0; p < before_.size.size(); ++p) {
      const double size = root_mean_square(before_.size[p]);
      if (size > most) {
        most = size;
        worst = p;
      }
    }
    const Measured& measured = *experiment_.measured;
    const bool angles = after_.angles;
    const auto rows = [&](const Channels& channels) -> const Row& {
      return (angles ? channels.angle : channels.side)[worst];
    };
    Figure figure;
    figure.title = fmt::format("{} of {}, before and after", angles ? "Angle" : "Side",
                               measured.points[worst].name);
    figure.caption = fmt::format("The point that was worst before; after: {}.", change_);
    figure.x = {"time", "s"};
    figure.y = {angles ? "angle" : "side", angles ? "rad" : "m"};
    figure.series.push_back(
        {"measured", measured.values.time, rows(measured.values), Mark::kPoints, 0});
    figure.series.push_back(
        {"before", predicted_before_.time, rows(predicted_before_), Mark::kLine, 2});
    figure.series.push_back(
        {"after", measured.predicted.time, rows(measured.predicted), Mark::kLine, 1});
    mark_parts(experiment_, figure);
    put("before_after_position", std::move(figure));
  }

  void add_map(const std::string& when, const Residuals& residuals) {
    if (residuals.points.size() < 2) return;
    Figure figure;
    figure.title = fmt::format("Residual by point and time, {}", when);
    figure.caption = fmt::format("After: {}. Both share one scale of colours.", change_);
    figure.x = {"time", "s"};
    HeatMap map;
    map.x = residuals.time;
    for (const Point& point : residuals.points) map.rows.push_back(point.name);
    map.value = residuals.size;
    map.scale = {quantity(), residuals.unit};
    map.maximum = std::max(largest(before_.size), largest(after_.size));
    figure.heat_map = std::move(map);
    put("residual_map_" + when, std::move(figure));
  }

  void add_spectrum() {
    const Spectrum before = mean_spectrum(before_);
    const Spectrum after = mean_spectrum(after_);
    if (before.frequency.empty()) return;
    Figure figure;
    figure.title = "Spectrum of the residuals, before and after";
    figure.caption = fmt::format(
        "Root mean square over the channels, through a Hann window; after: {}.", change_);
    figure.x = {"frequency", "Hz"};
    figure.y = {"amplitude", after_.unit, true};
    figure.series.push_back({"before", before.frequency, before.amplitude, Mark::kLine, 2});
    figure.series.push_back({"after", after.frequency, after.amplitude, Mark::kLine, 1});
    put("before_after_spectrum", std::move(figure));
  }

  std::string change_;
  const Experiment& experiment_;
  Residuals before_, after_;
  const Channels& predicted_before_;
  std::vector<ReportFigure>& figures_;
};

void add_before_after(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  std::vector<std::size_t> rounds;  // with a result
  for (std::size_t k = 0; k < diagnosis.rounds.size(); ++k)
    if (diagnosis.rounds[k].result) rounds.push_back(k);
  const auto compare = [&](const std::string& change, std::size_t before, std::size_t after) {
    for (const Experiment& experiment : diagnosis.rounds[after].result->experiments) {
      const auto& earlier = diagnosis.rounds[before].result->experiments;
      const auto same = std::find_if(earlier.begin(), earlier.end(), [&](const Experiment& e) {
        return e.name == experiment.name;
      });
      if (same == earlier.end() || !same->measured || !experiment.measured) continue;
      BeforeAfter(change, *same, experiment, figures).add_all();
    }
  };
  if (rounds.size() > 2) compare("all changes", rounds.front(), rounds.back());
  for (std::size_t k = 1; k < rounds.size(); ++k)
    compare(name_of(diagnosis, rounds[k]), rounds[k - 1], rounds[k]);
}

/// Of "side density".
std::string direction_of(const ForceHistory& history) {
  for (const char* const direction : {"side", "across"})
    if (history.quantity.starts_with(direction)) return direction;
  return "down";
}

/// A density over place and time.
Figure density_map(const ForceHistory& history, double maximum) {
  Figure figure;
  figure.title = fmt::format("Missing force: {} by arc length and time", history.quantity);
  figure.caption =
      fmt::format("Positive values push {}. The maps of all directions share one scale of colours.",
                  direction_of(history) == "down"   ? "down"
                  : direction_of(history) == "side" ? "to the side that counts as positive"
                                                    : "across, the way that counts as positive");
  figure.x = {"time", "s"};
  HeatMap& map = figure.heat_map.emplace();
  map.x = history.time;
  map.rows = history.rows;
  map.value = history.value;
  map.scale = {history.quantity, history.unit};
  map.is_signed = true;
  map.maximum = maximum;
  return figure;
}

/// Values over time, each with the ends of its interval of 95 % as thinner company.
Figure bands(const ForceHistory& history, const std::vector<std::size_t>& rows,
             const std::string& title) {
  Figure figure;
  figure.title = title;
  figure.caption = "Estimate, and the ends of its interval of 95 %.";
  figure.x = {"time", "s"};
  figure.y = {"force", history.unit};
  figure.rules = {{false, 0, ""}};
  int colour = 1;
  for (const std::size_t i : rows) {
    figure.series.push_back({history.rows[i], history.time, history.value[i], Mark::kLine, colour});
    Series ends{history.rows[i] + ", 95 %", {}, {}, Mark::kLine, colour + 3};
    for (const double sign : {-kNormalQuantile95, kNormalQuantile95}) {
      for (std::size_t k = 0; k < history.time.size(); ++k) {
        ends.x.push_back(history.time[k]);
        ends.y.push_back(history.value[i][k] + sign * history.deviation[i][k]);
      }
      ends.x.push_back(kAbsent);
      ends.y.push_back(kAbsent);
    }
    figure.series.push_back(std::move(ends));
    ++colour;
  }
  return figure;
}

std::size_t strongest_row(const ForceHistory& history) {
  std::size_t strongest = 0;
  for (std::size_t i = 1; i < history.value.size(); ++i)
    if (root_mean_square(history.value[i]) > root_mean_square(history.value[strongest]))
      strongest = i;
  return strongest;
}

/// Where, when, which way and how strong.
void add_missing_force(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  if (!diagnosis.missing_force || !diagnosis.missing_force->found) return;
  const MissingForce& force = *diagnosis.missing_force;
  double maximum = 0;
  for (const ForceHistory& history : force.densities)
    maximum = std::max(maximum, largest(history.value));
  if (!force.places.empty()) {
    Figure figure;
    figure.title = "Missing force: a force at one place alone";
    figure.caption =
        "Log of the odds for a force that acts there and nowhere else, against no force.";
    figure.x = {"arc length", "m"};
    figure.y = {"log evidence", "1"};
    Series series{"force at one place", {}, {}, Mark::kLineWithPoints, 1};
    for (const ForcePlace& place : force.places) {
      if (place.arc_length <= 0) continue;  // the torque at the support
      series.x.push_back(place.arc_length);
      series.y.push_back(place.log_evidence);
    }
    figure.series.push_back(std::move(series));
    if (force.best && force.best->arc_length > 0)
      figure.rules.push_back({true, force.best->arc_length, "best"});
    add_diagnosis_figure(figures, "missing_force_place", std::move(figure));
  }
  if (force.one_place)
    for (const ForceHistory& history : force.at_best) {
      std::vector<std::size_t> rows(history.rows.size());
      for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = i;
      add_diagnosis_figure(figures, "missing_force_bands",
                           bands(history, rows, fmt::format("Missing {}", history.quantity)), "",
                           "", history.experiment);
    }
  for (const ForceHistory& history : force.densities) {
    add_diagnosis_figure(figures, "missing_force_" + direction_of(history),
                         density_map(history, maximum), "", "", history.experiment);
    if (force.one_place) continue;
    const std::size_t row = strongest_row(history);
    add_diagnosis_figure(
        figures, "missing_force_bands_" + direction_of(history),
        bands(history, {row},
              fmt::format("Missing force: {} at {}", history.quantity, history.rows[row])),
        "", "", history.experiment);
  }
}

}  // namespace

void add_diagnosis_figures(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures) {
  add_gap(diagnosis, figures);
  add_predictions(diagnosis, figures);
  add_shares(diagnosis, figures);
  add_before_after(diagnosis, figures);
  add_scores(diagnosis, figures);
  add_missing_force(diagnosis, figures);
}

}  // namespace catena::report
