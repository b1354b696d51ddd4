// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/trim.hpp"

#include <algorithm>
#include <cmath>

#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/final_model.hpp"
#include "identify/diagnosis/thresholds.hpp"
#include "identify/diagnosis/variant.hpp"
#include "identify/diagnosis/verdict.hpp"

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// The effect a case's parameter belongs to; nullptr: none.
const Candidate* effect_of(const ParameterSpec& spec, const DiagnosisContext& context) {
  const std::size_t dot = spec.sets.find('.');
  return dot == std::string::npos ? nullptr : context.find(spec.sets.substr(0, dot));
}

const CandidateParameter* parameter_of(const Candidate& candidate, const std::string& name) {
  for (const CandidateParameter& parameter : candidate.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

}  // namespace

FittedModel trim(const FittedModel& refit, const std::vector<NoiseModel>& noise,
                 DiagnosisContext& context) {
  FittedModel model = fit_model(refit.problem, refit.x, noise, context.least_squares, context.stop);
  if (!model.ok) model = refit;
  const Problem& problem = *model.problem;
  const VectorXd errors = standard_errors(model, noise);
  Case smaller = problem.with(model.x);
  int dropped = 0;
  std::vector<std::string> fixed;
  for (const Candidate& candidate : context.library()) {
    std::vector<ParameterSpec*> needless;
    int amplitudes = 0;
    for (ParameterSpec& spec : smaller.parameters) {
      if (effect_of(spec, context) != &candidate || !spec.free) continue;
      const CandidateParameter* parameter = parameter_of(candidate, spec.sets);
      if (!parameter || parameter->role != ParameterRole::kAmplitude) continue;
      ++amplitudes;
      const Index j = unknown_index(problem, spec.name);
      if (std::abs(model.x[j] - parameter->neutral) < kThresholds.needless_amplitude * errors[j])
        needless.push_back(&spec);
    }
    if (static_cast<int>(needless.size()) >= amplitudes)
      continue;  // no effect without an amplitude
    for (ParameterSpec* spec : needless) {
      const auto index =
          static_cast<int>(parameter_of(candidate, spec->sets) - candidate.parameters.data());
      spec->value = candidate.parameters[static_cast<std::size_t>(index)].neutral;
      spec->free = false;
      spec->measured = spec->standard_deviation = kNotGiven;
      ++dropped;
      for (ParameterSpec& other : smaller.parameters) {
        const CandidateParameter* phase = parameter_of(candidate, other.sets);
        if (phase && phase->role == ParameterRole::kPhase && phase->amplitude == index)
          other.free = false;
      }
    }
  }
  if (dropped == 0) return model;
  const auto simpler = std::make_shared<const Problem>(smaller, problem.model());
  FittedModel refitted = fit_model(simpler, transfer(problem, model.x, *simpler), noise,
                                   context.least_squares, context.stop);
  if (!refitted.ok) return model;
  const double allowed =
      dropped * std::log(static_cast<double>(std::max(2L, fit_gap(model, noise).count)));
  const bool as_good = sum_of_squares(refitted, noise) < sum_of_squares(model, noise) + allowed;
  const bool opens_gap = as_good && gap_left(refitted, noise) && !gap_left(model, noise);
  return as_good && !opens_gap ? refitted : model;
}

}  // namespace catena
