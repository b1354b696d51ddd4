// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// Numbers of frames, in steps of the frame rate. Where `time` (s) has no such steps: 0, 1, 2, ...
std::vector<int> frame_numbers(const std::vector<double>& time);

/// The columns of a matrix (channels x frames) at their frames; NaN in frames that are missing.
/// `frame`: as of frame_numbers().
Eigen::MatrixXd on_grid(const Eigen::MatrixXd& matrix, const std::vector<int>& frame);

/// Distance of a value from the cubic through the two values seen before and the two seen after it,
/// over that of white noise of variance 1. NaN where there are not as many close by.
double roughness(const Eigen::VectorXd& values, Eigen::Index at);

/// Makes NaN of single values far from what their neighbours say, the farthest first, for it makes
/// its neighbours look wrong. Channels x frames; returns how many.
long take_out_outliers(Eigen::MatrixXd& grid);

}  // namespace catena
