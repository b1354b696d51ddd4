// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>

#include "identify/noise/noise_shape.hpp"

namespace catena {

/// Fills what was not seen (NaN): with the best linear estimate from the frames around it, for noise
/// of a shape on top of any cubic; linearly where too few are seen around it.
class Filler {
 public:
  explicit Filler(const NoiseShape& shape);

  /// One channel, on a grid of frames.
  Eigen::VectorXd operator()(const Eigen::VectorXd& values);

 private:
  const Eigen::VectorXd& weights_for(unsigned seen);

  Eigen::VectorXd correlation_;
  std::map<unsigned, Eigen::VectorXd> weights_;  // by which frames around are seen
};

}  // namespace catena
