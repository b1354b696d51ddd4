// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/segments.hpp"

namespace catena {

/// Whether a noise shows less in the differences of neighbouring channels than it would: of every channel
/// less the mean of its two neighbours in its direction, a third of the power is missing, beyond chance.
///
/// Noise of different channels has nothing in common but a common mode, be it smoothed or slow: all of
/// it is in these differences. What a model misses of the mechanics is alike in neighbours, and leaves
/// little there. So they bound the noise at all frequencies, those of the motion too.
///
/// `sigma`: size of each channel's own noise. `direction`: as of estimate_noise(); channels of a direction come in
/// their order along the cable. `noise_power`: what is claimed, per frequency of the segments; white noise of these
/// sizes has the power 1. False where no direction has three channels.
bool neighbours_refute(const Segments& segments, const Eigen::VectorXd& sigma,
                       const std::vector<int>& direction, const Eigen::VectorXd& noise_power);

}  // namespace catena
