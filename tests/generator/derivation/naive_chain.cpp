// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/generator/derivation/naive_chain.hpp"

#include <utility>

namespace catena {

using GiNaC::cos;
using GiNaC::ex;
using GiNaC::numeric;
using GiNaC::pow;
using GiNaC::sin;
using GiNaC::sqrt;

namespace {

const numeric kHalf(1, 2);
const numeric kFloor(1, 1000000);  // m/s and rad/s

// |x| as the effects regularise it
ex size_of(const ex& x) { return sqrt(x * x + kFloor * kFloor); }

ex derivative(const ex& expression, const ex& symbol) {
  return expression.diff(GiNaC::ex_to<GiNaC::symbol>(symbol));
}

}  // namespace

bool NaiveChain::knows(const std::string& effect) {
  static const std::set<std::string> known = {"added_mass",
                                              "air_drag_isotropic",
                                              "air_drag_linear",
                                              "air_drag_quadratic",
                                              "axial_stretch",
                                              "buoyancy",
                                              "centre_offset",
                                              "current",
                                              "current_series",
                                              "gravity_tilt",
                                              "joint_damping_quadratic",
                                              "joint_dry_friction",
                                              "joint_hysteresis",
                                              "joint_stiffness_cubic",
                                              "link_damping",
                                              "load_drag",
                                              "load_inertia",
                                              "load_mass",
                                              "pivot_damping",
                                              "pivot_dry_friction",
                                              "pivot_rest_angle",
                                              "pivot_stiffness",
                                              "rest_curvature",
                                              "sea_floor",
                                              "steady_wind",
                                              "support_motion",
                                              "support_series",
                                              "swinging_load"};
  return known.contains(effect);
}

NaiveChain::NaiveChain(int links, std::set<std::string> effects)
    : n_(links), effects_(std::move(effects)) {
  make_coordinates();
  make_shape();
  add_energies();
  for (int i = 1; i <= n_; ++i) {
    add_link_forces(i);
    add_joint_moments(i);
  }
  add_load_forces();
}

ex NaiveChain::symbol(const std::string& name) {
  const auto found = symbols_.find(name);
  if (found != symbols_.end()) return found->second;
  return symbols_[name] = GiNaC::realsymbol(name);
}

ex NaiveChain::symbol(const std::string& family, int i) {
  return symbol(family + "[" + std::to_string(i) + "]");
}

ex NaiveChain::rate(const ex& expression) {
  ex sum = 0;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    sum += derivative(expression, q_[i]) * v_[i] + derivative(expression, v_[i]) * a_[i];
  }
  return sum;
}

void NaiveChain::make_coordinates() {
  const auto add = [&](const std::string& family, int i) {
    const std::string index = i == 0 ? "" : "[" + std::to_string(i) + "]";
    q_.push_back(symbol(family + index));
    v_.push_back(symbol(family + "_dot" + index));
    a_.push_back(symbol(family + "_ddot" + index));
  };
  for (int i = 1; i <= n_; ++i) add("theta", i);
  if (has("axial_stretch")) {
    for (int i = 1; i <= n_; ++i) add("axial_stretch_strain", i);
  }
  if (has("swinging_load")) add("swinging_load_swing", 0);
  // The support moves as prescribed; its rows give the force that makes it.
  add("support_side", 0);
  add("support_down", 0);
  force_.resize(q_.size());
}

GiNaC::exmap NaiveChain::support_motion() {
  const ex t = symbol("time");
  const auto p = [&](const std::string& name) { return parameter("support_motion", name); };
  GiNaC::exmap motion;
  for (const std::string direction : {"side", "down"}) {
    std::vector<ex> values(3);  // and their first two derivatives
    if (has("support_motion")) {
      const ex turn = 2 * GiNaC::Pi * p("frequency");
      const ex phase = turn * t + p(direction + "_phase"), size = p(direction + "_amplitude");
      values = {size * sin(phase), size * turn * cos(phase), -size * turn * turn * sin(phase)};
    }
    const std::string endings[] = {"", "_rate", "_acceleration"}, dots[] = {"", "_dot", "_ddot"};
    for (std::size_t k = 0; k < 3; ++k) {
      if (has("support_series")) {
        values[k] += parameter("support_series", "scale") *
                     symbol("support_series_support_" + direction + endings[k]);
      }
      motion[symbol("support_" + direction + dots[k])] = values[k];
    }
  }
  return motion;
}

