// SPDX-License-Identifier: BSD-3-Clause
#include "identify/report/residuals.hpp"

#include <cmath>

namespace catena::report {
namespace {

constexpr double kMilli = 1e3;

Rows differences(const Rows& measured, const Rows& predicted) {
  Rows rows;
  for (std::size_t p = 0; p < measured.size(); ++p) {
    rows.emplace_back();
    for (std::size_t t = 0; t < measured[p].size(); ++t) {
      rows.back().push_back(kMilli * (measured[p][t] - predicted[p][t]));
    }
  }
  return rows;
}

/// The length of the vector to a point, in the unit of the channels.
double distance(const Rows& side, const Rows& down, const Rows& across, std::size_t point,
                std::size_t time) {
  const double in_plane = std::hypot(side[point][time], down[point][time]);
  return across.empty() ? in_plane : std::hypot(in_plane, across[point][time]);
}

}  // namespace

Residuals residuals_of(const Experiment& experiment) {
  Residuals residuals;
  if (!experiment.measured) return residuals;
  const Measured& measured = *experiment.measured;
  residuals.angles = measured.values.side.empty();
  residuals.unit = residuals.angles ? "mrad" : "mm";
  residuals.time = measured.values.time;
  if ((residuals.angles ? measured.predicted.angle : measured.predicted.side).empty())
    return residuals;
  residuals.points = measured.points;
  if (residuals.angles) {
    residuals.angle = differences(measured.values.angle, measured.predicted.angle);
    for (const Row& row : residuals.angle) {
      residuals.size.emplace_back();
      for (const double value : row) residuals.size.back().push_back(std::abs(value));
    }
    return residuals;
  }
  residuals.side = differences(measured.values.side, measured.predicted.side);
  residuals.down = differences(measured.values.down, measured.predicted.down);
  residuals.across = differences(measured.values.across, measured.predicted.across);
  const auto from_support = [](const Channels& at, std::size_t point, std::size_t time) {
    return distance(at.side, at.down, at.across, point, time);
  };
  for (std::size_t p = 0; p < residuals.side.size(); ++p) {
    residuals.size.emplace_back();
    residuals.radial.emplace_back();
    for (std::size_t t = 0; t < residuals.time.size(); ++t) {
      residuals.size.back().push_back(
          distance(residuals.side, residuals.down, residuals.across, p, t));
      residuals.radial.back().push_back(
          kMilli * (from_support(measured.values, p, t) - from_support(measured.predicted, p, t)));
    }
  }
  return residuals;
}

Row mean_over_points(const Rows& rows, std::size_t times) {
  Row mean(times, kAbsent);
  for (std::size_t t = 0; t < times; ++t) {
    double sum = 0;
    int seen = 0;
    for (const Row& row : rows) {
      if (std::isnan(row[t])) continue;
      sum += row[t];
      ++seen;
    }
    if (seen > 0) mean[t] = sum / seen;
  }
  return mean;
}

double mean_absolute(const Row& row) {
  double sum = 0;
  int seen = 0;
  for (const double value : row) {
    if (std::isnan(value)) continue;
    sum += std::abs(value);
    ++seen;
  }
  return seen == 0 ? kAbsent : sum / seen;
}

double root_mean_square(const Row& row) {
  double sum = 0;
  int seen = 0;
  for (const double value : row) {
    if (std::isnan(value)) continue;
    sum += value * value;
    ++seen;
  }
  return seen == 0 ? kAbsent : std::sqrt(sum / seen);
}

}  // namespace catena::report
