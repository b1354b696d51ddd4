// SPDX-License-Identifier: BSD-3-Clause
#include "identify/fit/easier_problems.hpp"

#include <algorithm>

namespace catena {
namespace {

using Eigen::Index;

constexpr double kRoughTolerance = 1e-4;  // of simulations
constexpr double kFinerTolerance = 0.1;   // of the problem's own
constexpr double kRoughlyThere = 1e-2;    // of the optimiser
constexpr Index kRoughFrames = 100;       // are kept of an experiment that has more,
constexpr Index kValuesPerUnknown = 100;  // and at least so many numbers of all

void scale_tolerances(SimulationSpec& simulation, double factor) {
  simulation.relative_tolerance *= factor;
  simulation.absolute_tolerance_position *= factor;
  simulation.absolute_tolerance_velocity *= factor;
}

/// Keeps every `every`-th of the frames to be fitted.
void thin_out(Recording& recording, Index every) {
  const Index kept = (recording.fit_frames + every - 1) / every;
  for (Index k = 0; k < kept; ++k) {
    recording.time[static_cast<std::size_t>(k)] =
        recording.time[static_cast<std::size_t>(every * k)];
    recording.measured.col(k) = recording.measured.col(every * k).eval();
  }
  recording.time.resize(static_cast<std::size_t>(kept));
  recording.measured.conservativeResize(Eigen::NoChange, kept);
  recording.fit_frames = kept;
}

/// Noise of which nothing is known but its level.
std::shared_ptr<const NoiseModel> white_noise(double level) {
  NoiseModel noise;
  noise.level = level;
  return std::make_shared<const NoiseModel>(std::move(noise));
}

}  // namespace

Problem first_seconds(const Problem& problem, double seconds) {
  std::vector<Experiment> experiments = problem.experiments();
  for (Experiment& experiment : experiments) {
    const std::vector<double>& time = experiment.recording.time;
    const double end = experiment.spec.start + seconds + 1e-9;
    const auto seen = std::upper_bound(time.begin(), time.end(), end) - time.begin();
    experiment.recording.fit_frames =
        std::min<Index>(experiment.recording.fit_frames, std::max<Index>(seen, 2));
  }
  return Problem(problem.the_case(), problem.model(), std::move(experiments));
}

Problem with_tolerance(const Problem& problem, double tolerance) {
  Case the_case = problem.the_case();
  the_case.optimiser.tolerance = tolerance;
  return Problem(std::move(the_case), problem.model(), problem.experiments());
}

Problem with_defect_weight(const Problem& problem, double weight) {
  std::vector<Experiment> experiments = problem.experiments();
  for (Experiment& experiment : experiments) experiment.defect_weight = weight;
  return Problem(problem.the_case(), problem.model(), std::move(experiments));
}

Problem without_loss(const Problem& problem) {
  Case the_case = problem.the_case();
  the_case.error.loss = Loss::kNone;
  return Problem(std::move(the_case), problem.model(), problem.experiments());
}

Problem finer(const Problem& problem) {
  Case the_case = problem.the_case();
  scale_tolerances(the_case.simulation, kFinerTolerance);
  return Problem(std::move(the_case), problem.model(), problem.experiments());
}

bool finer_than_rough(const Problem& problem) {
  return problem.the_case().simulation.relative_tolerance <= kRoughTolerance / 10 &&
         problem.the_case().optimiser.tolerance < kRoughlyThere;
}

Problem rough(const Problem& problem) {
  Case the_case = problem.the_case();
  the_case.optimiser.tolerance = std::max(kRoughlyThere, the_case.optimiser.tolerance);
  scale_tolerances(the_case.simulation,
                   std::max(1.0, kRoughTolerance / the_case.simulation.relative_tolerance));

  std::vector<Experiment> experiments = problem.experiments();
  Index values = 0;
  for (const Experiment& experiment : experiments)
    if (experiment.fitted())
      values += experiment.recording.fit_frames *
                static_cast<Index>(experiment.recording.channels.size());
  const Index enough = kValuesPerUnknown * static_cast<Index>(problem.unknowns().size());
  for (Experiment& experiment : experiments) {
    if (!experiment.fitted()) continue;
    const Index every = std::min(experiment.recording.fit_frames / kRoughFrames,
                                 values / std::max<Index>(enough, 1));
    if (every < 2) continue;
    thin_out(experiment.recording, every);
    if (experiment.noise) experiment.noise = white_noise(experiment.noise->level);
  }
  return Problem(std::move(the_case), problem.model(), std::move(experiments));
}

}  // namespace catena
