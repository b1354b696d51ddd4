// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnose.hpp"

#include <chrono>

#include "common/input_error.hpp"
#include "identify/diagnosis/baseline.hpp"
#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/discovery.hpp"
#include "identify/diagnosis/doubted_knowns.hpp"
#include "identify/diagnosis/look_back.hpp"
#include "identify/diagnosis/pairs.hpp"
#include "identify/diagnosis/sealed_part.hpp"
#include "identify/diagnosis/search.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// Adds effects, and looks back at them. What looking back changed may make room for more effects,
/// or need more links.
void look_ahead_and_back(DiagnosisState& state) {
  for (int round = 0; round < kThresholds.rounds; ++round) {
    look_for_effects(state);
    if (state.found.effects.empty() || !look_back(state) || !gap_left(state.last())) break;
  }
}

Diagnosis examine(Case the_case, DiagnosisContext& context, const DiagnosisOptions& options) {
  DiagnosisState state(context, options);
  hold_out(the_case, context, state.found.notes);
  seal_last_part(the_case, context);
  for (Candidate& doubtful : doubtful_parameters(the_case, context.model_with({}, the_case.links)))
    context.add(std::move(doubtful));
  context.begin("fitting the baseline");
  state.enter(fit_baseline(for_the_search(the_case), context), {}, "");
  const std::vector<Experiment>& experiments = state.last().model.problem->experiments();
  for (Candidate& known : doubted_knowns(the_case, experiments))
    if (!context.knows(known.id)) context.add(std::move(known));
  look_ahead_and_back(state);
  // One after the other two effects may both be missed: neither is worth much alone, or a third
  // imitates both.
  if ((!explained(state) || one_may_imitate_two(state.last())) && add_pair(state))
    look_ahead_and_back(state);
  conclude(state, the_case);
  discover(state, the_case);
  state.found.predictions = prediction_errors(
      state.found.final, without_laws(state, state.found.final, state.found.effects),
      state.found.noise, context);
  context.stop_if_asked();
  return std::move(state.found);
}

}  // namespace

Diagnosis diagnose(Case the_case, DiagnosisContext& context, const DiagnosisOptions& options) {
  const auto begin = std::chrono::steady_clock::now();
  if (the_case.experiments.empty()) throw InputError("the case has no experiment to diagnose");
  try {
    Diagnosis found = examine(std::move(the_case), context, options);
    found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return found;
  } catch (const std::exception&) {
    // The interruption is the cause: Ctrl-C ends a compiler that is running, too.
    context.stop_if_asked();
    throw;
  }
}

}  // namespace catena
