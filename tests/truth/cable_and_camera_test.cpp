// SPDX-License-Identifier: BSD-3-Clause
//
// The hidden truths must themselves be right: known solutions, conservation, convergence, and for
// every hidden effect that it does something and that its neutral value does nothing.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>
#include <string>

#include "tests/support/near.hpp"
#include "truth/cable.hpp"
#include "truth/film_camera.hpp"
#include "truth/kept_motion.hpp"
#include "truth/random.hpp"

namespace {

using truth::Cable;
using truth::Hidden;

std::vector<double> frames(double duration, double rate) {
  std::vector<double> t;
  for (int i = 0; i <= static_cast<int>(std::lround(duration * rate)); ++i) t.push_back(i / rate);
  return t;
}

double largest_difference(const truth::Motion& a, const truth::Motion& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.time.size(); ++i)
    for (std::size_t k = 0; k < a.arc.size(); ++k)
      worst = std::max(worst, std::hypot(a.side[i][k] - b.side[i][k], a.down[i][k] - b.down[i][k]));
  return worst;
}

TEST_CASE("a single stiff rod with a load swings as a compound pendulum, exact period") {
  Cable rod{.links = 1,
            .length = 0.8,
            .density = 0.5,
            .bending_stiffness = 0,
            .bending_damping = 0,
            .load_mass = 0.3};
  const double amplitude = 1.2;
  const double mass = rod.density * rod.length;
  const double inertia =
      mass * rod.length * rod.length / 3 + rod.load_mass * rod.length * rod.length;
  const double weight = (mass / 2 + rod.load_mass) * rod.length * rod.gravity;
  // T = 4 K(sin(amplitude / 2)) / omega
  const double period =
      4 * std::comp_ellint_1(std::sin(amplitude / 2)) / std::sqrt(weight / inertia);
  const truth::Motion motion =
      truth::move(rod, {}, {amplitude}, {rod.length}, {0, period, 3 * period});
  CHECK(motion.angle[1][0] == catena::near(amplitude, 1e-5));
  CHECK(motion.angle[2][0] == catena::near(amplitude, 1e-5));
  const truth::Motion quarter = truth::move(rod, {}, {amplitude}, {rod.length}, {0, period / 4});
  CHECK(std::abs(quarter.angle[1][0]) < 1e-5);
}

TEST_CASE("without damping the energy stays, with damping it only falls") {
  Cable cable{.bending_damping = 0};
  const auto start = truth::catenary_angles(cable, 1.2, 2.0);
  const auto energy = truth::mechanical_energy(cable, start, frames(3, 30));
  const double swing = 1.381 * 9.81 * 0.5;  // J, about what is exchanged
  for (const double e : energy) CHECK(std::abs(e - energy[0]) < 2e-3 * swing);
  cable.bending_damping = 0.008;
  const auto damped = truth::mechanical_energy(cable, start, frames(3, 30));
  for (std::size_t i = 1; i < damped.size(); ++i) CHECK(damped[i] < damped[i - 1] + 1e-6);
  CHECK(damped.back() < damped.front() - 0.01 * swing);
}

TEST_CASE("the catenary ends at the held point") {
  Cable cable{.links = 200};
  double side = 0, down = 0;
  for (const double a : truth::catenary_angles(cable, 1.2, 2.0)) {
    side += cable.length / cable.links * std::sin(a);
    down += cable.length / cable.links * std::cos(a);
  }
  CHECK(side == catena::near(1.2, 1e-3));
  CHECK(down == catena::near(2.0, 1e-3));
  CHECK_THROWS_AS(truth::catenary_angles(cable, 2.0, 2.0), std::invalid_argument);
}

