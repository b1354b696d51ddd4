// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/missing_force.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/cpu_seconds.hpp"
#include "identify/forces/force_history.hpp"
#include "identify/forces/force_sizes.hpp"
#include "identify/forces/forces_everywhere.hpp"
#include "identify/forces/missing_force_words.hpp"
#include "identify/forces/place_search.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

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
/// every joint by itself, along the cable and in all joints. Then in time at its place, or between two of those that
/// were tried.
LawSites sites_of(const MissingForce& missing, const ChainMeasures& chain) {
  std::vector<double> places;
  const auto add_place = [&](const MissingForce::Place& place) {
    if (place.joint < 0) places.push_back(place.arc_length);
  };
  add_place(*missing.best);
  if (!missing.one_place)
    for (const MissingForce::Place& place : missing.places) add_place(place);
  LawSites sites;
  for (const double place : places) sites.first.push_back({SiteKind::kPlace, place});
  for (Index joint = 0; joint < chain.lengths.size(); ++joint)
    sites.first.push_back({SiteKind::kJoint, chain.lengths.head(joint).sum(), joint});
  sites.first.push_back({SiteKind::kCable});
  sites.first.push_back({SiteKind::kJoints});
  if (missing.one_place) {
    sites.pushed = missing.best->joint >= 0
                       ? LawSite{SiteKind::kJoint, missing.best->arc_length, missing.best->joint}
                       : LawSite{SiteKind::kPlace, missing.best->arc_length};
    return sites;
  }
  const double near = 0.5 * chain.length / kForcePlaces;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = i + 1; j < places.size(); ++j)
      if (std::abs(places[i] - places[j]) > near)
        sites.pairs.push_back({.kind = SiteKind::kPair,
                               .arc_length = std::min(places[i], places[j]),
                               .other_arc_length = std::max(places[i], places[j])});
  return sites;
}

/// A force that has settled, and the motion with it.
struct SettledForce {
  ForcePaths paths;
  Smoothed smoothed;
};

/// A force at a place, or a moment in a joint in space, without the directions that are not shown, as a force is: the
/// weakest ones. A cable hardly shows what pushes along it, so that a direction of small size that follows the
/// noise takes from the others what is not its own. All that are left where the motion cannot be followed with fewer.
/// `least`: what the log evidence must be.
SettledForce directions_shown(SettledForce all, const std::vector<double>& variance,
                              const ChainMeasures& chain, double least) {
  if (variance.size() == 1) return all;
  std::vector<double> squares(variance.size(), 0.0);
  for (const Smoothed::Recording& recording : all.smoothed.recordings)
    for (std::size_t m = 0; m < squares.size(); ++m)
      squares[m] += recording.force.row(static_cast<Index>(2 * m)).squaredNorm();
  const auto weakest = std::min_element(squares.rbegin(), squares.rend());
  const auto last = squares.rend() - weakest - 1;
  SettledForce fewer = all;
  std::vector<ForcePattern> patterns = all.paths.patterns();
  patterns.erase(patterns.begin() + last);
  for (std::size_t m = 0; m < patterns.size(); ++m) patterns[m].group = static_cast<int>(m);
  fewer.paths.act(std::move(patterns));
  std::vector<double> of_fewer = variance;
  of_fewer.erase(of_fewer.begin() + last);
  std::optional<Smoothed> smoothed =
      fewer.paths.settle(of_fewer, largest_variances(fewer.paths.patterns(), chain), true);
  if (!smoothed || smoothed->log_evidence < least) return all;
  fewer.smoothed = std::move(*smoothed);
  return directions_shown(std::move(fewer), of_fewer, chain, least);
}

/// Forces everywhere without the patterns that the recordings do not show: those that are resolved least, as
/// many as the log evidence allows, with the time scale of the largest evidence. Of their strengths the
/// evidence says nothing, so they stay near where its search began, and every interval with them. With the
/// covariances of means over time. Nothing where the motion cannot be followed.
std::optional<SettledForce> patterns_shown(const SettledForce& all,
                                           const std::vector<double>& variance,
                                           const ChainMeasures& chain,
                                           const std::vector<MissingForce::Pattern>& resolved) {
  std::optional<LinearProblem> linear = all.paths.linearise();
  if (!linear) return std::nullopt;
  std::vector<std::size_t> order(resolved.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return resolved[a].resolved > resolved[b].resolved;
  });
  const auto evidence_of = [&](std::size_t count) {
    std::vector<ActingForce> acting;
    for (std::size_t k = 0; k < count; ++k)
      acting.push_back({static_cast<Index>(order[k]), all.paths.patterns()[order[k]].group});
    return smooth_forces(*linear, acting, variance, all.paths.prior, false).log_evidence;
  };
  // Few patterns are tried first: the work grows with the cube of their number.
  const double least = all.smoothed.log_evidence - kForceThresholds.log_evidence;
  std::size_t few = 0, enough = 1;
  while (enough < order.size() && evidence_of(enough) < least) {
    few = enough;
    enough = std::min(2 * enough, order.size());
  }
  while (few + 1 < enough) {
    const std::size_t middle = (few + enough) / 2;
    (evidence_of(middle) < least ? few : enough) = middle;
  }
  order.resize(enough);
  std::sort(order.begin(), order.end());
  SettledForce shown = all;
  std::vector<ForcePattern> patterns;
  std::vector<double> variances;
  for (const std::size_t k : order) {
    patterns.push_back(all.paths.patterns()[k]);
    variances.push_back(variance[static_cast<std::size_t>(patterns.back().group)]);
    patterns.back().group = static_cast<int>(patterns.size()) - 1;
  }
  shown.paths.act(std::move(patterns));
  if (!shown.paths.settle(variances, largest_variances(shown.paths.patterns(), chain), true))
    return std::nullopt;
  linear = shown.paths.linearise();
  if (!linear) return std::nullopt;
  std::vector<ActingForce> acting;
  for (std::size_t m = 0; m < variances.size(); ++m)
    acting.push_back({static_cast<Index>(m), static_cast<int>(m)});
  Index later = 0;
  for (std::size_t r = 0; r < shown.paths.paths().size(); ++r)
    later = std::max(later, nodes_of_mean(shown.paths.times(r)));
  shown.smoothed = smooth_forces(*linear, acting, variances, shown.paths.prior, true, later);
  return shown;
}

