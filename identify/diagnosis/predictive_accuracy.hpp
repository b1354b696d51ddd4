// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// The probability that chance alone lets `model` lead like this: the held-out frames are cut into
/// 12 blocks, and the squared residuals of both models, in units of the noise, are compared block by
/// block with the signed-rank test of Wilcoxon (F. X. Diebold, R. S. Mariano: Comparing predictive
/// accuracy, 1995, section 1.2). It is exact for blocks that are independent, and no matter how much
/// the residuals grow from block to block. From 1/4096 (`model` leads in all blocks) to 1, which is
/// also the answer where fewer than 24 frames are held out.
double chance_of_lead(const FittedModel& model, const FittedModel& other,
                      const std::vector<double>& sigmas);

/// Whether `model` predicts what no fit has seen better than `other` does: beyond chance
/// (DiagnosisThresholds::odds), and by more than a detail (as_good_held_out).
bool predicts_better(const FittedModel& model, const FittedModel& other,
                     const std::vector<double>& sigmas);

}  // namespace catena