TEST_CASE("a small angle of a string of many links follows the first mode of a hanging cable") {
  // no load, no bending: omega_1 = j_01 / 2 sqrt(g / L), j_01 the first zero of the Bessel function
  // J_0
  Cable cable{.links = 60,
              .length = 1,
              .density = 0.1,
              .bending_stiffness = 0,
              .bending_damping = 0,
              .load_mass = 0};
  const double j01 = 2.404825557695773;
  std::vector<double> start;
  for (int i = 0; i < cable.links; ++i) {
    // mode shape J_0(j01 sqrt(1 - s)); its slope at the link's middle, J_0' = -J_1
    const double rest = std::sqrt(1 - (i + 0.5) / cable.links);
    start.push_back(0.01 * std::cyl_bessel_j(1, j01 * rest) * j01 / (2 * rest));
  }
  const double period = 2 * std::numbers::pi / (j01 / 2 * std::sqrt(cable.gravity / cable.length));
  const truth::Motion motion = truth::move(cable, {}, start, {0.5, 1.0}, {0, period / 2, period});
  CHECK(motion.side[1][1] == catena::near(-motion.side[0][1], 0.01));
  CHECK(motion.side[2][1] == catena::near(motion.side[0][1], 0.01));
  CHECK(motion.side[2][0] == catena::near(motion.side[0][0], 0.02));
}

TEST_CASE("halving the step moves no marker by more than 0.05 mm") {
  struct Row {
    std::string name;
    double value;
  };
  for (const Row& row :
       {Row{"air_drag_quadratic.normal", 0.2}, Row{"joint_dry_friction.moment", 0.01},
        Row{"axial_stretch.axial_stiffness", 1e4}, Row{"joint_hysteresis.moment", 0.02}}) {
    CAPTURE(row.name);
    Cable cable;
    Hidden hidden;
    truth::set_hidden(hidden, row.name, row.value);
    const auto start = truth::catenary_angles(cable, 1.2, 2.0);
    const auto t = frames(4, 60);
    const auto coarse = truth::move(cable, hidden, start, {1.3, 2.585}, t);
    const auto fine = truth::move(cable, hidden, start, {1.3, 2.585}, t, {.step = 1e-4});
    CHECK(largest_difference(coarse, fine) < 5e-5);
  }
}

TEST_CASE("every hidden effect moves the markers, and nothing moves at its neutral value") {
  struct Row {
    std::string name;
    double value;
  };
  const Row rows[] = {{"air_drag_isotropic.coefficient", 0.05},
                      {"air_drag_linear.normal", 0.05},
                      {"air_drag_linear.tangential", 0.2},
                      {"air_drag_quadratic.normal", 0.05},
                      {"air_drag_quadratic.tangential", 0.2},
                      {"steady_wind.normal", 0.05},
                      {"steady_wind.tangential", 0.1},
                      {"added_mass.normal", 0.02},
                      {"added_mass.tangential", 0.02},
                      {"added_mass.load", 0.1},
                      {"buoyancy.displaced", 0.02},
                      {"buoyancy.load_displaced", 0.2},
                      {"link_damping.coefficient", 0.05},
                      {"load_drag.coefficient", 0.02},
                      {"load_mass.correction", 0.3},
                      {"load_inertia.offset", 0.05},
                      {"load_inertia.about_centre", 0.01},
                      {"joint_dry_friction.moment", 0.01},
                      {"pivot_dry_friction.moment", 0.05},
                      {"joint_damping_quadratic.coefficient", 0.05},
                      {"joint_stiffness_cubic.cubic", 1},
                      {"rest_curvature.curvature", 1},
                      {"pivot_rest_angle.rest", 1},
                      {"pivot_stiffness.change", 0.5},
                      {"pivot_damping.change", 0.1},
                      {"joint_hysteresis.moment", 0.02},
                      {"centre_offset.fraction", 0.2},
                      {"gravity_tilt.tilt", 0.02},
                      {"axial_stretch.axial_stiffness", 1e4},
                      {"support_motion.side_amplitude", 0.01},
                      {"support_motion.down_amplitude", 0.02},
                      {"clock_offset.offset", 0.02},
                      {"scale.factor", 1.02},
                      {"camera_tilt.tilt", 0.01},
                      {"marker_offset.across", 0.01},
                      {"marker_offset.along", 0.01},
                      {"origin_offset.side_shift", 0.01},
                      {"origin_offset.down_shift", 0.01},
                      {"wall_spring.stiffness", 2},
                      {"magnet.strength", 0.05},
                      {"kick.impulse", 0.05},
                      {"gusts.size", 0.1},
                      {"stop.stiffness", 5},
                      {"string.stiffness", 2},
                      {"brake.damping", 0.1},
                      {"joint_stop.stiffness", 1},
                      {"tension_friction.reach", 2e-3},
                      {"leak.rate", 0.1},
                      {"insect.mass", 0.05},
                      {"carried.share", 0.8}};
  const Cable cable{.links = 12};
  const auto start = truth::catenary_angles(cable, 1.2, 2.0);
  const truth::Camera camera{.rate = 30, .duration = 3, .noise = 0};
  const truth::Recording quiet = truth::film(cable, {}, start, camera);
  const auto difference = [&](const Hidden& hidden) {
    const truth::Recording seen = truth::film(cable, hidden, start, camera);
    double worst = 0;
    for (std::size_t i = 0; i < seen.time.size(); ++i)
      for (std::size_t k = 0; k < seen.arc.size(); ++k)
        worst = std::max(worst, std::hypot(seen.side[i][k] - quiet.side[i][k],
                                           seen.down[i][k] - quiet.down[i][k]));
    return worst;
  };
  CHECK(difference({}) == 0);
  for (const Row& row : rows) {
    CAPTURE(row.name);
    Hidden hidden;
    hidden.support_frequency = 0.7;
    hidden.wind = 3;
    truth::set_hidden(hidden, row.name, row.value);
    const double moved = difference(hidden);
    CHECK(moved > 1e-3);
    CHECK(moved < 2.0);
  }
}

