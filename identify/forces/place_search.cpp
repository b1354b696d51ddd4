// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/place_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/forces/force_sizes.hpp"
#include "identify/forces/forces_everywhere.hpp"
#include "identify/forces/sensor_error.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

/// Looks around the best of the places, each so many times closer.
constexpr int kCloserLooks = 2;
constexpr double kCloser = 3;
/// Sizes of a force alone, as multiples of that of the forces everywhere, whose evidence is
/// compared.
constexpr double kSizes[] = {0.3, 1.0, 3.0};

/// Root mean square over time of the whole force, N: the size from which single places are tried.
double size_of(const ForcePaths& paths, const ChainMeasures& chain) {
  double sum = 0, count = 0;
  for (const ForcePath& path : paths.paths()) {
    for (Index k = 0; k < path.force.cols(); ++k) {
      MatrixXd carried = MatrixXd::Zero(chain.lengths.size(), chain.in_space ? 3 : 2);
      MatrixXd torque = MatrixXd::Zero(chain.lengths.size(), chain.in_space ? 3 : 1);
      for (std::size_t m = 0; m < paths.patterns().size(); ++m) {
        const ForcePattern& pattern = paths.patterns()[m];
        const double size = path.force(static_cast<Index>(2 * m), k);
        carried += size * pattern.carried;
        torque += size * pattern.torque;
      }
      // What a link's end carries is the force below: its mean square along the cable.
      double squares = 0;
      for (Index i = 0; i < carried.cols(); ++i) squares += carried.col(i).squaredNorm();
      sum += squares / static_cast<double>(carried.rows()) +
             torque.squaredNorm() / (chain.length * chain.length);
      count += 1;
    }
  }
  return std::sqrt(sum / std::max(1.0, count));
}

/// So many patterns from `first` on, of one variance.
std::vector<ActingForce> acting(Index first, Index count) {
  std::vector<ActingForce> forces;
  for (Index i = 0; i < count; ++i) forces.push_back({first + i, 0});
  return forces;
}

/// The largest evidence over the variance of some patterns, and the variance that has it.
struct Peak {
  double log_evidence = 0, variance = 0;
};

/// Of patterns of one kind that act on `paths`, `linear` about it. `size`: from where the variance is sought.
Peak peak_of(const LinearProblem& linear, const ForcePaths& paths, const ChainMeasures& chain,
             const std::vector<ActingForce>& acting, double size) {
  const auto evidence_of = [&](double variance) {
    return smooth_forces(linear, acting, {variance}, paths.prior, false).log_evidence;
  };
  Peak best;
  std::vector<double> evidence;
  for (const double factor : kSizes) {
    const double variance = factor * size * factor * size;
    evidence.push_back(evidence_of(variance));
    if (evidence.size() == 1 || evidence.back() > best.log_evidence)
      best = {evidence.back(), variance};
  }
  // The top of the parabola through them, where it is between them.
  const double slope = 0.5 * (evidence[2] - evidence[0]);
  const double bend = evidence[2] - 2 * evidence[1] + evidence[0];
  if (bend < 0 && std::abs(slope) < -bend) {
    const double shift = -slope / bend, ratio = kSizes[1] / kSizes[0];
    const double deviation = size * std::pow(ratio, shift);
    best = {evidence[1] - 0.5 * slope * slope / bend, deviation * deviation};
  }
  const auto first = static_cast<std::size_t>(acting.front().pattern);
  const double largest = largest_variances({paths.patterns()[first]}, chain).back();
  return best.variance > largest ? Peak{evidence_of(largest), largest} : best;
}

/// The top of the parabola through the best place and its neighbours; the best where it has none
/// on one side.
double top_between(std::vector<MissingForce::Place> tried, double best) {
  std::sort(tried.begin(), tried.end(),
            [](const auto& a, const auto& b) { return a.arc_length < b.arc_length; });
  const auto at = std::find_if(tried.begin(), tried.end(),
                               [&](const auto& place) { return place.arc_length == best; });
  if (at == tried.begin() || at == tried.end() || at + 1 == tried.end()) return best;
  const auto &a = *(at - 1), &b = *at, &c = *(at + 1);
  const double left = (b.log_evidence - a.log_evidence) / (b.arc_length - a.arc_length);
  const double right = (c.log_evidence - b.log_evidence) / (c.arc_length - b.arc_length);
  if (!(left > right)) return best;
  // The slope of the parabola falls from `left` to `right` between the middles of the intervals.
  const double begin = 0.5 * (a.arc_length + b.arc_length);
  const double end = 0.5 * (b.arc_length + c.arc_length);
  return std::clamp(begin + (end - begin) * left / (left - right), a.arc_length, c.arc_length);
}

}  // namespace

std::vector<ForcePattern> point_patterns(const std::vector<double>& places,
                                         const ChainMeasures& chain) {
  std::vector<ForcePattern> patterns;
  for (const double s : places)
    for (const ForceDirection direction : force_directions(chain.in_space)) {
      patterns.push_back(point_pattern(direction, s, chain));
      patterns.back().group = static_cast<int>(direction);
    }
  return patterns;
}

PlaceSearch::PlaceSearch(ForcePaths& paths, const ChainMeasures& chain)
    : paths_(paths), chain_(chain), size_(size_of(paths, chain)) {}

