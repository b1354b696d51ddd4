// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// What one search for something missing is about.
struct CandidateSearch {
  DiagnosisContext& context;
  FittedModel base;                  ///< something may be missing in it
  std::vector<std::string> effects;  ///< those of the library that are in the base already
  std::vector<NoiseModel> noise;     ///< of every experiment

  /// Whether the base has an effect of this id already.
  bool in_base(const std::string& id) const;
  /// The base's case and unknowns with a candidate added, all its parameters free.
  std::shared_ptr<const Problem> problem_with(const Candidate& candidate) const;
  /// The base's case with a freer start. Nothing where the start is not a polynomial.
  std::optional<Case> with_free_start() const;
};

}  // namespace catena