void NaiveChain::make_shape() {
  if (has("gravity_tilt")) tilt_ = parameter("gravity_tilt", "tilt");

  ex at_side = symbol("support_side"), at_down = symbol("support_down");
  side = {at_side};
  down = {at_down};
  middle_side_ = middle_down_ = centre_side_ = centre_down_ = rest_ = {ex(0)};
  for (int i = 1; i <= n_; ++i) {
    const ex theta = symbol("theta", i), nominal = symbol("length", i);
    ex length = nominal;
    if (has("axial_stretch")) length = nominal * (1 + symbol("axial_stretch_strain", i));
    ex centre = length / 2;
    if (has("centre_offset")) centre += parameter("centre_offset", "fraction") * nominal;
    middle_side_.push_back(at_side + length / 2 * sin(theta));
    middle_down_.push_back(at_down + length / 2 * cos(theta));
    centre_side_.push_back(at_side + centre * sin(theta));
    centre_down_.push_back(at_down + centre * cos(theta));
    at_side += length * sin(theta);
    at_down += length * cos(theta);
    side.push_back(at_side);
    down.push_back(at_down);
    ex rest = 0;
    if (has("rest_curvature")) {
      const ex spacing = i == 1 ? nominal / 2 : (symbol("length", i - 1) + nominal) / 2;
      rest += parameter("rest_curvature", "curvature") * spacing;
    }
    if (i == 1 && has("pivot_rest_angle")) rest += parameter("pivot_rest_angle", "rest");
    rest_.push_back(rest);
  }
  if (has("load_inertia")) {
    const ex offset = parameter("load_inertia", "offset"), theta = symbol("theta", n_);
    at_side += offset * sin(theta);
    at_down += offset * cos(theta);
  }
  if (has("swinging_load")) {
    const ex reach = parameter("swinging_load", "reach"), swing = symbol("swinging_load_swing");
    at_side += reach * sin(swing);
    at_down += reach * cos(swing);
  }
  side.push_back(at_side);
  down.push_back(at_down);
}

void NaiveChain::add_energies() {
  const ex g = symbol("gravity");
  // How deep a point lies along gravity
  const auto depth = [&](const ex& s, const ex& d) { return d * cos(tilt_) + s * sin(tilt_); };
  const auto squared_speed = [&](const ex& s, const ex& d) {
    const ex vs = rate(s), vd = rate(d);
    return vs * vs + vd * vd;
  };
  for (int i = 1; i <= n_; ++i) {
    const ex m = symbol("mass", i), theta = symbol("theta", i), w = symbol("theta_dot", i);
    const ex l = symbol("length", i), above = i == 1 ? ex(0) : symbol("theta", i - 1);
    const ex angle = theta - above - rest_[i];
    kinetic_ += kHalf * m * squared_speed(centre_side_[i], centre_down_[i]) +
                kHalf * symbol("inertia", i) * w * w;
    potential_ += -m * g * depth(centre_side_[i], centre_down_[i]) +
                  kHalf * symbol("stiffness", i) * angle * angle;
    if (has("joint_stiffness_cubic")) {
      potential_ += parameter("joint_stiffness_cubic", "cubic") / 4 * pow(angle, 4);
    }
    if (i == 1 && has("pivot_stiffness")) {
      potential_ += parameter("pivot_stiffness", "change") / 2 * angle * angle;
    }
    if (has("added_mass")) {
      const ex vs = rate(middle_side_[i]), vd = rate(middle_down_[i]);
      const ex across = vs * cos(theta) - vd * sin(theta);
      const ex along = vs * sin(theta) + vd * cos(theta);
      kinetic_ += kHalf * l *
                  (parameter("added_mass", "normal") * across * across +
                   parameter("added_mass", "tangential") * along * along);
    }
    if (has("buoyancy")) {
      potential_ +=
          parameter("buoyancy", "displaced") * l * g * depth(middle_side_[i], middle_down_[i]);
    }
    if (has("sea_floor")) {
      const ex sunk = floor_at(middle_side_[i], middle_down_[i]).sunk;
      potential_ += kHalf * parameter("sea_floor", "firmness") * l * sunk * sunk;
    }
    if (has("axial_stretch")) {
      const ex strain = symbol("axial_stretch_strain", i);
      potential_ += kHalf * parameter("axial_stretch", "axial_stiffness") * l * strain * strain;
    }
  }
  ex load = symbol("load_mass");
  if (has("load_mass")) load += parameter("load_mass", "correction");
  const ex s = side.back(), d = down.back(), w = symbol("theta_dot", n_);
  kinetic_ += kHalf * load * squared_speed(s, d);
  potential_ += -load * g * depth(s, d);
  if (has("load_inertia")) {
    kinetic_ += kHalf * parameter("load_inertia", "about_centre") * w * w;
  }
  if (has("swinging_load")) {
    const ex swing_rate = symbol("swinging_load_swing_dot");
    kinetic_ += kHalf * parameter("swinging_load", "about_centre") * swing_rate * swing_rate;
  }
  if (has("added_mass")) kinetic_ += kHalf * parameter("added_mass", "load") * squared_speed(s, d);
  if (has("buoyancy")) potential_ += parameter("buoyancy", "load_displaced") * g * depth(s, d);
  if (has("sea_floor")) {
    const ex sunk = floor_at(s, d).sunk;
    potential_ += kHalf * parameter("sea_floor", "load_firmness") * sunk * sunk;
  }
}

