// SPDX-License-Identifier: GPL-3.0-or-later
//
// The ends of the chain in space: clamps whose direction turns, the constraints that hold the far end or a
// joint, the moments and the power of what holds them.
#include <algorithm>
#include <map>
#include <string>

#include "common/in_quotes.hpp"
#include "common/input_error.hpp"
#include "description/expression_syntax.hpp"
#include "generator/derivation/chain.hpp"
#include "generator/derivation/effect_expression.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// 1/s: a gap at a held end closes as exp(-kClosingRate t). Faster than cables of metres swing; steps may be
// longer, as they are implicit.
const ex kClosingRate = 100;

}  // namespace

// The direction of a clamp, made a unit vector as those of links are.
std::vector<ex> Chain::unit_vector(const Effect& effect,
                                   const std::vector<const Expression*>& components,
                                   const std::string& name, const std::string& unit_name,
                                   int index) {
  std::vector<ex> vector, unit;
  ex square = 0;
  bool has_length = false;
  for (const Axis axis : axes()) {
    const ex value = evaluate(effect, *components[axis], kShape, Place::kAnywhere, 0, "1");
    has_length = has_length || !value.is_zero();
    vector.push_back(define_variable(name + ending(axis), kNoIndex, value));
    square += vector.back() * vector.back();
  }
  if (!has_length) {
    const Expression& given = **std::find_if(components.begin(), components.end(),
                                             [](const auto* each) { return each->given(); });
    throw InputError(given.file + ":" + std::to_string(given.line) + ": " + given.key +
                     ": all components are zero, and a vector of length zero has no direction; "
                     "give one that is not zero");
  }
  const ex scale =
      definitions_.define(name + "_scale", kNoIndex,
                          inverse_square_root(define_variable(name + "_square", kNoIndex, square)));
  for (const Axis axis : axes())
    unit.push_back(define_variable(unit_name + ending(axis), index, scale * vector[axis]));
  return unit;
}

void Chain::turn_clamp() {
  for (const Effect& effect : description_.effects) {
    const Support& support = effect.support;
    if (!support.turns()) continue;
    const std::vector<ex> clamp =
        unit_vector(effect, {&support.clamp_side, &support.clamp_down, &support.clamp_across},
                    "clamp", "unit", 0);
    for (const Axis axis : axes()) direction_[axis][0] = clamp[axis];
  }
}

namespace {

std::vector<ex> cross_product(const std::vector<ex>& a, const std::vector<ex>& b) {
  std::vector<ex> product;
  for (std::size_t k = 0; k < 3; ++k)
    product.push_back(a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);
  return product;
}

}  // namespace

// The axis about which rest angles bend the cable at the clamp, at a right angle to it: if no effect gives it, from
// down towards side.
void Chain::place_bend_axis() {
  std::vector<ex> given = {0, 0, -1};
  for (const Effect& effect : description_.effects) {
    const Support& support = effect.support;
    if (!support.has_bend_axis()) continue;
    given = unit_vector(
        effect, {&support.bend_axis_side, &support.bend_axis_down, &support.bend_axis_across},
        "bend_axis", "unit_bend_axis", kNoIndex);
  }
  const std::vector<ex> clamp = by_axis(direction_, 0);
  ex along = 0, square = 0, rate = 0;
  for (const Axis axis : axes()) along += given[axis] * clamp[axis];
  CarriedAxis& first = bend_axes_.emplace_back();
  if (along.is_zero()) {
    first.axis = given;
  } else {
    std::vector<ex> across;
    for (const Axis axis : axes()) {
      across.push_back(define_variable("bend_axis_across_clamp" + ending(axis), kNoIndex,
                                       given[axis] - along * clamp[axis]));
      square += across.back() * across.back();
    }
    const ex scale = definitions_.define(
        "bend_axis_across_clamp_scale", kNoIndex,
        inverse_square_root(define_variable("bend_axis_across_clamp_square", kNoIndex, square)));
    for (const Axis axis : axes())
      first.axis.push_back(define_variable("carried_axis" + ending(axis), 0, scale * across[axis]));
  }
  first.crossing = cross_product(clamp, first.axis);
  for (const Axis axis : axes()) {
    rate += time_.of(first.axis[axis]) * first.crossing[axis];
    if (GiNaC::is_a<GiNaC::symbol>(first.axis[axis]))
      of_carried_axis_[definitions_.number_of(first.axis[axis])] = {0, axis};
  }
  first.roll_rate = define_quasi_velocity("carried_roll_rate", 0, rate);
}

