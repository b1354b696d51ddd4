// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_history.hpp"

#include <algorithm>

#include "identify/problem/initial_state.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MissingForce::History force_history(const ForcePaths& paths, std::size_t number,
                                    const Problem& problem, const Smoothed& smoothed,
                                    const ChainMeasures& chain, bool densities) {
  MissingForce::History history;
  history.experiment =
      problem.experiments()[static_cast<std::size_t>(paths.paths()[number].experiment)].spec.name;
  history.time = paths.times(number);
  const auto& patterns = paths.patterns();
  const Smoothed::Recording& found = smoothed.recordings[number];
  for (const ForcePattern& pattern : patterns)
    history.rows.emplace_back(densities                  ? pattern.name
                              : !pattern.torque.isZero() ? "moment"
                              : !pattern.side.isZero()   ? "side"
                                                         : "down");
  const auto count = static_cast<Index>(patterns.size());
  const Index times = found.force.cols(), links = chain.lengths.size();
  history.size.resize(count, times);
  history.deviation.resize(count, times);
  // Densities of the patterns at the links, from what the links' ends carry.
  MatrixXd side = MatrixXd::Zero(links, count), down = side;
  for (Index m = 0; densities && m < count; ++m) {
    const ForcePattern& pattern = patterns[static_cast<std::size_t>(m)];
    if (pattern.density.size() == 0) continue;
    (pattern.direction == ForceDirection::kSide ? side : down).col(m) = pattern.density;
  }
  const MatrixXd lowest = shape_basis(Shape::kSmooth, static_cast<int>(links),
                                      std::min(2, static_cast<int>(links)), chain.lengths);
  const auto add = [&](const MatrixXd& shape, Index k, MatrixXd& value, MatrixXd& deviation) {
    if (value.size() == 0) {
      value.resize(shape.rows(), times);
      deviation.resize(shape.rows(), times);
    }
    value.col(k) = shape * history.size.col(k);
    const MatrixXd& covariance = found.covariance[static_cast<std::size_t>(k)];
    deviation.col(k) =
        (shape * covariance * shape.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  };
  for (Index k = 0; k < times; ++k) {
    for (Index m = 0; m < count; ++m) history.size(m, k) = found.force(2 * m, k);
    history.deviation.col(k) =
        found.covariance[static_cast<std::size_t>(k)].diagonal().cwiseMax(0.0).cwiseSqrt();
    if (!densities) continue;
    const Eigen::ArrayXd angles = paths.paths()[number].state.col(k).head(links).array();
    const MatrixXd normal =
        angles.cos().matrix().asDiagonal() * side - angles.sin().matrix().asDiagonal() * down;
    const MatrixXd tangential =
        angles.sin().matrix().asDiagonal() * side + angles.cos().matrix().asDiagonal() * down;
    // Of P_0 and P_1, whose squares integrate to L and L / 3.
    MatrixXd modes = lowest.transpose() * chain.lengths.asDiagonal() * normal / chain.length;
    modes.bottomRows(modes.rows() - 1) *= 3;
    add(side, k, history.side, history.side_deviation);
    add(down, k, history.down, history.down_deviation);
    add(normal, k, history.normal, history.normal_deviation);
    add(tangential, k, history.tangential, history.tangential_deviation);
    add(modes, k, history.normal_modes, history.normal_modes_deviation);
  }
  return history;
}

}  // namespace catena
