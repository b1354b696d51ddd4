// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/diagnosis.hpp"

namespace catena {

/// A diagnosis under way: what its stages take and leave.
class DiagnosisState {
 public:
  /// Both must outlive the state.
  DiagnosisState(DiagnosisContext& the_context, const DiagnosisOptions& the_options)
      : context(the_context), options(the_options) {}

  DiagnosisContext& context;
  const DiagnosisOptions& options;
  /// Of the final model's case: fits with some of its effects (fit_with_effects), by what was kept.
  std::map<std::vector<std::string>, FittedModel> fits_with_effects;
  Diagnosis found;  ///< so far; `final` and what follows from it are still empty

  /// The best model so far.
  Stage& last() { return found.stages.back(); }
  const Stage& last() const { return found.stages.back(); }

  /// Takes a model as the best so far. The noise follows the best model: where its residuals tell more of it,
  /// or give a lower level, than those before, theirs is used from now on. Throws InputError where the first
  /// model's residuals do not tell the noise.
  void enter(FittedModel model, std::vector<std::string> effects, const std::string& added,
             const std::string& removed = "");

  /// Sum of the squared residuals of the fitted part, in units of the noise squared.
  double squares(const FittedModel& model) const;
  /// So large a gap that the linear score may rank wrongly.
  bool far() const;
  /// Whether a model that leaves this predicts what no fit has seen as well as the best so far.
  bool generalises(const GapTest& held_out) const;
  /// Whether the best model so far leaves no gap and `model`, once entered, would leave one.
  bool reopens_gap(const FittedModel& model) const;
  /// Whether a model with exactly these effects was the best once: looking back replaces no effect
  /// by one that was replaced before.
  bool had(std::vector<std::string> effects) const;
  /// Twice `links`, or as many as are allowed.
  int more_links(int links) const;
};

/// `effects` and one more.
std::vector<std::string> with(std::vector<std::string> effects, const std::string& id);

}  // namespace catena
