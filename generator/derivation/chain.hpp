// SPDX-License-Identifier: GPL-3.0-or-later
//
// The chain: its kinematics (2.24)-(2.27), energies (2.3)-(2.9) with the load's potential,
// dissipation (3.2)-(3.14) and effects; and its equations of motion by Euler-Lagrange,
//
//     r_i = d/dt(dL/dqdot_i) - dL/dq_i + dD/dqdot_i - Q_i = 0,     L = T - V.
//
// T, V and D are written in variables y (positions of link centres and joints, joint angles) that
// are functions of the coordinates q, y = y(q, t). The Euler-Lagrange expression is covariant under
// such a change of variables,
//
//     d/dt(dL/dqdot_i) - dL/dq_i = sum_y [d/dt(dL/dydot) - dL/dy] dy/dq_i,
//
// as virtual work is. So each energy is differentiated with respect to the few variables it is
// written in. This gives the generalised forces of the variables. The chain rule carries them
// through the definitions of y to the coordinates, from the free end to the support. The
// generalised force of the position of a joint is the cut force: the force of the upper part of the
// chain on the part below the joint.
//
// Some expressions are written in quasi-velocities w = W(y) ydot, such as an angular velocity, which are
// the rates of no variables. With p = dT/dw and f = dD/dw they give
//
//     sum_w [d/dt(p dw/dydot) - p dw/dy + f dw/dydot].
//
// In space the coordinates are the three components of one vector q_i for each link, and the link's
// direction, from its upper to its lower end, is e_i = q_i / |q_i|. T, V and D are written in e_i, edot_i,
// so q_i has no constraint. Its length moves nothing; to give it equations of its own, T has
//
//     1/8 (I_i + m_i l_i^2 / 4) (d|q_i|^2 / dt)^2
//
// besides, which vanishes while |q_i| = 1. Of these equations, what is perpendicular to q_i is the chain's
// with the constraints |q_i| = 1 and their multipliers, and what is along q_i says that |q_i|^2 has no
// acceleration. |q_i| may drift by rounding and errors of steps; the motion does not see it.
//
// A held end: the constraint g = (far end of link n) - (where it is held) = 0, or that of any other link that is
// held, enters as a kinetic energy mu'. g', bilinear in the rates, with three further coordinates mu.
// Euler-Lagrange makes of it
//
//     ... + (dg/dq)' mu'' in the equations of q,      g'' = 0 in those of mu:
//
// -mu'' is the multiplier, the force that holds the end, and the constraint has lost two indices. Neither
// mu nor mu' enters the equations. A force on mu, -(2 a g' + a^2 g), lets a gap close as
// exp(-a t) (Baumgarte), so that errors of steps do not add up.
//
// A load with coordinates of its own, such as the angle of a hook, is a point whose position depends on them,
// too. They belong to no link and come last, like mu; what effects name at such a load are variables y, or
// quasi-velocities, so that T of a body that turns freely is written in its angular velocity.
//
// Torsion: an isotropic rod that is straight at rest has the same twist all along, and bending does not see
// it. Its energy is V = GJ twist^2 / (2 L), twist = roll + path. Roll is how much further the clamp of the far
// end has been turned about its axis than that of the support; path is by how much a frame of the end turns
// against one that is carried along the links, from the clamp e_0 to the clamp e_{n+1}, without twist. It is a
// function of the shape up to whole turns, but one without a simple form. Its rate is simple:
//
//     path' = sum_k w_k,    w_k = (e_{k-1} x e_k) . (e'_{k-1} + e'_k) / (1 + e_{k-1} . e_k),
//
// so path is a state with this rate, which counts whole turns, too, and dpath/dq = dpath'/dq': w_k are
// quasi-velocities, and the generalised force of each is dV/dpath = GJ twist / L.
//
// Rest angles bend the cable about an axis a_i of each link, which is carried from link to link without twist, a_0 with
// the clamp:
//
//     a_i = a_{i-1} - (a_{i-1} . e_i) (e_{i-1} + e_i) / (1 + e_{i-1} . e_i).
//
// It leans with its link and rolls about it,
//
//     a_i' = (w_0 - w_1 - ... - w_i) e_i x a_i - (a_i . e_i') e_i,    w_0 = a_0' . (e_0 x a_0),
//
// with the w_k of torsion, so a generalised force on a_i is one on w_0 ... w_i and on e_i.
//
// The velocity v of a point, normal to its link, is a vector in space. Effects are written in its size,
// which is that of v x e, and the force along it is (a number) e x (v x e). In the plane v x e has one
// component, across, which is the velocity along the normal (cos a, -sin a).
#pragma once

