// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/place_kinematics.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

LinkMotion link_motion(const VectorXd& state, Index coordinates, const LinkChain& chain,
                       Index link) {
  LinkMotion motion;
  if (!chain.in_space) {
    const double across = std::cos(state[link]), along = std::sin(state[link]);
    motion.along = Eigen::Vector2d(along, across);
    motion.by_turn = Eigen::Vector2d(across, -along);
    motion.rate = VectorXd::Constant(1, state[coordinates + link]);
    return motion;
  }
  const Index links = chain.lengths.size();
  Vector3d vector, faster;
  for (Index i = 0; i < 3; ++i) {
    vector[i] = state[i * links + link];
    faster[i] = state[coordinates + i * links + link];
  }
  const Vector3d along = vector.normalized();
  Matrix3d by_turn;
  for (Index i = 0; i < 3; ++i) by_turn.col(i) = Vector3d::Unit(i).cross(along);
  motion.along = along;
  motion.by_turn = by_turn;
  motion.rate = along.cross(faster) / vector.norm();
  return motion;
}

PlaceKinematics place_kinematics(const VectorXd& state, Index coordinates, const LinkChain& chain,
                                 double s) {
  const VectorXd& lengths = chain.lengths;
  const Index components = chain.in_space ? 3 : 2, turns = chain.in_space ? 3 : 1;
  PlaceKinematics place;
  place.motion.position.setZero(components);
  place.motion.velocity.setZero(components);
  place.motion.along.setZero(components);
  place.by_turns.setZero(components, turns * lengths.size());
  double begin = 0;
  for (Index k = 0; k < lengths.size(); ++k) {
    const bool on_it = k == 0 || s > begin;
    const double length = std::clamp(s - begin, 0.0, lengths[k]);
    begin += lengths[k];
    if (!on_it) break;
    const LinkMotion link = link_motion(state, coordinates, chain, k);
    const LinkTurns by_turn = length * link.by_turn;
    place.motion.position += length * link.along;
    place.motion.velocity += by_turn * link.rate;
    place.motion.along = link.along;
    place.by_turns.middleCols(turns * k, turns) = by_turn;
  }
  return place;
}

}  // namespace catena
