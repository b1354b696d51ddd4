// SPDX-License-Identifier: GPL-3.0-or-later
//
// The coordinates of a chain and where they put its points: the part of Chain that knows no forces.
#include "generator/derivation/chain.hpp"

namespace catena {

using GiNaC::ex;

// The coordinates of the plane: the angle of each link.
void Chain::add_angles() {
  for (auto* family : {&theta_, &theta_dot_, &theta_ddot_}) family->resize(1);
  const auto make = [&](const char* name, std::vector<ex>& family) {
    for (Link i = 1; i <= links_; ++i) family.push_back(definitions_.input(name, i));
  };
  make("theta", theta_);
  make("theta_dot", theta_dot_);
  make("theta_ddot", theta_ddot_);
  sine_.resize(1);
  cosine_.resize(1);
  for (Link i = 1; i <= links_; ++i) {
    add_coordinate(theta_[i], theta_dot_[i], theta_ddot_[i]);
    sine_.push_back(definitions_.define("sine", i, GiNaC::sin(theta_[i])));
    cosine_.push_back(definitions_.define("cosine", i, GiNaC::cos(theta_[i])));
    time_.set(sine_[i], cosine_[i] * theta_dot_[i]);
    time_.set(cosine_[i], -sine_[i] * theta_dot_[i]);
  }
  direction_ = {sine_, cosine_};
}

// The coordinates of space: the components of one vector for each link, made a unit vector. Entry 0 is
// the clamp, which points straight down if nothing turns it.
void Chain::add_directions() {
  for (const Axis axis : axes()) direction_.push_back({axis == kDown ? ex(1) : ex(0)});
  direction_square_.resize(1);
  for (const Axis axis : axes()) {
    const std::string name = "direction" + ending(axis);
    for (Link i = 1; i <= links_; ++i)
      add_coordinate(definitions_.input(name, i), definitions_.input(name + "_dot", i),
                     definitions_.input(name + "_ddot", i));
  }
  for (Link i = 1; i <= links_; ++i) {
    ex square = 0;
    const auto component = [&](Axis axis) {
      return definitions_.input("direction" + ending(axis), i);
    };
    for (const Axis axis : axes()) square += component(axis) * component(axis);
    direction_square_.push_back(define_variable("direction_square", i, square));
    const ex scale =
        definitions_.define("direction_scale", i, inverse_square_root(direction_square_[i]));
    variables_.insert(definitions_.number_of(scale));
    for (const Axis axis : axes())
      direction_[axis].push_back(
          define_variable("unit" + ending(axis), i, scale * component(axis)));
  }
}

void Chain::make_inputs() {
  const auto per_link = [&](const char* family) {
    std::vector<ex> symbols(1);
    for (Link i = 1; i <= links_; ++i) symbols.push_back(definitions_.input(family, i));
    return symbols;
  };
  length_ = per_link("length");
  mass_ = per_link("mass");
  inertia_ = per_link("inertia");
  stiffness_ = per_link("stiffness");
  damping_ = per_link("damping");
  if (in_plane()) torque_ = per_link("torque");
  load_mass_ = definitions_.input("load_mass");
  gravity_ = definitions_.input("gravity");
  time_symbol_ = definitions_.input("time");
  time_.set(time_symbol_, 1);

  if (in_plane()) {
    add_angles();
  } else {
    add_directions();
  }
  for (const Effect& effect : description_.effects) {
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at == Place::kLoad) continue;
      const std::string name = effect.id + "_" + coordinate.name;
      auto& symbols = effect_symbols_[effect.id + "." + coordinate.name];
      symbols.resize(1);
      for (Link i = 1; i <= links_; ++i) {
        symbols.push_back(definitions_.input(name, i));
        add_coordinate(symbols[i], definitions_.input(name + "_dot", i),
                       definitions_.input(name + "_ddot", i));
      }
    }
    for (const ExtraState& state : effect.states) {
      if (state.at == Place::kLoad) {
        effect_symbols_[effect.id + "." + state.name] = {
            definitions_.input(effect.id + "_" + state.name)};
        continue;
      }
      const Link last = state.at == Place::kPivot ? 1 : links_;
      for (const std::string& component : state_components()) {
        auto& symbols = effect_symbols_[effect.id + "." + state.name + component];
        symbols.resize(1);
        for (Link i = 1; i <= last; ++i)
          symbols.push_back(definitions_.input(effect.id + "_" + state.name + component, i));
      }
    }
    if (effect.held_end.holds()) {
      const Link link = effect.held_end.link;
      held_.push_back({&effect, link == 0 ? links_ : link, {}});
      for (const Axis axis : axes()) {
        const std::string name = effect.held_end.named("hold") + ending(axis);
        held_.back().mu.push_back(definitions_.input(name));
        add_border_coordinate(name);
      }
    }
    if (effect.held_end.twists()) path_ = definitions_.input(effect.id + "_twist_of_path");
    for (const SignalChannel& signal : effect.signals) {
      const std::string name = effect.id + "_" + signal.name;
      const ex value = definitions_.input(name);
      const ex rate = definitions_.input(name + "_rate");
      time_.set(value, rate);
      time_.set(rate, definitions_.input(name + "_acceleration"));
    }
  }
  for (const Effect& effect : description_.effects) {
    for (const Coordinate& coordinate : effect.coordinates) {
      if (coordinate.at != Place::kLoad) continue;
      const std::string name = effect.id + "_" + coordinate.name;
      effect_symbols_[effect.id + "." + coordinate.name] = {definitions_.input(name)};
      add_border_coordinate(name);
    }
  }
}