void NaiveChain::add_force(const ex& at_side, const ex& at_down, const ex& force_side,
                           const ex& force_down) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    force_[i] += force_side * derivative(at_side, q_[i]) + force_down * derivative(at_down, q_[i]);
  }
}

void NaiveChain::add_joint_moment(int joint, const ex& moment) {
  force_[static_cast<std::size_t>(joint) - 1] += moment;
  if (joint > 1) force_[static_cast<std::size_t>(joint) - 2] -= moment;
}

void NaiveChain::add_link_forces(int i) {
  const ex l = symbol("length", i), theta = symbol("theta", i);
  const ex s = middle_side_[i], d = middle_down_[i], vs = rate(s), vd = rate(d);
  // normal and tangential components to side and down
  const auto add_components = [&](const ex& normal, const ex& tangential) {
    add_force(s, d, normal * cos(theta) + tangential * sin(theta),
              -normal * sin(theta) + tangential * cos(theta));
  };
  const auto across = [&](const ex& us, const ex& ud) -> ex {
    return us * cos(theta) - ud * sin(theta);
  };
  const auto along = [&](const ex& us, const ex& ud) -> ex {
    return us * sin(theta) + ud * cos(theta);
  };
  if (has("air_drag_linear")) {
    add_components(-l * parameter("air_drag_linear", "normal") * across(vs, vd),
                   -l * parameter("air_drag_linear", "tangential") * along(vs, vd));
  }
  const auto add_quadratic = [&](const std::string& effect, const ex& us, const ex& ud) {
    const ex un = across(us, ud), ut = along(us, ud);
    add_components(-l * parameter(effect, "normal") * size_of(un) * un,
                   -l * parameter(effect, "tangential") * size_of(ut) * ut);
  };
  if (has("air_drag_quadratic")) add_quadratic("air_drag_quadratic", vs, vd);
  if (has("steady_wind")) add_quadratic("steady_wind", vs - parameter("steady_wind", "wind"), vd);
  for (const std::string effect : {"current", "current_series"}) {
    if (!has(effect)) continue;
    const Fluid fluid = fluid_at(effect, s, d);
    const ex us = vs - fluid.side, un = across(us, vd), ut = along(us, vd);
    const ex size = sqrt(un * un + fluid.across * fluid.across + kFloor * kFloor);
    add_components(-l * parameter(effect, "normal") * size * un,
                   -l * parameter(effect, "tangential") * size_of(ut) * ut);
  }
  if (has("air_drag_isotropic")) {
    const ex speed = sqrt(vs * vs + vd * vd + kFloor * kFloor);
    const ex c = l * parameter("air_drag_isotropic", "coefficient");
    add_force(s, d, -c * speed * vs, -c * speed * vd);
  }
  if (has("sea_floor")) {
    const Floor floor = floor_at(s, d);
    const ex push = parameter("sea_floor", "firmness") * floor.sunk * floor.touch;
    add_force(s, d, -l * parameter("sea_floor", "friction") * push * slip(vs),
              -l * parameter("sea_floor", "resistance") * floor.touch * vd);
  }
  const std::size_t row = static_cast<std::size_t>(i) - 1;
  if (has("link_damping")) {
    force_[row] -= parameter("link_damping", "coefficient") * l * symbol("theta_dot", i);
  }
  if (has("axial_stretch")) {
    const ex viscosity =
        parameter("axial_stretch", "axial_stiffness") * parameter("axial_stretch", "relaxation");
    force_[row + static_cast<std::size_t>(n_)] -=
        viscosity * l * symbol("axial_stretch_strain_dot", i);
  }
  force_[row] += symbol("torque", i);
}

void NaiveChain::add_joint_moments(int i) {
  const ex above = i == 1 ? ex(0) : symbol("theta_dot", i - 1);
  const ex w = symbol("theta_dot", i) - above;
  add_joint_moment(i, -symbol("damping", i) * w);
  const numeric scale(1, 100);
  const auto dry = [&](const ex& moment) -> ex {
    return -moment * w / sqrt(w * w + scale * scale);
  };
  if (has("joint_dry_friction")) {
    add_joint_moment(i, dry(parameter("joint_dry_friction", "moment")));
  }
  if (has("joint_damping_quadratic")) {
    add_joint_moment(i, -parameter("joint_damping_quadratic", "coefficient") * size_of(w) * w);
  }
  if (has("joint_hysteresis")) {
    add_joint_moment(i, -parameter("joint_hysteresis", "moment") *
                            symbol("joint_hysteresis_slip", i) /
                            parameter("joint_hysteresis", "reach"));
  }
  if (i == 1 && has("pivot_dry_friction")) {
    add_joint_moment(i, dry(parameter("pivot_dry_friction", "moment")));
  }
  if (i == 1 && has("pivot_damping")) {
    add_joint_moment(i, -parameter("pivot_damping", "change") * w);
  }
}

