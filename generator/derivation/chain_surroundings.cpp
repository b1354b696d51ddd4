// SPDX-License-Identifier: GPL-3.0-or-later
//
// What the expressions of effects may name at a place of the chain: its point, its angles and directions, its
// motion and that of the fluid, and what the effect itself defines.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "description/expression_syntax.hpp"
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

// What is at the load or along a chord belongs to no link, and has a family of its own.
int Chain::index_at(Place place, Link i) {
  return place == Place::kLoad || place == Place::kChord ? kNoIndex : i;
}
std::string Chain::named_at(Place place) {
  return place == Place::kLoad ? "load_" : place == Place::kChord ? "chord_" : "";
}

ex Chain::effect_parameter(const Effect& effect, const EffectParameter& parameter, Link i) {
  const bool shared = parameter.scope == Scope::kModel;
  return definitions_.input(effect.id + "_" + parameter.name, shared ? kNoIndex : i);
}

std::vector<ex> Chain::point_at(Place place, Link i) const {
  std::vector<ex> point;
  for (const Axis axis : axes())
    point.push_back(place == Place::kLoad         ? load_[axis]
                    : place == Place::kLinkCentre ? middle_[axis][i]
                                                  : joint_[axis][i - 1]);
  return point;
}

std::vector<ex> Chain::direction_at(Place place, Link i) const {
  std::vector<ex> direction;
  for (const Axis axis : axes())
    direction.push_back(direction_[axis][place == Place::kLoad ? links_ : i]);
  return direction;
}

void Chain::add_size(Surroundings& here, const std::string& name, const char* unit,
                     const std::vector<ex>& components, const std::vector<ex>& direction) {
  ex square = 0;
  for (const ex& component : components) square += component * component;
  const GiNaC::realsymbol placeholder("square_of_" + name);
  here.add(name, GiNaC::sqrt(placeholder), unit);
  here.sizes.push_back({name, placeholder, square, square, direction});
}

// The velocity of the fluid, by axis.
std::vector<ex> Chain::flow(const Effect& effect, Place place, Link i) {
  Surroundings here = surroundings(effect, kPosition, place, i);
  add_definitions(effect, kPosition, place, here);
  std::vector<ex> velocity;
  const std::string prefix = effect.id + "_" + named_at(place) + "flow_";
  for (const auto& [axis, part] : {std::pair{"side", &effect.flow.side},
                                   {"down", &effect.flow.down},
                                   {"across", &effect.flow.across}}) {
    velocity.push_back(
        part->given() ? definitions_.define(prefix + axis, index_at(place, i),
                                            parse_expression(*part, here.known, Unit::parse("m/s")))
                      : ex(0));
  }
  return velocity;
}

