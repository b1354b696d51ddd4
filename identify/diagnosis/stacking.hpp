// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace catena {

/// Numbers of several recordings, channels x frames each, as one vector: those whose place in `seen` is no
/// NaN, recording after recording, frame after frame.
Eigen::VectorXd stacked_where_seen(const std::vector<Eigen::MatrixXd>& parts,
                                   const std::vector<Eigen::MatrixXd>& seen);

/// The inverse. NaN where nothing was seen.
std::vector<Eigen::MatrixXd> unstacked(const Eigen::VectorXd& stacked,
                                       const std::vector<Eigen::MatrixXd>& seen);

}  // namespace catena