TEST_CASE("the camera's noise, loss and pixels are as asked, and the same for the same seed") {
  const Cable cable{.links = 12};
  const auto start = truth::catenary_angles(cable, 1.2, 2.0);
  truth::Camera camera{.rate = 60, .duration = 4, .noise = 1e-3, .lost = 0.05, .seed = 7};
  const auto seen = truth::film(cable, {}, start, camera);
  const auto again = truth::film(cable, {}, start, camera);
  camera.noise = camera.lost = 0;
  const auto exact = truth::film(cable, {}, start, camera);
  double sum = 0;
  int count = 0, missing = 0;
  for (std::size_t i = 0; i < seen.time.size(); ++i)
    for (std::size_t k = 0; k < seen.arc.size(); ++k) {
      if (std::isnan(seen.side[i][k])) {
        ++missing;
        CHECK(std::isnan(again.side[i][k]));
        continue;
      }
      CHECK(seen.side[i][k] == again.side[i][k]);
      sum += std::pow(seen.side[i][k] - exact.side[i][k], 2) +
             std::pow(seen.down[i][k] - exact.down[i][k], 2);
      count += 2;
    }
  CHECK(std::sqrt(sum / count) == catena::near(1e-3, 0.05));
  CHECK(missing > 0.02 * static_cast<double>(seen.time.size() * 12));
  CHECK(missing < 0.10 * static_cast<double>(seen.time.size() * 12));
  camera.pixel = 2e-3;
  const auto rounded = truth::film(cable, {}, start, camera);
  for (const auto& frame : rounded.side)
    for (const double x : frame) CHECK(std::abs(std::remainder(x, 2e-3)) < 1e-12);
}

/// White noise of deviation 1 of 12 marks.
truth::NoiseTable white_noise(std::size_t frames) {
  truth::Random random(3);
  truth::NoiseTable table(frames);
  for (auto& frame : table)
    for (int k = 0; k < 12; ++k) {
      const double side = random.normal();
      frame.push_back({side, random.normal()});
    }
  return table;
}

struct NoiseStatistics {
  double deviation, lag_one, shared, fourth;
};

