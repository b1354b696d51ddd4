// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

struct Diagnosis;
struct FinalParameter;

/// Standard errors of all unknowns from the sensitivities, allowing for autocorrelated residuals
/// (times the root of the autocorrelation factor) and for what is left above the noise; infinite in
/// null directions.
Eigen::VectorXd standard_errors(const FittedModel& model, const std::vector<NoiseModel>& noise);

/// Replaces the final model by one that has its effects and no others: derived, compiled, loaded,
/// shown to equal the case's model where the effects vanish, and fitted once more, simulated and
/// optimised as `asked` says.
void make_final_model(Diagnosis& diagnosis, const Case& asked, DiagnosisContext& context);

/// The fitted parameters, physics first, with standard errors.
std::vector<FinalParameter> final_parameters(const Diagnosis& diagnosis);

}  // namespace catena
