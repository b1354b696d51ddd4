// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace catena {

/// An expression as the user wrote it, and the place where it was written, for messages. Values and
/// units are checked by the generator (generator/derivation/effect_expression.hpp).
struct Expression {
  std::string text;  ///< empty: not given
  std::string file;
  int line = 0;
  std::string key;  ///< "force.normal"

  bool given() const { return !text.empty(); }
};

/// One parameter for the whole model, or one per joint or per link (`name_1` .. `name_n`).
enum class Scope { kModel, kJoint, kLink };

/// Where on the chain a term stands. Joint i connects link i-1 (the support, for i = 1) to link i.
enum class Place {
  kJoint,       ///< every joint 1..n, the pivot included; position of joint i = upper end of link i
  kPivot,       ///< joint 1 alone
  kLink,        ///< every link as a rigid body: its absolute angle, or an added coordinate
  kLinkCentre,  ///< the mass centre of every link
  kLoad,        ///< the load
  kChord,       ///< the straight line between two places of the chain (Chord)
  kAnywhere,    ///< definitions only: from time, parameters, constants and signals alone
};

/// Whether the chain has such a place for every link or joint, and not one alone.
inline bool is_of_each_link(Place place) {
  return place == Place::kJoint || place == Place::kLink || place == Place::kLinkCentre;
}

struct EffectParameter {
  std::string name;
  std::string unit;
  std::string description;
  double default_value =
      std::numeric_limits<double>::quiet_NaN();  ///< if not stated, the neutral value
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  /// The value at which the effect vanishes. NaN: there is none (a frequency, for example).
  /// Infinite: the effect vanishes in the limit only; then convergence to the plain chain can be
  /// shown, but not equality.
  double neutral = std::numeric_limits<double>::quiet_NaN();
  Scope scope = Scope::kModel;
  /// What a value above, or below, the neutral one says is wrong with the case, with {} in place of
  /// how far it is from there: "the load is {} heavier than the case says". Empty: nothing.
  std::string above, below;
  /// Another parameter of the effect, which this one does not exceed; empty: none. Both have one value for the
  /// whole model and the same unit, lower bound and neutral value. A diagnosis goes by it, a case need not.
  std::string at_most;
};

/// A fixed number with a unit. `text` is the decimal number as written, so that it stays exact.
struct Constant {
  std::string name;
  std::string text;
  double value = 0;
  std::string unit;
};

/// A named sub-expression, usable in every later expression of the same effect and place.
struct Definition {
  std::string name;
  Place at = Place::kAnywhere;
  Expression value;
};

/// A force on a point of the chain, N; or N/m if `per_length`: then it acts on the whole length of
/// the link and is evaluated at its centre. Given are some of side, down and across, or normal,
/// tangential or both. Components that are not given are zero. In the plane a force across does nothing.
struct ForceTerm {
  Place at = Place::kLinkCentre;  ///< kLinkCentre, kJoint, kLoad; kChord with `along` only
  bool per_length = false;        ///< kLinkCentre only
  Expression side, down, across;
  /// kLinkCentre, kLoad. Tangential: along the link, away from the support. Normal: in the plane along
  /// (cos a, -sin a); in space along the part of the velocity, or of the relative one, that is normal to
  /// the link: an odd function of velocity_normal, or of relative_normal, gives its size.
  Expression normal, tangential;
  /// Instead of all these, at any place: `value` times the velocity `along`, which is linear in velocities
  /// and rates, is the power of the force. Along the rate of an angle it is a moment, N m.
  Expression along, value;
};

/// Velocity of the fluid around the chain, m/s, where a force asks for it: a function of the position
/// there, time, parameters, constants and signals. It gives the symbols relative_side, ... of forces: the
/// velocity of the chain less that of the fluid.
struct Flow {
  Expression side, down, across;

  bool given() const { return side.given() || down.given() || across.given(); }
};

