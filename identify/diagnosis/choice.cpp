// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/choice.hpp"

#include <algorithm>
#include <cmath>

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

}  // namespace

bool more_than_a_detail(const DiagnosisState& state, const Comparison& comparison) {
  return comparison.misfit_removed >
         kThresholds.detail * std::pow(misfit_without_effects(state.found.stages), 2);
}

bool acceptable(const DiagnosisState& state, const Explanation& explanation) {
  if (!explanation.refitted) return false;
  const Comparison& comparison = explanation.comparison;
  const double log10_p = comparison.log10_p + std::log10(std::max(1, state.found.tried));
  return log10_p < kThresholds.certain && comparison.criterion < 0 &&
         comparison.misfit_share > kThresholds.worthwhile &&
         state.generalises(explanation.held_out) && more_than_a_detail(state, comparison);
}

const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations) {
  const Explanation* best = nullptr;
  for (const Explanation& explanation : explanations)
    if (acceptable(state, explanation) &&
        (!best || remainder(state, explanation) < remainder(state, *best)))
      best = &explanation;
  if (!best) return best;
  const Explanation* simplest = best;
  for (const Explanation& explanation : explanations) {
    if (!acceptable(state, explanation) || &explanation == best ||
        !simpler(state, explanation, *best) ||
        decide(best->model, explanation.model, state.found.sigmas).decided)
      continue;
    if (simplest == best || remainder(state, explanation) < remainder(state, *simplest))
      simplest = &explanation;
  }
  return simplest;
}

}  // namespace catena
