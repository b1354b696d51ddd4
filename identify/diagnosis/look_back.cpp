// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/look_back.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/errors_of_knowns.hpp"
#include "identify/diagnosis/links.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/search.hpp"
#include "identify/diagnosis/special_case.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/trim.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

void forget_alternatives(Diagnosis& found) {
  found.alternatives.clear();
  found.forms.clear();
  found.runners_up.clear();
}

/// The stage before the last, if `id` was added to exactly `others` there, with the present number
/// of links, after a look at what else could be added.
const Stage* stage_before(const DiagnosisState& state, const std::string& id,
                          const std::vector<std::string>& others) {
  const std::vector<Stage>& stages = state.found.stages;
  if (stages.size() < 2) return nullptr;
  const Stage& before = stages[stages.size() - 2];
  const bool fits = before.effects == others && state.last().added == id &&
                    before.links == state.last().links && !before.explanations.empty();
  return fits ? &before : nullptr;
}

/// The best model so far fitted without one of its effects, and what could be added to it instead.
/// Its model has no problem where it could not be fitted.
Stage stage_without(DiagnosisState& state, const std::string& id,
                    const std::vector<std::string>& others) {
  DiagnosisContext& context = state.context;
  context.begin("looking back at " + id);
  const Stage& last = state.last();
  Stage without;
  const Case the_case = without_effect(last.model.problem->the_case(), id);
  const auto problem =
      std::make_shared<const Problem>(the_case, context.model_with(others, the_case.links));
  without.model = fit_model(problem, transfer(*last.model.problem, last.model.x, *problem),
                            state.found.noise, context.least_squares, context.stop);
  if (!without.model.ok) return {};
  without.effects = others;
  without.links = the_case.links;
  without.fit = fit_gap(without.model, state.found.noise);
  without.held_out = held_out_gap(without.model, state.found.noise);
  // Something that nearly fits may stand in the place of the right one. Else the looks ahead have tried
  // all of them.
  const bool nearly =
      gap_left(last) && nearly_closes(last.fit, last_without_effects(state.found.stages).fit);
  if (!needless(state, without))
    without.explanations =
        look(state, without.model, others, nearly ? RefitOthers::kAlways : RefitOthers::kNever);
  return without;
}

/// What an explanation is beside the effect named, in its place.
struct Weighed {
  const Explanation* explanation = nullptr;
  const Candidate* effect = nullptr;  // nullptr: a rival that is no effect
  Decision decision;
  bool better = false;  // leaves less
  /// Predicts what was held out worse, or needs a drive without predicting it better, or drives the
  /// chain as it moves anyway.
  bool no_rival = false;
};

/// A law that leads another one in what was fitted has to lead beside plausible errors of what the case states
/// and the sensors report, too: what these leave, the wrong law may fit. Else the other one leads, and perhaps so
/// far that the data decide for it.
void weigh_beside_errors_of_knowns(const DiagnosisState& state, const std::string& named,
                                   const std::vector<std::string>& others, Weighed& weighed) {
  const auto is_law = [&](const std::string& id) {
    return !is_error_of_known(*state.context.find(id));
  };
  const Explanation& explanation = *weighed.explanation;
  if (!weighed.effect || !is_law(explanation.id) || !is_law(named)) return;
  const std::vector<std::string> effects = with(others, explanation.id);
  const Stage& last = state.last();
  const double lead =
      lead_beyond_errors_of_knowns(state, {explanation.model, effects}, {last.model, last.effects});
  Decision& decision = weighed.decision;
  if (lead > decision.needed) return;
  weighed.better = false;
  decision.decided =
      -lead > decision.needed && predicts_as_well(last.held_out, explanation.held_out);
}

Weighed weigh(const DiagnosisState& state, const std::string& named, const Stage& without,
              const Explanation& explanation) {
  Weighed weighed;
  weighed.explanation = &explanation;
  weighed.effect = explanation.is_effect() ? state.context.find(explanation.id) : nullptr;
  const FittedModel& last = state.last().model;
  weighed.better = state.squares(explanation.model) < state.squares(last);
  weighed.decision = weighed.better ? decide(explanation.model, last, state.found.noise)
                                    : decide(last, explanation.model, state.found.noise);
  weighed.no_rival =
      predicts_better(last, explanation.model, state.found.noise) ||
      goes_with_the_motion(state, without.model, explanation) ||
      needs_no_drive(state, named, state.last().held_out, explanation.id, explanation.held_out);
  if (weighed.better && weighed.decision.decided && !weighed.no_rival)
    weigh_beside_errors_of_knowns(state, named, without.effects, weighed);
  return weighed;
}

