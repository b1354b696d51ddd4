// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// An experiment in which two models that explain the same data differ most.
struct TellingExperiment {
  std::string words;  ///< "release it from 1.5 times the angles and film 12.6 s; look at the load"
  double difference = 0;  ///< rms difference of the predictions there, in units of the noise
};

/// Tries other starts (half and one and a half times the angles, mirrored), other loads (twice, half),
/// a film of twice the length and every joint as a marker, with both models as they are fitted now;
/// returns the one that differs most.
TellingExperiment telling_experiment(const FittedModel& a, const FittedModel& b,
                                     const std::vector<double>& sigmas);

}  // namespace catena