void Chain::add_border_coordinate(const std::string& name) {
  add_coordinate(definitions_.input(name), definitions_.input(name + "_dot"),
                 definitions_.input(name + "_ddot"));
  ++border_;
}

// (2.24)-(2.27), with the changes that effects make
void Chain::make_kinematics() {
  ex support[3];
  for (const Effect& effect : description_.effects) {
    support[kSide] += evaluate(effect, effect.support.side, kShape, Place::kAnywhere, 0, "m");
    support[kDown] += evaluate(effect, effect.support.down, kShape, Place::kAnywhere, 0, "m");
    support[kAcross] += evaluate(effect, effect.support.across, kShape, Place::kAnywhere, 0, "m");
  }
  if (!in_plane()) {
    turn_clamp();
    place_bend_axis();
  }
  for (const Axis axis : axes())
    joint_.push_back({define_variable("joint" + ending(axis), 0, support[axis])});
  span_ = centre_ = middle_ = Points(joint_.size(), std::vector<ex>(1));
  reach_ = joint_angle_ = std::vector<ex>(1);
  arc_ = hanging_depth_ = {ex(0)};

  for (Link i = 1; i <= links_; ++i) {
    const ex extension = kinematic(&Kinematics::extension, "m", Place::kLink, i);
    reach_.push_back(extension.is_zero()
                         ? length_[i]
                         : define_variable("stretched_length", i, length_[i] + extension));
    const ex offset = kinematic(&Kinematics::centre_offset, "m", Place::kLink, i);
    arc_.push_back(definitions_.define("arc", i, arc_[i - 1] + length_[i]));
    for (const Axis axis : axes())
      span_[axis].push_back(
          define_variable("span" + ending(axis), i, reach_[i] * direction_[axis][i]));
    for (const Axis axis : axes())
      middle_[axis].push_back(
          define_variable("centre" + ending(axis), i, joint_[axis][i - 1] + span_[axis][i] / 2));
    for (const Axis axis : axes()) {
      const ex& middle = middle_[axis][i];
      centre_[axis].push_back(offset.is_zero()
                                  ? middle
                                  : define_variable("mass_centre" + ending(axis), i,
                                                    middle + offset * direction_[axis][i]));
    }
    for (const Axis axis : axes())
      joint_[axis].push_back(
          define_variable("joint" + ending(axis), i, joint_[axis][i - 1] + span_[axis][i]));
    if (!in_plane()) continue;
    ex rest = kinematic(&Kinematics::rest_angle, "rad", Place::kJoint, i);
    if (i == 1) rest += kinematic(&Kinematics::pivot_rest_angle, "rad", Place::kPivot, i);
    const ex above = i == 1 ? ex(0) : theta_[i - 1];
    joint_angle_.push_back(define_variable("joint_angle", i, theta_[i] - above - rest));
  }
  const ex load_offset = kinematic(&Kinematics::load_offset, "m", Place::kLoad, 0);
  Expression Kinematics::*const displacement[] = {&Kinematics::load_side, &Kinematics::load_down,
                                                  &Kinematics::load_across};
  for (const Axis axis : axes()) {
    const ex& end = joint_[axis][links_];
    const ex displaced = load_offset * direction_[axis][links_] +
                         kinematic(displacement[axis], "m", Place::kLoad, 0);
    load_.push_back(displaced.is_zero() ? end
                                        : define_shape("load" + ending(axis), end + displaced));
  }
  load_mass_ += kinematic(&Kinematics::load_mass, "kg", Place::kAnywhere, 0);
  load_inertia_ = kinematic(&Kinematics::load_inertia, "kg m^2", Place::kAnywhere, 0);
  const ex tilt = kinematic(&Kinematics::gravity_tilt, "rad", Place::kAnywhere, 0);
  cos_tilt_ =
      tilt.is_zero() ? ex(1) : definitions_.define("tilt_cosine", kNoIndex, GiNaC::cos(tilt));
  sin_tilt_ = tilt.is_zero() ? ex(0) : definitions_.define("tilt_sine", kNoIndex, GiNaC::sin(tilt));

  for (const Effect& effect : description_.effects) place_chord(effect);
  place_held();
  point_ = joint_;
  for (const Axis axis : axes()) point_[axis].push_back(load_[axis]);
}