/// Of the marks from the second on: `shared` is the correlation of neighbours, `fourth` the mean
/// fourth power over the squared mean square.
NoiseStatistics statistics_of(const truth::NoiseTable& table) {
  double squares = 0, lags = 0, shared = 0, fourth = 0, count = 0;
  for (std::size_t i = 1; i < table.size(); ++i)
    for (std::size_t k = 1; k + 1 < table[i].size(); ++k)
      for (const std::size_t d : {0U, 1U}) {
        const double x = table[i][k][d];
        squares += x * x;
        lags += x * table[i - 1][k][d];
        shared += x * table[i][k + 1][d];
        fourth += std::pow(x, 4);
        count += 1;
      }
  return {std::sqrt(squares / count), lags / squares, shared / squares,
          fourth * count / (squares * squares)};
}

TEST_CASE("noise of other kinds is as asked") {
  const truth::NoiseTable white = white_noise(4000);
  const auto of = [&](const truth::NoiseKind& kind) {
    return statistics_of(truth::noise_of_kind(white, kind, 12));  // the first mark is the noisy one
  };
  CHECK(truth::noise_of_kind(white, {}, 12) == white);
  const NoiseStatistics plain = of({});
  CHECK(plain.fourth == catena::near(3, 0.05));
  const NoiseStatistics correlated = of({.autocorrelation = 0.6});
  CHECK(correlated.deviation == catena::near(1, 0.03));
  CHECK(correlated.lag_one == catena::near(0.6, 0.03));
  const NoiseStatistics shaking = of({.shaking = 1});
  CHECK(shaking.deviation == catena::near(std::sqrt(2), 0.05));
  CHECK(shaking.shared == catena::near(0.5, 0.1));
  const NoiseStatistics tails = of({.tails = 5});
  CHECK(tails.deviation == catena::near(1, 0.05));
  CHECK(tails.fourth > 4.5);
  const NoiseStatistics smoothed = of({.smoothed = true});
  CHECK(smoothed.deviation == catena::near(std::sqrt(17.0 / 35), 0.03));
  const NoiseStatistics outliers = of({.outliers = 0.001});
  CHECK(outliers.deviation == catena::near(std::sqrt(1 + 0.4), 0.1));

  const truth::NoiseTable noisy = truth::noise_of_kind(white, {.noisy_marker = 3}, 12);
  CHECK(noisy[17][0][1] == doctest::Approx(3 * white[17][0][1]));
  CHECK(noisy[17][1][1] == white[17][1][1]);
}

}  // namespace

TEST_CASE("a motion that was kept is filmed again with the same bytes, another one is computed") {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("kept_motion_" + std::to_string(getpid()));
  const Cable cable{.links = 4};
  const truth::Camera camera{.rate = 20, .duration = 0.5, .markers = 3};
  int computed = 0;
  const auto filmed = [&](const Hidden& hidden, const truth::Camera& by) {
    const truth::Moves moves = [&](const std::vector<double>& arc,
                                   const std::vector<double>& time) {
      ++computed;
      return truth::move(cable, hidden, truth::catenary_angles(cable, 1.2, 2.0), arc, time);
    };
    return truth::film(cable, hidden,
                       truth::kept(moves, truth::fingerprint(cable, hidden, {}), folder), by);
  };
  const truth::Recording first = filmed({}, camera), again = filmed({}, camera);
  CHECK(computed == 1);
  CHECK(first.side == again.side);
  CHECK(first.down == again.down);
  truth::Camera noisier = camera;
  noisier.seed = 2;
  Hidden seen;  // the camera's own error
  seen.camera_tilt = 0.1;
  CHECK(filmed({}, noisier).side != first.side);
  CHECK(filmed(seen, camera).side != first.side);
  CHECK(computed == 1);
  // Everything that changes the motion, its points or its times.
  truth::Camera faster = camera, more = camera;
  faster.rate = 40;
  more.markers = 4;
  filmed({}, faster);
  filmed({}, more);
  CHECK(computed == 3);
  for (const truth::HiddenParameter& parameter : truth::hidden_parameters()) {
    Hidden other;
    other.*parameter.value += 0.01;
    const bool moves =
        truth::fingerprint(cable, other, {}).number() != truth::fingerprint(cable, {}, {}).number();
    const bool of_camera = parameter.name.starts_with("scale.") ||
                           parameter.name.starts_with("camera_tilt.") ||
                           parameter.name.starts_with("clock_offset.") ||
                           parameter.name.starts_with("marker_offset.") ||
                           parameter.name.starts_with("origin_offset.");
    CAPTURE(parameter.name);
    CHECK(moves == !of_camera);
  }
  for (const auto& file : std::filesystem::directory_iterator(folder))
    std::filesystem::resize_file(file.path(), 100);
  CHECK_THROWS_AS(filmed({}, camera), std::runtime_error);
  std::filesystem::remove_all(folder);
}

