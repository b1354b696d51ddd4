// SPDX-License-Identifier: GPL-3.0-or-later
//
// Adds the terms of effects to the chain. Expressions are parsed with the symbols of their place.
// They become potentials, dissipation functions, forces and torques (virtual work), kinetic
// energies, extra states and sensor expressions.
#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/in_quotes.hpp"
#include "description/expression_syntax.hpp"
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

namespace {

// What is at the load belongs to no link, and has a family of its own.
int index_at(Place place, int i) { return place == Place::kLoad ? kNoIndex : i; }
std::string at_load(Place place) { return place == Place::kLoad ? "load_" : ""; }

// Whether a power of `square` that is not whole stands somewhere: the size of the vector itself.
bool has_root_of(const ex& expression, const ex& square) {
  if (GiNaC::is_a<GiNaC::power>(expression) && expression.op(0).is_equal(square) &&
      !expression.op(1).info(GiNaC::info_flags::integer))
    return true;
  for (const ex& part : expression)
    if (has_root_of(part, square)) return true;
  return false;
}

// Whether all names in an expression are known there.
bool has_meaning(const Expression& expression, const ExpressionContext& known) {
  const std::set<std::string> names = names_in(expression);
  return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
    return name == "pi" || known.symbols.contains(name);
  });
}

}  // namespace

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
  here.known.add(name, GiNaC::sqrt(placeholder), Unit::parse(unit));
  here.sizes.push_back({name, placeholder, square, square, direction});
}

