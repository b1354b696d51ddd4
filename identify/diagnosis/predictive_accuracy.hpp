// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Held-out frames, two for each of 12 blocks: fewer tell nothing of two models.
inline constexpr std::size_t kFewestFramesToCompare = 24;

/// The probability that chance alone lets `model` lead like this: the held-out frames are cut into
/// 12 blocks, and the squared residuals of both models, in units of the noise, are compared block by
/// block with the signed-rank test of Wilcoxon (F. X. Diebold, R. S. Mariano: Comparing predictive
/// accuracy, 1995, section 1.2). It is exact for blocks that are independent, and no matter how much
/// the residuals grow from block to block. From 1/4096 (`model` leads in all blocks) to 1, which is
/// also the answer where fewer frames are held out than kFewestFramesToCompare.
double chance_of_lead(const FittedModel& model, const FittedModel& other,
                      const std::vector<NoiseModel>& noise);

/// Whether `model` predicts what no fit has seen better than `other` does: beyond chance
/// (DiagnosisThresholds::odds), and by more than a detail (as_good_held_out).
bool predicts_better(const FittedModel& model, const FittedModel& other,
                     const std::vector<NoiseModel>& noise);

/// Whether a model that leaves `held_out` of what no fit has seen predicts it as well as one that
/// leaves `other`: an effect must, beside the model without it. True where nothing is held out.
bool predicts_as_well(const GapTest& held_out, const GapTest& other);

}  // namespace catena
