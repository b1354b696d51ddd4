// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_pattern.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

const char* word(ForceDirection direction) {
  return direction == ForceDirection::kSide ? "side" : "down";
}

/// The pattern whose forces act at the middles of the links.
void act_at_middles(const VectorXd& force, VectorXd& carried) {
  carried.resize(force.size());
  double below = 0;
  for (Index k = force.size() - 1; k >= 0; --k) {
    carried[k] = below + 0.5 * force[k];
    below += force[k];
  }
}

ForcePattern empty(Index links, std::string name, std::string unit) {
  ForcePattern pattern;
  pattern.name = std::move(name);
  pattern.unit = std::move(unit);
  pattern.torque.setZero(links);
  pattern.side.setZero(links);
  pattern.down.setZero(links);
  return pattern;
}

}  // namespace

VectorXd link_middles(const VectorXd& lengths) {
  VectorXd middles(lengths.size());
  double begin = 0;
  for (Index k = 0; k < lengths.size(); ++k) {
    middles[k] = begin + 0.5 * lengths[k];
    begin += lengths[k];
  }
  return middles;
}

ForcePattern density_pattern(ForceDirection direction, const std::string& shape,
                             const VectorXd& density, const VectorXd& lengths) {
  ForcePattern pattern =
      empty(lengths.size(), fmt::format("{} density {}", word(direction), shape), "N/m");
  pattern.direction = direction;
  pattern.density = density;
  act_at_middles(density.cwiseProduct(lengths),
                 direction == ForceDirection::kSide ? pattern.side : pattern.down);
  return pattern;
}

ForcePattern point_pattern(ForceDirection direction, double s, const VectorXd& lengths) {
  const Index n = lengths.size();
  ForcePattern pattern = empty(
      n, fmt::format("{} force at arc length {:.3g} m", word(direction), s), fmt::format("N"));
  pattern.direction = direction;
  VectorXd& carried = direction == ForceDirection::kSide ? pattern.side : pattern.down;
  double begin = 0;
  for (Index k = 0; k < n; ++k) {
    carried[k] = std::clamp((s - begin) / lengths[k], 0.0, 1.0);
    begin += lengths[k];
  }
  return pattern;
}

ForcePattern torque_pattern(Index link, Index links) {
  ForcePattern pattern = empty(links, fmt::format("torque on link {}", link + 1), "N m");
  pattern.torque[link] = 1;
  return pattern;
}

ForcePattern moment_pattern(Index joint, const VectorXd& lengths) {
  ForcePattern pattern = empty(
      lengths.size(),
      joint == 0
          ? std::string("torque at the support")
          : fmt::format("moment in the joint at arc length {:.3g} m", lengths.head(joint).sum()),
      "N m");
  pattern.torque[joint] = 1;
  if (joint > 0) pattern.torque[joint - 1] = -1;
  return pattern;
}

void add_generalised_force(const ForcePattern& pattern, const VectorXd& lengths,
                           const double* angles, double size, double* force) {
  for (Index k = 0; k < lengths.size(); ++k)
    force[k] += size * (lengths[k] * (std::cos(angles[k]) * pattern.side[k] -
                                      std::sin(angles[k]) * pattern.down[k]) +
                        pattern.torque[k]);
}

}  // namespace catena
