// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Where, when and how residuals are large.
struct ResidualPlaces {
  /// "largest at marker 12 (the load)", "at high speed", "after 2 s"
  std::vector<std::string> words;
  std::vector<std::string> points;  ///< of the experiment looked at
  std::vector<double> point_rms;    ///< m or rad
};

/// Of the fitted part of the first experiment that has one. `sigmas`: the noise of every experiment,
/// m or rad. Empty where there are fewer than eight frames.
ResidualPlaces residual_places(const FittedModel& model, const std::vector<double>& sigmas);

}  // namespace catena