// By how much a frame that is carried from link i - 1 to link i without twist turns about it, per velocity of the two.
std::vector<ex> Chain::turning_between(Link i) {
  std::vector<ex> turning;
  for (const Axis axis : axes())
    turning.push_back(definitions_.define("turning_between" + ending(axis), i,
                                          joint_cross_[axis][i] / (1 + joint_cosine_[i])));
  return turning;
}

ex Chain::path_turning(Link i) {
  const std::vector<ex> turning = turning_between(i);
  ex sum = 0;
  for (const Axis axis : axes())
    sum += turning[axis] * (time_.of(direction_[axis][i - 1]) + time_.of(direction_[axis][i]));
  return define_quasi_velocity("path_turning", i, sum);
}

// From link i - 1 to link i.
void Chain::carry_bend_axis(Link i) {
  const CarriedAxis& before = bend_axes_.back();
  const std::vector<ex> above = by_axis(direction_, i - 1), link = by_axis(direction_, i);
  ex along = 0;
  for (const Axis axis : axes()) along += before.axis[axis] * link[axis];
  const ex share = definitions_.define("carried_axis_share", i, along / (1 + joint_cosine_[i]));
  CarriedAxis next;
  next.turning = turning_between(i);
  // Before the axis: what moves the axis is later than what it moves by.
  next.roll_rate =
      definitions_.define_always("carried_roll_rate", i, before.roll_rate - path_turning(i));
  quasi_velocities_.insert(definitions_.number_of(next.roll_rate));
  for (const Axis axis : axes())
    next.axis.push_back(definitions_.define_always(
        "carried_axis" + ending(axis), i, before.axis[axis] - share * (above[axis] + link[axis])));
  const std::vector<ex> crossing = cross_product(link, next.axis);
  for (const Axis axis : axes())
    next.crossing.push_back(
        definitions_.define("carried_axis_crossing" + ending(axis), i, crossing[axis]));
  ex leaning = 0;
  for (const Axis axis : axes()) leaning += next.axis[axis] * time_.of(link[axis]);
  for (const Axis axis : axes()) {
    const int number = definitions_.number_of(next.axis[axis]);
    variables_.insert(number);
    of_carried_axis_[number] = {i, axis};
    time_.set(next.axis[axis], next.roll_rate * next.crossing[axis] - leaning * link[axis]);
  }
  bend_axes_.push_back(std::move(next));
}

// The bend of joint i without a moment: a vector along the axis that is carried to it. The joint beyond the last link
// bends by what is the same for all joints.
std::vector<ex> Chain::rest_bend(Link i) {
  ex angle = 0;
  for (const Effect& effect : description_.effects) {
    const bool of_joints =
        std::any_of(effect.parameters.begin(), effect.parameters.end(),
                    [](const EffectParameter& each) { return each.scope != Scope::kModel; });
    if (i <= links_ || !of_joints)
      angle += evaluate(effect, effect.kinematics.rest_angle, kShape, Place::kJoint, i, "rad");
    if (i == 1)
      angle +=
          evaluate(effect, effect.kinematics.pivot_rest_angle, kShape, Place::kPivot, i, "rad");
  }
  if (angle.is_zero()) return {};
  angle = definitions_.define("rest_angle", i, angle);
  while (static_cast<Link>(bend_axes_.size()) < i)
    carry_bend_axis(static_cast<Link>(bend_axes_.size()));
  std::vector<ex> rest;
  for (const Axis axis : axes()) {
    const ex& along = bend_axes_[static_cast<std::size_t>(i) - 1].axis[axis];
    rest.push_back(along.is_zero() ? ex(0)
                                   : define_variable("rest_bend" + ending(axis), i, angle * along));
  }
  return rest;
}

