// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/candidate_search.hpp"

#include <algorithm>

#include "identify/diagnosis/diagnosis_state.hpp"
#include "identify/diagnosis/residual_frequencies.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {
namespace {

constexpr int kMoreTerms = 4;  // of the start's shape, tried as a rival
constexpr int kRateTerms = 3;  // of its velocity

/// Every frequency of the case's effects at least so high that the recordings show it.
Case with_shown_frequencies(Case the_case, const FittedModel& base) {
  const double lowest = lowest_shown_frequency(base);
  for (ParameterSpec& parameter : the_case.parameters) {
    if (parameter.unit != "Hz") continue;
    parameter.lower = std::clamp(lowest, parameter.lower, parameter.upper);
    parameter.value = std::max(parameter.value, parameter.lower);
  }
  return the_case;
}

}  // namespace

bool CandidateSearch::in_base(const std::string& id) const {
  return std::find(effects.begin(), effects.end(), id) != effects.end();
}

std::shared_ptr<const Problem> CandidateSearch::problem_with(const Candidate& candidate) const {
  const Case& the_case = base.problem->the_case();
  return std::make_shared<const Problem>(
      with_shown_frequencies(with_effects(the_case, {candidate}, true), base),
      context.model_with(with(effects, candidate.id), the_case.links));
}

std::optional<Case> CandidateSearch::with_free_start() const {
  return with_freer_start(base.problem->the_case(), kMoreTerms, kRateTerms);
}

}  // namespace catena
