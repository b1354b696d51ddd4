// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/fit_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/noise/noise_level.hpp"

namespace catena {

namespace {

/// In m or rad.
struct NoiseLeft {
  double noise = 0, rms = 0;
};

NoiseLeft left_of(const Experiment& experiment, const Prediction& prediction) {
  const Eigen::MatrixXd residual = (prediction.simulated - experiment.recording.measured)
                                       .leftCols(experiment.recording.fit_frames);
  NoiseLeft left;
  left.noise = experiment.spec.noise;
  if (std::isnan(left.noise)) left.noise = noise_level(residual, experiment.recording.time);
  left.rms = std::sqrt(
      residual.array().isNaN().select(0, residual.array().square()).sum() /
      static_cast<double>(std::max<Eigen::Index>(1, (!residual.array().isNaN()).count())));
  return left;
}

/// "2.1", or "2.1 to 3.4".
std::string range_of(const std::vector<double>& values, int digits) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const std::string low = fmt::format("{:.{}g}", *least, digits);
  const std::string high = fmt::format("{:.{}g}", *most, digits);
  return low == high ? low : fmt::format("{} to {}", low, high);
}

}  // namespace

std::vector<FitRemark> remarks_on_fit(const Problem& problem, const Evaluation& best) {
  // A right model ends at 1; too few links, or smoothed tracks, at about 1.5.
  constexpr double kFarAbove = 2;
  std::vector<FitRemark> remarks;
  const std::vector<Experiment>& experiments = problem.experiments();
  for (std::size_t source = 0; source < problem.the_case().experiments.size(); ++source) {
    std::vector<double> times, noise;  // of windows far above
    std::size_t first = 0, windows = 0;
    for (std::size_t e = 0; e < experiments.size(); ++e) {
      if (experiments[e].source != static_cast<int>(source) || !experiments[e].fitted()) continue;
      ++windows;
      const NoiseLeft left = left_of(experiments[e], best.predictions[e]);
      if (!(left.rms > kFarAbove * left.noise)) continue;
      if (times.empty()) first = e;
      times.push_back(left.rms / left.noise);
      noise.push_back(1e3 * left.noise);
    }
    if (times.empty()) continue;
    const bool angles = experiments[first].spec.kind == DataKind::kAngles;
    remarks.push_back(
        {first, problem.the_case().experiments[source].name,
         fmt::format(
             "the fit leaves {} times the noise ({} {}){}. Something is missing: a measure "
             "of the cable, or an effect; catena diagnose {}",
             range_of(times, 2), range_of(noise, 3), angles ? "mrad" : "mm",
             windows > 1 ? fmt::format(" in {} of {} fitted windows", times.size(), windows) : "",
             problem.the_case().file.string())});
  }
  return remarks;
}

}  // namespace catena