// The velocity of the point, and that relative to the fluid, along the link and normal to it; where the link
// points, and the rate of that.
void Chain::add_motion_along_link(const Effect& effect, Place place, Link i, Surroundings& here) {
  const Link link = place == Place::kLoad ? links_ : i;
  const int index = index_at(place, i);
  std::vector<ex> velocity, direction = direction_at(place, i);
  for (const ex& component : point_at(place, i)) velocity.push_back(time_.of(component));
  velocity.resize(3), direction.resize(3);
  const char* const axis_names[] = {"side", "down", "across"};
  for (std::size_t k = 0; k < 3; ++k) {
    here.add(std::string("direction_") + axis_names[k], direction[k], "1");
    here.add(std::string("direction_rate_") + axis_names[k], time_.of(direction[k]), "1/s");
  }
  // v x e about side, down and across, and e x (v x e)
  const auto add_normal = [&](const std::string& name, const std::string& family,
                              const std::vector<ex>& v, const auto& define) {
    std::vector<ex> crossing(3), normal;
    const auto cross = [](const std::vector<ex>& a, const std::vector<ex>& b, std::size_t k) {
      return a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
    };
    // side, down, across is a left-handed or a right-handed system; twice a product, it does not matter.
    for (std::size_t k = 0; k < 3; ++k)
      crossing[k] = define(family + axis_names[k] + "_velocity", cross(v, direction, k));
    for (std::size_t k = 0; k < 3; ++k) normal.push_back(cross(direction, crossing, k));
    add_size(here, name, "m/s", crossing, normal);
  };
  const auto quasi_velocity = [&](const std::string& family, const ex& value) {
    return define_quasi_velocity(named_at(place) + family, index, value);
  };
  const auto dot = [](const std::vector<ex>& a, const std::vector<ex>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  if (in_plane()) {
    here.add("velocity_normal", velocity[0] * cosine_[link] - velocity[1] * sine_[link], "m/s");
    here.add("velocity_tangential", dot(velocity, direction), "m/s");
  } else {
    add_normal("velocity_normal", "crossing_", velocity, quasi_velocity);
    const ex tangential = quasi_velocity("tangential_velocity", dot(velocity, direction));
    here.sizes.back().in_energy = dot(velocity, velocity) - tangential * tangential;
    here.add("velocity_tangential", tangential, "m/s");
  }
  if (!effect.flow.given()) return;

  const std::vector<ex> fluid = flow(effect, place, i);
  std::vector<ex> relative;
  for (std::size_t k = 0; k < 3; ++k) relative.push_back(velocity[k] - fluid[k]);
  here.add("relative_tangential", dot(relative, direction), "m/s");
  // In the plane a flow across it adds to the size of the relative velocity.
  if (in_plane() && fluid[kAcross].is_zero()) {
    here.add("relative_normal", relative[0] * cosine_[link] - relative[1] * sine_[link], "m/s");
  } else {
    add_normal("relative_normal", effect.id + "_crossing_", relative,
               [&](const std::string& family, const ex& value) {
                 return definitions_.define(named_at(place) + family, index, value);
               });
  }
}

std::vector<ex> Chain::by_axis(const Points& points, Link link) const {
  std::vector<ex> vector;
  for (const Axis axis : axes()) vector.push_back(points[axis][link]);
  return vector;
}

// Parameters, constants and signals of the effect, by the names it gave them.
void Chain::add_own(const Effect& effect, Link i, Surroundings& here) {
  for (const EffectParameter& parameter : effect.parameters) {
    // A parameter per joint or link has no value at the load and at the support.
    if (parameter.scope != Scope::kModel && i == 0) continue;
    here.add(parameter.name, effect_parameter(effect, parameter, i), parameter.unit);
  }
  for (const Constant& constant : effect.constants)
    here.add(constant.name, exact_number(constant.text), constant.unit);
  for (const SignalChannel& signal : effect.signals) {
    const std::string name = effect.id + "_" + signal.name;
    here.add(signal.name, definitions_.input(name), signal.unit);
    here.add(signal.name + "_rate", definitions_.input(name + "_rate"), signal.unit + "/s");
    here.add(signal.name + "_acceleration", definitions_.input(name + "_acceleration"),
             signal.unit + "/s^2");
  }
}

// Where the place is and, if motion is known, how it moves, by itself and relative to the fluid.
void Chain::add_point(const Effect& effect, bool motion, Place place, Link i, Surroundings& here) {
  std::vector<ex> point = point_at(place, i);
  point.resize(3);
  here.add("side", point[kSide], "m");
  here.add("down", point[kDown], "m");
  // An effect may have a name `across` of its own.
  if (!here.known.symbols.contains("across")) here.add("across", point[kAcross], "m");
  here.add("depth", cos_tilt_ * point[kDown] + sin_tilt_ * point[kSide], "m");
  if (!motion) return;
  std::vector<ex> fluid(3);
  if (effect.flow.given()) fluid = flow(effect, place, i);
  const char* axis_names[] = {"side", "down", "across"};
  for (std::size_t k = 0; k < 3; ++k) {
    const ex velocity = time_.of(point[k]);
    here.add(std::string("velocity_") + axis_names[k], velocity, "m/s");
    if (effect.flow.given())
      here.add(std::string("relative_") + axis_names[k], velocity - fluid[k], "m/s");
  }
}

void Chain::add_angle_of_link(Link link, Surroundings& here) {
  if (in_plane()) {
    here.add("angle", theta_[link], "rad");
    here.add("rate", theta_dot_[link], "rad/s");
  } else {
    add_size(here, "rate", "rad/s", by_axis(link_turning_, link));
  }
}

// The angle of a joint, its rate, the states it carries and the tension there.
void Chain::add_motion_of_joint(const Effect& effect, Link i, Surroundings& here) {
  if (!steady_tension_.empty())
    here.add(kSteadyTension, steady_tension_[static_cast<std::size_t>(i)], "N");
  if (in_plane()) {
    here.add("joint_angle", joint_angle_[i], "rad");
    here.add("joint_rate", time_.of(joint_angle_[i]), "rad/s");
  } else {
    add_size(here, "joint_angle", "rad", {});
    here.sizes.back().square = here.sizes.back().in_energy = squared_angle(joint_cosine_[i]);
    const std::vector<ex> turning = by_axis(joint_turning_, i);
    add_size(here, "joint_rate", "rad/s", turning, turning);
  }
  for (const ExtraState& state : effect.states) {
    if (state.at == Place::kLoad || (state.at == Place::kPivot && i != 1)) continue;
    std::vector<ex> symbols;
    for (const std::string& component : state_components())
      symbols.push_back(effect_symbols_.at(effect.id + "." + state.name + component)[i]);
    if (in_plane()) {
      here.add(state.name, symbols.front(), state.unit);
    } else {
      add_size(here, state.name, state.unit.c_str(), symbols, symbols);
    }
  }
}

Chain::Surroundings Chain::surroundings(const Effect& effect, Knowledge knowledge, Place place,
                                        Link i) {
  Surroundings here;
  here.add("time", time_symbol_, "s");
  here.add("gravity", gravity_, "m/s^2");
  add_own(effect, i, here);
  const bool motion = knowledge == kMotion;
  if (place == Place::kLink || place == Place::kLinkCentre) {
    here.add("length", length_[i], "m");
    here.add("mass", mass_[i], "kg");
    here.add("inertia", inertia_[i], "kg m^2");
    here.add("arc", arc_[i - 1] + length_[i] / 2, "m");
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at == Place::kLoad) continue;
      const ex symbol = effect_symbols_.at(effect.id + "." + coordinate.name)[i];
      here.add(coordinate.name, symbol, coordinate.unit);
      here.add(coordinate.name + "_rate", time_.of(symbol), coordinate.unit + "/s");
    }
    if (motion) add_angle_of_link(i, here);
    if (knowledge != kShape && place == Place::kLinkCentre)
      add_point(effect, motion, place, i, here);
    if (motion && place == Place::kLinkCentre) add_motion_along_link(effect, place, i, here);
  } else if (place == Place::kJoint || place == Place::kPivot) {
    here.add("stiffness", stiffness_[i], "N m/rad");
    here.add("damping", damping_[i], "N m s/rad");
    here.add("arc", arc_[i - 1], "m");
    here.add("spacing", spacing(i), "m");
    if (knowledge != kShape) add_point(effect, motion, place, i, here);
    if (motion) add_motion_of_joint(effect, i, here);
  } else if (place == Place::kLoad) {
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at != Place::kLoad) continue;
      const ex symbol = effect_symbols_.at(effect.id + "." + coordinate.name)[0];
      here.add(coordinate.name, symbol, coordinate.unit);
      if (motion) here.add(coordinate.name + "_rate", time_.of(symbol), coordinate.unit + "/s");
    }
    if (knowledge == kShape) return here;
    if (motion) {
      for (const ExtraState& state : effect.states)
        if (state.at == Place::kLoad)
          here.add(state.name, effect_symbols_.at(effect.id + "." + state.name)[0], state.unit);
    }
    here.add("load_mass", load_mass_, "kg");
    if (motion) add_angle_of_link(links_, here);
    add_point(effect, motion, place, i, here);
    if (motion) add_motion_along_link(effect, place, i, here);
  } else if (place == Place::kChord) {
    const ex& distance = chords_.at(effect.id).distance;
    here.add("distance", distance, "m");
    if (motion) here.add("distance_rate", time_.of(distance), "m/s");
  }
  return here;
}