enum class ScalarKind {
  kTorque,       ///< N m, acting on the joint angle theta_i - theta_{i-1} (kJoint, kPivot), on the
                 ///< angle of the link (kLink), or on theta_n (kLoad)
  kPotential,    ///< J, or J/m
  kDissipation,  ///< W, or W/m: D in d/dt(dL/dv) - dL/dq = -dD/dv
  kKinetic,      ///< J, or J/m, added to T
};

struct ScalarTerm {
  ScalarKind kind = ScalarKind::kTorque;
  Place at = Place::kJoint;
  bool per_length = false;  ///< kLink and kLinkCentre only: times the length of the link
  Expression value;
};

/// Prescribed motion of the support, m, and in space the direction of its clamp, from which the first
/// link continues without bending: a vector of any length but zero; straight down if nothing is given, and
/// a component that is not given is zero. They depend on time, parameters, constants and signals only.
struct Support {
  Expression side, down, across;                    ///< across: in space
  Expression clamp_side, clamp_down, clamp_across;  ///< in space; of no unit
  /// In space: the axis about which rest angles bend the cable, a vector of any length but zero, which may
  /// turn with the clamp; if not given, that of bending from down towards side.
  Expression bend_axis_side, bend_axis_down, bend_axis_across;  ///< of no unit

  /// Whether the point moves, the clamp turns, the axis of bending is stated; whether any of these.
  bool moves() const { return side.given() || down.given() || across.given(); }
  bool turns() const { return clamp_side.given() || clamp_down.given() || clamp_across.given(); }
  bool has_bend_axis() const {
    return bend_axis_side.given() || bend_axis_down.given() || bend_axis_across.given();
  }
  bool given() const { return moves() || turns() || has_bend_axis(); }
  std::array<const Expression*, 9> all() const {
    return {&side,         &down,           &across,         &clamp_side,      &clamp_down,
            &clamp_across, &bend_axis_side, &bend_axis_down, &bend_axis_across};
  }
};

/// In space: where the far end of a link is held, m, by a constraint: a vector of time, parameters,
/// constants and signals. A component that is not given is zero. The end of the cable may be clamped there, too,
/// in a direction in which the last link ends without bending: a vector of any length but zero.
struct HeldEnd {
  Expression side, down, across;
  Expression clamp_side, clamp_down, clamp_across;  ///< of no unit
  /// N m/rad and N m s/rad, of the clamp; if not given, those of a joint between the middle of the last
  /// link and its end. As functions of parameters, constants, and of these: `stiffness`, `damping`.
  Expression clamp_stiffness, clamp_damping;
  /// With a clamp: GJ, N m^2, as a function of parameters and constants, and by how much the clamps of the two
  /// ends twist the cable, rad, as a function of time, parameters, constants and signals. Nothing: no torsion.
  Expression torsional_stiffness, roll;
  int link = 0;  ///< the link, from 1; 0: the last

  /// What names begin with: "hold", or "hold_6" where link 6 is held.
  std::string named(const std::string& what) const {
    return link == 0 ? what : what + "_" + std::to_string(link);
  }
  /// Whether it holds the point, its direction, its twist.
  bool holds() const { return side.given() || down.given() || across.given(); }
  bool turns() const { return clamp_side.given() || clamp_down.given() || clamp_across.given(); }
  bool twists() const { return torsional_stiffness.given(); }
  std::array<const Expression*, 10> all() const {
    return {&side,
            &down,
            &across,
            &clamp_side,
            &clamp_down,
            &clamp_across,
            &clamp_stiffness,
            &clamp_damping,
            &torsional_stiffness,
            &roll};
  }
};

/// The straight line between two places of the chain, at the arc lengths `from` and `to`, m: functions of
/// parameters and constants. Beyond the ends of the chain they stand for its ends.
struct Chord {
  Expression from, to;

  bool given() const { return from.given(); }
};