// The velocity of the fluid, by axis.
std::vector<ex> Chain::flow(const Effect& effect, Place place, Link i) {
  Surroundings here = surroundings(effect, kPosition, place, i);
  add_definitions(effect, kPosition, place, here);
  std::vector<ex> velocity;
  const std::string prefix = effect.id + "_" + at_load(place) + "flow_";
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

// The velocity of the point, and that relative to the fluid, along the link and normal to it; where the link points, and
// the rate of that.
void Chain::add_motion_along_link(const Effect& effect, Place place, Link i, Surroundings& here) {
  const Link link = place == Place::kLoad ? links_ : i;
  const int index = index_at(place, i);
  std::vector<ex> velocity, direction = direction_at(place, i);
  for (const ex& component : point_at(place, i)) velocity.push_back(time_.of(component));
  velocity.resize(3), direction.resize(3);
  const char* const axis_names[] = {"side", "down", "across"};
  for (std::size_t k = 0; k < 3; ++k) {
    here.known.add(std::string("direction_") + axis_names[k], direction[k], Unit::parse("1"));
    here.known.add(std::string("direction_rate_") + axis_names[k], time_.of(direction[k]),
                   Unit::parse("1/s"));
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
    return define_quasi_velocity(at_load(place) + family, index, value);
  };
  const auto dot = [](const std::vector<ex>& a, const std::vector<ex>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  };
  if (in_plane()) {
    here.known.add("velocity_normal", velocity[0] * cosine_[link] - velocity[1] * sine_[link],
                   Unit::parse("m/s"));
    here.known.add("velocity_tangential", dot(velocity, direction), Unit::parse("m/s"));
  } else {
    add_normal("velocity_normal", "crossing_", velocity, quasi_velocity);
    const ex tangential = quasi_velocity("tangential_velocity", dot(velocity, direction));
    here.sizes.back().in_energy = dot(velocity, velocity) - tangential * tangential;
    here.known.add("velocity_tangential", tangential, Unit::parse("m/s"));
  }
  if (!effect.flow.given()) return;

  const std::vector<ex> fluid = flow(effect, place, i);
  std::vector<ex> relative;
  for (std::size_t k = 0; k < 3; ++k) relative.push_back(velocity[k] - fluid[k]);
  here.known.add("relative_tangential", dot(relative, direction), Unit::parse("m/s"));
  // In the plane a flow across it adds to the size of the relative velocity.
  if (in_plane() && fluid[kAcross].is_zero()) {
    here.known.add("relative_normal", relative[0] * cosine_[link] - relative[1] * sine_[link],
                   Unit::parse("m/s"));
  } else {
    add_normal("relative_normal", effect.id + "_crossing_", relative,
               [&](const std::string& family, const ex& value) {
                 return definitions_.define(at_load(place) + family, index, value);
               });
  }
}

Chain::Surroundings Chain::surroundings(const Effect& effect, Knowledge knowledge, Place place,
                                        Link i) {
  Surroundings here;
  const auto add = [&](const std::string& name, const ex& value, const std::string& unit) {
    here.known.add(name, value, Unit::parse(unit));
  };
  add("time", time_symbol_, "s");
  add("gravity", gravity_, "m/s^2");
  for (const EffectParameter& parameter : effect.parameters) {
    // A parameter per joint or link has no value at the load and at the support.
    if (parameter.scope != Scope::kModel && i == 0) continue;
    add(parameter.name, effect_parameter(effect, parameter, i), parameter.unit);
  }
  for (const Constant& constant : effect.constants) {
    add(constant.name, exact_number(constant.text), constant.unit);
  }
  for (const SignalChannel& signal : effect.signals) {
    const std::string name = effect.id + "_" + signal.name;
    add(signal.name, definitions_.input(name), signal.unit);
    add(signal.name + "_rate", definitions_.input(name + "_rate"), signal.unit + "/s");
    add(signal.name + "_acceleration", definitions_.input(name + "_acceleration"),
        signal.unit + "/s^2");
  }
  const bool motion = knowledge == kMotion;
  const auto add_point = [&] {
    std::vector<ex> point = point_at(place, i);
    point.resize(3);
    add("side", point[kSide], "m");
    add("down", point[kDown], "m");
    // An effect may have a name `across` of its own.
    if (!here.known.symbols.contains("across")) add("across", point[kAcross], "m");
    add("depth", cos_tilt_ * point[kDown] + sin_tilt_ * point[kSide], "m");
    if (!motion) return;
    std::vector<ex> fluid(3);
    if (effect.flow.given()) fluid = flow(effect, place, i);
    const char* axes[] = {"side", "down", "across"};
    for (std::size_t k = 0; k < 3; ++k) {
      const ex velocity = time_.of(point[k]);
      add(std::string("velocity_") + axes[k], velocity, "m/s");
      if (effect.flow.given()) add(std::string("relative_") + axes[k], velocity - fluid[k], "m/s");
    }
  };
  const auto by_axis = [&](const Points& points, Link link) {
    std::vector<ex> vector;
    for (const Axis axis : axes()) vector.push_back(points[axis][link]);
    return vector;
  };
  const auto add_angle = [&](Link link) {
    if (in_plane()) {
      add("angle", theta_[link], "rad");
      add("rate", theta_dot_[link], "rad/s");
    } else {
      add_size(here, "rate", "rad/s", by_axis(link_turning_, link));
    }
  };
  if (place == Place::kLink || place == Place::kLinkCentre) {
    add("length", length_[i], "m");
    add("mass", mass_[i], "kg");
    add("inertia", inertia_[i], "kg m^2");
    add("arc", arc_[i - 1] + length_[i] / 2, "m");
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at == Place::kLoad) continue;
      const ex symbol = effect_symbols_.at(effect.id + "." + coordinate.name)[i];
      add(coordinate.name, symbol, coordinate.unit);
      add(coordinate.name + "_rate", time_.of(symbol), coordinate.unit + "/s");
    }
    if (motion) add_angle(i);
    if (knowledge != kShape && place == Place::kLinkCentre) add_point();
    if (motion && place == Place::kLinkCentre) add_motion_along_link(effect, place, i, here);
  } else if (place == Place::kJoint || place == Place::kPivot) {
    add("stiffness", stiffness_[i], "N m/rad");
    add("damping", damping_[i], "N m s/rad");
    add("arc", arc_[i - 1], "m");
    add("spacing", spacing(i), "m");
    if (knowledge != kShape) add_point();
    if (motion) {
      if (!steady_tension_.empty())
        add(kSteadyTension, steady_tension_[static_cast<std::size_t>(i)], "N");
      if (in_plane()) {
        add("joint_angle", joint_angle_[i], "rad");
        add("joint_rate", time_.of(joint_angle_[i]), "rad/s");
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
          add(state.name, symbols.front(), state.unit);
        } else {
          add_size(here, state.name, state.unit.c_str(), symbols, symbols);
        }
      }
    }
  } else if (place == Place::kLoad) {
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at != Place::kLoad) continue;
      const ex symbol = effect_symbols_.at(effect.id + "." + coordinate.name)[0];
      add(coordinate.name, symbol, coordinate.unit);
      if (motion) add(coordinate.name + "_rate", time_.of(symbol), coordinate.unit + "/s");
    }
    if (knowledge == kShape) return here;
    if (motion) {
      for (const ExtraState& state : effect.states)
        if (state.at == Place::kLoad)
          add(state.name, effect_symbols_.at(effect.id + "." + state.name)[0], state.unit);
    }
    add("load_mass", load_mass_, "kg");
    if (motion) add_angle(links_);
    add_point();
    if (motion) add_motion_along_link(effect, place, i, here);
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

