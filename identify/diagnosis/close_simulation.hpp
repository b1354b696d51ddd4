// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// The model with its simulation so close that the errors of its steps are small beside the noise
/// (DiagnosisThresholds::simulation_error), fitted again where they were not: what errs by chance from one
/// simulation to the next tells no models apart, and ends fits before they are at their minimum. No closer
/// than the case asks. `noise`: of every experiment.
FittedModel simulated_closely(FittedModel model, const std::vector<NoiseModel>& noise,
                              const DiagnosisContext& context);

}  // namespace catena
