// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "identify/problem/initial_state.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Densities of the part at a right angle to the cable, links x patterns: towards growing angles, in space one for each
/// direction. `density`: to each direction.
std::vector<MatrixXd> normal_to_cable(const std::vector<MatrixXd>& density, const VectorXd& state,
                                      const ChainMeasures& chain) {
  const Index links = chain.lengths.size();
  if (!chain.in_space) {
    const Eigen::ArrayXd angles = state.head(links).array();
    return {angles.cos().matrix().asDiagonal() * density[0] -
            angles.sin().matrix().asDiagonal() * density[1]};
  }
  Eigen::MatrixX3d along = state.head(3 * links).reshaped(links, 3);
  along.rowwise().normalize();
  MatrixXd tangential = MatrixXd::Zero(links, density[0].cols());
  for (Index i = 0; i < 3; ++i)
    tangential += along.col(i).asDiagonal() * density[static_cast<std::size_t>(i)];
  std::vector<MatrixXd> normal = density;
  for (Index i = 0; i < 3; ++i)
    normal[static_cast<std::size_t>(i)] -= along.col(i).asDiagonal() * tangential;
  return normal;
}

}  // namespace

MissingForce::History force_history(const ForcePaths& paths, std::size_t number,
                                    const Problem& problem, const Smoothed& smoothed,
                                    const ChainMeasures& chain, bool densities) {
  MissingForce::History history;
  history.experiment =
      problem.experiments()[static_cast<std::size_t>(paths.paths()[number].experiment)].spec.name;
  history.time = paths.times(number);
  const auto& patterns = paths.patterns();
  const Smoothed::Recording& found = smoothed.recordings[number];
  for (const ForcePattern& pattern : patterns) {
    const bool moment = !pattern.torque.isZero();
    history.rows.push_back(densities        ? pattern.name
                           : !moment        ? word_of(pattern.direction)
                           : chain.in_space ? fmt::format("about {}", word_of(pattern.direction))
                                            : "moment");
  }
  const auto count = static_cast<Index>(patterns.size());
  const Index times = found.force.cols(), links = chain.lengths.size();
  history.size.resize(count, times);
  history.deviation.resize(count, times);
  // Densities of the patterns at the links.
  const std::vector<ForceDirection> directions = force_directions(chain.in_space);
  std::vector<MatrixXd> density(directions.size(), MatrixXd::Zero(links, count));
  for (Index m = 0; densities && m < count; ++m) {
    const ForcePattern& pattern = patterns[static_cast<std::size_t>(m)];
    if (pattern.density.size() == 0) continue;
    density[static_cast<std::size_t>(pattern.direction)].col(m) = pattern.density;
  }
  const MatrixXd lowest = shape_basis(Shape::kSmooth, static_cast<int>(links),
                                      std::min(2, static_cast<int>(links)), chain.lengths);
  const auto add = [&](const MatrixXd& shape, Index k, MissingForce::OverTime& over_time) {
    if (over_time.value.size() == 0) {
      over_time.value.resize(shape.rows(), times);
      over_time.deviation.resize(shape.rows(), times);
    }
    over_time.value.col(k) = shape * history.size.col(k);
    const MatrixXd& covariance = found.covariance[static_cast<std::size_t>(k)];
    over_time.deviation.col(k) =
        (shape * covariance * shape.transpose()).diagonal().cwiseMax(0.0).cwiseSqrt();
  };
  if (densities) {
    history.densities.resize(directions.size());
    history.normal_modes.resize(chain.in_space ? 3 : 1);
  }
  for (Index k = 0; k < times; ++k) {
    for (Index m = 0; m < count; ++m) history.size(m, k) = found.force(2 * m, k);
    history.deviation.col(k) =
        found.covariance[static_cast<std::size_t>(k)].diagonal().cwiseMax(0.0).cwiseSqrt();
    if (!densities) continue;
    for (std::size_t i = 0; i < directions.size(); ++i) add(density[i], k, history.densities[i]);
    const std::vector<MatrixXd> normal =
        normal_to_cable(density, paths.paths()[number].state.col(k), chain);
    for (std::size_t i = 0; i < normal.size(); ++i) {
      // Of P_0 and P_1, whose squares integrate to L and L / 3.
      MatrixXd modes = lowest.transpose() * chain.lengths.asDiagonal() * normal[i] / chain.length;
      modes.bottomRows(modes.rows() - 1) *= 3;
      add(modes, k, history.normal_modes[i]);
    }
  }
  return history;
}

}  // namespace catena