ex Chain::without_sizes(ex value, const Expression& expression, const Surroundings& here,
                        bool in_energy) const {
  for (const Size& size : here.sizes) {
    if (has_root_of(value, size.placeholder))
      fail_at(expression, in_quotes(size.name) +
                              " is the size of a vector in space, which has no derivative at zero; "
                              "write it with even powers only, as " +
                              in_quotes(size.name + "^2"));
    value = value.subs(size.placeholder == (in_energy ? size.in_energy : size.square),
                       GiNaC::subs_options::no_pattern);
  }
  return value;
}

ex Chain::evaluate(const Effect& effect, const Expression& expression, Knowledge knowledge,
                   Place place, Link i, const char* unit, bool in_energy) {
  if (!expression.given()) return 0;
  Surroundings here = surroundings(effect, knowledge, place, i);
  add_definitions(effect, knowledge, place, here);
  return without_sizes(parse_expression(expression, here.known, Unit::parse(unit)), expression,
                       here, in_energy);
}

std::vector<std::string> Chain::state_components() const {
  std::vector<std::string> components;
  if (in_plane()) return {""};
  for (const Axis axis : axes()) components.push_back(ending(axis));
  return components;
}

// Each term is the size of one vector times an even function of all sizes: this function times the vector.
std::vector<ex> Chain::evaluate_vector(const Effect& effect, const Expression& expression,
                                       Place place, Link i, const char* unit) {
  Surroundings here = surroundings(effect, kMotion, place, i);
  add_definitions(effect, kMotion, place, here);
  const ex value = parse_expression(expression, here.known, Unit::parse(unit)).expand();
  std::vector<ex> vector(axes().size());
  const auto add_term = [&](const ex& term) {
    for (const Size& along : here.sizes) {
      if (along.direction.empty()) continue;
      ex factor = term * GiNaC::pow(along.placeholder, ex(GiNaC::numeric(-1, 2)));
      if (std::any_of(here.sizes.begin(), here.sizes.end(),
                      [&](const Size& size) { return has_root_of(factor, size.placeholder); }))
        continue;
      for (const Size& size : here.sizes)
        factor = factor.subs(size.placeholder == size.square, GiNaC::subs_options::no_pattern);
      for (std::size_t k = 0; k < vector.size(); ++k) vector[k] += factor * along.direction[k];
      return;
    }
    fail_at(
        expression,
        "in space this is a vector along joint_rate and states; write a sum of terms that are odd "
        "in one of them and even in the others, as moment*slip/reach");
  };
  if (GiNaC::is_a<GiNaC::add>(value)) {
    for (const ex& term : value) add_term(term);
  } else if (!value.is_zero()) {
    add_term(value);
  }
  return vector;
}

