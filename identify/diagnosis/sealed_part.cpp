// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/sealed_part.hpp"

#include <cmath>
#include <limits>

#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/thresholds.hpp"

namespace catena {

void seal_last_part(Case& the_case, DiagnosisContext& context) {
  const Problem problem(the_case, context.model_with({}, the_case.links));
  for (const Experiment& experiment : problem.experiments()) {
    if (!std::isnan(the_case.experiments[static_cast<std::size_t>(experiment.source)].window))
      continue;
    const std::vector<double>& time = experiment.recording.time;
    const auto fitted =
        static_cast<std::size_t>(experiment.fitted() ? experiment.recording.fit_frames : 0);
    const auto held_out = static_cast<double>(time.size() - fitted);
    const auto sealed = static_cast<std::size_t>(kThresholds.sealed_share * held_out);
    if (time.size() - fitted - sealed < kFewestFramesToCompare) continue;
    the_case.experiments[static_cast<std::size_t>(experiment.source)].sealed_from =
        time[time.size() - sealed - 1];
  }
}

double sealed_rms(const FittedModel& model) {
  double sum = 0, count = 0;
  for (std::size_t e = 0; e < model.predicted.size(); ++e) {
    const Eigen::MatrixXd& sealed = model.problem->experiments()[e].recording.sealed;
    if (sealed.size() == 0) continue;
    const Eigen::MatrixXd residuals = model.predicted[e] - sealed;
    for (const double residual : residuals.reshaped()) {
      if (std::isnan(residual)) continue;
      sum += residual * residual;
      count += 1;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : kNotGiven;
}

Problem with_opened_seals(const Problem& problem) {
  Case the_case = problem.the_case();
  for (ExperimentSpec& spec : the_case.experiments)
    spec.sealed_from = std::numeric_limits<double>::infinity();
  std::vector<Experiment> experiments = problem.experiments();
  for (Experiment& experiment : experiments) open_seal(experiment.recording);
  return Problem(the_case, problem.model(), std::move(experiments));
}

}  // namespace catena
