// SPDX-License-Identifier: BSD-3-Clause
#include "identify/results/fit_remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/noise/noise_level.hpp"

namespace catena {

std::vector<std::string> remarks_on_fit(const Problem& problem, const Evaluation& best) {
  // A right model ends at 1; too few links, or smoothed tracks, at about 1.5.
  constexpr double kFarAbove = 2;
  std::vector<std::string> remarks(problem.experiments().size());
  for (std::size_t e = 0; e < remarks.size(); ++e) {
    const Experiment& experiment = problem.experiments()[e];
    const Eigen::MatrixXd residual = (best.predictions[e].simulated - experiment.recording.measured)
                                         .leftCols(experiment.recording.fit_frames);
    double noise = experiment.spec.noise;
    if (std::isnan(noise)) noise = noise_level(residual, experiment.recording.time);
    const double rms = std::sqrt(
        residual.array().isNaN().select(0, residual.array().square()).sum() /
        static_cast<double>(std::max<Eigen::Index>(1, (!residual.array().isNaN()).count())));
    if (!(rms > kFarAbove * noise)) continue;
    const bool angles = experiment.spec.kind == DataKind::kAngles;
    remarks[e] = fmt::format(
        "the fit leaves {:.2g} times the noise ({:.3g} {}). Something is missing: a measure of the "
        "cable, or an effect; catena diagnose {}",
        rms / noise, 1e3 * noise, angles ? "mrad" : "mm", problem.the_case().file.string());
  }
  return remarks;
}

}  // namespace catena
