// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "identify/forces/candidate_law.hpp"
#include "identify/forces/force_path.hpp"

namespace catena {

/// When a law is taken (a part of the thresholds of a diagnosis, identify/diagnosis/thresholds.hpp).
struct LawThresholds {
  /// Share of random forces for which the best law does as well. Of 100 forces that follow no law
  /// one has one. Evidence: docs/discovery.md.
  double chance = 0.01;
  /// Share of what the free force explains in the second part that a law must explain there. One
  /// that leaves more than a fifth is not the law of this force, or not the only one. Chosen.
  double confirmed = 0.8;
  /// Difference of the Bayesian information criterion below which two formulas are not told apart:
  /// odds of 1 to 20, from which Kass and Raftery (1995) call evidence strong.
  double undecided = 6;
  /// Share of what a formula explains that its terms must explain beyond one with fewer of them. Without these the force is
  /// off by less than 5 % of its root mean square: signs are smoothed and parameters followed in a line, which is no
  /// better, and noise has no part in that. Chosen.
  double worth = 0.002;
  /// Squared residuals that a formula may leave about the motion that it gives itself, over those about the motion found,
  /// or over noise if that is more. What leaves more was right about a motion that it does not make: parameters that
  /// are far from their values can make a wrong law look so. Twice the residual. Chosen.
  double astray = 4;
  /// Over noise: the error of the motion that two laws, or two models, share at least, for no law is exact. By so much in
  /// every number that was measured, another one may be behind and be the right one (identify/diagnosis/compare.cpp).
  /// As DiagnosisThresholds::law_error.
  double shared_error = 0.1;
  /// Formulas that are fitted exactly in the law's place: those that are not told apart from it, then those that are
  /// little behind, most probable first. Each costs a fit. Chosen.
  int rivals = 3;
};
inline constexpr LawThresholds kLawThresholds;

/// What the missing force goes with: a formula of few constants, or nothing.
///
/// The candidates are conjugate pairs of a force and a variable (law_variable.hpp) at many sites, so
/// none can make energy, except against a velocity, and those that do are refused. All are tested
/// together. How: docs/discovery.md.
struct ForceLaw {
  bool found = false;
  std::string force, variable;    ///< of the best candidate: "side force", "side position"
  LawSite site;                   ///< of the best candidate
  CandidateLaw::Formula formula;  ///< empty where nothing is found
  double place_deviation = 0, other_place_deviation = 0;  ///< m, of the arc lengths of the site
  int candidates = 0;
  bool by_points =
      false;  ///< chosen by every other point that is seen and confirmed by the rest: a law of the time
  const char* chosen_in() const {
    return by_points ? "one half of the points" : "the first part of the frames";
  }
  /// What the law, chosen and fitted in the first part of the frames, explains in the second, of what
  /// the free force explains: 1 is all. A force that follows noise less than the free one may leave less: more than 1.
  double confirmed = 0;
  double share_confirmed() const { return std::clamp(confirmed, 0.0, 1.0); }
  /// Probability that the best of all candidates does as well for a random force of the same
  /// spectrum.
  double chance = 1;
  std::vector<ForceLaw> rivals;  ///< formulas that the data do not tell from it
  /// Those that are told from it by linear equations only, most probable first, one of each pair, of its own only if it is
  /// a curve. As far as the equations err, exact fits decide.
  std::vector<ForceLaw> behind;
  double left_more =
      0;  ///< of one of these: squared residuals, over the noise, beyond those of rivals, in the mean
  std::vector<std::string> words;
};

/// Where a law may act. The others are looked at where the first have none.
struct LawSites {
  std::vector<LawSite> first;
  std::vector<LawSite> pairs;     ///< of places; none where the force is at one place
  std::optional<LawSite> pushed;  ///< the one place of the force, where it may follow the time
};

/// `paths`: settled with forces; other patterns act on it afterwards. Nothing where the motion cannot be followed.
std::optional<ForceLaw> law_of_force(ForcePaths& paths, const LawChain& chain,
                                     const LawSites& sites);

}  // namespace catena
