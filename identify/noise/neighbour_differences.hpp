// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/segments.hpp"

namespace catena {

/// The power of what neighbouring channels do not share: of every channel less the mean of its two
/// neighbours in its direction.
///
/// Noise of different channels has nothing in common but a common mode, be it smoothed or slow: all of
/// it is in these differences. What a model misses of the mechanics is alike in neighbours, and leaves
/// little there. So they bound the noise at all frequencies, those of the motion too.
class NeighbourDifferences {
 public:
  /// `sigma`: size of each channel's own noise. Channels of a direction come in their order along the
  /// cable; `direction`: as of estimate_noise().
  NeighbourDifferences(const Segments& segments, const Eigen::VectorXd& sigma,
                       const std::vector<int>& direction);

  /// Per frequency; white noise of these sizes has the power 1. Zero where no direction has three channels.
  const Eigen::VectorXd& power() const { return power_; }
  /// Whether noise of this power, at the frequencies of power(), would show more in them than there
  /// is: a third of it is missing, beyond chance.
  bool refute(const Eigen::VectorXd& noise_power) const;

 private:
  Eigen::VectorXd power_;
  double values_ = 0;  // independent complex ones behind the power at one frequency
};

}  // namespace catena
