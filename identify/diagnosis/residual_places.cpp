// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/residual_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/residual_frequencies.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr Index kFewestFramesOfPlaces = 8;
constexpr double kClearlyLargest = 1.3;  // over the rms of all points
constexpr double kBySpeed = 1.25;        // ratio of the rms at high and at low speed
constexpr double kByTime = 1.5;          // ratio of the rms after and before a moment

/// Mean of the squares of the values that are not NaN; 0 if there are none.
double mean_square(const MatrixXd& values) {
  double sum = 0, count = 0;
  for (const double value : values.reshaped())
    if (!std::isnan(value)) sum += value * value, count += 1;
  return count > 0 ? sum / count : 0;
}

std::string point_name(const Experiment& experiment, std::size_t point) {
  const PointSpec& spec = experiment.recording.points[point];
  const bool last = point + 1 == experiment.recording.points.size();
  if (spec.load) return spec.name + " (the load)";
  if (spec.link > 0) return spec.name;
  return spec.name + (last ? " (the lowest)" : "");
}

/// The moment at which the mean square changes most, and both sides of it.
struct Onset {
  double time = 0, before = 0, after = 0;
};
Onset onset_of(const MatrixXd& residual, const std::vector<double>& time) {
  Onset best;
  double contrast = 0;
  for (Index k = residual.cols() / 8; k < residual.cols() * 7 / 8; ++k) {
    const double before = mean_square(residual.leftCols(k));
    const double after = mean_square(residual.rightCols(residual.cols() - k));
    const double ratio = std::abs(std::log((after + 1e-30) / (before + 1e-30)));
    if (ratio <= contrast) continue;
    contrast = ratio;
    best = {time[static_cast<std::size_t>(k)], std::sqrt(before), std::sqrt(after)};
  }
  return best;
}

void by_point(const Experiment& experiment, const MatrixXd& residual, ResidualPlaces& places) {
  const auto& channels = experiment.recording.channels;
  const std::size_t points = experiment.recording.points.size();
  for (std::size_t p = 0; p < points; ++p) {
    double sum = 0, count = 0;
    for (std::size_t c = 0; c < channels.size(); ++c)
      if (static_cast<std::size_t>(channels[c].point) == p) {
        sum += mean_square(residual.row(static_cast<Index>(c)));
        count += 1;
      }
    places.points.push_back(point_name(experiment, p));
    places.point_rms.push_back(std::sqrt(sum / std::max(1.0, count)));
  }
  const auto largest =
      static_cast<std::size_t>(std::max_element(places.point_rms.begin(), places.point_rms.end()) -
                               places.point_rms.begin());
  if (points > 1)
    places.words.push_back(
        fmt::format("{} at {}",
                    places.point_rms[largest] > kClearlyLargest * std::sqrt(mean_square(residual))
                        ? "largest"
                        : "a little larger",
                    places.points[largest]));
}

/// `predicted`: gives the speed of the motion.
void by_speed(const Experiment& experiment, const MatrixXd& residual, const MatrixXd& predicted,
              ResidualPlaces& places) {
  std::vector<std::pair<double, double>> squares;
  for (Index k = 1; k + 1 < residual.cols(); ++k) {
    const double step = experiment.recording.time[static_cast<std::size_t>(k + 1)] -
                        experiment.recording.time[static_cast<std::size_t>(k - 1)];
    const double speed = (predicted.col(k + 1) - predicted.col(k - 1)).norm() / step;
    squares.emplace_back(speed, mean_square(residual.col(k)));
  }
  std::sort(squares.begin(), squares.end());
  const std::size_t third = squares.size() / 3;
  double slow = 0, fast = 0;  // mean squares in the slowest and the fastest third of the motion
  for (std::size_t k = 0; k < third; ++k) {
    slow += squares[k].second / static_cast<double>(third);
    fast += squares[squares.size() - 1 - k].second / static_cast<double>(third);
  }
  const double slow_rms = std::sqrt(slow), fast_rms = std::sqrt(fast);
  if (fast_rms > kBySpeed * slow_rms) places.words.push_back("at high speed");
  if (slow_rms > kBySpeed * fast_rms) places.words.push_back("at low speed");
}

void by_time(const Experiment& experiment, const MatrixXd& residual, ResidualPlaces& places) {
  const Onset onset = onset_of(residual, experiment.recording.time);
  if (onset.after > kByTime * onset.before)
    places.words.push_back(fmt::format("after {:.2g} s", onset.time));
  else if (onset.before > kByTime * onset.after)
    places.words.push_back(fmt::format("before {:.2g} s", onset.time));
  else
    places.words.push_back("all the time");
}

void by_frequency(const FittedModel& model, const std::vector<double>& sigmas,
                  ResidualPlaces& places) {
  const std::vector<double> lines = strongest_frequencies(model, sigmas, 1);
  if (!lines.empty()) places.words.push_back(fmt::format("strongest at {:.2g} Hz", lines.front()));
}

}  // namespace

ResidualPlaces residual_places(const FittedModel& model, const std::vector<double>& sigmas) {
  ResidualPlaces places;
  std::size_t e = 0;
  while (e + 1 < model.fit_residual.size() && model.fit_residual[e].cols() == 0) ++e;
  const Experiment& experiment = model.problem->experiments()[e];
  const MatrixXd& residual = model.fit_residual[e];
  if (residual.cols() < kFewestFramesOfPlaces) return places;
  by_point(experiment, residual, places);
  by_speed(experiment, residual, model.predicted[e], places);
  by_time(experiment, residual, places);
  by_frequency(model, sigmas, places);
  return places;
}

}  // namespace catena
