// SPDX-License-Identifier: BSD-3-Clause
#include "identify/forces/law_variable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "description/expression_syntax.hpp"

namespace catena {

using Eigen::Index;
using Eigen::MatrixXd;
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
    {LawVariable::kAcrossPosition, true, "across force", "across position", "m",
     "across + offset*direction_across"},
    {LawVariable::kDistance, true, "force away from a fixed point", "distance from it", "m", ""},
    {LawVariable::kAcceleration, false, "force of a mass", "acceleration less gravity", "m/s^2",
     ""},
    {LawVariable::kChord, true, "force that parts two places", "their distance", "m", "distance"},
    {LawVariable::kChordRate, false, "force that parts two places", "rate of their distance", "m/s",
     "distance_rate"},
    {LawVariable::kRelaxingSidePosition, false, "side force", "relaxing side position", "m",
     "velocity_side"},
    {LawVariable::kRelaxingDownPosition, false, "down force", "relaxing down position", "m",
     "velocity_down"},
    {LawVariable::kSideVelocity, false, "side force", "side velocity", "m/s",
     "velocity_side + offset*cos(angle)*rate"},
    {LawVariable::kDownVelocity, false, "down force", "down velocity", "m/s",
     "velocity_down - offset*sin(angle)*rate"},
    {LawVariable::kAcrossVelocity, false, "across force", "across velocity", "m/s",
     "velocity_across + offset*direction_rate_across"},
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
    {LawVariable::kRateUnderTension, false, "moment over the tension", "joint rate", "rad/s",
     "joint_rate"},
    {LawVariable::kTension, true, "moment", "tension", "N", kSteadyTension},
    {LawVariable::kCurvature, true, "bending moment", "curvature", "1/m", "joint_angle/spacing"},
    {LawVariable::kCurvatureRate, false, "bending moment", "rate of curvature", "1/(m s)",
     "joint_rate/spacing"},
    {LawVariable::kRelaxingCurvature, false, "bending moment", "relaxing curvature", "1/m",
     "joint_rate/spacing"},
    {LawVariable::kCurvatureRateUnderTension, false, "bending moment over the tension",
     "rate of curvature", "1/(m s)", "joint_rate/spacing"},
    {LawVariable::kTimeOfSideForce, true, "side force", "time", "s",
     "velocity_side + offset*cos(angle)*rate"},
    {LawVariable::kTimeOfDownForce, true, "down force", "time", "s",
     "velocity_down - offset*sin(angle)*rate"},
    {LawVariable::kTimeOfAcrossForce, true, "across force", "time", "s",
     "velocity_across + offset*direction_rate_across"},
    {LawVariable::kTimeOfMoment, true, "moment", "time", "s", "joint_rate"},
};

const NamesOfVariable& row_of(LawVariable variable) {
  return *std::find_if(std::begin(kNames), std::end(kNames),
                       [&](const NamesOfVariable& names) { return names.variable == variable; });
}

/// m, m/s: a vector that is shorter has no direction.
constexpr double kLeastDistance = 1e-12;

/// A variable of a place, and its derivative by the position or by the velocity.
struct OfPlace {
  double value = 0;
  ChainVector along;
};

