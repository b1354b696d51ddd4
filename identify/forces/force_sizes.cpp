// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/force_sizes.hpp"

#include <algorithm>

#include "identify/forces/missing_force.hpp"

namespace catena {
namespace {

using Eigen::Index;

constexpr double kStandardGravity = 9.80665;  // m/s^2
/// Of the weight; from there the evidence moves a variance by a factor of up to 100 at once.
constexpr double kFirstShare = 0.01;

/// Size of a pattern that does what this share of the weight does.
double size_of(const ForcePattern& pattern, const ChainMeasures& chain, double share) {
  const double gravity = std::max(chain.gravity, kStandardGravity);
  if (pattern.torque.isZero()) {
    const double force = share * ((chain.masses.sum() + chain.load) * gravity);
    return pattern.density.size() > 0 ? force / chain.length : force;
  }
  // A moment acts on the link above its joint and on that below.
  Index below = 1;
  while (pattern.torque.row(pattern.torque.rows() - below).isZero()) ++below;
  return share * ((chain.masses.tail(below).sum() + chain.load) * gravity) *
         chain.lengths.tail(below).sum();
}

/// Of each group the largest.
std::vector<double> variances_of(const std::vector<ForcePattern>& patterns,
                                 const ChainMeasures& chain, double share) {
  std::vector<double> variances;
  for (const ForcePattern& pattern : patterns) {
    const auto group = static_cast<std::size_t>(pattern.group);
    variances.resize(std::max(variances.size(), group + 1), 0.0);
    const double size = size_of(pattern, chain, share);
    variances[group] = std::max(variances[group], size * size);
  }
  return variances;
}

}  // namespace

std::vector<double> first_variances(const std::vector<ForcePattern>& patterns,
                                    const ChainMeasures& chain) {
  return variances_of(patterns, chain, kFirstShare);
}

std::vector<double> largest_variances(const std::vector<ForcePattern>& patterns,
                                      const ChainMeasures& chain) {
  return variances_of(patterns, chain, kForceThresholds.weights);
}

}  // namespace catena
