// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "truth/hidden.hpp"
#include "truth/vector.hpp"

namespace truth {

/// A cable in the plane and its motion from rest, with more links than the models that are fitted
/// to it. It is independent of generator/, generated/ and runtime/: the equations are Newton's for
/// each link, from the tip to the support, and the integrator is the implicit midpoint rule.
struct Cable {
  int links = 24;
  double length = 2.585;    // m
  double density = 0.1424;  // kg/m
  double bending_stiffness =
      0.014;  // EI, N m^2; joint stiffness EI / link length, double at the clamp
  double bending_damping = 0.008;  // N m^2 s; joint damping likewise
  double load_mass = 1.381;        // kg
  double gravity = 9.81;           // m/s^2
};

/// Positions of points on the cable over time.
struct Motion {
  std::vector<double> time;                            // s
  std::vector<double> arc;                             // m from the support, unstretched
  std::vector<std::vector<double>> side, down, angle;  // [time][point], m and rad
};

/// The hidden laws that are in no library (hidden.hpp): what they do at mid-cable, at the load and in
/// the joint at mid-cable, dry friction in every joint, and the motion there.
struct OutsideForces {
  struct AtPoint {
    Vector position, velocity, acceleration;  // m, m/s, m/s^2
    double angle = 0;                         // rad, of the link
    Vector force;                             // N, on the cable or the load
  };
  struct Joint {
    double angle = 0, rate = 0;  // rad, rad/s
    double friction = 0;         // N m, dry, against the rate while the joint slides
  };
  double time = 0;  // s
  AtPoint middle, load;
  double joint_angle = 0, joint_rate = 0, joint_moment = 0;  // rad, rad/s, N m that opens the joint
  struct Tie {
    double distance = 0, rate = 0, force = 0;  // m, m/s, N that parts its two ends
  };
  Tie tie;
  std::vector<Joint> joints;  // the support first
};

struct Integration {
  double step = 2e-4;  // s; half of it changes no marker by more than 0.05 mm
};

/// Absolute angles of the links of a cable hanging between the origin and a held point, released
/// from there: chords of the catenary of the given length. Throws std::invalid_argument if the
/// point is out of reach.
std::vector<double> catenary_angles(const Cable& cable, double held_side, double held_down);

/// The motion from rest at the given link angles, seen at the points `arc` at times `time`
/// (increasing, from 0). Throws std::invalid_argument for a hidden law that only the rod has (rod.hpp),
/// std::runtime_error if the integration fails.
Motion move(const Cable& cable, const Hidden& hidden, const std::vector<double>& start_angles,
            const std::vector<double>& arc, const std::vector<double>& time,
            const Integration& integration = {});

/// What the hidden laws do in the same motion: in the middle of the integrator's step that leads to, or
/// beyond, each of these times.
std::vector<OutsideForces> outside_forces(const Cable& cable, const Hidden& hidden,
                                          const std::vector<double>& start_angles,
                                          const std::vector<double>& time,
                                          const Integration& integration = {});

/// Kinetic plus potential energy over time of the same motion without hidden effects, J, for the
/// tests of this simulator itself.
std::vector<double> mechanical_energy(const Cable& cable, const std::vector<double>& start_angles,
                                      const std::vector<double>& time,
                                      const Integration& integration = {});

}  // namespace truth
