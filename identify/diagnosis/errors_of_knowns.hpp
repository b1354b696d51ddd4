// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace catena {

class DiagnosisState;
struct Candidate;
struct FittedModel;

/// Whether an effect is an error of what the case knows or of a sensor, and no physics that is
/// missing: it changes what is reported, or its file has words for a wrong known.
bool is_error_of_known(const Candidate& candidate);

/// What one of the effects found explains and no plausible errors of knowns and sensors explain
/// instead: where the model was fitted or where it was held out, whichever is more.
struct BeyondErrorsOfKnowns {
  double of_misfit = 0;  ///< as a share of the squared misfit of the model without effects
  double of_effect = 0;  ///< as a share of what the effect explains beside no such errors
};

/// To the model with the effect and to the one without it, such errors are added: gravity and camera a little
/// tilted, a heavier load, another length and density, marks that sit elsewhere, a lens, a shutter that
/// rolls. Each has a standard deviation (DiagnosisThresholds). What they and the free unknowns change is
/// linearised, and fitted to the fitted part. Zero where the model without the effect cannot be fitted.
/// Throws Interrupted.
BeyondErrorsOfKnowns beyond_errors_of_knowns(DiagnosisState& state, const std::string& effect);

struct ModelWithEffects {
  const FittedModel& model;
  const std::vector<std::string>& effects;
};
/// By how much one model leaves less of the fitted part than another where the same errors are added to both: sum
/// of squares, in noise levels squared. Zero where the worse one cannot be simulated with them.
double lead_beyond_errors_of_knowns(const DiagnosisState& state, const ModelWithEffects& better,
                                    const ModelWithEffects& worse);

}  // namespace catena
