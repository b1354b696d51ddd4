// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "identify/diagnosis/fitted_model.hpp"

namespace catena {

/// Errors like those that a model leaves where it was fitted, noise and what its laws get wrong together, in one
/// experiment, at all of its frames: random series of the same spectrum.
class FittedErrors {
 public:
  /// `left`: channels x frames of a fitted part; `stretch`: of the size, for what the unknowns took of it.
  FittedErrors(const Eigen::MatrixXd& left, Eigen::Index frames, double stretch);
  /// channels x frames
  Eigen::MatrixXd draw(std::mt19937_64& random) const;

 private:
  Eigen::Index frames_;
  Eigen::MatrixXd spectrum_;
};

/// Of every experiment. One without a fitted part errs by as many noise levels as the one that it errs like.
std::vector<FittedErrors> fitted_errors(const FittedModel& model,
                                        const std::vector<NoiseModel>& noise, double stretch);

/// Of what was seen; 0 if nothing was.
double mean_square(const Eigen::MatrixXd& residual);

}  // namespace catena