void Chain::add_definitions(const Effect& effect, Knowledge knowledge, Place place,
                            Surroundings& here) {
  for (const Definition& definition : effect.definitions) {
    const bool at_place =
        definition.at == place || (definition.at == Place::kJoint && place == Place::kPivot);
    if (at_place && place == Place::kLoad && effect.moves_load()) {
      // What moves the load is a function of its shape, and so are some of the definitions.
      if (knowledge == kMotion || has_meaning(definition.value, here.known))
        add_load_definition(effect, definition, here);
    } else if (definition.at == Place::kAnywhere || (at_place && knowledge == kMotion)) {
      add_definition(definition, here.known);
    }
  }
}

// At a load with coordinates of its own, a definition of the shape is a variable, whose rate has a name, too,
// and one that is linear in rates is a quasi-velocity. Others are written out where they are used.
void Chain::add_load_definition(const Effect& effect, const Definition& definition,
                                Surroundings& here) {
  const auto [value, unit] = parse_expression(definition.value, here.known);
  const bool of_sizes =
      std::any_of(here.sizes.begin(), here.sizes.end(),
                  [&, &v = value](const Size& size) { return v.has(size.placeholder); });
  if (of_sizes) return here.known.add(definition.name, value, unit);

  const auto rates = coefficients_of_rates(value);
  const bool of_shape = rates && rates->empty();
  const auto [named, is_new] = load_definitions_.emplace(effect.id + "." + definition.name, value);
  const std::string family = effect.id + "_" + definition.name;
  if (is_new && of_shape && !time_.of(value).is_zero()) {
    named->second = define_shape(family, value);
  } else if (is_new && rates && !of_shape) {
    named->second = define_quasi_velocity(family, kNoIndex, value);
    differentiate_names_in(definitions_[definitions_.number_of(named->second)].value);
  }
  here.known.add(definition.name, named->second, unit);
  if (of_shape)
    here.known.add(definition.name + "_rate", time_.of(named->second), unit / Unit::parse("s"));
}

}  // namespace catena
