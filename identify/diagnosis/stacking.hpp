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

/// The experiment whose fitted part tells what a model gets wrong in experiment `e`: itself. Where nothing of it is
/// fitted, the first that has a fitted part and as many channels; else the first that has a fitted part.
/// `fitted`: channels x frames of every experiment, no columns where nothing is fitted; not of all.
std::size_t errs_like(const std::vector<Eigen::MatrixXd>& fitted, std::size_t e,
                      Eigen::Index channels);

/// So many channels: those of `series`, again from the first after the last.
Eigen::MatrixXd channels_in_turn(const Eigen::MatrixXd& series, Eigen::Index channels);

}  // namespace catena
