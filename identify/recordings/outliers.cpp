// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace catena {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index kNear = 4;               // frames on either side that a point is compared with
constexpr Index kFewest = 3;             // of them that must be comparable
constexpr Index kWidest = 12;            // frames: a cubic over more does not follow the motion
constexpr std::size_t kFewestSeen = 12;  // frames, for the scatter of a marker to mean something

/// How far one point lies from the cubic through its neighbours.
struct Difference {
  VectorXd vector;   ///< of all components of the point; empty: not comparable
  double noise = 1;  ///< its standard deviation where that of a coordinate is 1
  double size() const { return vector.size() ? vector.norm() / noise : 0; }
};

/// One marker (or link) over the frames in which it was seen. Places count these frames.
class Track {
 public:
  Track(const Recording& recording, Index first_row, Index rows)
      : recording_(recording), first_row_(first_row), rows_(rows) {
    const auto& measured = recording.measured;
    for (Index k = 0; k < measured.cols(); ++k)
      if (!measured.block(first_row, k, rows, 1).array().isNaN().any()) frames_.push_back(k);
    left_out_.assign(frames_.size(), false);
    differences_.resize(frames_.size());
    for (Index i = 0; i < size(); ++i) update(i);
    std::vector<double> sizes;
    for (const Difference& difference : differences_)
      if (difference.vector.size()) sizes.push_back(difference.size());
    if (sizes.size() < kFewestSeen) return;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    // The median of |x| over the standard deviation, of normal numbers in 1, 2 and 3 dimensions.
    constexpr double kMedian[] = {0.6745, 1.1774, 1.5382};
    scatter_ = *middle / kMedian[rows - 1];
  }

  Index size() const { return static_cast<Index>(frames_.size()); }
  Index frame(Index place) const { return frames_[static_cast<std::size_t>(place)]; }
  double scatter() const { return scatter_; }
  bool left_out(Index place) const { return left_out_[static_cast<std::size_t>(place)]; }
  const Difference& difference(Index place) const {
    return differences_[static_cast<std::size_t>(place)];
  }
  /// At a frame; not comparable where the marker was not seen.
  Difference at_frame(Index frame) const {
    const auto found = std::lower_bound(frames_.begin(), frames_.end(), frame);
    if (found == frames_.end() || *found != frame) return {};
    return difference(found - frames_.begin());
  }

  void leave_out(Index place, bool out) { left_out_[static_cast<std::size_t>(place)] = out; }
  void update_near(Index place) {
    for (Index i = std::max<Index>(0, place - 2 * kNear);
         i < std::min(size(), place + 2 * kNear + 1); ++i)
      update(i);
  }

  /// From the cubic through the nearest two kept frames on either side, or the nearest four.
  Difference compare(Index place) const {
    Index chosen[4], count = 0, before = place, after = place;
    const auto next = [&](Index from, Index step) {
      do from += step;
      while (from >= 0 && from < size() && left_out(from));
      return from;
    };
    before = next(before, -1);
    after = next(after, 1);
    for (int side = 0; count < 4; side = 1 - side) {
      if (before < 0 && after >= size()) return {};
      if ((side == 0 && before >= 0) || after >= size()) {
        chosen[count++] = before;
        before = next(before, -1);
      } else {
        chosen[count++] = after;
        after = next(after, 1);
      }
    }
    const auto [first, last] = std::minmax_element(chosen, chosen + 4);
    if (frame(std::max(*last, place)) - frame(std::min(*first, place)) > kWidest) return {};
    Difference difference{position(place), 1};
    double gain = 1;
    for (const Index i : chosen) {
      double weight = 1;
      for (const Index j : chosen)
        if (j != i) weight *= (time(place) - time(j)) / (time(i) - time(j));
      difference.vector -= weight * position(i);
      gain += weight * weight;
    }
    difference.noise = std::sqrt(gain);
    return difference;
  }

