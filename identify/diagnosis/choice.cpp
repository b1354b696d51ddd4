// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/choice.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/special_case.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// What an explanation leaves, with the cost of its unknowns (Bayesian information criterion).
double remainder(const DiagnosisState& state, const Explanation& explanation) {
  return state.squares(explanation.model) +
         std::log(static_cast<double>(std::max(2L, explanation.fit.count))) *
             explanation.comparison.added;
}

bool simpler(const DiagnosisState& state, const Explanation& a, const Explanation& b) {
  if (a.comparison.added != b.comparison.added) return a.comparison.added < b.comparison.added;
  return a.is_effect() && b.is_effect() &&
         is_special_case(*state.context.find(a.id), *state.context.find(b.id),
                         state.context.model_with_all(state.last().links));
}

/// The acceptable ones that the held-out part confirms: none of the others predicts it better. What
/// has many unknowns may imitate the fitted part best.
std::vector<const Explanation*> confirmed(const DiagnosisState& state,
                                          const std::vector<Explanation>& explanations) {
  std::vector<const Explanation*> candidates;
  for (const Explanation& explanation : explanations)
    if (acceptable(state, state.last().model, explanation)) candidates.push_back(&explanation);
  std::vector<const Explanation*> left;
  for (const Explanation* each : candidates)
    if (std::none_of(candidates.begin(), candidates.end(), [&](const Explanation* other) {
          return predicts_better(other->model, each->model, state.found.noise);
        }))
      left.push_back(each);
  return left;
}

}  // namespace

bool more_than_a_detail(const DiagnosisState& state, const FittedModel& base,
                        const FittedModel& larger) {
  const Stage& bare = last_without_effects(state.found.stages);
  const std::vector<NoiseModel>& noise = state.found.noise;
  const double removed =
      std::pow(fit_gap(base, noise).misfit, 2) - std::pow(fit_gap(larger, noise).misfit, 2);
  if (removed > kThresholds.detail * std::pow(bare.fit.misfit, 2)) return true;
  const double later =
      std::pow(held_out_gap(base, noise).rms, 2) - std::pow(held_out_gap(larger, noise).rms, 2);
  return later > kThresholds.detail * std::pow(bare.held_out.rms, 2) &&
         predicts_better(larger, base, noise);
}

bool acceptable(const DiagnosisState& state, const FittedModel& base,
                const Explanation& explanation) {
  if (!explanation.refitted) return false;
  const Comparison& comparison = explanation.comparison;
  return explanation.chance <= kThresholds.chance && comparison.criterion < 0 &&
         comparison.misfit_share > kThresholds.worthwhile &&
         state.generalises(explanation.held_out) &&
         more_than_a_detail(state, base, explanation.model) &&
         (static_cast<int>(state.last().effects.size()) < kThresholds.effects_unconfirmed ||
          predicts_better(explanation.model, base, state.found.noise));
}

const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations) {
  const std::vector<const Explanation*> candidates = confirmed(state, explanations);
  const Explanation* best = nullptr;
  for (const Explanation* explanation : candidates)
    if (!best || remainder(state, *explanation) < remainder(state, *best)) best = explanation;
  if (!best) return best;
  const Explanation* simplest = best;
  for (const Explanation* explanation : candidates) {
    if (explanation == best || !simpler(state, *explanation, *best) ||
        decide(best->model, explanation->model, state.found.noise).decided)
      continue;
    if (simplest == best || remainder(state, *explanation) < remainder(state, *simplest))
      simplest = explanation;
  }
  return simplest;
}

}  // namespace catena