#include <ginac/ginac.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "description/description.hpp"
#include "generator/derivation/definitions.hpp"
#include "generator/derivation/effect_expression.hpp"
#include "generator/derivation/unit_vector_functions.hpp"

namespace catena {

/// The components of positions. The plane has the first two.
enum Axis { kSide, kDown, kAcross };

/// A component, as names of families end: "joint" + "_side".
std::string ending(Axis axis);

/// A stored energy (J) or a power (W), as the model table lists it.
struct EnergyItem {
  enum Kind { kStored, kDissipated, kSupplied };
  std::string name;
  Kind kind;
  std::vector<GiNaC::ex> parts;  ///< to be summed
};

/// kApart: the generalised forces of every effect are definitions of their own.
enum class EffectForces { kMerged, kApart };

class Chain {
 public:
  /// Derives the equations. `only_term` is empty for all terms; otherwise it names the only one
  /// that is kept: "kinetic", "gravity", "elastic", "friction", "torque" or the id of an effect.
  /// Throws std::invalid_argument for effects that space does not have (conflict_in), and InputError for
  /// expressions without a meaning at their place.
  Chain(const Description& description, int links, const std::string& only_term = "",
        EffectForces effect_forces = EffectForces::kMerged);

  Definitions& definitions() { return definitions_; }
  int links() const { return links_; }

  /// The terms of the residual: "kinetic", "gravity", "elastic", "friction", "torque", and the ids
  /// of the effects that add one.
  static std::vector<std::string> term_names(const Description& description);

  /// r, one entry per coordinate.
  const std::vector<GiNaC::ex>& residual() const { return residual_; }
  const std::vector<GiNaC::ex>& coordinates() const { return coordinates_; }
  const std::vector<GiNaC::ex>& rates() const { return rates_; }
  const std::vector<GiNaC::ex>& accelerations() const { return accelerations_; }
  /// In space: the unit vector along link i, [axis][i], i = 1 ... n, and its generalised force.
  const std::vector<std::vector<GiNaC::ex>>& directions() const { return direction_; }
  const std::vector<std::vector<GiNaC::ex>>& direction_forces() const { return direction_force_; }
  /// Of the last coordinates, how many belong to constraints: three for each place that is held.
  int constraints() const { return 3 * static_cast<int>(held_.size()); }
  /// Of the last coordinates, how many belong to no link: those of the load, or of that constraint.
  int border() const { return border_; }
  /// The gaps of those constraints, m: of each by axis.
  const std::vector<GiNaC::ex>& gap() const { return gap_; }
  /// What holds an end exerts on the chain, by axis: force, N, and moment, N m (in the plane one).
  struct Reaction {
    std::vector<GiNaC::ex> force, moment;
  };
  /// At the support, and at each place that is held.
  const std::vector<Reaction>& reactions() const { return reactions_; }
  /// Extra states of effects and their rates, in the same order.
  const std::vector<GiNaC::ex>& states() const { return states_; }
  const std::vector<GiNaC::ex>& state_rates() const { return state_rates_; }
  /// The state of torsion, zero without it. Its rate is a sum over all joints; it is in no rate itself.
  const GiNaC::ex& path() const { return path_; }
  /// In space: the axis about which rest angles bend the cable, carried along the links without twist.
  struct CarriedAxis {
    std::vector<GiNaC::ex> axis;      ///< by axis, at a right angle to the link
    std::vector<GiNaC::ex> crossing;  ///< link x axis: where it goes as it rolls about the link
    std::vector<GiNaC::ex>
        turning;  ///< what it rolls by, from the axis before: turning . (edot_{i-1} + edot_i)
    GiNaC::ex roll_rate;  ///< how fast, about the link, rad/s
  };
  /// By link, as far as rest angles ask for them; entry 0: of the clamp, which nothing but time moves.
  const std::vector<CarriedAxis>& bend_axes() const { return bend_axes_; }
  /// The forces along the chords of effects, by effect and axis, N: each acts on all links between two places.
  const std::vector<GiNaC::ex>& chord_forces() const { return chord_forces_; }

