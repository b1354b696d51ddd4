// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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

/// A node of a mean, and its weight.
struct Weight {
  Index node = 0;
  double weight = 1;
};

/// Of a mean around node k. Of many frames some are enough: the work grows with the square of their number.
std::vector<Weight> weights_around(const std::vector<double>& times, Index k) {
  constexpr Index kMostNodes = 40;
  const auto distance = [&](Index i) {
    return std::abs(times[static_cast<std::size_t>(i)] - times[static_cast<std::size_t>(k)]);
  };
  Index first = k, end = k + 1;
  while (first > 0 && distance(first - 1) < kMeanReach) --first;
  while (end < static_cast<Index>(times.size()) && distance(end) < kMeanReach) ++end;
  const Index step = 1 + (end - first) / kMostNodes;
  std::vector<Weight> weights;
  double sum = 0;
  for (Index i = k - (k - first) / step * step; i < end; i += step) {
    weights.push_back({i, 1 + std::cos(std::numbers::pi * distance(i) / kMeanReach)});
    sum += weights.back().weight;
  }
  for (Weight& of : weights) of.weight /= sum;
  return weights;
}

/// Means of `shape` times the forces found, rows x times. `shapes`: one of each node, or one of all.
MissingForce::OverTime means_of(const std::vector<MatrixXd>& shapes, const MatrixXd& size,
                                const Smoothed::Recording& found,
                                const std::vector<std::vector<Weight>>& weights) {
  const auto shape = [&](Index node) -> const MatrixXd& {
    return shapes.size() == 1 ? shapes.front() : shapes[static_cast<std::size_t>(node)];
  };
  MissingForce::OverTime means;
  means.value.setZero(shape(0).rows(), size.cols());
  means.deviation.setZero(shape(0).rows(), size.cols());
  for (Index k = 0; k < size.cols(); ++k) {
    const std::vector<Weight>& around = weights[static_cast<std::size_t>(k)];
    VectorXd variance = VectorXd::Zero(means.value.rows());
    for (std::size_t i = 0; i < around.size(); ++i) {
      const auto [node, weight] = around[i];
      means.value.col(k) += weight * shape(node) * size.col(node);
      const auto& covariance = found.covariance[static_cast<std::size_t>(node)];
      for (std::size_t j = i; j < around.size(); ++j) {
        const auto [later, other] = around[j];
        const MatrixXd moved = shape(node) * covariance.at(static_cast<std::size_t>(later - node));
        variance +=
            (i == j ? 1 : 2) * weight * other * moved.cwiseProduct(shape(later)).rowwise().sum();
      }
    }
    means.deviation.col(k) = variance.cwiseMax(0.0).cwiseSqrt();
  }
  return means;
}

}  // namespace

Index nodes_of_mean(const std::vector<double>& times) {
  Index most = 0;
  for (Index k = 0; k < static_cast<Index>(times.size()); ++k) {
    const std::vector<Weight> around = weights_around(times, k);
    most = std::max(most, around.back().node - around.front().node);
  }
  return most;
}

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
  MatrixXd size(count, times);
  for (Index m = 0; m < count; ++m) size.row(m) = found.force.row(2 * m);
  std::vector<std::vector<Weight>> weights;
  for (Index k = 0; k < times; ++k)
    weights.push_back(densities ? weights_around(history.time, k) : std::vector<Weight>{{k}});
  const MissingForce::OverTime sizes =
      means_of({MatrixXd::Identity(count, count)}, size, found, weights);
  history.size = sizes.value;
  history.deviation = sizes.deviation;
  if (!densities) return history;
  // Densities of the patterns at the links.
  std::vector<MatrixXd> density(force_directions(chain.in_space).size(),
                                MatrixXd::Zero(links, count));
  for (Index m = 0; m < count; ++m) {
    const ForcePattern& pattern = patterns[static_cast<std::size_t>(m)];
    if (pattern.density.size() == 0) continue;
    density[static_cast<std::size_t>(pattern.direction)].col(m) = pattern.density;
  }
  for (const MatrixXd& of : density)
    history.densities.push_back(means_of({of}, size, found, weights));
  const MatrixXd lowest = shape_basis(Shape::kSmooth, static_cast<int>(links),
                                      std::min(2, static_cast<int>(links)), chain.lengths);
  std::vector<std::vector<MatrixXd>> modes(chain.in_space ? 3 : 1);
  for (Index k = 0; k < times; ++k) {
    const std::vector<MatrixXd> normal =
        normal_to_cable(density, paths.paths()[number].state.col(k), chain);
    for (std::size_t i = 0; i < normal.size(); ++i) {
      // Of P_0 and P_1, whose squares integrate to L and L / 3.
      MatrixXd& shape = modes[i].emplace_back(lowest.transpose() * chain.lengths.asDiagonal() *
                                              normal[i] / chain.length);
      shape.bottomRows(shape.rows() - 1) *= 3;
    }
  }
  for (const std::vector<MatrixXd>& of : modes)
    history.normal_modes.push_back(means_of(of, size, found, weights));
  return history;
}

}  // namespace catena