// A force normal to the link, by axis: an odd function f(w) of the size w of a vector, such as
// velocity_normal, is the vector times f(w)/w, which is even.
std::vector<ex> Chain::force_along_normal(const Effect& effect, const ForceTerm& force, Link i,
                                          const ex& scale, const char* unit) {
  Surroundings here = surroundings(effect, kMotion, force.at, i);
  add_definitions(effect, kMotion, force.at, here);
  const ex value = parse_expression(force.normal, here.known, Unit::parse(unit));
  const auto is_even = [&](const ex& factor) {
    return std::none_of(here.sizes.begin(), here.sizes.end(),
                        [&](const Size& size) { return has_root_of(factor, size.placeholder); });
  };
  for (const Size& along : here.sizes) {
    if (along.direction.empty()) continue;
    ex factor = value * GiNaC::pow(along.placeholder, ex(GiNaC::numeric(-1, 2)));
    if (!is_even(factor)) factor = factor.expand();
    if (!is_even(factor)) continue;
    for (const Size& size : here.sizes)
      factor = factor.subs(size.placeholder == size.square, GiNaC::subs_options::no_pattern);
    factor =
        definitions_.define(effect.id + "_" + at_load(force.at) + "normal_force_per_" + along.name,
                            index_at(force.at, i), scale * factor);
    std::vector<ex> components;
    for (const ex& component : along.direction) components.push_back(factor * component);
    components.resize(axes().size());
    return components;
  }
  fail_at(
      force.normal,
      std::string("in space a force normal to a link has the direction of velocity_normal or of "
                  "relative_normal; write an odd function of one of them, such as "
                  "-c*velocity_normal*sqrt(velocity_normal^2 + floor^2)"));
}

ex Chain::kinematic(Expression Kinematics::*quantity, const char* unit, Place place, Link i) {
  ex sum = 0;
  for (const Effect& effect : description_.effects) {
    sum += evaluate(effect, effect.kinematics.*quantity, kShape, place, i, unit);
  }
  return sum;
}

void Chain::add_effect_terms(const Effect& effect) {
  const auto each = [&](Place place, const auto& act) {
    if (place == Place::kLoad) {
      act(0);
    } else {
      const Link last = place == Place::kPivot ? 1 : links_;
      for (Link i = 1; i <= last; ++i) act(i);
    }
  };
  for (const ExtraState& state : effect.states) {
    const std::string unit = state.unit + "/s";
    if (state.at == Place::kLoad) {
      states_.push_back(effect_symbols_.at(effect.id + "." + state.name)[0]);
      state_rates_.push_back(
          definitions_.named(evaluate(effect, state.rate, kMotion, state.at, 0, unit.c_str()),
                             effect.id + "_" + state.name + "_rate", kNoIndex));
      continue;
    }
    const std::vector<std::string> components = state_components();
    std::vector<std::vector<ex>> rates(1);  // [joint][component]
    each(state.at, [&](Link i) {
      if (in_plane()) {
        rates.push_back({evaluate(effect, state.rate, kMotion, state.at, i, unit.c_str())});
      } else {
        rates.push_back(evaluate_vector(effect, state.rate, state.at, i, unit.c_str()));
      }
    });
    // In the order of the table: all joints of a component.
    for (std::size_t k = 0; k < components.size(); ++k) {
      const std::string name = state.name + components[k];
      each(state.at, [&](Link i) {
        states_.push_back(effect_symbols_.at(effect.id + "." + name)[i]);
        state_rates_.push_back(definitions_.named(rates[static_cast<std::size_t>(i)][k],
                                                  effect.id + "_" + name + "_rate", i));
      });
    }
  }
  if (effect.held_end.twists()) {
    states_.push_back(path_);
    state_rates_.push_back(
        definitions_.named(time_.of(path_), effect.id + "_twist_of_path_rate", kNoIndex));
  }
  if (!wanted(effect.id)) return;

  for (const ForceTerm& force : effect.forces)
    each(force.at, [&](Link i) { add_force_term(effect, force, i); });
  for (const ScalarTerm& term : effect.scalars)
    each(term.at, [&](Link i) { add_scalar_term(effect, term, i); });
}

