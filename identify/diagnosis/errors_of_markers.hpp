// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Of every experiment: channels x frames (m or rad), all that is not sealed; empty: nothing.
using Frames = std::vector<Eigen::MatrixXd>;

/// What plausible errors of markers change in the predictions, each by one standard deviation
/// (PlausibleErrors) and the same in all windows of a recording: every mark off along the cable and
/// across it, in all pictures that show it. In the plane also a shutter that rolls down the picture. What
/// else a camera gets wrong are effects, or its own parameters.
std::vector<Frames> errors_of_markers(const FittedModel& model);

}  // namespace catena
