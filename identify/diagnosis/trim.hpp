// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Fits what a refit found as closely as the case asks. Puts amplitudes of effects that the data do not need
/// (within two standard errors of the neutral value, or at it) back to neutral and refits again. Every effect
/// keeps an amplitude. Returns the model as it was where that leaves more than the amplitudes are worth, or a
/// gap where there was none.
FittedModel trim(const FittedModel& refit, const std::vector<NoiseModel>& noise,
                 DiagnosisContext& context);

}  // namespace catena
