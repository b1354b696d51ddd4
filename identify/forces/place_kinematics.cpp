// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/place_kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace catena {

PlaceKinematics place_kinematics(const Eigen::VectorXd& state, Eigen::Index coordinates,
                                 const Eigen::VectorXd& lengths, double s) {
  PlaceKinematics place;
  place.motion.setZero();
  place.by_angles.setZero(2, lengths.size());
  double begin = 0;
  for (Eigen::Index k = 0; k < lengths.size(); ++k) {
    const bool on_it = k == 0 || s > begin;
    const double length = std::clamp(s - begin, 0.0, lengths[k]);
    begin += lengths[k];
    if (!on_it) break;
    const double angle = state[k], rate = state[coordinates + k];
    const double across = length * std::cos(angle), along = length * std::sin(angle);
    place.motion.head<4>() += Eigen::Vector4d(along, across, across * rate, -along * rate);
    place.motion.tail<2>() << angle, rate;
    place.by_angles.col(k) << across, -along;
  }
  return place;
}

}  // namespace catena
