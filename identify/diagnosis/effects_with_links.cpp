// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/effects_with_links.hpp"

#include <algorithm>

#include "common/parallel.hpp"
#include "identify/diagnosis/candidate_scores.hpp"
#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/trim.hpp"

namespace catena {
namespace {

/// The effects that left least when added to `looked`, but `except`, each refitted with so many
/// links; without those whose refit failed. Throws Interrupted.
std::vector<Explanation> best_with_links(DiagnosisState& state, const Stage& looked, int links,
                                         const std::string& except = "") {
  DiagnosisContext& context = state.context;
  std::vector<Explanation> best = best_effects(looked.explanations, state.found.noise,
                                               kThresholds.tried_with_more_links, except);
  context.begin("refitting with more links", best.size());
  in_parallel(best.size(), context.threads, [&](std::size_t k) {
    best[k].model = tried_with_links(best[k].model, links, with(looked.effects, best[k].id),
                                     state.found.noise, context);
  });
  context.stop_if_asked();
  std::erase_if(best, [](const Explanation& each) { return !each.model.ok; });
  return best;
}

}  // namespace

bool add_with_more_links(DiagnosisState& state) {
  const Stage& looked = state.last();
  const int links = state.more_links(looked.links);
  if (links <= looked.links) return false;
  std::vector<Explanation> explanations = best_with_links(state, looked, links);
  if (explanations.empty()) return false;
  const bool known = looked.finer.refitted && looked.finer.links == links;
  FittedModel finer = known ? looked.finer.model
                            : refitted_with_links(looked.model, links, looked.effects,
                                                  state.found.noise, state.context);
  state.context.stop_if_asked();
  if (!finer.ok) return false;
  // The finer chain's own fit may be the worse one, where it ends in another minimum.
  const FittedModel& base =
      state.squares(finer) < state.squares(looked.model) ? finer : looked.model;
  for (Explanation& each : explanations) {
    each.comparison = compare(base, each.model, state.found.noise);
    each.fit = fit_gap(each.model, state.found.noise);
    each.held_out = held_out_gap(each.model, state.found.noise);
  }
  const CandidateSearch search{state.context, base, looked.effects, state.found.noise};
  CandidateScores scores(search);
  scores.score(false);
  if (std::any_of(explanations.begin(), explanations.end(),
                  [&](const Explanation& each) { return state.context.find(each.id)->own_model; }))
    scores.score(true);
  scores.set_chances(explanations);
  state.enter(std::move(finer), looked.effects, kTooFewLinks);
  state.last().explanations = std::move(explanations);
  const Explanation* best = choose(state, state.last().explanations);
  if (!best) {
    state.found.stages.pop_back();
    return false;
  }
  state.enter(trim(best->model, state.found.noise, state.context),
              with(state.last().effects, best->id), best->id);
  return true;
}

void try_others_with_more_links(DiagnosisState& state) {
  const Stage& looked = state.found.stages[state.found.stages.size() - 2];
  const int links = state.more_links(state.last().links);
  if (links <= state.last().links) return;
  const std::vector<Explanation> others = best_with_links(state, looked, links, state.last().added);
  const Explanation* best = nullptr;
  for (const Explanation& each : others)
    if (!best || state.squares(each.model) < state.squares(best->model)) best = &each;
  if (best && state.squares(best->model) < state.squares(state.last().model) &&
      decide(best->model, state.last().model, state.found.noise).decided &&
      state.generalises(held_out_gap(best->model, state.found.noise)) &&
      !state.reopens_gap(best->model))
    state.enter(trim(best->model, state.found.noise, state.context), with(looked.effects, best->id),
                best->id, state.last().added);
}

void go_back_to_fewer_links(DiagnosisState& state) {
  for (std::size_t s = state.found.stages.size(); s-- > 0;) {
    const int links = state.found.stages[s].links;
    if (links >= state.last().links) continue;
    FittedModel model = refitted_with_links(state.last().model, links, state.last().effects,
                                            state.found.noise, state.context);
    if (!model.ok || state.squares(model) >= state.squares(state.last().model) ||
        state.reopens_gap(model))
      break;
    state.enter(std::move(model), state.last().effects, "", kTooFewLinks);
  }
}

}  // namespace catena