  /// Where the support (0), the far end of each link (1..n) and the load (n + 1) are.
  const std::vector<GiNaC::ex>& position(Axis axis) const { return point_[axis]; }
  std::vector<Axis> axes() const {
    return in_plane() ? std::vector{kSide, kDown} : std::vector{kSide, kDown, kAcross};
  }
  GiNaC::ex rate(const GiNaC::ex& expression) { return time_.of(expression); }

  const std::vector<EnergyItem>& energies() const { return energies_; }
  /// T (J), V (J) and Rayleigh's D (W), each to be summed. Forces and torques are in none of them.
  struct EnergyFunctions {
    std::vector<GiNaC::ex> kinetic, potential, dissipation;
  };
  const EnergyFunctions& energy_functions() const { return energy_functions_; }
  /// Whether a definition is the generalised force of one effect (EffectForces::kApart).
  bool is_effect_force(int number) const { return effect_forces_.contains(number); }
  /// Joint moments, link tensions, curvatures (see catena_model.h), links entries each.
  const std::vector<GiNaC::ex>& moments() const { return moments_; }
  const std::vector<GiNaC::ex>& tensions() const { return tensions_; }
  const std::vector<GiNaC::ex>& curvatures() const { return curvatures_; }

  /// Sensor effects: what they report of a point whose side, down and angle, in space across, are `seen`.
  struct Sensor {
    std::vector<std::string> seen;
    std::vector<GiNaC::ex> reported;
    GiNaC::ex clock;
    bool given = false;
  };
  const Sensor& sensor() const { return sensor_; }

  /// What changes its sign at an event: one value, or one for each link or joint.
  struct Event {
    Place at;
    std::vector<GiNaC::ex> values;
  };
  /// In the order of the table: those of one place first.
  const std::vector<Event>& events() const { return events_; }

 private:
  using ex = GiNaC::ex;
  using Link = int;
  using Points = std::vector<std::vector<ex>>;  // [axis][link or joint]

  bool in_plane() const { return description_.space == Space::kPlane; }
  /// The square of the velocity of a point that has these components.
  ex speed_squared(const std::vector<ex>& position);
  /// Of the angular velocity of a link.
  ex squared_rate(Link i);

  void check_held() const;
  void make_inputs();
  void make_kinematics();
  void add_angles();
  void add_directions();
  void turn_clamp();
  void place_bend_axis();
  std::vector<ex> turning_between(Link i);
  ex path_turning(Link i);
  void carry_bend_axis(Link i);
  std::vector<ex> rest_bend(Link i);
  void add_steady_tensions();
  void place_chord(const Effect& effect);
  ex force_of_chords(Axis axis, Link i);
  void place_held();
  void clamp_end(const Effect& effect);
  void hold();
  void twist(const Effect& effect);
  std::vector<ex> unit_vector(const Effect& effect,
                              const std::vector<const Expression*>& components,
                              const std::string& name, const std::string& unit_name, int index);
  void add_coordinate(const ex& q, const ex& v, const ex& a);
  void add_border_coordinate(const std::string& name);
  void add_chain_terms();
  void add_joint_terms(Link k);
  void add_effect_terms(const Effect& effect);
  void add_sensors();
  void add_events();
  /// Calls act(i) for every link or joint i of a place; of a place that is one, for 1 or 0.
  void at_each(Place place, const auto& act) const {
    const Link first = place == Place::kLoad || place == Place::kChord ? 0 : 1;
    const Link last = is_of_each_link(place) ? links_ : first;
    for (Link i = first; i <= last; ++i) act(i);
  }
  void add_power_of_ends();
  void pull_back();

