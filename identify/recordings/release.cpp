// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/release.hpp"

#include <algorithm>
#include <cmath>

namespace catena {

using Eigen::Index;

double release_time(const Recording& recording) {
  constexpr double kFirstShare = 0.01, kLaterShare = 0.04;  // of the farthest any point gets
  const auto& measured = recording.measured;
  const auto points = static_cast<Index>(recording.points.size());
  const Index rows = recording.components();
  const auto first = [&](Index p) {
    Index k = 0;
    while (k + 1 < measured.cols() && measured.block(p * rows, k, rows, 1).hasNaN()) ++k;
    return k;
  };
  // How far the point that moved most has come.
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(measured.cols());
  for (Index p = 0; p < points; ++p) {
    const Eigen::VectorXd start = measured.block(p * rows, first(p), rows, 1);
    for (Index k = 0; k < measured.cols(); ++k) {
      const double distance = (measured.block(p * rows, k, rows, 1) - start).norm();
      if (distance > moved[k]) moved[k] = distance;  // not for NaN
    }
  }
  // The time at which a share of the way is reached, for two frames at least: one may be noise.
  const auto first_beyond = [&](double share) {
    const double least = share * moved.maxCoeff();
    Index k = 0;
    while (k + 2 < moved.size() && !(moved[k] > least && moved[k + 1] > least)) ++k;
    // Between the frames, as the square root of the distance grows.
    const auto time = [&](Index frame) { return recording.time[static_cast<std::size_t>(frame)]; };
    if (k == 0) return time(0);
    const double before = std::sqrt(std::min(moved[k - 1], least)), after = std::sqrt(moved[k]);
    return time(k - 1) + (time(k) - time(k - 1)) * (std::sqrt(least) - before) / (after - before);
  };
  const double release = 2 * first_beyond(kFirstShare) - first_beyond(kLaterShare);
  const auto after = std::lower_bound(recording.time.begin(), recording.time.end(), release);
  if (after == recording.time.begin()) return *after;
  const double before = *(after - 1);
  return after != recording.time.end() && *after - release < release - before ? *after : before;
}

}  // namespace catena
