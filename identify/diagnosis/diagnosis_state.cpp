// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/diagnosis_state.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "common/input_error.hpp"
#include "common/nearest_name.hpp"
#include "identify/diagnosis/close_simulation.hpp"
#include "identify/diagnosis/predictive_accuracy.hpp"
#include "identify/diagnosis/remainder.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {
namespace {

/// The noise once this model is the best. What was told from white noise of one size goes first; then
/// the lower, for what a model misses makes it larger.
std::vector<NoiseModel> best_known(std::vector<NoiseModel> noise,
                                   const std::vector<NoiseModel>& of_model) {
  for (std::size_t e = 0; e < noise.size(); ++e)
    if (of_model[e].told != noise[e].told ? of_model[e].told : of_model[e].level < noise[e].level)
      noise[e] = of_model[e];
  return noise;
}

std::string described(const Stage& stage) {
  return fmt::format("{}, {} links: {:.3g} times the noise",
                     stage.effects.empty() ? "the case's model" : "with " + listed(stage.effects),
                     stage.links, stage.fit.ratio());
}

}  // namespace

void DiagnosisState::enter(FittedModel model, std::vector<std::string> effects,
                           const std::string& added, const std::string& removed) {
  const std::vector<NoiseModel> of_model = noise_of(model);
  if (found.noise.empty()) {
    for (const NoiseModel& each : of_model)
      if (!(each.level > 0))
        throw InputError(
            "too few neighbouring frames to estimate the noise: give `noise` in the "
            "experiment");
    found.noise = of_model;
  }
  found.noise = best_known(found.noise, of_model);
  model = simulated_closely(std::move(model), found.noise, context);
  Stage next;
  next.effects = std::move(effects);
  next.added = added;
  found.freer_start = found.freer_start || added == kStartShape;
  next.removed = removed;
  next.links = model.problem->the_case().links;
  next.fit = fit_gap(model, found.noise);
  next.held_out = tested_held_out_gap(model, found.noise);
  next.model = std::move(model);
  found.stages.push_back(std::move(next));
  context.tell_best(described(last()));
}

double DiagnosisState::squares(const FittedModel& model) const {
  return sum_of_squares(model, found.noise);
}

bool DiagnosisState::far() const { return last().fit.ratio() > kThresholds.far; }

bool DiagnosisState::generalises(const GapTest& held_out) const {
  return predicts_as_well(held_out, last().held_out);
}

bool DiagnosisState::reopens_gap(const FittedModel& model) const {
  return !gap_left(last()) && gap_left(model, best_known(found.noise, noise_of(model)));
}

bool DiagnosisState::had(std::vector<std::string> effects) const {
  std::sort(effects.begin(), effects.end());
  return std::any_of(found.stages.begin(), found.stages.end(), [&](const Stage& stage) {
    std::vector<std::string> others = stage.effects;
    std::sort(others.begin(), others.end());
    return others == effects;
  });
}

int DiagnosisState::more_links(int links) const { return std::min(2 * links, options.max_links); }

std::vector<std::string> with(std::vector<std::string> effects, const std::string& id) {
  effects.push_back(id);
  return effects;
}

}  // namespace catena
