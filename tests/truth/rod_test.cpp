// SPDX-License-Identifier: BSD-3-Clause
//
// The elastic rod as a truth: held against the chain of many links, which is coded apart, and against
// itself with finer steps and elements.
#include "truth/rod.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "tests/support/near.hpp"
#include "truth/files.hpp"
#include "truth/film_camera.hpp"

namespace rod_test {
namespace {

using truth::Cable;
using truth::Hidden;
using truth::Motion;

const Cable kCable{.links = 36,
                   .length = 1.2,
                   .bending_stiffness = 0.1,
                   .bending_damping = 0.01,
                   .load_mass = 0.2};
const std::vector<double> kHeld = {0.6, 0.9};
const std::vector<double> kArc = {0.3, 0.6, 0.9, 1.2};

std::vector<double> frames(double duration) {
  std::vector<double> t;
  for (int i = 0; i <= static_cast<int>(std::lround(30 * duration)); ++i) t.push_back(i / 30.0);
  return t;
}

double largest_difference(const Motion& a, const Motion& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i)
    for (std::size_t k = 0; k < a.arc.size(); ++k)
      worst = std::max(worst, std::hypot(a.side[i][k] - b.side[i][k], a.down[i][k] - b.down[i][k]));
  return worst;
}

Motion moved(const Hidden& hidden, double duration = 2) {
  return truth::move_rod(kCable, hidden, kHeld, kArc, frames(duration));
}

/// Of the lowest mark in the last two seconds, m.
double last_swing(const Motion& motion) {
  double largest = 0;
  for (std::size_t i = motion.side.size() - 60; i < motion.side.size(); ++i)
    largest = std::max(largest, std::abs(motion.side[i].back()));
  return largest;
}

}  // namespace

TEST_CASE("a chain of many links follows the rod, plain and in wind, drag and with a bent shape") {
  Cable many = kCable;
  many.links = 120;
  Hidden all;
  all.drag_quadratic_normal = 0.1;
  all.wind_normal = 0.05;
  all.wind = 2;
  all.load_drag = 0.02;
  all.rest_curvature = 0.5;
  all.load_mass_extra = 0.02;
  all.gravity_tilt = 0.05;
  all.support_side_amplitude = 0.02;
  all.support_frequency = 1.3;
  for (const Hidden& hidden : {Hidden{}, all}) {
    std::vector<double> middles;
    for (int i = 0; i < many.links; ++i) middles.push_back((i + 0.5) * many.length / many.links);
    const Motion start = truth::move_rod(kCable, hidden, kHeld, middles, {0});
    const Motion chain = truth::move(many, hidden, start.angle[0], kArc, frames(2));
    CHECK(largest_difference(moved(hidden), chain) < 6e-4);
  }
}

TEST_CASE("half the step and twice the elements change little") {
  Hidden hidden;
  hidden.joint_friction = 0.01;
  hidden.hysteresis_moment = 0.02;
  const Motion once = moved(hidden);
  CHECK(largest_difference(
            once, truth::move_rod(kCable, hidden, kHeld, kArc, frames(2), {.step = 1e-4})) < 5e-5);
  Cable finer = kCable;
  finer.links = 72;
  CHECK(largest_difference(moved({}), truth::move_rod(finer, {}, kHeld, kArc, frames(2))) < 4e-4);
}

TEST_CASE(
    "friction takes the swing away, then sticks: what is left swings faster, as of a stiffer rod") {
  Hidden hidden;
  hidden.joint_friction = 0.1;
  const Motion stuck = moved(hidden, 20), free = moved({}, 20);
  struct Swing {
    double largest = 0;  // m, of the last seconds
    int crossings = 0;
  };
  const auto last_seconds = [](const Motion& motion) {
    Swing swing;
    const std::size_t end = motion.side.size();
    for (std::size_t i = end - 240; i + 1 < end; ++i) {
      const double here = motion.side[i].back(), next = motion.side[i + 1].back();
      swing.largest = std::max(swing.largest, std::abs(here));
      swing.crossings += (here < 0) != (next < 0);
    }
    return swing;
  };
  const Swing slow = last_seconds(free), fast = last_seconds(stuck);
  CHECK(fast.largest < 0.3 * slow.largest);
  CHECK(fast.crossings > slow.crossings);
}

TEST_CASE("friction that is larger at rest holds the cable farther from plumb in the end") {
  const auto stuck_at = [](const Motion& motion) { return std::abs(motion.side.back().back()); };
  const auto with = [](double stribeck) {
    Hidden hidden;
    hidden.joint_friction = 0.1;
    hidden.stribeck = stribeck;
    return moved(hidden, 20);
  };
  const Motion plain = with(0), lugre = with(1e-9), larger = with(1);
  // Without excess the two laws differ only before friction slips.
  CHECK(largest_difference(plain, lugre) < 0.25 * largest_difference(plain, moved({}, 20)));
  CHECK(stuck_at(larger) > 1.1 * stuck_at(lugre));
}