  bool wanted(const std::string& term) const { return only_term_.empty() || only_term_ == term; }
  void add_kinetic(const std::string& item, const ex& energy);
  void add_momenta(const ex& energy);
  void add_momentum(int rate, const ex& momentum);
  void add_potential(const std::string& item, const ex& energy);
  void add_dissipation(const std::string& item, const ex& function);
  struct Component {
    ex variable, force;
  };
  void add_force(const std::string& item, const std::vector<Component>& components);
  void add_energy(const std::string& item, EnergyItem::Kind kind, const ex& part);
  void add_generalised_force(const ex& variable, const ex& force);
  void add_generalised_force(int variable, const ex& force);
  ex generalised_force_of(int variable);
  ex spacing(Link i) const;
  std::vector<ex> moment_of_joint(Link i);
  ex define_variable(const std::string& family, int index, const ex& value);
  ex define_quasi_velocity(const std::string& family, int index, const ex& value);
  ex define_shape(const std::string& family, const ex& value);
  void differentiate_names_in(const ex& value);
  std::optional<std::map<int, ex>> coefficients_of_rates(const ex& velocity) const;

  /// The symbols that an expression at link or joint i may use (docs/effects.md): those of the
  /// shape, or those of the motion too.
  enum Knowledge { kShape, kPosition, kMotion };
  /// Sum over all effects of one kinematic quantity, at link or joint i.
  ex kinematic(Expression Kinematics::*quantity, const char* unit, Place place, Link i);
  ex evaluate(const Effect& effect, const Expression& expression, Knowledge knowledge, Place place,
              Link i, const char* unit, bool in_energy = false);
  /// What an expression calls velocity_normal, joint_angle, ... is the size of a vector in space. While it
  /// is read, `placeholder` stands for its square.
  struct Size {
    std::string name;
    ex placeholder, square;
    ex in_energy;               ///< the square with fewer terms, which rounding may make negative
    std::vector<ex> direction;  ///< the vector, by axis, if forces may act along it
  };
  struct Surroundings {
    ExpressionContext known;
    std::vector<Size> sizes;

    void add(const std::string& name, const ex& value, const std::string& unit) {
      known.add(name, value, Unit::parse(unit));
    }
  };
  Surroundings surroundings(const Effect& effect, Knowledge knowledge, Place place, Link i);
  void add_definitions(const Effect& effect, Knowledge knowledge, Place place, Surroundings& here);
  void add_load_definition(const Effect& effect, const Definition& definition, Surroundings& here);
  ex without_sizes(ex value, const Expression& expression, const Surroundings& here,
                   bool in_energy = false) const;
  void add_size(Surroundings& here, const std::string& name, const char* unit,
                const std::vector<ex>& components, const std::vector<ex>& direction = {});
  void add_own(const Effect& effect, Link i, Surroundings& here);
  void add_point(const Effect& effect, bool motion, Place place, Link i, Surroundings& here);
  void add_angle_of_link(Link link, Surroundings& here);
  void add_motion_of_joint(const Effect& effect, Link i, Surroundings& here);
  void add_motion_along_link(const Effect& effect, Place place, Link i, Surroundings& here);
  std::vector<ex> flow(const Effect& effect, Place place, Link i);
  std::vector<ex> by_axis(const Points& points, Link link) const;
  void add_force_term(const Effect& effect, const ForceTerm& force, Link i);
  void add_torque_of_joint(const Effect& effect, const ScalarTerm& term, Link i);
  void add_force_along(const Effect& effect, const ForceTerm& force, Link i);
  void add_scalar_term(const Effect& effect, const ScalarTerm& term, Link i);
  /// What follows the name of a state; in space it is a vector.
  std::vector<std::string> state_components() const;
  /// factor times direction, by axis.
  struct AlongVector {
    std::string name;
    std::vector<ex> direction;
    ex factor;
  };
  static std::optional<AlongVector> along_one_vector(const ex& term, const Surroundings& here);
  /// In space: an odd function of the sizes of vectors, such as joint_rate and states, as a vector, by axis.
  std::vector<ex> evaluate_vector(const Effect& effect, const Expression& expression, Place place,
                                  Link i, const char* unit);
  std::vector<ex> force_along_normal(const Effect& effect, const ForceTerm& force, Link i,
                                     const ex& scale, const char* unit);
  /// The point where effects act at a place, and the directions of its link; by axis.
  std::vector<ex> point_at(Place place, Link i) const;
  std::vector<ex> direction_at(Place place, Link i) const;
  /// How what is defined at a place is numbered and called.
  static int index_at(Place place, Link i);
  static std::string named_at(Place place);
  ex effect_parameter(const Effect& effect, const EffectParameter& parameter, Link i);

