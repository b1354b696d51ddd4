// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/forces/force_path.hpp"
#include "identify/forces/place_law.hpp"

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
  /// odds of 1 to 20. Chosen.
  double undecided = 6;
};

/// What the force at one place goes with: a formula of few constants, or nothing.
///
/// The candidates are conjugate pairs at the place: a force against the position along itself, or
/// against the velocity along itself. So none can make energy, except against a velocity, and those
/// that do are refused. How they are compared and tested: docs/discovery.md.
struct ForceLaw {
  bool found = false;
  std::string force, variable;  ///< of the best candidate: "side force", "side position"
  PlaceLaw::Formula formula;    ///< empty where nothing is found
  double place = 0;             ///< m, arc length of the force, if the law is right
  double place_deviation = 0;   ///< m
  int candidates = 0;
  /// What the law, chosen and fitted in the first part of the frames, explains in the second, of what
  /// the free force explains: 1 is all.
  double confirmed = 0;
  /// Probability that the best of all candidates does as well for a random force of the same
  /// spectrum.
  double chance = 1;
  std::vector<std::string> rivals;  ///< formulas that the data do not tell from it
  std::vector<std::string> words;
};

/// `paths`: settled with the patterns of one place alone: side and down, or the torque at the
/// support; other patterns act on it afterwards. `arc_length`: of the place, m, 0 for the torque.
/// `lengths`: of the links, m. `coordinates`: of the model, the angles first. Nothing where the
/// motion cannot be followed.
std::optional<ForceLaw> law_of_force(ForcePaths& paths, const Eigen::VectorXd& lengths,
                                     Eigen::Index coordinates, double arc_length);

}  // namespace catena