// Links between two places that are held have to be two at least, or they cannot move.
void Chain::check_held() const {
  std::map<Link, const Effect*> by_link;
  for (const Effect* effect : description_.holding()) {
    const Link link = effect->held_end.link == 0 ? links_ : effect->held_end.link;
    const std::string what = in_quotes(effect->id) + " holds the far end of link ";
    if (link > links_)
      throw InputError(what + std::to_string(link) + ", and the chain has " +
                       std::to_string(links_) + " links; ask for more, or name another link");
    if (!by_link.emplace(link, effect).second)
      throw InputError(what + std::to_string(link) + ", which " + in_quotes(by_link.at(link)->id) +
                       " holds, too; leave one away");
  }
  Link before = 0;
  for (const auto& [link, effect] : by_link) {
    if (link < before + 2) {
      const std::string what = effect->held_end.link == 0 && before == 0
                                   ? " holds the far end: one link between two fixed points cannot "
                                     "move; ask for 2 links "
                                     "or more"
                                   : " holds the far end of link " + std::to_string(link) +
                                         ", which is one link away from another place that is "
                                         "held: it cannot move; hold "
                                         "places that are 2 links or more apart";
      throw InputError(in_quotes(effect->id) + what);
    }
    before = link;
  }
}

// Where the chain is held.
void Chain::place_held() {
  for (const Held& held : held_) {
    const HeldEnd& end = held.effect->held_end;
    const Expression* const place[] = {&end.side, &end.down, &end.across};
    std::vector<ex> at;
    for (const Axis axis : axes())
      at.push_back(
          define_variable(end.named("end") + ending(axis), kNoIndex,
                          evaluate(*held.effect, *place[axis], kShape, Place::kAnywhere, 0, "m")));
    for (const Axis axis : axes())
      gap_.push_back(define_variable(end.named("gap") + ending(axis), kNoIndex,
                                     joint_[axis][held.link] - at[axis]));
    if (end.turns()) clamp_end(*held.effect);
  }
}

// The joint beyond the last link that clamps it where it is held.
void Chain::clamp_end(const Effect& effect) {
  const HeldEnd& held = effect.held_end;
  const Link last = links_ + 1;
  const std::vector<ex> clamp = unit_vector(
      effect, {&held.clamp_side, &held.clamp_down, &held.clamp_across}, "end_clamp", "unit", last);
  for (const Axis axis : axes()) direction_[axis].push_back(clamp[axis]);
  // What is given of joint n, of the length of cable from the middle of the last link to its end.
  const ex shorter = spacing(links_) / (length_[links_] / 2);
  const auto add = [&](std::vector<ex>& of_joints, const char* name, const Expression& given,
                       const char* unit) {
    const ex usual = of_joints[links_] * shorter;
    ex value = usual;
    if (given.given()) {
      Surroundings here = surroundings(effect, kShape, Place::kAnywhere, 0);
      here.add("stiffness", stiffness_[links_] * shorter, "N m/rad");
      here.add("damping", damping_[links_] * shorter, "N m s/rad");
      add_definitions(effect, kShape, Place::kAnywhere, here);
      value = parse_expression(given, here.known, Unit::parse(unit));
    }
    of_joints.push_back(definitions_.define(name, kNoIndex, value));
  };
  add(stiffness_, "end_stiffness", held.clamp_stiffness, "N m/rad");
  add(damping_, "end_damping", held.clamp_damping, "N m s/rad");
}

// The constraints, and the clamp.
void Chain::hold() {
  auto gap = gap_.begin();
  for (const Held& held : held_) {
    if (held.effect->held_end.turns()) add_joint_terms(links_ + 1);
    if (held.effect->held_end.twists()) twist(*held.effect);
    for (const ex& mu : held.mu) {
      const ex apart = *gap++;
      if (!wanted(held.effect->id)) continue;
      const ex rate = time_.of(apart);
      add_momenta(time_.of(mu) * rate);
      add_generalised_force(mu, 2 * kClosingRate * rate + kClosingRate * kClosingRate * apart);
    }
  }
}