/// Changes of the kinematics. Changes by several effects are added.
struct Kinematics {
  Expression centre_offset;  ///< m, mass centre of link i past its middle, away from the support
  Expression load_offset;    ///< m, load past the end of link n, along link n
  Expression load_side, load_down,
      load_across;              ///< m, load from the end of link n; across: in space
  Expression load_inertia;      ///< kg m^2, of the load about its own centre; it turns with link n
  Expression load_mass;         ///< kg, added to the load
  Expression rest_angle;        ///< rad, at every joint i: V = 1/2 k_i (joint angle - rest)^2
  Expression pivot_rest_angle;  ///< rad, at joint 1 alone
  Expression extension;         ///< m, added to the length of link i; may use coordinates
  Expression gravity_tilt;      ///< rad, gravity turned from down towards side

  std::array<const Expression*, 11> all() const {
    return {&centre_offset,    &load_offset,  &load_side,   &load_down,
            &load_across,      &load_inertia, &load_mass,   &rest_angle,
            &pivot_rest_angle, &extension,    &gravity_tilt};
  }
};

/// A further generalised coordinate, one for each link, or one of the load.
struct Coordinate {
  std::string name;
  std::string unit;
  std::string description;
  Place at = Place::kLink;  ///< kLink or kLoad
};

/// A further state of first order, one for each joint, or one for the pivot or the load alone.
struct ExtraState {
  std::string name;
  std::string unit;
  std::string description;
  Place at = Place::kJoint;  ///< kJoint, kPivot or kLoad
  Expression rate;           ///< unit of the state / s
};

/// A function of time given by data: symbols name, name_rate, name_acceleration.
struct SignalChannel {
  std::string name;
  std::string unit;
  std::string description;
};

/// A value at a place whose change of sign is an event: a link that touches the floor.
struct EventValue {
  std::string name;
  std::string unit;
  Place at = Place::kLinkCentre;
  Expression value;
};

/// What the sensor reports of a point: side, down, across (m) and angle (rad) as functions of the
/// true ones; and `clock`, the model time (s) of what was recorded at `time`. What is not given is
/// reported without change. Across has a meaning in space only, the angle in the plane only.
struct Sensor {
  Expression side, down, across, angle, clock;

  /// Whether it changes where a point is reported.
  bool moves() const { return side.given() || down.given() || across.given(); }
  bool given() const { return moves() || angle.given() || clock.given(); }
};

/// One piece of physics that may be added to the chain. The file is TOML of kind "effect".
///
///     const Effect drag = built_in_effect("air_drag_quadratic");
///     const std::string first = drag.parameters.front().name;  // "normal", in kg/m^2
struct Effect {
  std::string id;
  std::string title;
  std::string description;
  std::string form_of;  ///< id of the effect of which this is another law; empty: of none
  bool rare = false;    ///< a diagnosis looks for it only where the case says that it is possible
  std::string space;    ///< "plane" or "3d": the only one that has it; empty: both
  std::string source_file;  ///< path, or "built in: <id>"
  std::vector<EffectParameter> parameters;
  std::vector<Constant> constants;
  std::vector<Definition> definitions;
  Flow flow;
  std::vector<ForceTerm> forces;
  std::vector<ScalarTerm> scalars;
  Support support;
  HeldEnd held_end;
  Chord chord;
  Kinematics kinematics;
  std::vector<Coordinate> coordinates;
  std::vector<ExtraState> states;
  std::vector<SignalChannel> signals;
  std::vector<EventValue> events;
  Sensor sensor;

  /// Whether the load has coordinates of its own by this effect.
  bool moves_load() const {
    return std::any_of(coordinates.begin(), coordinates.end(),
                       [](const Coordinate& coordinate) { return coordinate.at == Place::kLoad; });
  }
};

/// Reads and checks an effect file. Throws InputError that names file, line, key, value and rule.
/// Units and symbols in expressions are not checked here, but by the generator.
Effect read_effect(const std::filesystem::path& path);

/// One of the effects that are compiled in. Throws InputError that names the nearest id.
Effect built_in_effect(std::string_view id);
/// The ids of all of them.
std::vector<std::string> built_in_effect_ids();

}  // namespace catena
