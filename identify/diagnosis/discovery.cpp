// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/discovery.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "common/nearest_name.hpp"
#include "identify/diagnosis/choice.hpp"
#include "identify/diagnosis/explanation.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/shares.hpp"
#include "identify/diagnosis/thresholds.hpp"
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
  Candidate& candidate = context.add_effect(id, effect_of(*force.law, id, length));
  const auto value_of = [&](const std::string& name) {
    for (const CandidateLaw::Constant& constant : force.law->formula.constants)
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

/// Log odds of the effects, with the force that is missing beside them, against a force without any
/// of them (`alone`). A force of no known form can do what effects do; what they imitate of it, they
/// only imitate. Unknowns count by the Bayesian information criterion.
double log_odds_against_force_alone(const Diagnosis& found, const MissingForce& beside,
                                    const FittedModel& without, const MissingForce& alone) {
  if (!without.ok) return std::numeric_limits<double>::quiet_NaN();
  const auto unknowns = [](const FittedModel& model) {
    return static_cast<double>(model.problem->unknowns().size());
  };
  const double added = unknowns(found.final) - unknowns(without);
  const double cost = 0.5 * added * std::log(static_cast<double>(found.final_fit.count));
  return beside.log_probability - alone.log_probability - cost;
}

}  // namespace

void discover(DiagnosisState& state, const Case& asked) {
  Diagnosis& found = state.found;
  const bool gap =
      found.verdict == DiagnosisVerdict::kUnexplained || found.verdict == DiagnosisVerdict::kPartly;
  // Where effects close the gap, one cause may have been taken for several of them only.
  if (!gap && found.effects.size() < 2) return;
  if (found.final.problem->model().in_space()) {
    if (gap) found.notes.emplace_back("the missing force is estimated in the plane only");
    return;
  }
  const Stage last = state.last();
  const MissingForce beside = force_missing_in(state, found.final);
  if (gap) found.force = beside;
  if (!last.effects.empty()) {
    Stage bare = last_without_effects(found.stages);
    if (bare.links != last.links) {
      bare.model = fit_with_effects(state, {});
      bare.links = last.links;
    }
    const MissingForce alone = bare.model.ok ? force_missing_in(state, bare.model) : MissingForce{};
    if (gap && take_law(state, bare, alone, asked)) return;
    const double log_odds = log_odds_against_force_alone(found, beside, bare.model, alone);
    const double decided = std::log(kThresholds.odds);
    if (alone.found && log_odds < (gap ? decided : -decided)) {
      if (!gap && take_law(state, bare, alone, asked)) return;
      found.force = beside;
      doubt_effects(state, alone.words.front());
      return;
    }
    if (alone.found && log_odds < decided) {
      add_force_as_rival(state, alone.words.front());
    } else if (alone.found && std::isfinite(log_odds)) {
      found.notes.push_back(
          fmt::format("a force of no known form instead of {} is ruled out by log odds of {:.3g}",
                      listed(found.effects), log_odds));
    }
  }
  if (gap) take_law(state, last, beside, asked);
}

}  // namespace catena