// Uniform twist of an isotropic rod between two clamps.
void Chain::twist(const Effect& effect) {
  for (Link k = 1; k <= links_ + 1; ++k) path_turning_.push_back(path_turning(k));
  ex rate = 0;
  for (const ex& turning : path_turning_) rate += turning;
  time_.set(path_, rate);
  if (const Expression& roll = effect.held_end.roll; roll.given())
    roll_ = define_variable("end_roll", kNoIndex,
                            evaluate(effect, roll, kShape, Place::kLoad, 0, "rad"));
  const ex per_twist = definitions_.define(
      "end_torsion", kNoIndex,
      evaluate(effect, effect.held_end.torsional_stiffness, kShape, Place::kLoad, 0, "N m^2") /
          arc_[links_]);
  const ex twist = definitions_.define("end_twist", kNoIndex, roll_ + path_);
  twist_moment_ = definitions_.define("end_twist_moment", kNoIndex, per_twist * twist);
  if (!wanted("elastic")) return;
  add_energy(effect.id, EnergyItem::kStored, per_twist * twist * twist / 2);
  for (const ex& turning : path_turning_) add_generalised_force(turning, twist_moment_);
}

// In space: the moment that link i exerts on what is above joint i by bending, damping and torsion, with the
// effects on them.
std::vector<ex> Chain::moment_of_joint(Link i) {
  const auto force_of = [&](const ex& variable) {
    if (!GiNaC::is_a<GiNaC::symbol>(variable)) return ex(0);
    const auto found = generalised_force_.find(definitions_.number_of(variable));
    return found == generalised_force_.end() ? ex(0) : found->second;
  };
  ex bending = -force_of(joint_cosine_[i]);
  const std::vector<ex>& rest = rest_bend_[i];
  if (!rest.empty()) {
    // What the cosine has of the rest is no moment about the cross product: it stands for the turn of the bend.
    ex along = 0;
    for (const Axis axis : axes()) along += rest[axis] * joint_cross_[axis][i];
    bending -= stiffness_[i] * angle_over_sine_slope(joint_cosine_[i]) * along;
  }
  std::vector<ex> moment;
  for (const Axis axis : axes()) {
    ex component = bending * joint_cross_[axis][i] + force_of(joint_turning_[axis][i]);
    if (!rest.empty()) component -= stiffness_[i] * rest[axis];
    // The moment of torsion is along the mean of the two links. About their bisector it does the work of path'.
    component +=
        twist_moment_ * (direction_[axis][i - 1] + direction_[axis][i]) / (1 + joint_cosine_[i]);
    moment.push_back(definitions_.define("joint_moment" + ending(axis), i, component));
  }
  return moment;
}

// The forces that move the ends do work, and the moments that turn their clamps. Where the end is held, the
// work is that at the end of the chain: what a gap takes of it is in the balance.
void Chain::add_power_of_ends() {
  const auto turning = [&](Axis axis, Link i) {
    return in_plane() ? ex(0) : direction_force_[axis][i] * time_.of(direction_[axis][i]);
  };
  ex of_support = 0;
  for (const Axis axis : axes())
    of_support += reactions_[0].force[axis] * time_.of(joint_[axis][0]) + turning(axis, 0);
  // The axis of rest angles at the clamp moves with time, and all the axes roll with it.
  for (const ex& component : in_plane() ? std::vector<ex>() : bend_axes_.front().axis) {
    const ex rate = time_.of(component);
    if (!rate.is_zero()) of_support += generalised_force_[definitions_.number_of(component)] * rate;
  }
  if (!of_support.is_zero()) add_energy("support", EnergyItem::kSupplied, of_support);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    const Held& held = held_[k];
    const HeldEnd& end = held.effect->held_end;
    ex power = 0;
    for (const Axis axis : axes()) {
      power += reactions_[k + 1].force[axis] * time_.of(joint_[axis][held.link]);
      if (end.turns()) power += turning(axis, links_ + 1);
    }
    if (end.twists()) power += twist_moment_ * time_.of(roll_);
    add_energy(end.named("end"), EnergyItem::kSupplied, power);
  }
}

}  // namespace catena
