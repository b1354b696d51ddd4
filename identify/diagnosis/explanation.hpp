// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/score.hpp"

namespace catena {

/// One explanation held against a fitted model: an effect, or a rival that is none.
struct Explanation {
  std::string id, title;
  int candidate = -1;  ///< index into the library; -1: a rival
  Score score;
  /// Starting values by the names of the unknowns: amplitudes, shapes and phases found by the
  /// score.
  std::vector<std::pair<std::string, double>> start;
  std::vector<std::pair<std::string, double>> other_start;  ///< of the best shape elsewhere
  double log10_p = 0;  ///< of the predicted fall, for one candidate
  std::string note;    ///< why it was not tried, or what to know about it

  bool refitted = false;
  FittedModel model;      ///< of the refit
  Comparison comparison;  ///< with the model it was added to
  /// Probability that the best of all that was tried removes as much by chance; 1 where too little was
  /// removed to ask.
  double chance = 1;
  GapTest fit, held_out;  ///< after the refit

  bool is_effect() const { return candidate >= 0; }
};

inline constexpr const char* kStartShape = "start_shape";
inline constexpr const char* kTooFewLinks = "too_few_links";

/// The refitted effects (no rivals) but `except`, those that leave least first, at most `count`.
std::vector<Explanation> best_effects(const std::vector<Explanation>& explanations,
                                      const std::vector<NoiseModel>& noise, std::size_t count,
                                      const std::string& except = "");

}  // namespace catena
