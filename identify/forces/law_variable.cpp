// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_variable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "identify/forces/place_kinematics.hpp"

namespace catena {

using Eigen::Index;
using Eigen::Vector2d;
using Eigen::VectorXd;

namespace {

struct NamesOfVariable {
  LawVariable variable;
  bool potential;
  const char *force, *name, *unit, *symbols;
};
constexpr NamesOfVariable kNames[] = {
    {LawVariable::kSidePosition, true, "side force", "side position", "m",
     "side + offset*sin(angle)"},
    {LawVariable::kDownPosition, true, "down force", "down position", "m",
     "down + offset*cos(angle)"},
    {LawVariable::kDistance, true, "force away from a fixed point", "distance from it", "m", ""},
    {LawVariable::kAcceleration, false, "force of a mass", "acceleration less gravity", "m/s^2",
     ""},
    {LawVariable::kRelaxingSidePosition, false, "side force", "relaxing side position", "m",
     "velocity_side"},
    {LawVariable::kRelaxingDownPosition, false, "down force", "relaxing down position", "m",
     "velocity_down"},
    {LawVariable::kSideVelocity, false, "side force", "side velocity", "m/s",
     "velocity_side + offset*cos(angle)*rate"},
    {LawVariable::kDownVelocity, false, "down force", "down velocity", "m/s",
     "velocity_down - offset*sin(angle)*rate"},
    {LawVariable::kNormalVelocity, false, "force normal to the cable", "normal velocity", "m/s",
     "velocity_normal + offset*rate"},
    {LawVariable::kTangentialVelocity, false, "force along the cable", "tangential velocity", "m/s",
     "velocity_tangential"},
    {LawVariable::kSpeed, false, "force along the velocity", "speed", "m/s", ""},
    {LawVariable::kLinkRate, false, "moment", "rate of the cable's turning", "rad/s", "rate"},
    {LawVariable::kJointAngle, true, "moment", "joint angle", "rad", "joint_angle"},
    {LawVariable::kJointRate, false, "moment", "joint rate", "rad/s", "joint_rate"},
    {LawVariable::kRelaxingJointAngle, false, "moment", "relaxing joint angle", "rad",
     "joint_rate"},
    {LawVariable::kCurvature, true, "bending moment", "curvature", "1/m", "joint_angle/spacing"},
    {LawVariable::kCurvatureRate, false, "bending moment", "rate of curvature", "1/(m s)",
     "joint_rate/spacing"},
    {LawVariable::kRelaxingCurvature, false, "bending moment", "relaxing curvature", "1/m",
     "joint_rate/spacing"},
    {LawVariable::kTimeOfSideForce, true, "side force", "time", "s",
     "velocity_side + offset*cos(angle)*rate"},
    {LawVariable::kTimeOfDownForce, true, "down force", "time", "s",
     "velocity_down - offset*sin(angle)*rate"},
    {LawVariable::kTimeOfMoment, true, "moment", "time", "s", "joint_rate"},
};

const NamesOfVariable& row_of(LawVariable variable) {
  return *std::find_if(std::begin(kNames), std::end(kNames),
                       [&](const NamesOfVariable& names) { return names.variable == variable; });
}

/// A variable of a place, and its derivative by (side, down) or by their rates.
struct OfPlace {
  double value = 0;
  Vector2d along;
};

OfPlace of_place(LawVariable variable, const PlaceMotion& motion, const Vector2d& fixed_point) {
  const double across = std::cos(motion[4]), along = std::sin(motion[4]);
  const Vector2d position = motion.head<2>(), velocity = motion.segment<2>(2);
  const auto size_of = [](const Vector2d& vector) {
    const double size = std::max(vector.norm(), 1e-12);
    return OfPlace{size, vector / size};
  };
  switch (variable) {
    case LawVariable::kSidePosition:
      return {position[0], {1, 0}};
    case LawVariable::kDownPosition:
      return {position[1], {0, 1}};
    case LawVariable::kDistance:
      return size_of(position - fixed_point);
    case LawVariable::kSideVelocity:
      return {velocity[0], {1, 0}};
    case LawVariable::kDownVelocity:
      return {velocity[1], {0, 1}};
    case LawVariable::kNormalVelocity:
      return {across * velocity[0] - along * velocity[1], {across, -along}};
    case LawVariable::kTangentialVelocity:
      return {along * velocity[0] + across * velocity[1], {along, across}};
    case LawVariable::kSpeed:
      return size_of(velocity);
    default:
      return {};
  }
}

}  // namespace

bool has_potential(LawVariable variable) { return row_of(variable).potential; }

std::optional<LawVariable> relaxing_of(LawVariable variable) {
  switch (variable) {
    case LawVariable::kRelaxingSidePosition:
      return LawVariable::kSidePosition;
    case LawVariable::kRelaxingDownPosition:
      return LawVariable::kDownPosition;
    case LawVariable::kRelaxingJointAngle:
      return LawVariable::kJointAngle;
    case LawVariable::kRelaxingCurvature:
      return LawVariable::kCurvature;
    default:
      return std::nullopt;
  }
}

std::string symbols_of(LawVariable variable) { return row_of(variable).symbols; }

std::optional<LawVariable> timed_of(LawVariable variable) {
  switch (variable) {
    case LawVariable::kTimeOfSideForce:
      return LawVariable::kSidePosition;
    case LawVariable::kTimeOfDownForce:
      return LawVariable::kDownPosition;
    case LawVariable::kTimeOfMoment:
      return LawVariable::kJointAngle;
    default:
      return std::nullopt;
  }
}

LawNames names_of(const LawSite& site, LawVariable variable) {
  const NamesOfVariable& row = row_of(variable);
  const bool moment = site.kind == SiteKind::kJoint || site.kind == SiteKind::kJoints;
  LawNames names{row.force,
                 row.name,
                 moment                               ? "N m"
                 : variable == LawVariable::kLinkRate ? "N"  // N m per metre
                 : site.kind == SiteKind::kCable      ? "N/m"
                                                      : "N",
                 row.unit,
                 row.symbols,
                 {}};
  if (site.kind == SiteKind::kJoint && site.joint == 0) {
    names.force = "torque at the support";
    names.variable = timed_of(variable)                             ? names.variable
                     : variable == LawVariable::kJointAngle         ? "angle of link 1"
                     : variable == LawVariable::kRelaxingJointAngle ? "relaxing angle of link 1"
                                                                    : "rate of link 1";
  }
  if (site.kind == SiteKind::kCable)  // at the middle of a link there is no offset
    names.symbols = variable == LawVariable::kSideVelocity     ? "velocity_side"
                    : variable == LawVariable::kDownVelocity   ? "velocity_down"
                    : variable == LawVariable::kNormalVelocity ? "velocity_normal"
                                                               : names.symbols;
  if (variable == LawVariable::kDistance) {
    names.squared =
        fmt::format("({} - point_side)^2 + ({} - point_down)^2",
                    symbols_of(LawVariable::kSidePosition), symbols_of(LawVariable::kDownPosition));
    names.symbols = fmt::format("sqrt({})", names.squared);
  } else if (variable == LawVariable::kSpeed) {
    names.squared = site.kind == SiteKind::kCable
                        ? std::string("velocity_side^2 + velocity_down^2")
                        : fmt::format("({})^2 + ({})^2", symbols_of(LawVariable::kSideVelocity),
                                      symbols_of(LawVariable::kDownVelocity));
  } else {
    names.squared = fmt::format("({})^2", names.symbols);
  }
  return names;
}

std::string site_in_words(const LawSite& site) {
  switch (site.kind) {
    case SiteKind::kPlace:
      return fmt::format(" at arc length {:.3g} m", site.arc_length);
    case SiteKind::kJoint:
      return site.joint == 0 ? std::string()
                             : fmt::format(" in the joint at arc length {:.3g} m", site.arc_length);
    case SiteKind::kCable:
      return " along the cable, per length";
    case SiteKind::kJoints:
      return " in every joint";
  }
  return "";
}

std::vector<LawElement> law_elements(const LawSite& site, LawVariable variable,
                                     const Vector2d& fixed_point, const LawChain& chain,
                                     const VectorXd& state) {
  const VectorXd& lengths = chain.lengths;
  const Index links = lengths.size();
  std::vector<LawElement> elements;
  const std::optional<LawVariable> relaxing = relaxing_of(variable), timed = timed_of(variable);
  if (relaxing || timed) {
    elements = law_elements(site, relaxing ? *relaxing : *timed, fixed_point, chain, state);
    const auto count = static_cast<Index>(elements.size());
    for (Index i = 0; i < count; ++i)
      elements[static_cast<std::size_t>(i)].value = state[state.size() - count + i];
    return elements;
  }
  if (variable == LawVariable::kAcceleration) {
    const PlaceKinematics place =
        place_kinematics(state, chain.coordinates, lengths, site.arc_length);
    const auto& side = place.by_angles.row(0);
    const auto& down = place.by_angles.row(1);
    const VectorXd faster = state.tail(links);
    const Eigen::RowVectorXd turning =
        state.segment(chain.coordinates, links).cwiseAbs2().transpose();
    elements.push_back({side.dot(faster) + turning.dot(down), side.transpose(), 1});
    elements.push_back({down.dot(faster) - turning.dot(side) - chain.gravity, down.transpose(), 1});
    return elements;
  }
  const auto add_joint = [&](Index joint, double spacing, double weight) {
    const Index of = has_potential(variable) ? 0 : chain.coordinates;
    LawElement& element = elements.emplace_back();
    element.gradient.setZero(links);
    element.gradient[joint] = 1 / spacing;
    element.value = state[of + joint];
    if (joint > 0) {
      element.gradient[joint - 1] = -1 / spacing;
      element.value -= state[of + joint - 1];
    }
    element.value /= spacing;
    element.weight = weight;
  };
  switch (site.kind) {
    case SiteKind::kPlace: {
      const PlaceKinematics place =
          place_kinematics(state, chain.coordinates, lengths, site.arc_length);
      const OfPlace of = of_place(variable, place.motion, fixed_point);
      elements.push_back({of.value, place.by_angles.transpose() * of.along, 1});
      break;
    }
    case SiteKind::kJoint:
      add_joint(site.joint, 1, 1);
      break;
    case SiteKind::kCable: {
      PlaceMotion motion = PlaceMotion::Zero();
      Eigen::Matrix2Xd by_angles = Eigen::Matrix2Xd::Zero(2, links);
      for (Index k = 0; k < links; ++k) {
        const double angle = state[k], rate = state[chain.coordinates + k];
        if (variable == LawVariable::kLinkRate) {
          elements.push_back({rate, VectorXd::Unit(links, k), lengths[k]});
          continue;
        }
        const double half = 0.5 * lengths[k];
        const Vector2d along(std::sin(angle), std::cos(angle)), across(along[1], -along[0]);
        motion.head<2>() += half * along;
        motion.segment<2>(2) += half * rate * across;
        motion.tail<2>() << angle, rate;
        by_angles.col(k) = half * across;
        const OfPlace of = of_place(variable, motion, fixed_point);
        elements.push_back({of.value, by_angles.transpose() * of.along, lengths[k]});
        motion.head<2>() += half * along;
        motion.segment<2>(2) += half * rate * across;
        by_angles.col(k) = lengths[k] * across;
      }
      break;
    }
    case SiteKind::kJoints:
      for (Index k = 0; k < links; ++k) {
        const double spacing = 0.5 * (lengths[k] + (k > 0 ? lengths[k - 1] : 0));
        add_joint(k, spacing, spacing);
      }
      break;
  }
  return elements;
}

std::vector<LawVariable> variables_of(const LawSite& site, double length) {
  switch (site.kind) {
    case SiteKind::kPlace: {
      std::vector<LawVariable> variables = {
          LawVariable::kSidePosition,   LawVariable::kDownPosition,
          LawVariable::kSideVelocity,   LawVariable::kDownVelocity,
          LawVariable::kNormalVelocity, LawVariable::kTangentialVelocity,
          LawVariable::kSpeed,          LawVariable::kDistance};
      // A mass at the end is a heavier load, which effects have; these remember nothing of places inside.
      if (at_end(site.arc_length, length))
        variables.insert(variables.end(),
                         {LawVariable::kRelaxingSidePosition, LawVariable::kRelaxingDownPosition});
      else
        variables.push_back(LawVariable::kAcceleration);
      return variables;
    }
    case SiteKind::kJoint:
      return {LawVariable::kJointAngle, LawVariable::kJointRate, LawVariable::kRelaxingJointAngle};
    case SiteKind::kCable:
      return {LawVariable::kNormalVelocity, LawVariable::kTangentialVelocity,
              LawVariable::kSpeed,          LawVariable::kSideVelocity,
              LawVariable::kDownVelocity,   LawVariable::kLinkRate};
    case SiteKind::kJoints:
      return {LawVariable::kCurvature, LawVariable::kCurvatureRate,
              LawVariable::kRelaxingCurvature};
  }
  return {};
}

std::vector<LawVariable> times_of(const LawSite& site) {
  switch (site.kind) {
    case SiteKind::kPlace:
      return {LawVariable::kTimeOfSideForce, LawVariable::kTimeOfDownForce};
    case SiteKind::kJoint:
      return {LawVariable::kTimeOfMoment};
    case SiteKind::kCable:
    case SiteKind::kJoints:
      break;
  }
  return {};
}

}  // namespace catena
