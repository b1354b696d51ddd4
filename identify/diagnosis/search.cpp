// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/search.hpp"

#include <algorithm>

#include "identify/diagnosis/candidate_scores.hpp"
#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/effects_with_links.hpp"
#include "identify/diagnosis/refits.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/trim.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// Takes more links if the data want them.
bool take_more_links(DiagnosisState& state) {
  FinerChain& finer = state.last().finer;
  finer = try_finer_chain(state.last().model, state.last().effects, state.found.noise,
                          state.options.max_links, state.context);
  if (finer.taken && state.reopens_gap(finer.model)) {
    finer.taken = false;
    finer.note = "refitted, and a gap that was closed would be open again";
  }
  if (!finer.taken) return false;
  state.enter(finer.model, state.last().effects, kTooFewLinks);
  return true;
}

/// Takes the best explanation of the present gap, alone or with more links.
bool take_explanation(DiagnosisState& state) {
  state.last().explanations = look(state, state.last().model, state.last().effects);
  const Explanation* best = choose(state, state.last().explanations);
  if (!best) return add_with_more_links(state);
  std::vector<std::string> effects = state.last().effects;
  if (best->is_effect()) effects.push_back(best->id);
  state.enter(trim(best->model, state.found.noise, state.context), effects, best->id);
  return true;
}

}  // namespace

void look_for_effects(DiagnosisState& state) {
  for (;;) {
    state.context.stop_if_asked();
    const bool gap = gap_left(state.last());
    // A name is given only at a number of links that leaves no trace.
    if (!gap && (state.last().effects.empty() || !trace_left(state.last()))) break;
    if (take_more_links(state)) continue;
    if (!gap || static_cast<int>(state.last().effects.size()) >= state.options.max_effects) break;
    if (!take_explanation(state)) break;
  }
  state.found.effects = state.last().effects;
  if (state.found.effects.empty()) return;
  if (trace_left(state.last())) try_others_with_more_links(state);
  go_back_to_fewer_links(state);
  state.found.effects = state.last().effects;
}

std::vector<Explanation> look(DiagnosisState& state, const FittedModel& model,
                              const std::vector<std::string>& effects, RefitOthers others) {
  DiagnosisContext& context = state.context;
  const bool far = state.far();
  const CandidateSearch search{context, model, effects, state.found.noise};
  CandidateScores scores(search);
  std::vector<Explanation> explanations = scores.score(false);
  refit_best(search, explanations,
             state.options.refits + (far ? kThresholds.more_refits_when_far : 0), far);
  context.stop_if_asked();
  const GapTest before = fit_gap(model, state.found.noise);
  const auto closed = [&] {
    return std::any_of(explanations.begin(), explanations.end(), [&](const Explanation& each) {
      return each.refitted && nearly_closes(each.fit, before);
    });
  };
  // Where the best leave a gap, the score ranked wrongly: what holds and slips scores little if it
  // holds most of the time. The others may be what is missing.
  if (others == RefitOthers::kAlways || (others == RefitOthers::kWhereGapIsLeft && !closed()))
    refit_rest(search, explanations);
  context.stop_if_asked();
  // Effects that need a model of their own cost more: only if the others leave a gap.
  if (!closed()) {
    std::vector<Explanation> more = scores.score(true);
    refit_best(search, more, kThresholds.own_model_refits, far);
    explanations.insert(explanations.end(), more.begin(), more.end());
    std::stable_sort(explanations.begin(), explanations.end(),
                     [](const Explanation& a, const Explanation& b) {
                       return a.score.removed > b.score.removed;
                     });
  }
  context.stop_if_asked();
  scores.set_chances(explanations);
  int tried = 0;
  for (const Explanation& each : explanations) tried += each.score.admissible || each.note.empty();
  state.found.tried = std::max(state.found.tried, tried);
  return explanations;
}

}  // namespace catena