/// Log evidence without what the fitted numbers of a prior, its strengths and time scale, gain by
/// chance: 1 each (Akaike, IEEE Trans. Automatic Control 19 (1974) 716). So forces everywhere, with many
/// strengths, can be held against a force at one place.
double log_evidence_of(const Smoothed& smoothed, std::size_t fitted_numbers) {
  return smoothed.log_evidence - static_cast<double>(fitted_numbers);
}

/// False where the equations cannot be followed.
bool examine(const Problem& problem, const VectorXd& x, const std::vector<double>& sigmas,
             const std::function<bool()>& keep_going, MissingForce& missing) {
  const LatentUnknowns unknowns(problem, x);
  ForcePaths paths(problem, unknowns, sigmas, x, keep_going);
  if (!paths.ok()) return false;
  const ChainMeasures chain(problem, x, paths.paths().front().experiment);
  const VectorXd middles = link_middles(chain.lengths);
  missing.arc_length.assign(middles.begin(), middles.end());

  const double squares_without = paths.squares();
  paths.act(forces_everywhere(chain));
  std::vector<double> variance = first_variances(paths.patterns(), chain);
  std::optional<Smoothed> everywhere =
      paths.settle(variance, largest_variances(paths.patterns(), chain), false);
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
      for (const std::vector<MatrixXd>& covariance : recording.covariance)
        left += covariance[0](static_cast<Index>(m), static_cast<Index>(m)), count += 1;
    missing.patterns.push_back({pattern.name, pattern.unit, std::sqrt(prior),
                                std::clamp(1 - left / count / prior, 0.0, 1.0)});
  }
  const std::optional<SettledForce> shown_everywhere =
      patterns_shown({paths, *everywhere}, variance, chain, missing.patterns);
  if (!shown_everywhere) return false;
  for (std::size_t r = 0; r < paths.paths().size(); ++r)
    missing.everywhere.push_back(force_history(shown_everywhere->paths, r, problem,
                                               shown_everywhere->smoothed, chain, true));
  add_parameters(problem, x, paths, unknowns, *everywhere, missing);

  PlaceSearch search(paths, chain);
  if (!search.look_everywhere(missing)) return false;
  const double of_all = log_evidence_of(*everywhere, variance.size());
  missing.log_evidence = of_all - search.none();
  missing.log_probability = std::max(of_all, search.none());
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
  std::vector<ForcePattern> patterns = moment ? moment_patterns(missing.best->joint, chain)
                                              : point_patterns({missing.best->arc_length}, chain);
  std::vector<double> at_place(patterns.size(), search.best_variance());
  for (std::size_t m = 0; m < patterns.size(); ++m) patterns[m].group = static_cast<int>(m);
  paths.act(std::move(patterns));
  const std::optional<Smoothed> there =
      paths.settle(at_place, largest_variances(paths.patterns(), chain), true);
  if (!there) return false;
  const double of_place = log_evidence_of(*there, at_place.size() + 1);
  missing.best->log_evidence = of_place - search.none();
  missing.one_place = of_place >= of_all;
  missing.log_probability = std::max(missing.log_probability, of_place);
  const SettledForce shown = directions_shown({paths, *there}, at_place, chain,
                                              there->log_evidence - kForceThresholds.log_evidence);
  for (std::size_t r = 0; r < paths.paths().size(); ++r)
    missing.at_best.push_back(force_history(shown.paths, r, problem, shown.smoothed, chain, false));
  if (missing.one_place) {
    add_parameters(problem, x, shown.paths, unknowns, shown.smoothed, missing);
    missing.log_evidence = missing.best->log_evidence;
    missing.share = 1 - paths.squares() / squares_without;
  }
  missing.law =
      law_of_force(missing.one_place ? paths : with_all,
                   {chain, problem.model().coordinates(), chain.gravity, chain.masses, chain.load},
                   sites_of(missing, chain));
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
