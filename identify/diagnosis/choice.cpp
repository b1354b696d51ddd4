// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/choice.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/residual_frequencies.hpp"
#include "identify/diagnosis/special_case.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// What an explanation leaves, with the cost of its unknowns: the Bayesian information criterion of
/// `independent` residuals whose variance is not known, for a law misses more than the noise.
double remainder(const DiagnosisState& state, const Explanation& explanation, double independent) {
  return independent * std::log(state.squares(explanation.model)) +
         std::log(independent) * explanation.comparison.added;
}

/// How many independent residuals the best of some explanations leaves.
double independent_residuals(const DiagnosisState& state,
                             const std::vector<const Explanation*>& explanations) {
  const Explanation& best = **std::min_element(
      explanations.begin(), explanations.end(), [&](const Explanation* a, const Explanation* b) {
        return state.squares(a->model) < state.squares(b->model);
      });
  return std::max(2.0, static_cast<double>(best.fit.count) / best.comparison.autocorrelation);
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
          return predicts_better(other->model, each->model, state.found.noise) ||
                 needs_no_drive(state, other->id, other->held_out, each->id, each->held_out);
        }))
      left.push_back(each);
  return left;
}

}  // namespace

bool more_than_a_detail_held_out(const DiagnosisState& state, const GapTest& base,
                                 const GapTest& larger) {
  const double whole = last_without_effects(state.found.stages).held_out.rms;
  return std::pow(base.rms, 2) - std::pow(larger.rms, 2) > kThresholds.detail * std::pow(whole, 2);
}

bool more_than_a_detail(const DiagnosisState& state, const FittedModel& base,
                        const FittedModel& larger) {
  const Stage& bare = last_without_effects(state.found.stages);
  const std::vector<NoiseModel>& noise = state.found.noise;
  const double removed =
      std::pow(fit_gap(base, noise).misfit, 2) - std::pow(fit_gap(larger, noise).misfit, 2);
  if (removed > kThresholds.detail * std::pow(bare.fit.misfit, 2)) return true;
  return more_than_a_detail_held_out(state, held_out_gap(base, noise),
                                     held_out_gap(larger, noise)) &&
         predicts_better(larger, base, noise);
}

bool goes_with_the_motion(const DiagnosisState& state, const FittedModel& base,
                          const Explanation& explanation) {
  const Candidate* const effect = state.context.find(explanation.id);
  if (!effect || !effect->driven ||
      nearly_closes(explanation.fit, fit_gap(base, state.found.noise)))
    return false;
  return std::any_of(effect->parameters.begin(), effect->parameters.end(),
                     [&](const CandidateParameter& parameter) {
                       const FittedModel& model = explanation.model;
                       const Eigen::Index j = unknown_index(*model.problem, parameter.name);
                       return parameter.unit == "Hz" && j >= 0 &&
                              !told_from_motion(base, model.x[j]);
                     });
}

bool acceptable(const DiagnosisState& state, const FittedModel& base,
                const Explanation& explanation) {
  if (!explanation.refitted) return false;
  const Comparison& comparison = explanation.comparison;
  return explanation.chance <= kThresholds.chance && comparison.criterion < 0 &&
         comparison.misfit_share > kThresholds.worthwhile &&
         state.generalises(explanation.held_out) &&
         more_than_a_detail(state, base, explanation.model) &&
         !goes_with_the_motion(state, base, explanation) &&
         (static_cast<int>(state.last().effects.size()) < kThresholds.effects_unconfirmed ||
          predicts_better(explanation.model, base, state.found.noise));
}

bool needs_no_drive(const DiagnosisState& state, const std::string& passive, const GapTest& left,
                    const std::string& driven, const GapTest& left_driven) {
  const auto is_driven = [&](const std::string& id) {
    const Candidate* const effect = state.context.find(id);
    return effect && effect->driven;
  };
  return left_driven.count > 0 && is_driven(driven) && !is_driven(passive) &&
         left.rms <= left_driven.rms;
}

const Explanation* choose(const DiagnosisState& state,
                          const std::vector<Explanation>& explanations) {
  const std::vector<const Explanation*> candidates = confirmed(state, explanations);
  if (candidates.empty()) return nullptr;
  const double independent = independent_residuals(state, candidates);
  const auto leaves_less = [&](const Explanation* a, const Explanation* b) {
    return remainder(state, *a, independent) < remainder(state, *b, independent);
  };
  const Explanation* const best =
      *std::min_element(candidates.begin(), candidates.end(), leaves_less);
  const Explanation* simplest = best;
  for (const Explanation* explanation : candidates) {
    if (explanation == best || !simpler(state, *explanation, *best) ||
        decide(best->model, explanation->model, state.found.noise).decided)
      continue;
    if (simplest == best || leaves_less(explanation, simplest)) simplest = explanation;
  }
  return simplest;
}

}  // namespace catena