OfPlace of_place(LawVariable variable, const PlaceMotion& motion, const ChainVector& fixed_point) {
  const ChainVector &position = motion.position, &velocity = motion.velocity;
  const auto component = [](const ChainVector& vector, Index i) {
    return OfPlace{vector[i], VectorXd::Unit(vector.size(), i)};
  };
  const auto size_of = [](const ChainVector& vector) {
    const double size = std::max(vector.norm(), kLeastDistance);
    return OfPlace{size, vector / size};
  };
  switch (variable) {
    case LawVariable::kSidePosition:
      return component(position, 0);
    case LawVariable::kDownPosition:
      return component(position, 1);
    case LawVariable::kAcrossPosition:
      return component(position, 2);
    case LawVariable::kDistance:
      return size_of(position - fixed_point);
    case LawVariable::kSideVelocity:
      return component(velocity, 0);
    case LawVariable::kDownVelocity:
      return component(velocity, 1);
    case LawVariable::kAcrossVelocity:
      return component(velocity, 2);
    case LawVariable::kNormalVelocity: {
      if (velocity.size() == 3)
        return size_of(velocity - motion.along.dot(velocity) * motion.along);
      const Vector2d normal(motion.along[1], -motion.along[0]);
      return {normal.dot(velocity), normal};
    }
    case LawVariable::kTangentialVelocity:
      return {motion.along.dot(velocity), motion.along};
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

bool over_tension(LawVariable variable) {
  return variable == LawVariable::kRateUnderTension ||
         variable == LawVariable::kCurvatureRateUnderTension;
}

bool has_accelerations(LawVariable variable) {
  return variable == LawVariable::kAcceleration || variable == LawVariable::kTension;
}

std::string symbols_of(LawVariable variable, bool in_space) {
  if (in_space) switch (variable) {
      case LawVariable::kSidePosition:
        return "side + offset*direction_side";
      case LawVariable::kDownPosition:
        return "down + offset*direction_down";
      case LawVariable::kSideVelocity:
      case LawVariable::kTimeOfSideForce:
        return "velocity_side + offset*direction_rate_side";
      case LawVariable::kDownVelocity:
      case LawVariable::kTimeOfDownForce:
        return "velocity_down + offset*direction_rate_down";
      default:
        break;
    }
  return row_of(variable).symbols;
}

std::optional<LawVariable> timed_of(LawVariable variable) {
  switch (variable) {
    case LawVariable::kTimeOfSideForce:
      return LawVariable::kSidePosition;
    case LawVariable::kTimeOfDownForce:
      return LawVariable::kDownPosition;
    case LawVariable::kTimeOfAcrossForce:
      return LawVariable::kAcrossPosition;
    case LawVariable::kTimeOfMoment:
      return LawVariable::kJointAngle;
    default:
      return std::nullopt;
  }
}

std::vector<std::string> components_of(const LawSite& site, LawVariable variable, bool in_space) {
  if (variable != LawVariable::kSpeed) return {names_of(site, variable, in_space).symbols};
  std::vector<std::string> components;
  for (const LawVariable of :
       {LawVariable::kSideVelocity, LawVariable::kDownVelocity, LawVariable::kAcrossVelocity})
    if (in_space || of != LawVariable::kAcrossVelocity)
      components.push_back(names_of(site, of, in_space).symbols);
  return components;
}

LawNames names_of(const LawSite& site, LawVariable variable, bool in_space) {
  const NamesOfVariable& row = row_of(variable);
  const bool moment = site.kind == SiteKind::kJoint || site.kind == SiteKind::kJoints;
  LawNames names{row.force,
                 row.name,
                 over_tension(variable)               ? "m"
                 : moment                             ? "N m"
                 : variable == LawVariable::kLinkRate ? "N"  // N m per metre
                 : site.kind == SiteKind::kCable      ? "N/m"
                                                      : "N",
                 row.unit,
                 symbols_of(variable, in_space),
                 {}};
  if (site.kind == SiteKind::kJoint && site.joint == 0) {
    names.force =
        over_tension(variable) ? "torque at the support over the tension" : "torque at the support";
    names.variable = timed_of(variable) || variable == LawVariable::kTension ? names.variable
                     : variable == LawVariable::kJointAngle                  ? "angle of link 1"
                     : variable == LawVariable::kRelaxingJointAngle ? "relaxing angle of link 1"
                                                                    : "rate of link 1";
  }
  const auto velocity = [&](LawVariable of) {
    const std::string symbols = symbols_of(of, in_space);
    // At the middle of a link there is no offset.
    return site.kind == SiteKind::kCable ? symbols.substr(0, symbols.find(' ')) : symbols;
  };
  if (variable == LawVariable::kSideVelocity || variable == LawVariable::kDownVelocity ||
      variable == LawVariable::kAcrossVelocity || variable == LawVariable::kNormalVelocity)
    names.symbols = velocity(variable);
  const auto squares = [](const std::vector<std::string>& components) {
    std::string sum;
    for (const std::string& component : components)
      sum += (sum.empty() ? "" : " + ") +
             (component.find(' ') == std::string::npos ? component : "(" + component + ")") + "^2";
    return sum;
  };
  if (variable == LawVariable::kDistance) {
    std::vector<std::string> apart;
    for (const auto& [of, name] : {std::pair(LawVariable::kSidePosition, "side"),
                                   std::pair(LawVariable::kDownPosition, "down"),
                                   std::pair(LawVariable::kAcrossPosition, "across")})
      if (in_space || of != LawVariable::kAcrossPosition)
        apart.push_back(fmt::format("{} - point_{}", symbols_of(of, in_space), name));
    names.squared = squares(apart);
    names.symbols = fmt::format("sqrt({})", names.squared);
  } else if (variable == LawVariable::kSpeed) {
    names.squared = squares(components_of(site, variable, in_space));
  } else if (in_space && variable == LawVariable::kNormalVelocity) {
    // The turn of the link is at a right angle to it.
    names.squared = "velocity_normal^2";
    if (site.kind == SiteKind::kPlace)
      names.squared +=
          " + 2*offset*(velocity_side*direction_rate_side + velocity_down*direction_rate_down + "
          "velocity_across*direction_rate_across) + offset^2*rate^2";
  } else {
    names.squared = fmt::format("({})^2", names.symbols);
  }
  return names;
}

std::string site_in_words(const LawSite& site) {
  switch (site.kind) {
    case SiteKind::kPlace:
      return fmt::format(" at arc length {:.3g} m", site.arc_length);
    case SiteKind::kPair:
      return fmt::format(" between arc lengths {:.3g} m and {:.3g} m", site.arc_length,
                         site.other_arc_length);
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

VectorXd joint_tensions(const LawChain& chain, const VectorXd& state,
                        const VectorXd& accelerations) {
  const Index links = chain.lengths.size();
  // Gravity less the acceleration: of the mass centre of every link, and of the end of the last one.
  Eigen::Matrix2Xd centre(2, links), along(2, links);
  Vector2d end(0, chain.gravity);
  for (Index k = 0; k < links; ++k) {
    const double angle = state[k], rate = state[chain.coordinates + k];
    along.col(k) << std::sin(angle), std::cos(angle);
    const Vector2d across(along(1, k), -along(0, k));
    const Vector2d more =
        chain.lengths[k] * (rate * rate * along.col(k) - accelerations[k] * across);
    centre.col(k) = end + 0.5 * more;
    end += more;
  }
  VectorXd tensions(links);
  Vector2d pull = chain.load * end;
  for (Index k = links - 1; k >= 0; --k) {
    pull += chain.masses[k] * centre.col(k);
    tensions[k] = pull.dot(along.col(k));
  }
  return tensions;
}

std::vector<LawElement> law_elements(const LawSite& site, LawVariable variable,
                                     const ChainVector& fixed_point, const LawChain& chain,
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
        place_kinematics(state, chain.coordinates, chain, site.arc_length);
    const auto& side = place.by_turns.row(0);
    const auto& down = place.by_turns.row(1);
    const VectorXd faster = state.tail(links);
    const Eigen::RowVectorXd turning =
        state.segment(chain.coordinates, links).cwiseAbs2().transpose();
    elements.push_back({side.dot(faster) + turning.dot(down), side.transpose(), 1});
    elements.push_back({down.dot(faster) - turning.dot(side) - chain.gravity, down.transpose(), 1});
    return elements;
  }
  const bool of_tension = variable == LawVariable::kTension;
  const VectorXd tensions = of_tension ? joint_tensions(chain, state, state.tail(links))
                            : over_tension(variable)
                                ? joint_tensions(chain, state, VectorXd::Zero(links))
                                : VectorXd();
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
    element.value = of_tension ? tensions[joint] : element.value / spacing;
    element.weight =
        over_tension(variable) ? weight * std::hypot(tensions[joint], kTensionFloor) : weight;
  };
  switch (site.kind) {
    case SiteKind::kPlace: {
      const PlaceKinematics place =
          place_kinematics(state, chain.coordinates, chain, site.arc_length);
      const OfPlace of = of_place(variable, place.motion, fixed_point);
      elements.push_back({of.value, place.by_turns.transpose() * of.along, 1});
      break;
    }
    case SiteKind::kPair: {
      const PlaceKinematics one =
          place_kinematics(state, chain.coordinates, chain, site.arc_length);
      const PlaceKinematics other =
          place_kinematics(state, chain.coordinates, chain, site.other_arc_length);
      const ChainVector apart = other.motion.position - one.motion.position;
      const double distance = std::max(apart.norm(), kLeastDistance);
      const ChainVector along = apart / distance;
      const ChainVector parting = other.motion.velocity - one.motion.velocity;
      const double value = variable == LawVariable::kChord ? distance : along.dot(parting);
      elements.push_back({value, (other.by_turns - one.by_turns).transpose() * along, 1});
      break;
    }
    case SiteKind::kJoint:
      add_joint(site.joint, 1, 1);
      break;
    case SiteKind::kCable: {
      const Index components = chain.in_space ? 3 : 2, each = chain.in_space ? 3 : 1;
      PlaceMotion motion{VectorXd::Zero(components), VectorXd::Zero(components), {}};
      MatrixXd by_turns = MatrixXd::Zero(components, chain.turns());
      for (Index k = 0; k < links; ++k) {
        const LinkMotion link = link_motion(state, chain.coordinates, chain, k);
        if (variable == LawVariable::kLinkRate) {
          elements.push_back({link.rate[0], VectorXd::Unit(links, k), lengths[k]});
          continue;
        }
        const double half = 0.5 * lengths[k];
        const ChainVector half_rate = half * link.rate;
        motion.along = link.along;
        motion.position += half * link.along;
        motion.velocity += link.by_turn * half_rate;
        by_turns.middleCols(each * k, each) = half * link.by_turn;
        const OfPlace of = of_place(variable, motion, fixed_point);
        elements.push_back({of.value, by_turns.transpose() * of.along, lengths[k]});
        motion.position += half * link.along;
        motion.velocity += link.by_turn * half_rate;
        by_turns.middleCols(each * k, each) = lengths[k] * link.by_turn;
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

std::vector<LawVariable> variables_of(const LawSite& site, const LawChain& chain) {
  std::vector<LawVariable> variables;
  const auto add = [&](std::initializer_list<LawVariable> more) {
    for (const LawVariable each : more) variables.push_back(each);
  };
  switch (site.kind) {
    case SiteKind::kPlace:
      add({LawVariable::kSidePosition, LawVariable::kDownPosition, LawVariable::kSideVelocity,
           LawVariable::kDownVelocity, LawVariable::kNormalVelocity,
           LawVariable::kTangentialVelocity, LawVariable::kSpeed, LawVariable::kDistance});
      if (chain.in_space) add({LawVariable::kAcrossPosition, LawVariable::kAcrossVelocity});
      // A mass at the end is a heavier load, which effects have; these remember nothing of places inside.
      else if (at_end(site.arc_length, chain.lengths.sum()))
        add({LawVariable::kRelaxingSidePosition, LawVariable::kRelaxingDownPosition});
      else
        add({LawVariable::kAcceleration});
      break;
    case SiteKind::kPair:
      add({LawVariable::kChord, LawVariable::kChordRate});
      break;
    case SiteKind::kCable:
      add({LawVariable::kNormalVelocity, LawVariable::kTangentialVelocity, LawVariable::kSpeed,
           LawVariable::kSideVelocity, LawVariable::kDownVelocity});
      add({chain.in_space ? LawVariable::kAcrossVelocity : LawVariable::kLinkRate});
      break;
    case SiteKind::kJoint:
      if (!chain.in_space)
        add({LawVariable::kJointAngle, LawVariable::kJointRate, LawVariable::kRelaxingJointAngle,
             LawVariable::kRateUnderTension, LawVariable::kTension});
      break;
    case SiteKind::kJoints:
      if (!chain.in_space)
        add({LawVariable::kCurvature, LawVariable::kCurvatureRate, LawVariable::kRelaxingCurvature,
             LawVariable::kCurvatureRateUnderTension, LawVariable::kTension});
      break;
  }
  return variables;
}

std::vector<LawVariable> times_of(const LawSite& site, bool in_space) {
  std::vector<LawVariable> times;
  if (site.kind == SiteKind::kPlace) {
    times = {LawVariable::kTimeOfSideForce, LawVariable::kTimeOfDownForce};
    if (in_space) times.push_back(LawVariable::kTimeOfAcrossForce);
  } else if (site.kind == SiteKind::kJoint && !in_space) {
    times = {LawVariable::kTimeOfMoment};
  }
  return times;
}

}  // namespace catena
