// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "identify/noise/noise_shape.hpp"

namespace catena {

/// The best linear prediction of a frame from those seen before it: coefficients at lags 1, 2, ...,
/// and the standard deviation of its error over that of the noise.
struct PredictionFilter {
  Eigen::VectorXd coefficients;
  double deviation = 1;
};

/// For noise of one shape.
class PredictionFilters {
 public:
  explicit PredictionFilters(const NoiseShape& shape);

  /// Of every channel and column of a window: an index into `filters`, which grows; -1: not seen.
  /// The columns are at `frame` in `grid`. What is held out, from column `fitted` on, is predicted
  /// from itself only.
  Eigen::MatrixXi patterns(const Eigen::MatrixXd& grid, const std::vector<int>& frame,
                           Eigen::Index fitted, std::vector<PredictionFilter>& filters) const;

 private:
  PredictionFilter filter_of(unsigned known) const;

  int lags_;
  Eigen::VectorXd correlation_;
};

}  // namespace catena