TEST_CASE("a drag whose coefficient goes with Reynolds' number lies between two constant ones") {
  const auto end_of = [](double coefficient, double growth) {
    Hidden hidden;
    hidden.drag_quadratic_normal = coefficient;
    hidden.drag_growth = growth;
    return last_swing(moved(hidden, 4));
  };
  const double grown = end_of(0.1, 0.08);  // at 1 m/s the coefficient is 1.19 times as large
  CHECK(grown < end_of(0.105, 0));
  CHECK(grown > end_of(0.2, 0));
}

TEST_CASE("every hidden effect of the rod moves it; what is not coded is refused") {
  const Motion quiet = moved({}, 1);
  for (const auto& effect : {std::pair<std::string, double>("air_drag_isotropic.coefficient", 0.05),
                             {"air_drag_linear.normal", 0.05},
                             {"air_drag_linear.tangential", 0.2},
                             {"air_drag_quadratic.normal", 0.05},
                             {"air_drag_quadratic.tangential", 1.0},
                             {"steady_wind.normal", 0.05},
                             {"steady_wind.tangential", 0.1},
                             {"load_drag.coefficient", 0.05},
                             {"load_mass.correction", 0.2},
                             {"joint_dry_friction.moment", 0.01},
                             {"rest_curvature.curvature", 0.5},
                             {"joint_hysteresis.moment", 0.02},
                             {"gravity_tilt.tilt", 0.02},
                             {"axial_stretch.axial_stiffness", 200.0},
                             {"support_motion.side_amplitude", 0.01},
                             {"support_motion.down_amplitude", 0.02}}) {
    CAPTURE(effect.first);
    Hidden hidden;
    hidden.wind = 3;
    truth::set_hidden(hidden, effect.first, effect.second);
    const double by = largest_difference(moved(hidden, 1), quiet);
    CHECK(by > 1e-3);
    CHECK(by < 1);
  }
  Hidden unknown;
  unknown.pivot_friction = 0.1;
  CHECK_THROWS_AS(moved(unknown), std::invalid_argument);
  Hidden of_rods;
  of_rods.stribeck = 0.5;
  CHECK_THROWS_AS(truth::move(kCable, of_rods, std::vector<double>(36, 0.1), kArc, {0}),
                  std::invalid_argument);
}

TEST_CASE("lens, shutter, misplaced marks and wrong knowns are as asked") {
  // Points that stand still, and one that falls.
  const truth::Moves still = [](const std::vector<double>& arc, const std::vector<double>& time) {
    Motion motion{.time = time, .arc = arc, .side = {}, .down = {}, .angle = {}};
    for (const double t : time) {
      motion.side.emplace_back(arc.size(), 0.4);
      motion.down.push_back(arc);
      motion.down.back().back() = 0.6 + t;
      motion.angle.emplace_back(arc.size(), 0.0);
    }
    return motion;
  };
  truth::Camera camera{.rate = 10, .duration = 0.5, .markers = 4, .noise = 0};
  const truth::Recording plain = truth::film(kCable, {}, still, camera);
  CHECK(plain.down[1].back() == doctest::Approx(0.7));
  camera.shutter = 0.02;  // it is read where it is then: half way and more down the picture
  const truth::Recording rolled = truth::film(kCable, {}, still, camera);
  CHECK(rolled.down[1].back() == doctest::Approx(0.7 + 0.02 * 0.7 / 1.2));
  CHECK(rolled.down[1].front() == plain.down[1].front());
  camera.shutter = 0;
  camera.lens = 0.01;
  const truth::Recording bent = truth::film(kCable, {}, still, camera);
  const double square =
      (0.4 * 0.4 + 0.3 * 0.3) / (1.2 * 1.2);  // the mark at 0.3 m, middle at 0.6 m
  CHECK(bent.side[0][0] == doctest::Approx(0.4 * (1 + 0.01 * square)));
  CHECK(bent.down[0][0] == doctest::Approx(0.6 - 0.3 * (1 + 0.01 * square)));
  camera.lens = 0;
  camera.misplaced = 3e-3;
  camera.markers = 400;
  const truth::Recording off = truth::film(kCable, {}, still, camera);
  double squares = 0;
  for (std::size_t k = 0; k + 1 < off.arc.size(); ++k)
    squares += std::pow(off.down[0][k] - off.arc[k], 2);
  CHECK(std::sqrt(squares / 399) == catena::near(3e-3, 0.1));
  CHECK(off.arc[0] == doctest::Approx(1.2 / 400));  // where the case has it

  truth::Stated stated;
  stated.set("length", 0.01);
  stated.set("density", -0.02);
  stated.set("load", 0.03);
  const Cable wrong = truth::as_stated(kCable, stated);
  CHECK(wrong.length == doctest::Approx(1.01 * kCable.length));
  CHECK(wrong.density == doctest::Approx(0.98 * kCable.density));
  CHECK(wrong.load_mass == doctest::Approx(1.03 * kCable.load_mass));
  CHECK(wrong.bending_stiffness == kCable.bending_stiffness);
  CHECK_THROWS_AS(stated.set("stiffness", 0.1), std::invalid_argument);
}

}  // namespace rod_test