bool PlaceSearch::look_everywhere(MissingForce& missing) {
  std::vector<double> at;
  for (int k = 1; k <= kForcePlaces; ++k) at.push_back(chain_.length * k / kForcePlaces);
  std::vector<ForcePattern> patterns = point_patterns(at, chain_);
  const auto forces = static_cast<Index>(patterns.size());
  for (ForcePattern& pattern : moment_patterns(0, chain_)) patterns.push_back(std::move(pattern));
  if (!linearise(std::move(patterns))) return false;
  none_ = smooth_forces(*linear_, {}, {}, paths_.prior, false).log_evidence;
  const Peak torque = peak_of(*linear_, paths_, chain_, acting(forces, chain_.in_space ? 3 : 1),
                              size_ * chain_.length);
  missing.places.push_back({moment_name(0, chain_.lengths), 0, torque.log_evidence - none_, 0});
  variance_.push_back(torque.variance);
  add(at, missing.places);
  return true;
}

bool PlaceSearch::look_closer(MissingForce& missing) {
  const auto best =
      static_cast<std::size_t>(std::max_element(missing.places.begin(), missing.places.end(),
                                                [](const auto& a, const auto& b) {
                                                  return a.log_evidence < b.log_evidence;
                                                }) -
                               missing.places.begin());
  missing.best = missing.places[best];
  best_variance_ = variance_[best];
  if (best == 0) return true;  // the support
  double step = chain_.length / kForcePlaces;
  std::vector<MissingForce::Place> tried(missing.places.begin() + 1, missing.places.end());
  std::vector<double> variances(variance_.begin() + 1, variance_.end());
  for (int round = 0; round < kCloserLooks; ++round) {
    step /= kCloser;
    std::vector<double> at;
    for (const int shift : {-2, -1, 1, 2}) {
      const double s = missing.best->arc_length + shift * step;
      if (s > 0 && s < chain_.length) at.push_back(s);
    }
    if (!linearise(point_patterns(at, chain_))) return false;
    variance_.clear();
    add(at, tried);
    variances.insert(variances.end(), variance_.begin(), variance_.end());
    for (std::size_t i = 0; i < tried.size(); ++i)
      if (tried[i].log_evidence > missing.best->log_evidence) {
        missing.best = tried[i];
        best_variance_ = variances[i];
      }
  }
  missing.best->arc_length = top_between(tried, missing.best->arc_length);
  missing.best->name = fmt::format("force at arc length {:.3g} m", missing.best->arc_length);
  return true;
}

bool PlaceSearch::look_at_joints(MissingForce& missing) {
  std::vector<Index> joints;
  const Index links = chain_.lengths.size();
  for (int k = 1; k <= kForcePlaces; ++k)
    joints.push_back(std::clamp<Index>((k * links) / (kForcePlaces + 1), 1, links - 1));
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  if (links < 2) return true;
  const auto tried = [&](Index joint) {
    return std::any_of(missing.joints.begin(), missing.joints.end(),
                       [&](const auto& place) { return place.joint == joint; });
  };
  while (!joints.empty()) {
    std::vector<ForcePattern> patterns;
    for (const Index joint : joints)
      for (ForcePattern& pattern : moment_patterns(joint, chain_))
        patterns.push_back(std::move(pattern));
    const auto each = static_cast<Index>(patterns.size() / joints.size());
    if (!linearise(std::move(patterns))) return false;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const Peak peak =
          peak_of(*linear_, paths_, chain_, acting(static_cast<Index>(i) * each, each),
                  size_ * chain_.length / static_cast<double>(links));
      missing.joints.push_back({moment_name(joints[i], chain_.lengths),
                                chain_.lengths.head(joints[i]).sum(), peak.log_evidence - none_,
                                static_cast<int>(joints[i])});
      if (!missing.best || missing.joints.back().log_evidence > missing.best->log_evidence) {
        missing.best = missing.joints.back();
        best_variance_ = peak.variance;
      }
    }
    // The neighbours of the best joint, until there is none that was not tried.
    const auto best = std::max_element(
        missing.joints.begin(), missing.joints.end(),
        [](const auto& a, const auto& b) { return a.log_evidence < b.log_evidence; });
    joints.clear();
    for (const int shift : {-1, 1}) {
      const Index joint = best->joint + shift;
      if (joint > 0 && joint < links && !tried(joint)) joints.push_back(joint);
    }
  }
  return true;
}

std::optional<MissingForce::Sensor> PlaceSearch::best_sensor() const {
  std::optional<MissingForce::Sensor> best;
  for (const SensorError& error : sensor_errors(paths_, chain_)) {
    const double evidence = log_evidence_of(error, *linear_) - none_;
    if (!best || evidence > best->log_evidence) best = {error.name, evidence};
  }
  return best;
}

bool PlaceSearch::linearise(std::vector<ForcePattern> patterns) {
  paths_.act(std::move(patterns));
  linear_ = paths_.linearise();
  return linear_.has_value();
}

/// Evidence of a force at each place, in every direction.
void PlaceSearch::add(const std::vector<double>& at, std::vector<MissingForce::Place>& places) {
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Index directions = chain_.in_space ? 3 : 2;
    const Peak peak = peak_of(*linear_, paths_, chain_,
                              acting(static_cast<Index>(i) * directions, directions), size_);
    places.push_back(
        {fmt::format("force at arc length {:.3g} m", at[i]), at[i], peak.log_evidence - none_});
    variance_.push_back(peak.variance);
  }
}

}  // namespace catena
