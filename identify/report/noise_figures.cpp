// SPDX-License-Identifier: BSD-3-Clause
//
// Whether the residuals are noise: how they go on from frame to frame, and their distribution beside
// the normal one.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/normal_quantile.hpp"
#include "identify/report/report_figures.hpp"
#include "identify/report/residuals.hpp"

namespace catena::report {
namespace {

constexpr std::size_t kFewestValues = 20;  // values, for either figure
constexpr std::size_t kMostLags = 60;
constexpr std::size_t kQuantiles = 200;

struct Channel {
  std::string name;
  Row fitted;  ///< mm or mrad, by frame; NaN: not seen
  int colour;
};

/// The fitted part of each channel of a point.
std::vector<Channel> channels_of(const Experiment& experiment, const Residuals& residuals,
                                 std::size_t point) {
  std::size_t frames = residuals.time.size();
  if (!std::isnan(experiment.fit_until))
    while (frames > 0 && residuals.time[frames - 1] > experiment.fit_until) --frames;
  const auto head = [&](const Row& row) {
    return Row(row.begin(), row.begin() + static_cast<std::ptrdiff_t>(frames));
  };
  if (residuals.angles) return {{"angle", head(residuals.angle[point]), 1}};
  std::vector<Channel> channels = {{"side", head(residuals.side[point]), 1},
                                   {"down", head(residuals.down[point]), 2}};
  if (!residuals.across.empty()) channels.push_back({"across", head(residuals.across[point]), 3});
  return channels;
}

Row seen(const Row& row) {
  Row values;
  std::copy_if(row.begin(), row.end(), std::back_inserter(values),
               [](double value) { return !std::isnan(value); });
  return values;
}

/// Of the lags 0, 1, ...: mean product of residuals so many frames apart, over their mean square.
Row autocorrelation(const Row& row) {
  const auto mean_product = [&](std::size_t lag) {
    double sum = 0, count = 0;
    for (std::size_t k = 0; k + lag < row.size(); ++k) {
      const double product = row[k] * row[k + lag];
      if (std::isnan(product)) continue;
      sum += product;
      count += 1;
    }
    return count > 0 ? sum / count : kAbsent;
  };
  Row result;
  for (std::size_t lag = 0; lag <= std::min(kMostLags, row.size() / 4); ++lag)
    result.push_back(mean_product(lag) / mean_product(0));
  return result;
}

/// The value below which a normal variable of variance 1 falls with this probability.
double normal_quantile(double probability) {
  double low = -10, high = 10;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::numbers::sqrt2) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Figure autocorrelation_of(const std::string& point, const std::vector<Channel>& channels) {
  Figure figure;
  figure.title = fmt::format("Autocorrelation of the residuals of {}", point);
  figure.caption =
      "Of the fitted part. White noise stays between the lines at 19 of 20 lags but the first.";
  figure.x = {"lag", "frames"};
  figure.y = {"autocorrelation", "1"};
  for (const Channel& channel : channels) {
    const double size = static_cast<double>(seen(channel.fitted).size());
    if (size < kFewestValues) continue;
    Series series{
        channel.name, {}, autocorrelation(channel.fitted), Mark::kLineWithPoints, channel.colour};
    for (std::size_t lag = 0; lag < series.y.size(); ++lag)
      series.x.push_back(static_cast<double>(lag));
    if (figure.rules.empty())
      for (const double side : {-1.0, 1.0})
        figure.rules.push_back(
            {false, side * kNormalQuantile95 / std::sqrt(size), side > 0 ? "white noise" : ""});
    figure.series.push_back(std::move(series));
  }
  return figure;
}

Figure quantiles_of(const std::string& point, const std::string& unit,
                    const std::vector<Channel>& channels) {
  Figure figure;
  figure.title = fmt::format("Quantiles of the residuals of {}", point);
  figure.caption =
      "Of the fitted part, beside those of a normal distribution of the same mean square (the "
      "straight lines): noise with heavy tails, or outliers, leave them at the ends.";
  figure.x = {"normal quantile", "1"};
  figure.y = {"residual", unit};
  for (const Channel& channel : channels) {
    Row sorted = seen(channel.fitted);
    if (sorted.size() < kFewestValues) continue;
    std::sort(sorted.begin(), sorted.end());
    const std::size_t shown = std::min(kQuantiles, sorted.size());
    Series series{channel.name, {}, {}, Mark::kPoints, channel.colour};
    for (std::size_t i = 0; i < shown; ++i) {
      // The first and the last value are always among them.
      const std::size_t rank = i * (sorted.size() - 1) / (shown - 1);
      series.x.push_back(
          normal_quantile((static_cast<double>(rank) + 0.5) / static_cast<double>(sorted.size())));
      series.y.push_back(sorted[rank]);
    }
    const double size = root_mean_square(sorted);
    const Row ends = {series.x.front(), series.x.back()};
    figure.series.push_back({fmt::format("{}, normal", channel.name),
                             ends,
                             {size * ends[0], size * ends[1]},
                             Mark::kLine,
                             channel.colour});
    figure.series.push_back(std::move(series));
  }
  return figure;
}

}  // namespace

void add_noise_figures(const Experiment& experiment, std::vector<ReportFigure>& figures) {
  if (!experiment.measured) return;
  const Residuals residuals = residuals_of(experiment);
  const auto add = [&](const std::string& family, const std::string& point, Figure figure) {
    if (!figure.series.empty())
      figures.push_back({std::move(figure), "residuals", family, experiment.name, "Point", point});
  };
  for (const std::string family : {"autocorrelation", "quantiles"})
    for (std::size_t p = 0; p < residuals.points.size(); ++p) {
      const std::string& point = residuals.points[p].name;
      const std::vector<Channel> channels = channels_of(experiment, residuals, p);
      add(family, point,
          family == "quantiles" ? quantiles_of(point, residuals.unit, channels)
                                : autocorrelation_of(point, channels));
    }
}

}  // namespace catena::report
