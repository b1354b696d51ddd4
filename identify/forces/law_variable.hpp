// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "identify/forces/place_kinematics.hpp"

namespace catena {

enum class SiteKind {
  kPlace,   ///< one point of the cable
  kPair,    ///< two points of the cable
  kJoint,   ///< one joint; joint 0 is the support
  kCable,   ///< every piece of the cable, per length
  kJoints,  ///< every joint, as the bending of the cable per length
};

/// Where a law acts.
struct LawSite {
  SiteKind kind = SiteKind::kPlace;
  double arc_length =
      0;  ///< m, of the place or the joint, of a pair of places the one nearer to the support
  Eigen::Index joint = 0;
  double other_arc_length = 0;  ///< m, of the other place of a pair
};

/// What a law may depend on. Its force is along the change of the variable, so that force times rate
/// of the variable is the power: the pair is conjugate. The time and the tension are in no such pair.
enum class LawVariable {
  // of a place
  kSidePosition,
  kDownPosition,
  kAcrossPosition,
  kDistance,      ///< from a fixed point
  kAcceleration,  ///< less that of gravity, as a vector
  // of a pair of places
  kChord,      ///< their distance
  kChordRate,  ///< its rate
  // of the end of the cable
  kRelaxingSidePosition,
  kRelaxingDownPosition,
  // of a place, or of every piece of the cable
  kSideVelocity,
  kDownVelocity,
  kAcrossVelocity,
  kNormalVelocity,
  kTangentialVelocity,
  kSpeed,
  // of every piece of the cable
  kLinkRate,
  // of a joint
  kJointAngle,
  kJointRate,
  kRelaxingJointAngle,
  kRateUnderTension,  ///< the rate again; the force is over the tension
  // of a joint, or of every joint
  kTension,  ///< of weights and accelerations; the moment is along the joint angle
  // of every joint
  kCurvature,
  kCurvatureRate,
  kRelaxingCurvature,
  kCurvatureRateUnderTension,
  // of a place, or of a joint
  kTimeOfSideForce,
  kTimeOfDownForce,
  kTimeOfAcrossForce,
  kTimeOfMoment,
};

/// Whether a force of the variable has a potential of the shape alone; else it is against a velocity, an
/// acceleration or a stretch that relaxes.
bool has_potential(LawVariable variable);

/// The position or angle x that a relaxing variable z follows, z' = x' - z / lag; nothing for others.
std::optional<LawVariable> relaxing_of(LawVariable variable);

/// Whether the force is over the tension there: friction that the tension presses.
bool over_tension(LawVariable variable);

/// A velocity of a site in the language of effects; of the speed its components.
std::vector<std::string> components_of(const LawSite& site, LawVariable variable, bool in_space);

/// Whether it goes with accelerations of the links, which then stand behind the state.
bool has_accelerations(LawVariable variable);

/// The position or angle along which a force acts that depends on the time; nothing for others.
std::optional<LawVariable> timed_of(LawVariable variable);

/// The names of a variable and of the force that goes with it.
struct LawNames {
  std::string force, variable, force_unit, variable_unit;
  /// The variable in the language of effects; its square where only that has a formula.
  std::string symbols, squared;
};
/// As texts and effect files have them.
LawNames names_of(const LawSite& site, LawVariable variable, bool in_space);

/// A variable of a place in the language of effects, `offset` past the middle of a link.
std::string symbols_of(LawVariable variable, bool in_space);

/// " at arc length 1.08 m", " between arc lengths 1.08 m and 2.37 m", " along the cable", or nothing for the support.
std::string site_in_words(const LawSite& site);

/// The variable at one piece of a site, or one component of it: its value, its derivative by the turns of the links (by
/// how fast they turn where it is a velocity), and the length that the piece stands for, m (1 at a place or a joint);
/// times the size of the tension, N, where the force is over that.
struct LawElement {
  double value = 0;
  Eigen::VectorXd gradient;
  double weight = 1;
};

/// The chain that laws act on, and coordinates of its model, of which those of the links are the first.
struct LawChain : LinkChain {
  Eigen::Index coordinates = 0;
  double gravity = 0;      ///< m/s^2
  Eigen::VectorXd masses;  ///< of the links, kg
  double load = 0;         ///< kg

  /// Turns of all links: their angles, in space turns about three axes.
  Eigen::Index turns() const { return lengths.size() * (in_space ? 3 : 1); }
};

/// The tension in every joint, N, from the support on, in the plane: what weights and accelerations below it make along
/// the link. Without accelerations it is the steady one (docs/effects.md). `state`: (q, v, z).
Eigen::VectorXd joint_tensions(const LawChain& chain, const Eigen::VectorXd& state,
                               const Eigen::VectorXd& accelerations);

/// N: the size of a tension T is sqrt(T^2 + floor^2), in effects, too.
inline constexpr double kTensionFloor = 1e-3;

/// `state`: (q, v, z), and behind it what the variable remembers (law_memory.hpp). `fixed_point`: m, for
/// the distance.
std::vector<LawElement> law_elements(const LawSite& site, LawVariable variable,
                                     const ChainVector& fixed_point, const LawChain& chain,
                                     const Eigen::VectorXd& state);

/// Variables of a site, but for the time. In space those of places and of the whole cable that remember nothing.
std::vector<LawVariable> variables_of(const LawSite& site, const LawChain& chain);

/// The time, of each direction in which the site may be pushed.
std::vector<LawVariable> times_of(const LawSite& site, bool in_space);

}  // namespace catena
