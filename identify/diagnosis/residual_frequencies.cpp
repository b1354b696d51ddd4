// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/residual_frequencies.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kLines = 8;                 // frequencies where the residuals are strongest
constexpr int kFrequencies = 24;          // and others, evenly spaced
constexpr double kFewestPeriods = 2;      // in the longest fitted part: fewer show no frequency
constexpr double kHighestFrequency = 12;  // Hz

double angle_of_frequency(double frequency, double t) {
  return 2 * std::numbers::pi * frequency * t;
}

struct Sampling {
  double duration = 0, rate = 0;  // s, 1/s
  double highest() const { return std::min(rate / 4, kHighestFrequency); }
};

/// Of the longest fitted part.
Sampling longest_sampling(const FittedModel& model) {
  Sampling longest;
  for (std::size_t e = 0; e < model.fit_residual.size(); ++e) {
    const Index frames = model.fit_residual[e].cols();
    if (frames < 8) continue;
    const auto& time = model.problem->experiments()[e].recording.time;
    const double span = time[static_cast<std::size_t>(frames - 1)] - time.front();
    if (span <= longest.duration) continue;
    longest.duration = span;
    longest.rate = static_cast<double>(frames - 1) / span;
  }
  return longest;
}

/// Frequencies of the strongest lines of series, one of each experiment, the strongest first.
std::vector<double> strongest_lines(const FittedModel& model, const std::vector<MatrixXd>& series,
                                    const std::vector<double>& sigmas, int count) {
  const Sampling sampling = longest_sampling(model);
  if (sampling.duration == 0) return {};
  // The power at a quarter of the resolution.
  const double step = 0.25 / sampling.duration, highest = sampling.highest();
  std::vector<std::pair<double, double>> lines;  // power, frequency
  std::vector<double> power;
  for (double f = 2 * step; f <= highest; f += step) {
    double sum = 0;
    for (std::size_t e = 0; e < series.size(); ++e) {
      const MatrixXd& r = series[e];
      const auto& time = model.problem->experiments()[e].recording.time;
      VectorXd cosine(r.cols()), sine(r.cols());
      for (Index k = 0; k < r.cols(); ++k) {
        const double angle = angle_of_frequency(f, time[static_cast<std::size_t>(k)]);
        cosine[k] = std::cos(angle);
        sine[k] = std::sin(angle);
      }
      for (Index c = 0; c < r.rows(); ++c) {
        double a = 0, b = 0;
        for (Index k = 0; k < r.cols(); ++k) {
          if (std::isnan(r(c, k))) continue;
          a += r(c, k) * cosine[k];
          b += r(c, k) * sine[k];
        }
        sum += (a * a + b * b) / (sigmas[e] * sigmas[e]);
      }
    }
    power.push_back(sum);
  }
  for (std::size_t i = 0; i < power.size(); ++i) {
    const bool left = i == 0 || power[i] >= power[i - 1];
    const bool right = i + 1 == power.size() || power[i] >= power[i + 1];
    if (left && right) lines.emplace_back(power[i], (2 + static_cast<double>(i)) * step);
  }
  std::sort(lines.rbegin(), lines.rend());
  std::vector<double> frequencies;
  for (const auto& [strength, frequency] : lines)
    if (static_cast<int>(frequencies.size()) < count) frequencies.push_back(frequency);
  return frequencies;
}

}  // namespace

double lowest_shown_frequency(const FittedModel& model) {
  const Sampling sampling = longest_sampling(model);
  return sampling.duration > 0 ? kFewestPeriods / sampling.duration : 0;
}

std::vector<double> strongest_frequencies(const FittedModel& model,
                                          const std::vector<double>& sigmas, int count) {
  return strongest_lines(model, model.fit_residual, sigmas, count);
}

bool told_from_motion(const FittedModel& model, double frequency) {
  std::vector<MatrixXd> motion;
  std::vector<double> sizes;  // m or rad
  for (std::size_t e = 0; e < model.predicted.size(); ++e) {
    MatrixXd& series =
        motion.emplace_back(model.predicted[e].leftCols(model.fit_residual[e].cols()));
    if (series.size() > 0) series.colwise() -= series.rowwise().mean().eval();
    sizes.push_back(series.norm() > 0 ? series.norm() : 1);
  }
  const std::vector<double> strongest = strongest_lines(model, motion, sizes, 1);
  return strongest.empty() ||
         std::abs(frequency - strongest.front()) * longest_sampling(model).duration > 1;
}

std::vector<double> driving_frequencies(const FittedModel& model,
                                        const std::vector<double>& sigmas) {
  std::vector<double> frequencies = strongest_frequencies(model, sigmas, kLines);
  const Sampling sampling = longest_sampling(model);
  if (sampling.duration == 0) return {};
  const double step = std::max(0.5 / sampling.duration, sampling.highest() / kFrequencies);
  for (double f = step; f <= sampling.highest(); f += step) frequencies.push_back(f);
  std::erase_if(frequencies, [&](double f) { return f < lowest_shown_frequency(model); });
  return frequencies;
}

}  // namespace catena
