// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/fitted_model.hpp"
#include "identify/diagnosis/workshop.hpp"

namespace catena {

struct Diagnosis;
struct FinalParameter;

/// Puts amplitudes of effects that the data do not need (within two standard errors of the neutral
/// value, or at it) back to neutral and refits; returns the model as it was where that leaves more.
FittedModel trim(const FittedModel& model, const std::vector<double>& floors, Workshop& workshop);

/// Standard errors of all unknowns from the sensitivities, allowing for coloured residuals (times
/// the root of the colour factor) and for what is left above the noise; infinite in null
/// directions.
Eigen::VectorXd standard_errors(const FittedModel& model, const std::vector<double>& floors);

/// Replaces the final model by one that has its effects and no others: derived, compiled, loaded,
/// shown to equal the case's model where the effects vanish, and fitted once more, simulated and
/// optimised as `asked` says.
void make_final_model(Diagnosis& diagnosis, const Case& asked, Workshop& workshop);

/// The fitted parameters, physics first, with standard errors.
std::vector<FinalParameter> final_parameters(const Diagnosis& diagnosis);

/// Whether one effect is a special case of another (drag of steady wind): parameters of the same
/// name give the same residuals r, the other's further ones at their defaults. Tried at seeded
/// random states of a model that has both.
bool is_special_case(const Candidate& special, const Candidate& general, const Model& both);

/// Largest difference between the residuals r of two models at seeded random states and parameters,
/// relative to the largest |r|, `larger` having parameters more than `smaller`, held at their
/// neutral values. Further coordinates of `larger` rest at zero.
double largest_difference(const Model& smaller, const Model& larger, unsigned seed);

}  // namespace catena