/// Puts an explanation where the report looks for it.
void sort_in(Diagnosis& found, const std::string& id, const Candidate& named,
             const Weighed& weighed, const Model& all) {
  const bool contains = weighed.effect && is_special_case(named, *weighed.effect, all);
  const bool form = weighed.effect && weighed.effect->effect.form_of == id;
  std::vector<Alternative>& list = weighed.decision.decided || weighed.no_rival || contains
                                       ? found.runners_up
                                   : form ? found.forms
                                          : found.alternatives;
  list.push_back({id, *weighed.explanation, weighed.decision});
}

/// Sorts the explanations that could stand in the place of `id`. Enters the model of the one that has a better claim to
/// the place, an effect or a freer start; returns whether there is one.
bool weigh_alternatives(DiagnosisState& state, const std::string& id, const Stage& without) {
  const Candidate& named = *state.context.find(id);
  const std::vector<NoiseModel>& noise = state.found.noise;
  const Explanation* successor = nullptr;
  for (const Explanation& explanation : without.explanations) {
    if (!explanation.refitted || explanation.id == id) continue;
    const Weighed weighed = weigh(state, id, without, explanation);
    const Model all = state.context.model_with_all(state.last().links);
    const bool is_new = weighed.effect ? !state.had(with(without.effects, explanation.id))
                                       : !state.found.freer_start;
    const bool may_succeed = is_new && !weighed.no_rival && !state.reopens_gap(explanation.model);
    // What was held out may decide, too.
    if (may_succeed && !successor && acceptable(state, without.model, explanation) &&
        (predicts_better(explanation.model, state.last().model, noise) ||
         needs_no_drive(state, explanation.id, explanation.held_out, id, state.last().held_out)))
      successor = &explanation;
    if (may_succeed && weighed.better && weighed.decision.decided &&
        state.generalises(explanation.held_out) &&
        (!successor || state.squares(explanation.model) < state.squares(successor->model)))
      successor = &explanation;
    // Of two that explain the same, one inside the other, the smaller has the name; of two laws of
    // one effect, the one that the other is declared a form of.
    if (may_succeed && weighed.effect && !successor && !weighed.decision.decided &&
        acceptable(state, without.model, explanation) &&
        (named.effect.form_of == weighed.effect->id ||
         is_special_case(*weighed.effect, named, all)))
      successor = &explanation;
    sort_in(state.found, id, named, weighed, all);
  }
  if (!successor) return false;
  state.enter(trim(successor->model, noise, state.context),
              successor->is_effect() ? with(without.effects, successor->id) : without.effects,
              successor->id, id);
  return true;
}

/// A cable has no links, and their number needs no name: takes more links in the place of an effect where the data do
/// not decide against them. Near a clamp, say, a long link is too stiff, or too soft.
bool more_links_do_as_well(DiagnosisState& state, const std::string& id, const Stage& without) {
  FinerChain finer = try_finer_chain(without.model, without.effects, state.found.noise,
                                     state.options.max_links, state.context);
  if (!finer.refitted || state.reopens_gap(finer.model)) return false;
  const FittedModel& last = state.last().model;
  const std::vector<NoiseModel>& noise = state.found.noise;
  if (state.squares(last) < state.squares(finer.model) && decide(last, finer.model, noise).decided)
    return false;
  if (!predicts_as_well(held_out_gap(finer.model, noise), state.last().held_out)) return false;
  state.enter(std::move(finer.model), without.effects, kTooFewLinks, id);
  return true;
}

}  // namespace

bool needless(const DiagnosisState& state, const Stage& without) {
  if (state.reopens_gap(without.model)) return false;
  const Stage& last = state.last();
  if (!without.fit.present || !predicts_as_well(last.held_out, without.held_out)) return true;
  // Others may have taken its place in what was fitted.
  if (!predicts_as_well(without.held_out, last.held_out) &&
      more_than_a_detail_held_out(state, without.held_out, last.held_out))
    return false;
  const Comparison gain = compare(without.model, last.model, state.found.noise);
  return gain.log10_p > -std::log10(kThresholds.odds) ||
         gain.misfit_share < kThresholds.worthwhile ||
         !more_than_a_detail(state, without.model, last.model);
}

bool look_back(DiagnosisState& state) {
  std::vector<std::string>& effects = state.found.effects;
  forget_alternatives(state.found);
  bool changed = false;
  for (std::size_t i = 0; i < effects.size();) {
    state.context.stop_if_asked();
    const std::string id = effects[i];
    std::vector<std::string> others = effects;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Stage* known = stage_before(state, id, others);
    const Stage without = known ? *known : stage_without(state, id, others);
    if (!without.model.problem) {
      ++i;
      continue;
    }
    if (needless(state, without)) {
      state.enter(without.model, others, "", id);
    } else if (!weigh_alternatives(state, id, without) &&
               !more_links_do_as_well(state, id, without)) {
      ++i;
      continue;
    }
    changed = true;
    effects = state.last().effects;
    forget_alternatives(state.found);
    i = 0;
  }
  return changed;
}

}  // namespace catena