 private:
  double time(Index place) const { return recording_.time[static_cast<std::size_t>(frame(place))]; }
  VectorXd position(Index place) const {
    return recording_.measured.block(first_row_, frame(place), rows_, 1);
  }
  void update(Index place) {
    differences_[static_cast<std::size_t>(place)] = left_out(place) ? Difference{} : compare(place);
  }

  const Recording& recording_;
  Index first_row_, rows_;
  std::vector<Index> frames_;
  std::vector<bool> left_out_;
  std::vector<Difference> differences_;
  double scatter_ = std::numeric_limits<double>::infinity();
};

/// Whether the point stands out once it, and at most one more near it, is left out; then `found` is
/// how far.
bool stands_alone(Track& track, Index place, const OutlierLimits& limits, Difference& found) {
  std::vector<Index> near;
  for (Index i = std::max<Index>(0, place - kNear); i <= std::min(track.size() - 1, place + kNear);
       ++i)
    if (i != place && !track.left_out(i)) near.push_back(i);
  std::vector<Index> others = {place};  // itself: no other one
  others.insert(others.end(), near.begin(), near.end());
  bool alone = false;
  for (const Index other : others) {
    track.leave_out(place, true);
    track.leave_out(other, true);
    double largest = 0;
    Index comparable = 0;
    for (const Index i : near) {
      if (i == other) continue;
      const Difference difference = track.compare(i);
      comparable += difference.vector.size() > 0;
      largest = std::max(largest, difference.size());
    }
    found = track.compare(place);
    track.leave_out(place, false);
    track.leave_out(other, false);
    alone = comparable >= kFewest &&
            found.size() > std::max(limits.scatter * track.scatter(), limits.neighbours * largest);
    if (alone) break;
  }
  // Unless it only stands out beside another point, which then is the one.
  for (const Index i : near) {
    track.leave_out(i, true);
    const Difference without = track.compare(place);
    track.leave_out(i, false);
    alone = alone && !(without.vector.size() && without.vector.norm() < 0.5 * found.vector.norm());
  }
  return alone;
}

}  // namespace

std::vector<Outlier> find_outliers(const Recording& recording, double size,
                                   const OutlierLimits& limits) {
  const auto points = static_cast<Index>(recording.points.size());
  const Index rows = recording.components();
  std::vector<Track> tracks;
  for (Index p = 0; p < points; ++p) tracks.emplace_back(recording, p * rows, rows);
  // Neighbouring markers that jump alike: the camera did, or the cable.
  const auto jumps_with_others = [&](Index p, Index frame, const Eigen::VectorXd& jump) {
    for (const Index q : {p - 1, p + 1}) {
      if (q < 0 || q >= points) continue;
      const Difference other = tracks[static_cast<std::size_t>(q)].at_frame(frame);
      if (other.vector.size() && other.vector.dot(jump) > jump.squaredNorm() / 3) return true;
    }
    return false;
  };
  std::vector<Outlier> outliers;
  for (Index p = 0; p < points; ++p) {
    Track& track = tracks[static_cast<std::size_t>(p)];
    std::vector<bool> tried(static_cast<std::size_t>(track.size()), false);
    for (;;) {  // the farthest first: it disturbs its neighbours' differences
      Index place = -1;
      for (Index i = 0; i < track.size(); ++i)
        if (!tried[static_cast<std::size_t>(i)] &&
            track.difference(i).size() > limits.scatter * track.scatter() &&
            (place < 0 || track.difference(i).size() > track.difference(place).size()))
          place = i;
      if (place < 0) break;
      tried[static_cast<std::size_t>(place)] = true;
      Difference found;
      if (!stands_alone(track, place, limits, found) || found.vector.norm() < limits.size * size ||
          jumps_with_others(p, track.frame(place), found.vector))
        continue;
      track.leave_out(place, true);
      track.update_near(place);
      outliers.push_back({static_cast<int>(p), track.frame(place), found.vector.norm()});
    }
  }
  std::sort(outliers.begin(), outliers.end(), [](const Outlier& a, const Outlier& b) {
    return a.point != b.point ? a.point < b.point : a.frame < b.frame;
  });
  return outliers;
}

}  // namespace catena
