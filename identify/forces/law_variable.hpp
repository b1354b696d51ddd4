// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace catena {

enum class SiteKind {
  kPlace,   ///< one point of the cable
  kJoint,   ///< one joint; joint 0 is the support
  kCable,   ///< every piece of the cable, per length
  kJoints,  ///< every joint, as the bending of the cable per length
};

/// Where a law acts.
struct LawSite {
  SiteKind kind = SiteKind::kPlace;
  double arc_length = 0;  ///< m, of the place or the joint
  Eigen::Index joint = 0;
};

/// What a law may depend on. Its force is along the change of the variable, so that force times rate
/// of the variable is the power: the pair is conjugate.
enum class LawVariable {
  // of a place
  kSidePosition,
  kDownPosition,
  kDistance,  ///< from a fixed point
  // of a place, or of every piece of the cable
  kSideVelocity,
  kDownVelocity,
  kNormalVelocity,
  kTangentialVelocity,
  kSpeed,
  // of every piece of the cable
  kLinkRate,
  // of a joint
  kJointAngle,
  kJointRate,
  // of every joint
  kCurvature,
  kCurvatureRate,
};

/// Whether a force of the variable has a potential; else it is against a velocity.
bool has_potential(LawVariable variable);

/// The names of a variable and of the force that goes with it.
struct LawNames {
  std::string force, variable, force_unit, variable_unit;
  /// The variable in the language of effects; its square where only that has a formula.
  std::string symbols, squared;
};
LawNames names_of(const LawSite& site, LawVariable variable);

/// " at arc length 1.08 m", " along the cable", or nothing for the support.
std::string site_in_words(const LawSite& site);

/// The variable at one piece of a site: its value, its derivative by the angles (by their rates
/// where it is a velocity), and the length that the piece stands for, m (1 at a place or a joint).
struct LawElement {
  double value = 0;
  Eigen::VectorXd gradient;
  double weight = 1;
};

/// The chain that laws act on: lengths of its links, m, and coordinates of its model, of which the
/// angles are the first.
struct LawChain {
  Eigen::VectorXd lengths;
  Eigen::Index coordinates = 0;
};

/// `state`: (q, v, z). `fixed_point`: side and down, m, for the distance.
std::vector<LawElement> law_elements(const LawSite& site, LawVariable variable,
                                     const Eigen::Vector2d& fixed_point, const LawChain& chain,
                                     const Eigen::VectorXd& state);

/// Variables of a kind of site.
std::vector<LawVariable> variables_of(SiteKind kind);

}  // namespace catena
