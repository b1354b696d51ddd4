// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/discovery.hpp"

#include <fmt/format.h>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/explanation.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"
#include "identify/forces/law_effect.hpp"
#include "identify/problem/parameter_map.hpp"

namespace catena {
namespace {

constexpr const char* kDiscoveredLaw = "discovered_law";

/// "discovered_law", or "discovered_law_2" where a case has one already.
std::string new_id(const DiagnosisContext& context) {
  std::string id = kDiscoveredLaw;
  for (int number = 2; context.knows(id); ++number)
    id = fmt::format("{}_{}", kDiscoveredLaw, number);
  return id;
}

/// The law as an effect of the library, whose parameters begin at the values found.
const Candidate& add_to_library(DiagnosisContext& context, const FittedModel& base,
                                const MissingForce& force) {
  const double length =
      link_lengths(base.problem->model(), base.problem->model_parameters(base.x, 0)).sum();
  const std::string id = new_id(context);
  Candidate& candidate =
      context.add_effect(id, effect_of(*force.law, id, force.law->place, length));
  const auto value_of = [&](const std::string& name) {
    for (const PlaceLaw::Constant& constant : force.law->formula.constants)
      if (name == constant.name) return constant.value;
    return force.law->place;
  };
  for (std::size_t i = 0; i < candidate.parameters.size(); ++i)
    candidate.parameters[i].value = value_of(candidate.effect.parameters[i].name);
  return candidate;
}

Explanation refitted_with(const DiagnosisState& state, const FittedModel& base,
                          const std::vector<std::string>& effects, const Candidate& candidate) {
  DiagnosisContext& context = state.context;
  Explanation explanation;
  explanation.id = candidate.id;
  const Case the_case = with_effects(base.problem->the_case(), {candidate}, true);
  const auto problem =
      std::make_shared<const Problem>(the_case, context.model_with(effects, the_case.links));
  FittedModel model = fit_model(problem, transfer(*base.problem, base.x, *problem),
                                state.found.noise, context.least_squares, context.stop);
  explanation.refitted = model.ok;
  if (!model.ok) return explanation;
  explanation.comparison = compare(base, model, state.found.noise);
  explanation.chance = chance_of_any(explanation.comparison, state.found.tried);
  explanation.fit = fit_gap(model, state.found.noise);
  explanation.held_out = held_out_gap(model, state.found.noise);
  explanation.model = std::move(model);
  return explanation;
}

MissingForce force_missing_in(const DiagnosisState& state, const FittedModel& model) {
  state.context.begin("estimating the missing force");
  MissingForce force = missing_force(*model.problem, model.x, levels(state.found.noise),
                                     [&] { return !state.context.stopped(); });
  state.context.stop_if_asked();
  return force;
}

/// Takes the law of a force that the stage `base` lacks, in place of the effects that `base` has
/// not. False, and nothing changed but the library and the notes, where it does not stand.
bool take_law(DiagnosisState& state, const Stage& base, MissingForce force, const Case& asked) {
  Diagnosis& found = state.found;
  if (!force.law || !force.law->found ||
      static_cast<int>(base.effects.size()) >= state.options.max_effects)
    return false;
  state.context.begin("fitting the law of the missing force");
  const Candidate& candidate = add_to_library(state.context, base.model, force);
  const std::vector<std::string> effects = with(base.effects, candidate.id);
  Explanation explanation = refitted_with(state, base.model, effects, candidate);
  state.context.stop_if_asked();
  const bool replaces = base.effects.size() < state.last().effects.size();
  Diagnosis before = found;
  if (acceptable(state, base.model, explanation) &&
      (!replaces || predicts_better(explanation.model, state.last().model, found.noise))) {
    state.enter(std::move(explanation.model), effects, candidate.id,
                replaces ? listed(state.last().effects) : "");
    found.effects = effects;
    found.law = candidate.id;
    found.force = std::move(force);
    if (replaces) {
      found.alternatives.clear();
      found.forms.clear();
    }
    conclude(state, asked);
    if (found.verdict == DiagnosisVerdict::kDiscovered) return true;
  }
  found = std::move(before);
  found.notes.push_back(fmt::format("the law of \"{}\" was fitted as an effect, but does not stand",
                                    candidate.title));
  return false;
}

}  // namespace

void discover(DiagnosisState& state, const Case& asked) {
  Diagnosis& found = state.found;
  if (found.verdict != DiagnosisVerdict::kUnexplained && found.verdict != DiagnosisVerdict::kPartly)
    return;
  if (found.final.problem->model().in_space()) {
    found.notes.emplace_back("the missing force is estimated in the plane only");
    return;
  }
  const Stage last = state.last(), bare = last_without_effects(found.stages);
  found.force = force_missing_in(state, found.final);
  // The effects may be there because they imitate the law.
  if (!last.effects.empty() && take_law(state, bare, force_missing_in(state, bare.model), asked))
    return;
  take_law(state, last, *found.force, asked);
}

}  // namespace catena
