// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/pairs.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/nearest_name.hpp"
#include "common/parallel.hpp"
#include "identify/diagnosis/candidate_scores.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/refits.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/search.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/trim.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// Two effects, and the models on the way to them.
struct Pair {
  Explanation first, second;
  std::vector<Explanation> beside;  // the first
  FittedModel finer;                // the pair with more links, where that was tried

  const FittedModel& best() const { return finer.ok ? finer : second.model; }
};

/// The last stage without effects; one made for it where more links were taken since. (With too few
/// links pairs are sought that imitate more of them.)
Stage without_effects(DiagnosisState& state) {
  std::size_t bare = state.found.stages.size() - 1;
  while (!state.found.stages[bare].effects.empty()) --bare;
  const Stage& last_bare = state.found.stages[bare];
  if (last_bare.links >= state.last().links) return last_bare;
  Stage finer;
  finer.links = state.last().links;
  finer.model =
      refitted_with_links(last_bare.model, finer.links, {}, state.found.noise, state.context);
  if (!finer.model.ok) return last_bare;
  finer.explanations = look(state, finer.model, {});
  return finer;
}

bool has(const std::vector<Explanation>& explanations, const std::string& id) {
  return std::any_of(explanations.begin(), explanations.end(),
                     [&](const Explanation& each) { return each.id == id; });
}

/// Whether something was sought beside that effect alone.
bool looked_beside(const DiagnosisState& state, const std::string& id, int links) {
  return std::any_of(state.found.stages.begin(), state.found.stages.end(), [&](const Stage& each) {
    return each.effects == std::vector<std::string>{id} && each.links == links &&
           !each.explanations.empty();
  });
}

/// The effects that may be the first of a pair, none beside which something was sought already: those
/// that left least of the base's misfit alone, and members of the pairs and triples that are worth most
/// together, be each alone worth little.
std::vector<Explanation> firsts_on(const DiagnosisState& state, const Stage& base) {
  const CandidateSearch search{state.context, base.model, {}, state.found.noise};
  CandidateScores scores(search);
  std::vector<Explanation> all = scores.score(false);
  const auto take = [&](std::vector<Explanation> firsts, std::size_t count) {
    std::erase_if(
        firsts, [&](const Explanation& each) { return looked_beside(state, each.id, base.links); });
    firsts.resize(std::min(firsts.size(), count));
    return firsts;
  };
  std::vector<Explanation> firsts =
      best_effects(base.explanations, state.found.noise, base.explanations.size());
  std::erase_if(firsts, [&](const Explanation& each) {
    return !(each.comparison.misfit_share > kThresholds.worthwhile);
  });
  firsts = take(std::move(firsts), kThresholds.firsts_of_pairs / 2);
  std::vector<Explanation> together;
  for (const std::string& id : scores.best_together())
    for (const std::vector<Explanation>* known : {&base.explanations, &std::as_const(all)})
      for (const Explanation& each : *known)
        if (each.id == id && each.score.admissible && !has(firsts, id) && !has(together, id))
          together.push_back(each);
  together = take(std::move(together), kThresholds.firsts_of_pairs - firsts.size());
  refit_rest(search, together);
  for (Explanation& each : together)
    if (each.refitted) firsts.push_back(std::move(each));
  return firsts;
}

bool has_pair(const std::vector<Pair>& pairs, const std::string& a, const std::string& b) {
  return std::any_of(pairs.begin(), pairs.end(),
                     [&](const Pair& pair) { return pair.first.id == b && pair.second.id == a; });
}

/// Adds the pairs of `first` with what is best beside it that chance does not explain.
void add_pairs_of(DiagnosisState& state, const Stage& base, const Explanation& first,
                  std::vector<Pair>& pairs) {
  const CandidateSearch search{state.context, first.model, {first.id}, state.found.noise};
  CandidateScores scores(search);
  std::vector<Explanation> beside = scores.score(false);
  refit_best(search, beside, kThresholds.seconds_of_pairs, false);
  state.context.stop_if_asked();
  scores.set_chances(beside);
  for (const Explanation& second : beside) {
    if (!second.refitted || !second.is_effect() ||
        second.comparison.misfit_share < kThresholds.worthwhile ||
        !predicts_as_well(second.held_out, first.held_out))
      continue;
    const Comparison both = compare(base.model, second.model, state.found.noise);
    if (!has_pair(pairs, first.id, second.id) && both.criterion < 0 &&
        second.chance <= kThresholds.chance)
      pairs.push_back({first, second, beside, {}});
  }
}

/// Each pair with more links, too, where none closes the gap.
void try_with_more_links(DiagnosisState& state, const Stage& base, std::vector<Pair>& pairs) {
  DiagnosisContext& context = state.context;
  const int links = state.more_links(base.links);
  const bool closed = !pairs.empty() && nearly_closes(pairs.front().second.fit,
                                                      fit_gap(base.model, state.found.noise));
  if (closed || links <= base.links) return;
  context.begin("refitting pairs with more links", pairs.size());
  in_parallel(pairs.size(), context.threads, [&](std::size_t k) {
    Pair& pair = pairs[k];
    pair.finer = tried_with_links(pair.second.model, links, {pair.first.id, pair.second.id},
                                  state.found.noise, context);
  });
  context.stop_if_asked();
  for (Pair& pair : pairs)
    if (pair.finer.ok && state.squares(pair.finer) >= state.squares(pair.second.model))
      pair.finer = {};
}

/// The best pairs on a model without effects, without those that were looked at already.
std::vector<Pair> pairs_on(DiagnosisState& state, const Stage& base) {
  std::vector<Pair> pairs;
  for (const Explanation& first : firsts_on(state, base)) add_pairs_of(state, base, first, pairs);
  std::stable_sort(pairs.begin(), pairs.end(), [&](const Pair& a, const Pair& b) {
    return state.squares(a.second.model) < state.squares(b.second.model);
  });
  pairs.resize(std::min(pairs.size(), kThresholds.tried_with_more_links));
  try_with_more_links(state, base, pairs);
  return pairs;
}

}  // namespace

bool add_pair(DiagnosisState& state) {
  if (state.options.max_effects < 2) return false;
  const std::vector<Pair> pairs = pairs_on(state, without_effects(state));
  const Pair* best = nullptr;
  for (const Pair& pair : pairs)
    if (!best || state.squares(pair.best()) < state.squares(best->best())) best = &pair;
  if (!best || state.squares(best->best()) >= state.squares(state.last().model)) return false;
  // Of as many effects, others take their place only where the data decide.
  if ((explained(state) || state.last().effects.size() >= 2) &&
      !decide(best->best(), state.last().model, state.found.noise).decided)
    return false;
  if (!state.generalises(held_out_gap(best->best(), state.found.noise)) ||
      state.reopens_gap(best->best()))
    return false;
  state.enter(best->first.model, {best->first.id}, best->first.id, listed(state.last().effects));
  state.last().explanations = best->beside;
  state.enter(trim(best->second.model, state.found.noise, state.context),
              {best->first.id, best->second.id}, best->second.id);
  if (best->finer.ok)
    state.enter(trim(best->finer, state.found.noise, state.context), state.last().effects,
                kTooFewLinks);
  state.found.effects = state.last().effects;
  return true;
}

}  // namespace catena
