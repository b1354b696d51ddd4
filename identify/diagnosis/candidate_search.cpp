// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/candidate_search.hpp"

#include <algorithm>

#include "identify/diagnosis/state.hpp"
#include "identify/diagnosis/variant.hpp"

namespace catena {
namespace {

constexpr int kMoreTerms = 4;  // of the start's shape, tried as a rival
constexpr int kRateTerms = 3;  // of its velocity

}  // namespace

bool CandidateSearch::in_base(const std::string& id) const {
  return std::find(effects.begin(), effects.end(), id) != effects.end();
}

std::shared_ptr<const Problem> CandidateSearch::problem_with(const Candidate& candidate) const {
  const Case& the_case = base.problem->the_case();
  return std::make_shared<const Problem>(
      with_effects(the_case, {candidate}, true),
      context.model_with(with(effects, candidate.id), the_case.links));
}

std::optional<Case> CandidateSearch::with_free_start() const {
  return with_freer_start(base.problem->the_case(), kMoreTerms, kRateTerms);
}

}  // namespace catena
