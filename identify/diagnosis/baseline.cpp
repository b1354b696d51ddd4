// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "common/parallel.hpp"
#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/fit/estimates.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

// Fits: so many starts, then refits from the best of them.
constexpr int kStarts = 3, kRefits = 2;
constexpr int kFirstEvaluations = 40;  // of each start; the best goes on
constexpr int kEvaluations = 80;       // of every later fit

double squares(const FittedModel& model) {
  return sum_of_squares(model, std::vector<NoiseModel>(model.fit_residual.size(), {.level = 1}));
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

/// Growing windows, windows that are to meet and robust losses have their own ways to the minimum.
LeastSquares as_the_case_asks(DiagnosisContext& context) {
  return [&context](const Problem& problem, const FitOptions& options) {
    return fit(problem, options, context.least_squares);
  };
}

/// Whether a fit leaves as much as if it did not follow the motion: its phase ran away.
bool loses_the_motion(const FittedModel& model) {
  double left = 0, motion = 0;
  for (std::size_t e = 0; e < model.fit_residual.size(); ++e)
    for (Index c = 0; c < model.fit_residual[e].rows(); ++c) {
      const auto measured = model.problem->experiments()[e].recording.measured.row(c).head(
          model.fit_residual[e].cols());
      double sum = 0, sum_of_squares = 0, count = 0;
      for (Index k = 0; k < measured.size(); ++k) {
        if (std::isnan(measured[k])) continue;
        sum += measured[k];
        sum_of_squares += measured[k] * measured[k];
        count += 1;
        left += std::pow(model.fit_residual[e](c, k), 2);
      }
      if (count > 0) motion += sum_of_squares - sum * sum / count;
    }
  return left > std::pow(kThresholds.follows, 2) * motion;
}

/// From a short beginning on, each twice as long as the one before.
std::vector<double> growing_windows(const Problem& problem) {
  double longest = 0;
  for (const Experiment& experiment : problem.experiments())
    if (experiment.fitted())
      longest = std::max(
          longest,
          experiment.recording.time[static_cast<std::size_t>(experiment.recording.fit_frames - 1)] -
              experiment.recording.time.front());
  std::vector<double> windows;
  for (double length = longest / 64; length < 0.75 * longest; length *= 2)
    windows.push_back(length);
  return windows;
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
    if (begin < end)
      the_case.experiments[s].fit_until = end - kThresholds.held_out_share * (end - begin);
  }
  const bool windows = std::any_of(the_case.experiments.begin(), the_case.experiments.end(),
                                   [](const ExperimentSpec& spec) { return spec.window > 0; });
  notes.push_back(fmt::format(
      "the case holds nothing out: the last {:.0f} % of each recording{} were not fitted",
      100 * kThresholds.held_out_share, windows ? ", and the windows that reach into it," : ""));
}

Case for_the_search(Case the_case) {
  SimulationSpec& simulation = the_case.simulation;
  simulation.relative_tolerance = std::max(simulation.relative_tolerance, 1e-6);
  simulation.absolute_tolerance_position = std::max(simulation.absolute_tolerance_position, 1e-8);
  simulation.absolute_tolerance_velocity = std::max(simulation.absolute_tolerance_velocity, 1e-7);
  the_case.optimiser.tolerance = std::max(the_case.optimiser.tolerance, 1e-4);
  the_case.optimiser.method = FitMethod::kLeastSquares;
  return the_case;
}

void require_yes_for_diagnosis(const Problem& problem, const DiagnosisContext& context) {
  if (context.provider.large_work) return;
  const double rounds =
      std::ceil(kStarts / static_cast<double>(context.threads)) + kShareOfRefit * kRefits;
  const double simulations = simulations_of_a_fit(problem) * rounds;
  Evaluation start;
  WorkEstimate estimate = estimate_of(
      problem, [&](double simulation) { return simulation * simulations; }, false,
      [&] { return context.stopped(); }, start);
  estimate.or_more = true;
  require_yes(false, "the diagnosis", estimate);
}

FittedModel fit_baseline(Case the_case, DiagnosisContext& context) {
  the_case.optimiser.max_evaluations =
      std::min(the_case.optimiser.max_evaluations, kFirstEvaluations);
  const Model model_of_case = context.model_with({}, the_case.links);
  // With more damping the motion is simpler, and what the fit descends on too.
  const std::array<double, kStarts> factors = {1, 5, 25};
  std::vector<FittedModel> fits;
  const auto fit_from_each_start = [&] {
    const auto problem = std::make_shared<const Problem>(the_case, model_of_case);
    const std::size_t first = fits.size();
    fits.resize(first + factors.size());
    in_parallel(factors.size(), context.threads, [&](std::size_t k) {
      fits[first + k] = fit_model(problem, more_damped(*problem, factors[k]), {},
                                  as_the_case_asks(context), context.stop);
    });
    context.stop_if_asked();
  };
  const auto best = [&] {
    const FittedModel* least = nullptr;
    for (const FittedModel& fit : fits)
      if (fit.ok && (!least || squares(fit) < squares(*least))) least = &fit;
    return least;
  };
  fit_from_each_start();
  if (the_case.optimiser.growing_windows.empty() && (!best() || loses_the_motion(*best()))) {
    the_case.optimiser.growing_windows = growing_windows(*fits.front().problem);
    fit_from_each_start();
  }
  if (!best())
    throw std::runtime_error("the baseline could not be fitted: " + fits.front().message);
  the_case.optimiser.growing_windows.clear();  // the start of what follows is near enough
  the_case.optimiser.max_evaluations = kEvaluations;
  const auto longer = std::make_shared<const Problem>(the_case, model_of_case);
  FittedModel model = fit_model(longer, best()->x, {}, context.least_squares, context.stop);
  if (!model.ok) model = *best();
  const std::vector<NoiseModel> noise = noise_of(model);
  if (std::any_of(noise.begin(), noise.end(), [](const auto& each) { return !(each.level > 0); }))
    return model;
  const FittedModel weighed =
      fit_model(longer, model.x, noise, context.least_squares, context.stop);
  return weighed.ok ? weighed : model;
}

}  // namespace catena
