// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/cpu_seconds.hpp"
#include "identify/forces/force_path.hpp"
#include "identify/forces/sensor_error.hpp"
#include "identify/problem/initial_state.hpp"
#include "identify/problem/parameter_map.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr int kModes = 12;  // of each density
/// Places along the cable at which a force alone is tried.
constexpr int kPlaces = 10;
/// Looks around the best of them, each so many times closer.
constexpr int kCloserLooks = 2;
constexpr double kCloser = 3;
/// Sizes of a force alone, as multiples of that of the forces everywhere, whose evidence is
/// compared.
constexpr double kSizes[] = {0.3, 1.0, 3.0};
constexpr MissingForceThresholds kForceThresholds;
/// Share of the prior variance that data must take away from a pattern that they resolve.
constexpr double kResolved = 0.5;

/// The groups of patterns with one prior variance each.
enum Group { kSideDensity, kDownDensity, kEnd, kSupport, kGroups };

/// The chain that forces act on, at the fitted values.
struct ChainMeasures {
  VectorXd lengths;
  double length = 0, weight = 0;  // m, N with the load

  ChainMeasures(const Problem& problem, const VectorXd& x, int experiment) {
    const Model& model = problem.model();
    const VectorXd p = problem.model_parameters(x, experiment);
    lengths = link_lengths(model, p);
    length = lengths.sum();
    const double mass = p.segment(model.parameter_index("mass_1"), model.links()).sum() +
                        p[model.parameter_index("load_mass")];
    weight = mass * p[model.parameter_index("gravity")];
  }
};

std::vector<ForcePattern> all_patterns(const ChainMeasures& chain) {
  std::vector<ForcePattern> patterns;
  const auto add = [&](ForcePattern pattern, int group) {
    pattern.group = group;
    patterns.push_back(std::move(pattern));
  };
  const int modes = std::min<int>(kModes, static_cast<int>(chain.lengths.size()));
  for (int m = 0; m < modes; ++m)
    add(density_pattern(ForceDirection::kSide, m, chain.lengths), kSideDensity);
  for (int m = 0; m < modes; ++m)
    add(density_pattern(ForceDirection::kDown, m, chain.lengths), kDownDensity);
  add(point_pattern(ForceDirection::kSide, chain.length, chain.lengths), kEnd);
  add(point_pattern(ForceDirection::kDown, chain.length, chain.lengths), kEnd);
  add(moment_pattern(0, chain.lengths), kSupport);
  return patterns;
}

/// Where the search of the variances begins: a hundredth of the weight.
std::vector<double> first_variances(const ChainMeasures& chain) {
  const double force = 0.01 * chain.weight, density = force / chain.length;
  const double torque = force * chain.length;
  std::vector<double> variance(kGroups);
  variance[kSideDensity] = variance[kDownDensity] = density * density;
  variance[kEnd] = force * force;
  variance[kSupport] = torque * torque;
  return variance;
}

std::vector<ForcePattern> point_patterns(const std::vector<double>& places,
                                         const ChainMeasures& chain) {
  std::vector<ForcePattern> patterns;
  for (const double s : places)
    for (const ForceDirection direction : {ForceDirection::kSide, ForceDirection::kDown}) {
      patterns.push_back(point_pattern(direction, s, chain.lengths));
      patterns.back().group = direction == ForceDirection::kDown;
    }
  return patterns;
}

/// Root mean square over time of the whole force, N: the size from which single places are tried.
double size_of(const ForcePaths& paths, const ChainMeasures& chain) {
  double sum = 0, count = 0;
  for (const ForcePath& path : paths.paths()) {
    for (Index k = 0; k < path.force.cols(); ++k) {
      VectorXd side = VectorXd::Zero(chain.lengths.size()), down = side;
      VectorXd torque = side;
      for (std::size_t m = 0; m < paths.patterns().size(); ++m) {
        const ForcePattern& pattern = paths.patterns()[m];
        const double size = path.force(static_cast<Index>(2 * m), k);
        side += size * pattern.side;
        down += size * pattern.down;
        torque += size * pattern.torque;
      }
      // What a link's end carries is the force below: its mean square along the cable.
      sum += (side.squaredNorm() + down.squaredNorm()) / static_cast<double>(side.size()) +
             torque.squaredNorm() / (chain.length * chain.length);
      count += 1;
    }
  }
  return std::sqrt(sum / std::max(1.0, count));
}

