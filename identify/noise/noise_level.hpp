// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// Standard deviation of white noise in residuals (channels x frames; NaN where nothing was
/// measured), in their unit. NaN: there are too few neighbouring frames. `time`: of the frames, s.
///
/// Differences of order d of neighbouring frames wipe out what is smooth (the motion and what the
/// model misses of it) and keep white noise, whose variance they multiply by the binomial (2d over
/// d). The smallest estimate of orders 2 to 6 is taken: a higher order wipes out more, a lower one
/// is surer. The median over blocks of frames keeps short events from counting as noise.
double noise_level(const Eigen::MatrixXd& residual, const std::vector<double>& time);

}  // namespace catena
