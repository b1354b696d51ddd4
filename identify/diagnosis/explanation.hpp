// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "identify/diagnosis/compare.hpp"
#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/score.hpp"

namespace catena {

/// Where a refit may begin.
struct RefitStart {
  /// Of the effect, by the names of the unknowns: amplitudes, shapes and phases found by the score.
  std::vector<std::pair<std::string, double>> of_effect;
  /// Of the base, moved beside these as the linearised fit moves them; empty: as they are.
  Eigen::VectorXd of_base;

  bool given() const { return !of_effect.empty(); }
};

/// One explanation held against a fitted model: an effect, or a rival that is none.
struct Explanation {
  std::string id, title;
  int candidate = -1;  ///< index into the library; -1: a rival
  Score score;
  RefitStart start;
  RefitStart other_start;  ///< of the best shape elsewhere
  double log10_p = 0;      ///< of the predicted fall, for one candidate
  std::string note;        ///< why it was not tried, or what to know about it

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