/// The largest evidence over the variance of some patterns, and the variance that has it.
struct Peak {
  double log_evidence = 0, variance = 0;
};

Peak peak_of(const LinearProblem& linear, const std::vector<ActingForce>& acting,
             const ForcePrior& prior, double size) {
  Peak best;
  std::vector<double> evidence;
  for (const double factor : kSizes) {
    const double variance = factor * size * factor * size;
    evidence.push_back(smooth_forces(linear, acting, {variance}, prior, false).log_evidence);
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
  return best;
}

MissingForce::History history_of(const ForcePaths& paths, std::size_t number,
                                 const Problem& problem, const Smoothed& smoothed,
                                 const ChainMeasures& chain, bool densities) {
  MissingForce::History history;
  history.experiment =
      problem.experiments()[static_cast<std::size_t>(paths.paths()[number].experiment)].spec.name;
  history.time = paths.times(number);
  const auto& patterns = paths.patterns();
  const Smoothed::Recording& found = smoothed.recordings[number];
  if (!densities)
    for (const ForcePattern& pattern : patterns)
      history.rows.emplace_back(!pattern.torque.isZero() ? "moment"
                                : !pattern.side.isZero() ? "side"
                                                         : "down");
  const auto count = static_cast<Index>(patterns.size());
  const Index times = found.force.cols(), links = chain.lengths.size();
  history.size.resize(count, times);
  history.deviation.resize(count, times);
  // Densities of the patterns at the links, from what the links' ends carry.
  MatrixXd side = MatrixXd::Zero(links, count), down = side;
  if (densities) {
    for (Index m = 0; m < count; ++m) {
      const ForcePattern& pattern = patterns[static_cast<std::size_t>(m)];
      if (pattern.group > kDownDensity) continue;
      const int mode = static_cast<int>(m) % (static_cast<int>(count - 3) / 2);
      const VectorXd shape =
          shape_basis(Shape::kSmooth, static_cast<int>(links), mode + 1, chain.lengths).col(mode);
      (pattern.group == kSideDensity ? side : down).col(m) = shape;
    }
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

/// Tries a force at each place alone, about the motion with forces everywhere.
class PlaceSearch {
 public:
  PlaceSearch(ForcePaths& paths, const ChainMeasures& chain, double size)
      : paths_(paths), chain_(chain), size_(size) {}

  /// False where the equations cannot be followed.
  bool look_everywhere(MissingForce& missing) {
    std::vector<double> at;
    for (int k = 1; k <= kPlaces; ++k) at.push_back(chain_.length * k / kPlaces);
    std::vector<ForcePattern> patterns = point_patterns(at, chain_);
    patterns.push_back(moment_pattern(0, chain_.lengths));
    if (!linearise(std::move(patterns))) return false;
    none_ = smooth_forces(*linear_, {}, {}, paths_.prior, false).log_evidence;
    const Peak torque = peak_of(*linear_, {{static_cast<Index>(2 * at.size()), 0}}, paths_.prior,
                                size_ * chain_.length);
    missing.places.push_back({"torque at the support", 0, torque.log_evidence - none_, 0});
    variance_.push_back(torque.variance);
    add(at, missing.places);
    return true;
  }

  /// A moment in joints near the same places alone. Takes one that is better than every place.
  bool look_at_joints(MissingForce& missing) {
    std::vector<Index> joints;
    const Index links = chain_.lengths.size();
    for (int k = 1; k <= kPlaces; ++k)
      joints.push_back(std::clamp<Index>((k * links) / (kPlaces + 1), 1, links - 1));
    joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
    if (links < 2) return true;
    const auto tried = [&](Index joint) {
      return std::any_of(missing.joints.begin(), missing.joints.end(),
                         [&](const auto& place) { return place.joint == joint; });
    };
    while (!joints.empty()) {
      std::vector<ForcePattern> patterns;
      patterns.reserve(joints.size());
      for (const Index joint : joints) patterns.push_back(moment_pattern(joint, chain_.lengths));
      if (!linearise(std::move(patterns))) return false;
      for (std::size_t i = 0; i < joints.size(); ++i) {
        const Peak peak = peak_of(*linear_, {{static_cast<Index>(i), 0}}, paths_.prior,
                                  size_ * chain_.length / static_cast<double>(links));
        missing.joints.push_back({paths_.patterns()[i].name, chain_.lengths.head(joints[i]).sum(),
                                  peak.log_evidence - none_, static_cast<int>(joints[i])});
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

  /// The best of them, looked at more closely.
  bool look_closer(MissingForce& missing) {
    const auto best =
        static_cast<std::size_t>(std::max_element(missing.places.begin(), missing.places.end(),
                                                  [](const auto& a, const auto& b) {
                                                    return a.log_evidence < b.log_evidence;
                                                  }) -
                                 missing.places.begin());
    missing.best = missing.places[best];
    best_variance_ = variance_[best];
    if (best == 0) return true;  // the support
    double step = chain_.length / kPlaces;
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

  /// The error of the camera that explains most about the motion last linearised.
  std::optional<MissingForce::Sensor> best_sensor() const {
    std::optional<MissingForce::Sensor> best;
    for (const SensorError& error : sensor_errors(paths_, chain_.lengths)) {
      const double evidence = log_evidence_of(error, *linear_) - none_;
      if (!best || evidence > best->log_evidence) best = {error.name, evidence};
    }
    return best;
  }

  double best_variance() const { return best_variance_; }
  double none() const { return none_; }

 private:
  bool linearise(std::vector<ForcePattern> patterns) {
    paths_.act(std::move(patterns));
    linear_ = paths_.linearise();
    return linear_.has_value();
  }

  /// Evidence of side and down force at each place, patterns 2 i and 2 i + 1.
  void add(const std::vector<double>& at, std::vector<MissingForce::Place>& places) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto pattern = static_cast<Index>(2 * i);
      const Peak peak = peak_of(*linear_, {{pattern, 0}, {pattern + 1, 0}}, paths_.prior, size_);
      places.push_back(
          {fmt::format("force at arc length {:.3g} m", at[i]), at[i], peak.log_evidence - none_});
      variance_.push_back(peak.variance);
    }
  }

  /// The top of the parabola through the best place and its neighbours; the best where it has none
  /// on one side.
  static double top_between(std::vector<MissingForce::Place> tried, double best) {
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

  ForcePaths& paths_;
  const ChainMeasures& chain_;
  double size_, none_ = 0, best_variance_ = 0;
  std::optional<LinearProblem> linear_;
  std::vector<double> variance_;  // of each place
};

/// Where a history is strongest: row and time.
struct Strongest {
  Index row = 0, time = 0;
};
Strongest strongest_of(const MatrixXd& side, const MatrixXd& down) {
  Strongest at;
  (side.array().square() + down.array().square()).maxCoeff(&at.row, &at.time);
  return at;
}

std::string sized(double value, double deviation, const std::string& unit) {
  return fmt::format("{:.3g} {} ({:.3g} to {:.3g})", value, unit, value - 1.96 * deviation,
                     value + 1.96 * deviation);
}

/// "side", "down" or both, by what most of the mean square is.
std::string direction_of(double side, double down) {
  constexpr double kMost = 0.8;
  if (side > kMost * (side + down)) return "a side force";
  if (down > kMost * (side + down)) return "a force up or down";
  return "a force";
}

void describe_place(MissingForce& missing) {
  const MissingForce::Place& best = *missing.best;
  const MissingForce::History* where = &missing.at_best.front();
  Strongest at;
  const std::vector<std::string>& rows = where->rows;
  VectorXd squares = VectorXd::Zero(static_cast<Index>(rows.size()));
  double most = -1;
  for (const MissingForce::History& history : missing.at_best) {
    squares += history.size.rowwise().squaredNorm();
    Strongest here;
    const double size = history.size.colwise().norm().maxCoeff(&here.time);
    if (size > most) most = size, where = &history, at = here;
  }
  const bool torque = best.joint >= 0;
  squares.maxCoeff(&at.row);
  const auto of = [&](const char* name) {
    const auto row = std::find(rows.begin(), rows.end(), name);
    return row == rows.end() ? 0.0 : squares[row - rows.begin()];
  };
  const std::string what = torque
                               ? "a " + best.name
                               : fmt::format("{} at arc length {:.3g} m",
                                             direction_of(of("side"), of("down")), best.arc_length);
  missing.words.push_back(fmt::format(
      "{}, strongest at {:.3g} s of {}: {}{}", what, where->time[static_cast<std::size_t>(at.time)],
      where->experiment, torque ? "" : rows[static_cast<std::size_t>(at.row)] + " ",
      sized(where->size(at.row, at.time), where->deviation(at.row, at.time),
            torque ? "N m" : "N")));
  missing.words.push_back(
      "a force there alone explains the recordings as well as forces everywhere do");
}

void describe_everywhere(MissingForce& missing) {
  const MissingForce::History* where = &missing.everywhere.front();
  Strongest at;
  double most = -1, side = 0, down = 0;
  for (const MissingForce::History& history : missing.everywhere) {
    side += history.side.squaredNorm();
    down += history.down.squaredNorm();
    const Strongest here = strongest_of(history.side, history.down);
    const double size =
        std::hypot(history.side(here.row, here.time), history.down(here.row, here.time));
    if (size > most) most = size, where = &history, at = here;
  }
  const bool mostly_down = down > side;
  const MatrixXd& value = mostly_down ? where->down : where->side;
  const MatrixXd& deviation = mostly_down ? where->down_deviation : where->side_deviation;
  missing.words.push_back(
      fmt::format("{} along the cable, strongest at arc length {:.3g} m, {:.3g} s of {}: {} {}",
                  direction_of(side, down), missing.arc_length[static_cast<std::size_t>(at.row)],
                  where->time[static_cast<std::size_t>(at.time)], where->experiment,
                  mostly_down ? "down" : "side",
                  sized(value(at.row, at.time), deviation(at.row, at.time), "N/m")));
  missing.words.push_back(fmt::format(
      "a force at one place alone explains less: the best one is {}", missing.best->name));
}

void describe(MissingForce& missing) {
  if (!missing.found && missing.sensor) {
    missing.words.push_back(fmt::format(
        "no force on the chain: an error of the camera explains the recordings as well: {} "
        "(log evidence {:.4g}, of forces {:.4g})",
        missing.sensor->name, missing.sensor->log_evidence,
        std::max(missing.log_evidence, missing.best->log_evidence)));
    return;
  }
  if (!missing.found) {
    missing.words.push_back(
        fmt::format("no force on the chain: one would explain {:.1f} % of the squared residuals "
                    "(log evidence {:.3g})",
                    100 * missing.share, missing.log_evidence));
    return;
  }
  if (missing.one_place)
    describe_place(missing);
  else
    describe_everywhere(missing);
  std::string others;
  for (const auto* tried : {&missing.places, &missing.joints})
    for (const MissingForce::Place& place : *tried)
      if (place.log_evidence > missing.best->log_evidence - kForceThresholds.told_apart &&
          place.name != missing.best->name)
        others += (others.empty() ? "" : ", ") + place.name;
  if (!others.empty()) missing.words.push_back("these data do not tell it from: " + others);
  const auto resolved = std::count_if(missing.patterns.begin(), missing.patterns.end(),
                                      [](const auto& p) { return p.resolved > kResolved; });
  missing.words.push_back(fmt::format(
      "forces explain {:.0f} % of the squared residuals (log evidence {:.4g}); the data resolve {} "
      "of {} patterns",
      100 * missing.share, missing.log_evidence, resolved, missing.patterns.size()));
  if (missing.law && (missing.one_place || missing.law->found))
    missing.words.insert(missing.words.end(), missing.law->words.begin(), missing.law->words.end());
}

void add_parameters(const Problem& problem, const VectorXd& before, const ForcePaths& paths,
                    const LatentUnknowns& unknowns, const Smoothed& smoothed,
                    MissingForce& missing) {
  missing.parameters.clear();
  for (std::size_t j = 0; j < unknowns.shared().size(); ++j) {
    const Index i = unknowns.shared()[j];
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(i)];
    missing.parameters.push_back(
        {unknown.name, unknown.unit, before[i], paths.x()[i],
         unknowns.slope(i, paths.x()) *
             std::sqrt(std::max(0.0, smoothed.shared_variance[static_cast<Index>(j)]))});
  }
}

/// Where a law of the force may act: at its place, or at all that were tried where it has none, in
/// every joint by itself, along the cable and in all joints.
std::vector<LawSite> sites_of(const MissingForce& missing, const ChainMeasures& chain) {
  std::vector<LawSite> sites;
  const auto add_place = [&](const MissingForce::Place& place) {
    if (place.joint < 0) sites.push_back({SiteKind::kPlace, place.arc_length});
  };
  add_place(*missing.best);
  if (!missing.one_place)
    for (const MissingForce::Place& place : missing.places) add_place(place);
  for (Index joint = 0; joint < chain.lengths.size(); ++joint)
    sites.push_back({SiteKind::kJoint, chain.lengths.head(joint).sum(), joint});
  sites.push_back({SiteKind::kCable});
  sites.push_back({SiteKind::kJoints});
  return sites;
}

/// A force that has settled, and the motion with it.
struct SettledForce {
  ForcePaths paths;
  Smoothed smoothed;
};

/// The side and the down force at a place; the stronger alone where the other is not shown, as a force
/// is. A cable hardly shows what pushes along it, so that a direction of small size that follows the
/// noise takes from the other what is not its own. Both where the motion cannot be followed with one.
SettledForce directions_shown(SettledForce both, const std::vector<double>& variance) {
  std::vector<double> squares = {0, 0};
  for (const Smoothed::Recording& recording : both.smoothed.recordings)
    for (const Index m : {0, 1})
      squares[static_cast<std::size_t>(m)] += recording.force.row(2 * m).squaredNorm();
  const std::size_t stronger = squares[1] > squares[0];
  SettledForce alone = both;
  std::vector<ForcePattern> patterns = {both.paths.patterns()[stronger]};
  patterns.front().group = 0;
  alone.paths.act(std::move(patterns));
  std::vector<double> of_stronger = {variance[stronger]};
  std::optional<Smoothed> smoothed = alone.paths.settle(of_stronger, true);
  if (!smoothed ||
      both.smoothed.log_evidence - smoothed->log_evidence > kForceThresholds.log_evidence)
    return both;
  alone.smoothed = std::move(*smoothed);
  return alone;
}

/// False where the equations cannot be followed.
bool examine(const Problem& problem, const VectorXd& x, const std::vector<double>& sigmas,
             const std::function<bool()>& keep_going, MissingForce& missing) {
  const LatentUnknowns unknowns(problem, x);
  ForcePaths paths(problem, unknowns, sigmas, x, keep_going);
  if (!paths.ok()) return false;
  const ChainMeasures chain(problem, x, paths.paths().front().experiment);
  double begin = 0;
  for (const double length : chain.lengths) {
    missing.arc_length.push_back(begin + 0.5 * length);
    begin += length;
  }

  const double squares_without = paths.squares();
  paths.act(all_patterns(chain));
  std::vector<double> variance = first_variances(chain);
  std::optional<Smoothed> everywhere = paths.settle(variance, false);
  if (!everywhere) return false;
  ForcePaths with_all = paths;
  missing.share = 1 - paths.squares() / squares_without;
  // A force may be zero, so it leaves no more than none does: else the iterations went astray.
  if (!(missing.share > -kForceThresholds.share)) return false;
  for (std::size_t m = 0; m < paths.patterns().size(); ++m) {
    const ForcePattern& pattern = paths.patterns()[m];
    const double prior = variance[static_cast<std::size_t>(pattern.group)];
    double left = 0, count = 0;
    for (const Smoothed::Recording& recording : everywhere->recordings)
      for (const MatrixXd& covariance : recording.covariance)
        left += covariance(static_cast<Index>(m), static_cast<Index>(m)), count += 1;
    missing.patterns.push_back({pattern.name, pattern.unit, std::sqrt(prior),
                                std::clamp(1 - left / count / prior, 0.0, 1.0)});
  }
  for (std::size_t r = 0; r < paths.paths().size(); ++r)
    missing.everywhere.push_back(history_of(paths, r, problem, *everywhere, chain, true));
  add_parameters(problem, x, paths, unknowns, *everywhere, missing);

  PlaceSearch search(paths, chain, size_of(paths, chain));
  if (!search.look_everywhere(missing)) return false;
  missing.log_evidence = everywhere->log_evidence - search.none();
  missing.log_probability = std::max(everywhere->log_evidence, search.none());
  missing.found = missing.log_evidence > kForceThresholds.log_evidence &&
                  missing.share > kForceThresholds.share;
  if (!missing.found) {
    missing.places.clear();
    return true;
  }
  missing.sensor = search.best_sensor();
  if (!search.look_closer(missing) || !search.look_at_joints(missing)) return false;
  if (missing.sensor &&
      missing.sensor->log_evidence >= std::max(missing.log_evidence, missing.best->log_evidence)) {
    missing.found = false;
    return true;
  }

  // What acts there if it acts nowhere else.
  const bool moment = missing.best->joint >= 0;
  paths.act(moment ? std::vector{moment_pattern(missing.best->joint, chain.lengths)}
                   : point_patterns({missing.best->arc_length}, chain));
  std::vector<double> at_place(moment ? 1 : 2, search.best_variance());
  const std::optional<Smoothed> there = paths.settle(at_place, true);
  if (!there) return false;
  missing.best->log_evidence = there->log_evidence - search.none();
  missing.one_place = there->log_evidence >= everywhere->log_evidence;
  missing.log_probability = std::max(missing.log_probability, there->log_evidence);
  const SettledForce shown =
      moment ? SettledForce{paths, *there} : directions_shown({paths, *there}, at_place);
  for (std::size_t r = 0; r < paths.paths().size(); ++r)
    missing.at_best.push_back(history_of(shown.paths, r, problem, shown.smoothed, chain, false));
  if (missing.one_place) {
    add_parameters(problem, x, shown.paths, unknowns, shown.smoothed, missing);
    missing.log_evidence = missing.best->log_evidence;
    missing.share = 1 - paths.squares() / squares_without;
  }
  missing.law =
      law_of_force(missing.one_place ? paths : with_all,
                   {chain.lengths, problem.model().coordinates()}, sites_of(missing, chain));
  return true;
}

}  // namespace

MissingForce missing_force(const Problem& problem, const VectorXd& x,
                           const std::vector<double>& sigmas,
                           const std::function<bool()>& keep_going) {
  const double begin = cpu_seconds();
  MissingForce missing;
  if (examine(problem, x, sigmas, keep_going, missing)) {
    describe(missing);
  } else {
    missing = {};
    missing.words.push_back(
        "the missing force cannot be told: the motion cannot be followed with it");
  }
  missing.seconds = cpu_seconds() - begin;
  return missing;
}

}  // namespace catena
