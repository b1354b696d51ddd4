// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <random>

#include "identify/noise/noise_model.hpp"

namespace catena {

/// Normally distributed noise of a model, heavy tails apart: so many channels x frames, m or rad, frames in equal
/// steps.
Eigen::MatrixXd drawn_noise(const NoiseModel& noise, Eigen::Index channels, Eigen::Index frames,
                            std::mt19937_64& random);

}  // namespace catena