TEST_CASE("what the hidden laws in no library do, where they act") {
  const Cable cable{.links = 4};
  Hidden hidden;
  hidden.wall_spring = 0.5;
  hidden.magnet = 0.02;
  hidden.brake = 0.1;
  hidden.joint_stop = 1;
  const auto start = truth::catenary_angles(cable, 1.2, 2.0);
  const std::vector<double> time = frames(1, 1000);
  const auto forces = truth::outside_forces(cable, hidden, start, time);
  REQUIRE(forces.size() == time.size());
  const truth::Motion motion = truth::move(cable, hidden, start, {cable.length}, time);
  double work = 0, largest = 0;
  for (std::size_t i = 1; i < forces.size(); ++i) {
    const truth::OutsideForces& now = forces[i];
    CHECK(now.middle.force.side ==
          catena::near(-0.5 * (now.middle.position.side - hidden.wall_side), 1e-12));
    CHECK(now.middle.force.down == 0);
    // The load is where the motion has it, up to half a step.
    CHECK(std::abs(now.load.position.side - motion.side[i][0]) < 1e-3);
    const double share = now.joint_rate / hidden.brake_rate;
    const double play = std::max(0.0, std::abs(now.joint_angle) - hidden.joint_gap);
    CHECK(now.joint_moment == catena::near(-0.1 * now.joint_rate / (1 + share * share) -
                                               std::copysign(play, now.joint_angle),
                                           1e-12));
    work += (now.time - forces[i - 1].time) * dot(now.load.force, now.load.velocity);
    largest = std::max(largest, norm(now.load.force));
  }
  // A magnet gives what its potential -strength/distance loses.
  const auto potential = [&](const truth::OutsideForces& at) {
    const double away = cable.length + hidden.magnet_depth - at.load.position.down;
    return -hidden.magnet / std::sqrt(std::pow(at.load.position.side, 2) + away * away + 1e-4);
  };
  CHECK(work == catena::near(potential(forces.front()) - potential(forces.back()), 0.01));
  CHECK(largest > 0.1);
}

TEST_CASE("dry friction in every joint, where it slides") {
  const Cable cable{.links = 4};
  Hidden joints, tension;
  joints.joint_friction = 0.01;
  joints.pivot_friction = 0.02;
  tension.tension_friction = 0.003;
  const std::vector<double> start(4, 0.2), time = frames(1, 100);
  for (const truth::OutsideForces& now : truth::outside_forces(cable, joints, start, time)) {
    REQUIRE(now.joints.size() == 4);
    CHECK(now.joints[0].friction == doctest::Approx(0.03));
    CHECK(now.joints[3].friction == doctest::Approx(0.01));
    CHECK(now.joints[2].angle == now.joint_angle);
    CHECK(now.joints[2].rate == now.joint_rate);
  }
  // A straight cable that is let go near the vertical: its tension is nearly the weight below.
  const double link = cable.density * cable.length / 4;
  const truth::OutsideForces first = truth::outside_forces(cable, tension, start, time).front();
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(first.joints[i].friction ==
          catena::near(0.003 * cable.gravity *
                           (cable.load_mass + static_cast<double>(4 - i) * link) * std::cos(0.2),
                       0.01));
}