// Parallel to side and across, as these effects have it at a depth
NaiveChain::Fluid NaiveChain::fluid_at(const std::string& effect, const ex& s, const ex& d) {
  const ex depth = d * cos(tilt_) + s * sin(tilt_);
  if (effect == "current_series") {
    const auto speed = [&](const std::string& axis) -> ex {
      return symbol("current_series_current_" + axis) +
             depth * symbol("current_series_current_" + axis + "_shear");
    };
    return {speed("side"), speed("across")};
  }
  const ex height = 1 - depth / parameter(effect, "bed");
  const ex profile =
      GiNaC::exp(parameter(effect, "exponent") / 2 * GiNaC::log(height * height + kFloor));
  return {parameter(effect, "side_speed") * profile, parameter(effect, "across_speed") * profile};
}

// How far a point is sunk into the floor, and its derivative by the depth
NaiveChain::Floor NaiveChain::floor_at(const ex& s, const ex& d) {
  const ex below = d * cos(tilt_) + s * sin(tilt_) - parameter("sea_floor", "bed");
  const ex size = sqrt(below * below + pow(parameter("sea_floor", "rounding"), 2));
  return {kHalf * (below + size), kHalf * (1 + below / size)};
}

// The direction of sliding, smooth at rest
ex NaiveChain::slip(const ex& speed) {
  const numeric scale(1, 1000);
  return speed / sqrt(speed * speed + scale * scale);
}

void NaiveChain::add_load_forces() {
  const ex s = side.back(), d = down.back(), vs = rate(s), vd = rate(d);
  if (has("sea_floor")) {
    const Floor floor = floor_at(s, d);
    const ex push = parameter("sea_floor", "load_firmness") * floor.sunk * floor.touch;
    add_force(s, d, -parameter("sea_floor", "friction") * push * slip(vs), 0);
  }
  for (const std::string effect : {"current", "current_series"}) {
    if (!has(effect)) continue;
    const Fluid fluid = fluid_at(effect, s, d);
    const ex us = vs - fluid.side;
    const ex size = sqrt(us * us + vd * vd + fluid.across * fluid.across + kFloor * kFloor);
    add_force(s, d, -parameter(effect, "load") * size * us, -parameter(effect, "load") * size * vd);
  }
  if (has("swinging_load")) {
    const ex moment = parameter("swinging_load", "hinge_damping") *
                      (symbol("swinging_load_swing_dot") - symbol("theta_dot", n_));
    force_[static_cast<std::size_t>(n_) - 1] += moment;
    force_[force_.size() - 3] -= moment;  // before the two of the support
  }
  if (!has("load_drag")) return;
  const ex c = parameter("load_drag", "coefficient") * sqrt(vs * vs + vd * vd + kFloor * kFloor);
  add_force(s, d, -c * vs, -c * vd);
}

std::vector<ex> NaiveChain::rows() {
  std::vector<ex> rows;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    rows.push_back(rate(derivative(kinetic_, v_[i])) - derivative(kinetic_, q_[i]) +
                   derivative(potential_, q_[i]) - force_[i]);
  }
  return rows;
}

std::vector<ex> NaiveChain::residual() {
  std::vector<ex> residual = rows();
  residual.resize(residual.size() - 2);
  return residual;
}

std::vector<ex> NaiveChain::state_rates() {
  std::vector<ex> rates;
  if (!has("joint_hysteresis")) return rates;
  for (int i = 1; i <= n_; ++i) {
    const ex above = i == 1 ? ex(0) : symbol("theta_dot", i - 1);
    const ex w = symbol("theta_dot", i) - above, slip = symbol("joint_hysteresis_slip", i);
    rates.push_back(w - slip * size_of(w) / parameter("joint_hysteresis", "reach"));
  }
  return rates;
}

ex NaiveChain::power() {
  ex sum = 0;
  for (std::size_t i = 0; i < q_.size(); ++i) sum += force_[i] * v_[i];
  return sum;
}

ex NaiveChain::support_power() {
  const std::vector<ex> all = rows();
  const std::size_t last = all.size() - 1;
  return all[last - 1] * v_[last - 1] + all[last] * v_[last];
}

}  // namespace catena
