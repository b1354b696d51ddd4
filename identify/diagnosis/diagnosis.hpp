// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/normal_quantile.hpp"
#include "identify/diagnosis/explanation.hpp"
#include "identify/diagnosis/gap_test.hpp"
#include "identify/diagnosis/links.hpp"
#include "identify/diagnosis/prediction_errors.hpp"
#include "identify/diagnosis/shares.hpp"
#include "identify/forces/missing_force.hpp"

namespace catena {

enum class DiagnosisVerdict {
  kNone,         ///< nothing is missing
  kNamed,        ///< one or more effects
  kAmbiguous,    ///< effects that these data cannot tell apart
  kPartly,       ///< effects that are there but leave a gap
  kDiscovered,   ///< a law in no library, perhaps with other effects, perhaps beside a gap
  kUnexplained,  ///< a gap that nothing in the library closes
};
/// "none", "named", ... as in diagnosis.json.
const char* name_of(DiagnosisVerdict verdict);

/// One model on the way, and what was tried on it.
struct Stage {
  std::vector<std::string> effects;  ///< in the model
  std::string added, removed;  ///< since the stage before: an effect, too_few_links, start_shape
  int links = 0;
  FittedModel model;
  GapTest fit, held_out;
  FinerChain finer;
  std::vector<Explanation> explanations;  ///< most promising first; empty if nothing was sought
};

/// Effects between which the data do not decide, as the last added or in place of `instead_of`.
struct Alternative {
  std::string instead_of;
  Explanation explanation;
  Decision decision;
};

/// One parameter of the final model that was fitted.
struct FinalParameter {
  std::string name, unit, effect;  ///< effect: empty for the case's own
  double value = 0;
  double standard_error = 0;  ///< allowing for autocorrelation; infinite in null directions

  /// Half the width of the interval of 95 %.
  double half_width() const { return kNormalQuantile95 * standard_error; }
};

/// What a diagnosis found.
struct Diagnosis {
  DiagnosisVerdict verdict = DiagnosisVerdict::kNone;
  std::string sentence;                   ///< what the verdict says, one or two sentences
  std::vector<std::string> notes;         ///< what a reader must know of how it was found
  std::vector<NoiseModel> noise;          ///< per experiment
  std::vector<Stage> stages;              ///< baseline first
  std::vector<std::string> effects;       ///< of the final model
  std::vector<std::string> certain;       ///< those of them that stand whatever is left
  Shares shares;                          ///< of the misfit, among the effects
  std::optional<MissingForce> force;      ///< of the library's best model, where it leaves a gap
  std::string law;                        ///< the effect made of the law of that force; or empty
  bool freer_start = false;               ///< the start of the motion needed more terms
  std::vector<Alternative> alternatives;  ///< undecided ones
  std::vector<Alternative> forms;         ///< undecided too, but laws of the effect that is named
  std::vector<Alternative> runners_up;    ///< refitted and decided against
  FittedModel final;
  GapTest final_fit, final_held_out;
  PredictionErrors predictions;  ///< of the final model
  std::vector<FinalParameter> parameters;
  double equality = 0;  ///< largest relative difference to the case's model at the neutral values
  double seconds = 0;
  int tried = 0;  ///< candidates scored in the first look
};

struct DiagnosisOptions {
  int max_effects = 4;  ///< fits with all their subsets give the shares
  /// A clamped cable bends within sqrt(bending stiffness / tension), which a link must not exceed: 0.11 m
  /// for a soft rope of 10 m. More links are tried only where the data want them.
  int max_links = 120;
  int refits = 6;  ///< candidates refitted in every look
  /// A law in no library is sought also where effects of the library close the gap.
  bool discover = false;
};

}  // namespace catena
