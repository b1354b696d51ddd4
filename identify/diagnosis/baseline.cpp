// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/baseline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/parallel.hpp"
#include "identify/diagnosis/compare.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

constexpr int kFirstEvaluations = 40;  // of each start; the best goes on
constexpr int kEvaluations = 80;       // of every later fit
constexpr double kHeldOutShare = 0.3;  // of a recording, where the case holds nothing out

double squares(const FittedModel& model) {
  return sum_of_squares(model, std::vector<double>(model.fit_residual.size(), 1.0));
}

VectorXd more_damped(const Problem& problem, double factor) {
  VectorXd start = problem.start();
  for (std::size_t j = 0; j < problem.unknowns().size(); ++j) {
    const Unknown& unknown = problem.unknowns()[j];
    if (unknown.parameter < 0) continue;
    const ParameterSpec& spec =
        problem.the_case().parameters[static_cast<std::size_t>(unknown.parameter)];
    double& value = start[static_cast<Index>(j)];
    if (spec.sets.starts_with("damping"))
      value = std::clamp(factor * value, spec.lower, spec.upper);
  }
  return start;
}

}  // namespace

void hold_out(Case& the_case, DiagnosisContext& context, std::vector<std::string>& notes) {
  bool held = false;
  for (const ExperimentSpec& experiment : the_case.experiments)
    held = held || experiment.use == Use::kValidate || std::isfinite(experiment.fit_until);
  if (held) return;
  const Problem problem(the_case, context.model_with({}, the_case.links));
  for (std::size_t s = 0; s < the_case.experiments.size(); ++s) {
    // From the first frame of its first window to the last frame of its last.
    double begin = std::numeric_limits<double>::infinity(), end = -begin;
    for (const Experiment& window : problem.experiments()) {
      if (window.source != static_cast<int>(s)) continue;
      begin = std::min(begin, window.recording.time.front());
      end = std::max(end, window.recording.time.back());
    }
    if (begin < end) the_case.experiments[s].fit_until = end - kHeldOutShare * (end - begin);
  }
  notes.emplace_back("the case holds nothing out: the last 30 % of each recording were not fitted");
}

Case for_the_search(Case the_case) {
  SimulationSpec& simulation = the_case.simulation;
  simulation.relative_tolerance = std::max(simulation.relative_tolerance, 1e-6);
  simulation.absolute_tolerance_position = std::max(simulation.absolute_tolerance_position, 1e-8);
  simulation.absolute_tolerance_velocity = std::max(simulation.absolute_tolerance_velocity, 1e-7);
  the_case.optimiser.tolerance = std::max(the_case.optimiser.tolerance, 1e-4);
  return the_case;
}

FittedModel fit_baseline(Case the_case, DiagnosisContext& context) {
  the_case.optimiser.max_evaluations =
      std::min(the_case.optimiser.max_evaluations, kFirstEvaluations);
  const Model model_of_case = context.model_with({}, the_case.links);
  const auto problem = std::make_shared<const Problem>(the_case, model_of_case);
  // With more damping the motion is simpler, and what the fit descends on too.
  const std::vector<double> factors = {1, 5, 25};
  std::vector<FittedModel> fits(factors.size());
  in_parallel(factors.size(), context.threads, [&](std::size_t k) {
    fits[k] =
        fit_model(problem, more_damped(*problem, factors[k]), context.least_squares, context.stop);
  });
  context.stop_if_asked();
  FittedModel* best = nullptr;
  for (FittedModel& fit : fits)
    if (fit.ok && (!best || squares(fit) < squares(*best))) best = &fit;
  if (!best) throw std::runtime_error("the baseline could not be fitted: " + fits[0].message);
  the_case.optimiser.max_evaluations = kEvaluations;
  const auto longer = std::make_shared<const Problem>(the_case, model_of_case);
  FittedModel model = fit_model(longer, best->x, context.least_squares, context.stop);
  return model.ok ? model : *best;
}

}  // namespace catena
