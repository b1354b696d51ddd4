// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/cases/case.hpp"
#include "identify/diagnosis/context.hpp"
#include "identify/diagnosis/diagnosis_state.hpp"

namespace catena {

/// A gap where it was fitted, or in what the fit has not seen.
bool gap_left(const Stage& stage);
bool gap_left(const FittedModel& model, const std::vector<NoiseModel>& noise);
/// Too little for an effect to be sought, but not there by chance.
bool trace_left(const Stage& stage);

/// Whether the last stage explains the data: it leaves no gap, or so little that it is closed and
/// not only imitated.
bool explained(DiagnosisState& state);
/// Whether the last stage has one effect and leaves a trace: it may imitate two.
bool one_may_imitate_two(const Stage& last);

/// The last stage that had no effect; the baseline has none.
const Stage& last_without_effects(const std::vector<Stage>& stages);

/// A model with those of its effects only that are no laws, fitted again: errors of what is known
/// and of sensors. The model itself where all are, or where that cannot be fitted.
FittedModel without_laws(DiagnosisState& state, const FittedModel& model,
                         const std::vector<std::string>& effects);

/// Effects that stand whatever else is missing: each takes some of the misfit away where it was
/// fitted and where it was not, a good part in one of them (which one depends on where the recording
/// was cut). Where the data do not decide against others in its place, one of them is what stands;
/// nothing stands where what is no effect, a start that bends more or moves, does as well.
std::vector<std::string> standing_effects(const Diagnosis& found);

/// Divides the misfit among the effects, fits the final model as `asked` says, and tells what the
/// stages amount to. Throws std::runtime_error where it cannot be simulated, ModelError where it cannot be made.
void conclude(DiagnosisState& state, const Case& asked);

/// Without the effects found, a force of no known form does as well or better: none of them is certain.
/// `force`: where and when it acts, in words.
void doubt_effects(DiagnosisState& state, const std::string& force);
/// The effects close the gap, and the data do not decide between them and such a force.
void add_force_as_rival(DiagnosisState& state, const std::string& force);

}  // namespace catena
