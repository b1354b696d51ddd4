// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/close_simulation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "identify/diagnosis/thresholds.hpp"
#include "identify/problem/evaluation.hpp"

namespace catena {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Every tolerance a tenth, or what is asked.
SimulationSpec closer(SimulationSpec now, const SimulationSpec& asked) {
  const auto tighten = [&](double SimulationSpec::*tolerance) {
    now.*tolerance = std::max(0.1 * now.*tolerance, std::min(now.*tolerance, asked.*tolerance));
  };
  tighten(&SimulationSpec::relative_tolerance);
  tighten(&SimulationSpec::absolute_tolerance_position);
  tighten(&SimulationSpec::absolute_tolerance_velocity);
  return now;
}

std::shared_ptr<const Problem> with_simulation(const Problem& problem,
                                               const SimulationSpec& simulation) {
  Case the_case = problem.the_case();
  the_case.simulation = simulation;
  return std::make_shared<const Problem>(std::move(the_case), problem.model(),
                                         problem.experiments());
}

/// Root mean square of the difference of two simulations of the fitted part, over the noise.
double distance(const FittedModel& model, const Evaluation& a, const Evaluation& b,
                const std::vector<NoiseModel>& noise) {
  std::vector<MatrixXd> difference(model.fit_residual.size());
  for (std::size_t e = 0; e < difference.size(); ++e)
    if (model.fit_residual[e].cols() > 0)
      difference[e] = a.predictions[e].simulated - b.predictions[e].simulated;
  const VectorXd white = stacked(difference, model.fit_residual, noise);
  return white.norm() / std::sqrt(static_cast<double>(std::max<Eigen::Index>(1, white.size())));
}

}  // namespace

FittedModel simulated_closely(FittedModel model, const std::vector<NoiseModel>& noise,
                              const DiagnosisContext& context) {
  std::shared_ptr<const Problem> chosen = model.problem;
  Evaluation here = evaluate(*chosen, model.x, false, false);
  while (here.ok) {
    const SimulationSpec& now = chosen->the_case().simulation;
    const SimulationSpec next = closer(now, context.asked_simulation);
    if (next.relative_tolerance == now.relative_tolerance) break;
    const auto finer = with_simulation(*chosen, next);
    Evaluation there = evaluate(*finer, model.x, false, false);
    if (!there.ok || distance(model, here, there, noise) <= kThresholds.simulation_error) break;
    chosen = finer;
    here = std::move(there);
  }
  if (chosen == model.problem) return model;
  FittedModel fitted = fit_model(chosen, model.x, noise, context.least_squares, context.stop);
  return fitted.ok ? fitted : model;
}

}  // namespace catena
