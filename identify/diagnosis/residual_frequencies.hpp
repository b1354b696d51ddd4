// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Frequencies (Hz) of the strongest lines in the residuals of the fitted part, at most `count`,
/// the strongest first. `sigmas`: the noise of every experiment, m or rad. Empty where no
/// experiment has eight fitted frames.
std::vector<double> strongest_frequencies(const FittedModel& model,
                                          const std::vector<double>& sigmas, int count);

/// Whether the fitted part is long enough to tell a frequency (Hz) from the strongest one of the
/// motion that `model` predicts: they are one over its duration apart. Closer ones differ by a slow
/// change of amplitude and phase, as any law that goes with the motion makes it.
bool told_from_motion(const FittedModel& model, double frequency);

/// The lowest frequency (Hz) that the longest fitted part shows: two periods of it. 0 where no
/// experiment has eight fitted frames.
double lowest_shown_frequency(const FittedModel& model);

/// Frequencies (Hz) at which a driven motion is looked for: the strongest lines of the residuals,
/// and, since what a force of one frequency leaves after a fit need not be strongest there, others
/// half a resolution apart.
std::vector<double> driving_frequencies(const FittedModel& model,
                                        const std::vector<double>& sigmas);

}  // namespace catena