// The force that hangs below a joint, along the link below it, while all links turn at constant rates: there a joint
// accelerates against the joints above by -rate^2 (its place - theirs). With angular accelerations in it, a
// force of the tension would stand in the mass matrix.
void Chain::add_steady_tensions() {
  const ex plumb[] = {sin_tilt_, cos_tilt_, 0};
  steady_tension_.assign(static_cast<std::size_t>(links_) + 1, 0);
  for (const Axis axis : axes()) {
    const auto always = [&](const char* family, Link i, const ex& value) {
      return definitions_.define_always(family + ending(axis), i, value);
    };
    // Gravity less the acceleration, of the far end of a link and of its mass centre.
    ex end = plumb[axis] * gravity_ - time_.of(time_.of(joint_[axis][0]));
    std::vector<ex> centre(1);
    for (Link i = 1; i <= links_; ++i) {
      const ex offset = kinematic(&Kinematics::centre_offset, "m", Place::kLink, i);
      const ex towards = squared_rate(i) * direction_[axis][i];
      centre.push_back(end + towards * (reach_[i] / 2 + offset));
      end = always("steady_fall", i, end + towards * reach_[i]);
    }
    ex pull = always("steady_pull", links_ + 1, load_mass_ * end);
    for (Link i = links_; i >= 1; --i) {
      pull = always("steady_pull", i, pull + mass_[i] * centre[static_cast<std::size_t>(i)]);
      steady_tension_[static_cast<std::size_t>(i)] += pull * direction_[axis][i];
    }
  }
  for (Link i = 1; i <= links_; ++i) {
    ex& tension = steady_tension_[static_cast<std::size_t>(i)];
    tension = definitions_.define("steady_tension", i, tension);
  }
}

}  // namespace catena
