// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "identify/forces/force_law.hpp"
#include "identify/problem/problem.hpp"

namespace catena {

/// When a missing force is said (a part of the thresholds of a diagnosis,
/// identify/diagnosis/thresholds.hpp).
struct MissingForceThresholds {
  /// Against no force. Odds of 1 to 20 000: the search takes the largest of some ten evidences.
  double log_evidence = 10;
  /// Of the squared residuals. In recordings of some thousand numbers a force of half a per cent is
  /// significant where there is none: what the parameters' priors and the rule of the integration
  /// leave. A share is asked besides significance.
  double share = 0.01;
  /// Log odds below which two places are not told apart: 1 to 20, from which Kass and Raftery (1995) call
  /// evidence strong.
  double told_apart = 3;
  /// Standard deviation of a force, as its prior has it, over the weight of what it acts on (force_sizes.hpp): a
  /// stronger one would do to a hanging cable what gravity does, and be seen by whoever films it. Chosen before any
  /// outcome was seen. Evidence that a bound is needed: beside wrong laws the evidence of one filmed cable asked for
  /// 43 N/m along it, eight times its weight.
  double weights = 1;
};
inline constexpr MissingForceThresholds kForceThresholds;

/// Whether, where and when a force acts on the chain that the model does not have, from the
/// recordings alone.
///
/// Forces are densities to the side and down along the cable, in space across, too, a force at the end and a torque at
/// the support (forces_everywhere.hpp), each a smooth random function of time. They are estimated
/// together with every free parameter, the start and the free sensors; the prior variances are those
/// of the largest evidence. Then a force at each place alone is tried. The parts that are fitted are
/// used, of all recordings. How: docs/diagnosis.md.
struct MissingForce {
  /// The forces explain more than chance does, and more than `MissingForceThresholds::share` of the squared
  /// residuals. Everything else is empty where the motion cannot be followed, which `words` says.
  bool found = false;
  double log_evidence = 0;  ///< log of the odds against no force, for even odds before
  /// Log of the probability of the recordings with the forces, everywhere or at the best place,
  /// whichever is larger; up to a constant of the recordings and `sigmas`. So models compare. NaN
  /// where the motion cannot be followed.
  double log_probability = std::numeric_limits<double>::quiet_NaN();
  double share = 0;  ///< of the sum of the squared residuals that the forces take away

  struct Pattern {
    std::string name, unit;
    double prior_deviation = 0;  ///< of its size, from the evidence; in `unit`
    double resolved = 0;         ///< 1 - variance afterwards / before, mean over time: 0 to 1
  };
  std::vector<Pattern> patterns;

  struct OverTime {
    Eigen::MatrixXd value, deviation;  ///< rows x times
  };
  /// Sizes of some patterns over time, with standard deviations.
  struct History {
    std::string experiment;
    std::vector<double> time;         ///< s, of the frames that are fitted
    Eigen::MatrixXd size, deviation;  ///< patterns x times
    /// The patterns; of a single place: "side", "down", "across", "moment" or, in space, "about side".
    std::vector<std::string> rows;
    /// Densities to the side, down and, in space, across at the middles of the links, links x times, N/m; empty for a
    /// single place.
    std::vector<OverTime> densities;
    /// Legendre modes 0 and 1 of the density normal to the cable, 2 x times, N/m; positions hardly show what pushes
    /// along it. In space of each component of it.
    std::vector<OverTime> normal_modes;
  };
  std::vector<double> arc_length;   ///< m, of the middles of the links
  std::vector<History> everywhere;  ///< means over kMeanReach (force_history.hpp)

  /// A force at one place alone, or a moment in one joint; in space in every direction.
  struct Place {
    std::string name;
    double arc_length = 0;    ///< m
    double log_evidence = 0;  ///< against no force
    int joint = -1;           ///< of a moment; 0 is the support, -1 for a force
  };
  std::vector<Place> places;  ///< along the cable, the torque at the support first
  std::vector<Place> joints;  ///< moments in joints below it
  /// The error of the camera that explains most, without any force. Where its evidence is not below that
  /// of every force, no force is found.
  struct Sensor {
    std::string name;
    double log_evidence = 0;  ///< against none
  };
  std::optional<Sensor> sensor;
  /// The best place of all, refined, and what acts there if it acts nowhere else: a moment, N m, or
  /// a force, N, in the directions that are shown (`MissingForceThresholds::log_evidence`).
  std::optional<Place> best;
  std::vector<History> at_best;
  bool one_place = false;       ///< the evidence of the best place is not below that of all forces
  std::optional<ForceLaw> law;  ///< what the force goes with

  struct Parameter {
    std::string name, unit;
    double before = 0, value = 0, deviation = 0;  ///< fitted without and with forces
  };
  std::vector<Parameter> parameters;  ///< those of the case that are not of one experiment

  std::vector<std::string> words;
  double seconds = 0;  ///< of CPU time of this thread
};

/// `x`: fitted values of the problem's unknowns without forces, from where parameters may go, as far
/// as their prior lets them. `sigmas`: noise of every experiment, m or rad. `keep_going`: asked now
/// and then; false ends it early, without a result.
MissingForce missing_force(const Problem& problem, const Eigen::VectorXd& x,
                           const std::vector<double>& sigmas,
                           const std::function<bool()>& keep_going = {});

}  // namespace catena
