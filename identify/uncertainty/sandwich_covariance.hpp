// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "identify/fit/error.hpp"

namespace catena {

/// The correlation of a residual with the one a frame before.
struct LagOne {
  double autocorrelation = 0;
  bool significant = false;  ///< more than chance, at a level of 1 %
};

/// `r`: the residuals over their noise, in the order of `residuals.index`.
LagOne lag_one(const Residuals& residuals, const Eigen::VectorXd& r);

/// The errors of least squares without noise that is white.
struct LeastSquaresErrors {
  const Residuals& residuals;       ///< says the frame and channel of each row
  const Eigen::MatrixXd& jacobian;  ///< a row for each residual, a column for each scaled unknown
  const Eigen::VectorXd& r;         ///< residuals over their noise
  const Eigen::MatrixXd& inverse;   ///< (J'J)^-1, priors included; zero in null directions
  const Eigen::MatrixXd& priors;    ///< J'J of the priors alone
};

/// The sandwich (J'J)^-1 J'WJ (J'J)^-1 with W of an AR(1) process in every channel. Where sums over
/// frames with Bartlett's weights (Newey and West 1987, bandwidth of Andrews 1991) give more than twice
/// a variance, theirs is taken: markers that err together, autocorrelation that lasts.
Eigen::MatrixXd sandwich_covariance(const LeastSquaresErrors& errors, double autocorrelation);

}  // namespace catena