  Description description_;
  int links_;
  std::string only_term_;
  Definitions definitions_;
  Differential time_;

  // Inputs, indexed by link 1..n (entry 0 unused)
  std::vector<ex> theta_, theta_dot_, theta_ddot_, sine_, cosine_;
  std::vector<ex> length_, mass_, inertia_, stiffness_, damping_, torque_;
  ex load_mass_, gravity_, time_symbol_;
  ex load_inertia_;
  std::vector<ex> reach_;             ///< length of link i with its extension
  Points direction_;                  ///< of link i, towards the free end: a unit vector
  std::vector<ex> direction_square_;  ///< in space: |q_i|^2
  Points direction_force_;            ///< entry 0: of the clamp
  Points joint_;                      ///< far end of link i; 0 is the support
  Points span_;                       ///< from the upper to the lower end of link i
  Points centre_;                     ///< mass centre of link i
  Points middle_;                     ///< middle of link i, where effects act
  std::vector<ex> joint_angle_, arc_, hanging_depth_;
  std::vector<ex> steady_tension_;  ///< in joint i; empty: no effect asks for it
  std::vector<ex> joint_cosine_;    ///< in space
  Points link_turning_, joint_turning_,
      joint_cross_;  ///< in space, [axis]: angular velocity of a link, of
                     ///< a joint; cross product of its links
  std::vector<CarriedAxis>
      bend_axes_;  ///< in space: rest angles bend about them; entry 0: of the clamp
  std::vector<std::vector<ex>> rest_bend_;  ///< in space, [joint][axis]: empty if straight at rest
  std::vector<ex> load_;                    ///< by axis
  ex cos_tilt_, sin_tilt_;
  /// Coordinates, states: by "id.name"; of links and joints from 1 on, at 0 that of the load.
  std::map<std::string, std::vector<ex>> effect_symbols_;
  std::map<std::string, ex> load_definitions_;  ///< by "id.name"

  std::vector<ex> coordinates_, rates_, accelerations_, residual_, states_, state_rates_;
  Points point_;
  std::vector<ex> moments_, tensions_, curvatures_;
  std::vector<EnergyItem> energies_;
  EnergyFunctions energy_functions_;
  Sensor sensor_;
  std::vector<Event> events_;
  int border_ = 0;
  /// The far end of a link that is held.
  struct Held {
    const Effect* effect;
    Link link;
    std::vector<ex> mu;  ///< by axis
  };
  std::vector<Held> held_;
  /// The line between two places of the chain.
  struct ChordLine {
    std::vector<ex> fraction;  ///< of link i: the part that lies between
    std::vector<ex> vector;    ///< by axis
    ex distance;
  };
  std::map<std::string, ChordLine> chords_;  ///< by the effect's id
  /// Where a component of a carried axis belongs.
  struct OfCarriedAxis {
    Link link;
    Axis component;
  };
  std::map<int, OfCarriedAxis> of_carried_axis_;  ///< by its number
  std::vector<ex> chord_forces_;
  std::vector<ex> gap_;            ///< by place and axis
  ex path_, roll_, twist_moment_;  ///< of torsion; none: zero
  std::vector<ex> path_turning_;   ///< by joint
  std::vector<Reaction> reactions_;

  std::set<int> variables_;              ///< numbers of the variables y, coordinates included
  std::map<int, int> variable_of_rate_;  ///< number of ydot -> number of y
  std::set<int> quasi_velocities_;       ///< numbers of w
  std::map<int, ex> generalised_force_;  ///< number of y or w -> its generalised force
  std::string apart_;  ///< the effect whose forces are being added apart; empty: none
  std::map<int, std::map<std::string, ex>> force_of_effect_;  ///< number of y -> effect -> force
  std::set<int> effect_forces_;                               ///< numbers of their definitions
  EffectForces forces_;
};

}  // namespace catena