void Chain::add_force_along(const Effect& effect, const ForceTerm& force, Link i) {
  Surroundings here = surroundings(effect, kMotion, force.at, i);
  add_definitions(effect, kMotion, force.at, here);
  const auto [velocity, unit] = parse_expression(force.along, here.known);
  const Unit wanted = Unit::parse(force.per_length ? "W/m" : "W") / unit;
  const ex size =
      without_sizes(parse_expression(force.value, here.known, wanted), force.value, here);
  const ex along = without_sizes(velocity, force.along, here);
  if (along.is_zero()) return;  // a point that does not move, such as the support
  const auto coefficients = coefficients_of_rates(along);
  if (!coefficients || coefficients->empty())
    fail_at(
        force.along,
        "it is not linear in velocities and rates; a force does work along one of them, such as "
        "velocity_side, or along a sum of them times functions of the shape");
  const ex value =
      definitions_.define(effect.id + "_" + at_load(force.at) + "force_along",
                          index_at(force.at, i), (force.per_length ? length_[i] : ex(1)) * size);
  for (const auto& [rate, coefficient] : *coefficients) {
    const auto variable = variable_of_rate_.find(rate);
    add_generalised_force(variable == variable_of_rate_.end() ? rate : variable->second,
                          -value * coefficient);
  }
  add_energy(effect.id, EnergyItem::kSupplied, value * along);
}

void Chain::add_force_term(const Effect& effect, const ForceTerm& force, Link i) {
  if (force.along.given()) return add_force_along(effect, force, i);
  const char* unit = force.per_length ? "N/m" : "N";
  const ex scale = force.per_length ? length_[i] : ex(1);
  const auto part = [&](const char* what, const Expression& expression) {
    return definitions_.define(effect.id + "_" + at_load(force.at) + "force_" + what,
                               index_at(force.at, i),
                               scale * evaluate(effect, expression, kMotion, force.at, i, unit));
  };
  std::vector<ex> components = {part("side", force.side), part("down", force.down)};
  if (!in_plane()) components.push_back(part("across", force.across));
  const bool vector_normal = !in_plane() || effect.flow.across.given();
  if (force.normal.given() && vector_normal) {
    const std::vector<ex> normal = force_along_normal(effect, force, i, scale, unit);
    for (std::size_t k = 0; k < components.size(); ++k) components[k] += normal[k];
  } else if (force.normal.given()) {
    const Link link = force.at == Place::kLoad ? links_ : i;
    const ex normal = part("normal", force.normal);
    components[kSide] += normal * cosine_[link];
    components[kDown] += -normal * sine_[link];
  }
  const std::vector<ex> point = point_at(force.at, i), direction = direction_at(force.at, i);
  const ex tangential = part("tangential", force.tangential);
  std::vector<Component> forces;
  for (std::size_t k = 0; k < components.size(); ++k)
    forces.push_back({point[k], components[k] + tangential * direction[k]});
  add_force(effect.id, forces);
}

