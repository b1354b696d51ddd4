// SPDX-License-Identifier: BSD-3-Clause
//
// What the model leaves unexplained: residuals and their size over time (figure 7.6), by point and
// time, and spectra of measured and simulated positions (figure 7.7).
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/report/report_figures.hpp"
#include "identify/report/residuals.hpp"
#include "identify/report/spectrum.hpp"

namespace catena::report {
namespace {

void add_residual_figure(std::vector<ReportFigure>& figures, const Experiment& experiment,
                         const std::string& family, const std::string& point, Figure figure) {
  if (figure.x.label == "time") mark_parts(experiment, figure);
  const std::string kind = point.empty() ? "" : "Point";
  figures.push_back({std::move(figure), "residuals", family, experiment.name, kind, point});
}

/// The residuals of each point.
void add_by_point(const Experiment& experiment, const Residuals& residuals,
                  std::vector<ReportFigure>& figures) {
  for (std::size_t p = 0; p < residuals.points.size(); ++p) {
    Figure figure;
    figure.title = fmt::format("Residuals of {}", residuals.points[p].name);
    figure.caption = residuals.angles ? "Measured minus simulated."
                                      : "Measured minus simulated; radial: of the distance from "
                                        "the support, (6.7) to (6.10).";
    figure.x = {"time", "s"};
    figure.y = {"residual", residuals.unit};
    if (residuals.angles) {
      figure.series.push_back({"angle", residuals.time, residuals.angle[p], Mark::kLine, 1});
    } else {
      figure.series.push_back({"side", residuals.time, residuals.side[p], Mark::kLine, 1});
      figure.series.push_back({"down", residuals.time, residuals.down[p], Mark::kLine, 2});
      if (!residuals.across.empty())
        figure.series.push_back({"across", residuals.time, residuals.across[p], Mark::kLine, 4});
      figure.series.push_back({"radial", residuals.time, residuals.radial[p], Mark::kLine, 3});
    }
    add_residual_figure(figures, experiment, "residuals", residuals.points[p].name,
                        std::move(figure));
  }
}

/// The middle point, the last and the mean of all over time.
void add_error_over_time(const Experiment& experiment, const Residuals& residuals,
                         std::vector<ReportFigure>& figures) {
  const std::size_t last = residuals.points.size() - 1;
  const std::size_t middle = last / 2;
  Figure figure;
  figure.title = "Error over time";
  figure.caption = residuals.angles ? "Size of the difference between measured and simulated angle."
                                    : "Distance between measured and simulated position.";
  figure.x = {"time", "s"};
  figure.y = {residuals.angles ? "size of residual" : "distance", residuals.unit};
  if (last > 1) {
    figure.series.push_back(
        {residuals.points[middle].name, residuals.time, residuals.size[middle], Mark::kLine, 1});
  }
  if (last > 0) {
    figure.series.push_back(
        {residuals.points[last].name, residuals.time, residuals.size[last], Mark::kLine, 2});
  }
  figure.series.push_back({last > 0 ? "mean of all points" : residuals.points[0].name,
                           residuals.time, mean_over_points(residuals.size, residuals.time.size()),
                           Mark::kLine, 0});
  add_residual_figure(figures, experiment, "error_over_time", "", std::move(figure));
}

void add_map(const Experiment& experiment, const Residuals& residuals,
             std::vector<ReportFigure>& figures) {
  if (residuals.points.size() < 2) return;
  Figure figure;
  figure.title = "Size of the residual by point and time";
  figure.x = {"time", "s"};
  HeatMap map;
  map.x = residuals.time;
  for (const Point& point : residuals.points) map.rows.push_back(point.name);
  map.value = residuals.size;
  map.scale = {residuals.angles ? "size of residual" : "distance", residuals.unit};
  figure.heat_map = std::move(map);
  add_residual_figure(figures, experiment, "residual_map", "", std::move(figure));
}

/// Up to a little above the last frequency that stands out: a thousandth of the largest amplitude.
std::size_t worth_showing(const Row& amplitude) {
  const double largest = *std::max_element(amplitude.begin(), amplitude.end());
  std::size_t last = amplitude.size();
  while (last > 0 && amplitude[last - 1] < 1e-3 * largest) --last;
  return std::min(amplitude.size(), last + last / 4 + 10);
}

void add_spectra(const Experiment& experiment, const Coordinate& coordinate,
                 std::vector<ReportFigure>& figures) {
  const Rows& measured = experiment.measured->values.*coordinate.rows;
  const Rows& predicted = experiment.measured->predicted.*coordinate.rows;
  const Row& time = experiment.measured->values.time;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    const std::string& name = experiment.measured->points[p].name;
    const auto scaled = [](Row row) {
      for (double& value : row) value *= 1e3;
      return row;
    };
    Spectrum of_measured = amplitude_spectrum(time, scaled(measured[p]));
    if (of_measured.frequency.empty()) continue;
    const std::size_t shown = worth_showing(of_measured.amplitude);
    of_measured.frequency.resize(shown);
    of_measured.amplitude.resize(shown);
    Figure figure;
    figure.title = fmt::format("Spectrum of {} of {}", coordinate.name, name);
    figure.caption = "Amplitude, through a Hann window.";
    figure.x = {"frequency", "Hz"};
    figure.y = {"amplitude", std::string("m") + coordinate.unit, true};
    figure.series.push_back(
        {"measured", of_measured.frequency, of_measured.amplitude, Mark::kLineWithPoints, 0});
    if (!predicted.empty()) {
      // Only where a measurement is, so that both have the same gaps.
      Row seen = predicted[p];
      for (std::size_t t = 0; t < seen.size(); ++t) {
        if (std::isnan(measured[p][t])) seen[t] = kAbsent;
      }
      Spectrum simulated = amplitude_spectrum(time, scaled(seen));
      simulated.frequency.resize(std::min(shown, simulated.frequency.size()));
      simulated.amplitude.resize(simulated.frequency.size());
      figure.series.push_back(
          {"simulated", simulated.frequency, simulated.amplitude, Mark::kLine, 1});
    }
    add_residual_figure(figures, experiment, std::string("spectrum_") + coordinate.name, name,
                        std::move(figure));
  }
}

}  // namespace

void add_residual_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  if (!experiment.measured) return;
  const Residuals residuals = residuals_of(experiment);
  if (!residuals.points.empty()) {
    add_by_point(experiment, residuals, figures);
    add_error_over_time(experiment, residuals, figures);
    add_map(experiment, residuals, figures);
  }
  for (const Coordinate& coordinate : kCoordinates) add_spectra(experiment, coordinate, figures);
}

}  // namespace catena::report