void Chain::add_scalar_term(const Effect& effect, const ScalarTerm& term, Link i) {
  const bool joint = term.at == Place::kJoint || term.at == Place::kPivot;
  const ex scale = term.per_length ? length_[i] : ex(1);
  const auto value = [&](const char* unit, const char* unit_per_length) {
    return scale * evaluate(effect, term.value, kMotion, term.at, i,
                            term.per_length ? unit_per_length : unit,
                            term.kind == ScalarKind::kKinetic);
  };
  switch (term.kind) {
    case ScalarKind::kTorque:
      if (!in_plane()) {
        add_torque_of_joint(effect, term, i);
        break;
      }
      add_force(effect.id, {{joint ? joint_angle_[i] : theta_[i == 0 ? links_ : i],
                             definitions_.define(effect.id + "_" + at_load(term.at) + "torque",
                                                 index_at(term.at, i), value("N m", "N"))}});
      break;
    case ScalarKind::kPotential:
      add_potential(effect.id, value("J", "J/m"));
      break;
    case ScalarKind::kDissipation:
      add_dissipation(effect.id, value("W", "W/m"));
      break;
    case ScalarKind::kKinetic:
      add_kinetic(effect.id, value("J", "J/m"));
      break;
  }
}

// In space, between the two links of joint i: virtual work on the difference of their angular velocities.
void Chain::add_torque_of_joint(const Effect& effect, const ScalarTerm& term, Link i) {
  const std::vector<ex> torque = evaluate_vector(effect, term.value, term.at, i, "N m");
  ex power = 0;
  for (const Axis axis : axes()) {
    const ex component = definitions_.define(effect.id + "_torque" + ending(axis), i, torque[axis]);
    add_generalised_force(joint_turning_[axis][i], -component);
    power += component * joint_turning_[axis][i];
  }
  add_energy(effect.id, EnergyItem::kSupplied, power);
}

// Sensor effects act one after the other, in the order of the description. Clock offsets are added.
void Chain::add_sensors() {
  sensor_.seen = {"side", "down", in_plane() ? "angle" : "across"};
  std::vector<ex> seen;
  for (const std::string& name : sensor_.seen) seen.push_back(definitions_.input(name));
  sensor_.clock = time_symbol_;
  for (const Effect& effect : description_.effects) {
    if (!effect.sensor.given()) continue;
    sensor_.given = true;
    ExpressionContext symbols = surroundings(effect, kShape, Place::kAnywhere, 0).known;
    ExpressionContext clock_symbols = symbols;
    const auto add = [&](const std::string& name, const ex& value, const char* unit) {
      // An effect may have a name `across` of its own.
      if (name != "across" || !symbols.symbols.contains(name))
        symbols.add(name, value, Unit::parse(unit));
    };
    for (std::size_t k = 0; k < seen.size(); ++k)
      add(sensor_.seen[k], seen[k], sensor_.seen[k] == "angle" ? "rad" : "m");
    if (in_plane()) add("across", 0, "m");
    for (const Definition& definition : effect.definitions) {
      if (definition.at != Place::kAnywhere) continue;
      for (ExpressionContext* known : {&symbols, &clock_symbols})
        if (has_meaning(definition.value, *known)) add_definition(definition, *known);
    }
    const auto reported = [&](const Expression& by, const ex& before, const char* unit) {
      return by.given() ? parse_expression(by, symbols, Unit::parse(unit)) : before;
    };
    const catena::Sensor& by = effect.sensor;
    const ex side = reported(by.side, seen[0], "m"), down = reported(by.down, seen[1], "m");
    seen[2] = in_plane() ? reported(by.angle, seen[2], "rad") : reported(by.across, seen[2], "m");
    seen[0] = side;
    seen[1] = down;
    if (by.clock.given())
      sensor_.clock += parse_expression(by.clock, clock_symbols, Unit::parse("s")) - time_symbol_;
  }
  for (std::size_t k = 0; k < seen.size(); ++k)
    sensor_.reported.push_back(
        definitions_.named(seen[k], "observed_" + sensor_.seen[k], kNoIndex));
  sensor_.clock = definitions_.named(sensor_.clock, "model_time", kNoIndex);
}

}  // namespace catena
