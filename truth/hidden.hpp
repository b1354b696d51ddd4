// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace truth {

/// The effects that a recording may contain, one number per parameter, coded by hand. Effects of
/// the library under test have its names; those of the last group are in no library.
struct Hidden {
  // forces per length of cable, at the link centres (n across the link, t along it)
  double drag_isotropic = 0;                                        // kg/m^2
  double drag_linear_normal = 0, drag_linear_tangential = 0;        // N s/m^2
  double drag_quadratic_normal = 0, drag_quadratic_tangential = 0;  // kg/m^2
  double wind = 0, wind_normal = 0, wind_tangential = 0;            // m/s, kg/m^2
  double added_normal = 0, added_tangential = 0;                    // kg/m
  double buoyancy = 0;                                              // kg/m of displaced fluid
  double link_damping = 0;                                          // N s/rad, on a link's own rate
  // at the load
  double load_drag = 0;                             // kg/m
  double load_added_mass = 0, load_buoyancy = 0;    // kg
  double load_mass_extra = 0;                       // kg
  double load_offset = 0, load_rotary_inertia = 0;  // m beyond the cable's end, kg m^2
  // at the joints
  double joint_friction = 0, pivot_friction = 0;          // N m
  double joint_quadratic_damping = 0;                     // N m s^2/rad^2
  double cubic_stiffness = 0;                             // N m/rad^3, every joint
  double rest_curvature = 0;                              // 1/m
  double pivot_rest_angle = 0;                            // rad
  double pivot_stiffness = 0, pivot_damping = 0;          // N m/rad, N m s/rad, added at joint 1
  double hysteresis_moment = 0, hysteresis_reach = 0.02;  // N m, rad (Dahl)
  // the whole cable
  double centre_fraction = 0;      // mass centres past mid-link, share of the link's length
  double gravity_tilt = 0;         // rad
  double axial_stiffness = 0;      // N, force per strain; 0: cannot be stretched
  double axial_relaxation = 1e-3;  // s
  double support_side_amplitude = 0, support_down_amplitude = 0;                 // m
  double support_frequency = 1, support_side_phase = 0, support_down_phase = 0;  // Hz, rad
  // laws of the rod's friction and drag that no model has (rod.hpp)
  double stribeck = 0;  // by how much friction at rest exceeds that in motion, share
  double drag_growth =
      0;  // m/s; drag of slow motion is larger: its coefficient goes with Reynolds' number
  // the camera
  double clock_offset = 0;                     // s
  double scale = 1;                            // 1
  double camera_tilt = 0;                      // rad
  double marker_across = 0, marker_along = 0;  // m
  double origin_side = 0, origin_down = 0;     // m
  // outside every library
  double wall_spring = 0, wall_side = 0.3;  // N/m, m; at mid-cable
  double place_drag = 0;                    // kg/m, at mid-cable
  double magnet = 0, magnet_depth = 0.1;    // N m^2, m below the rest point
  double kick = 0, kick_time = 1.5;         // N s sideways at mid-cable, s
  double push = 0, push_time = 1.5;    // N sideways at mid-cable, begins within 0.5 s of that, s
  double shove = 0, shove_fade = 0.4;  // N sideways at mid-cable from 1.5 s on, s; fades
  double shake = 0,
         shake_period = 0.8;  // N sideways at mid-cable from 1.5 s on, s; one period of a sine
  double gusts = 0, gusts_turn = 0;       // N sideways at mid-cable, rad; five oscillations
  double stop = 0, stop_side = 0.3;       // N/m, m; pushes mid-cable back beyond it
  double string = 0, string_slack = 0.6;  // N/m, m; from mid-cable to a hook, taut when longer
  double string_side = -0.3, string_down = 0.6;  // m, of the hook
  double tie = 0,
         tie_slack = 1;  // N/m, m; from mid-cable to the middle of the last link, taut when longer
  double tie_limit = 0;  // N, of what it holds before it slips; 0: none
  double tie_damping = 0;                  // N s/m, between these two
  double tie_valve = 0;                    // N s/m, the same on their way apart
  double brake = 0, brake_rate = 2;        // N m s/rad, rad/s; eddy brake in mid-joint
  double joint_stop = 0, joint_gap = 0.1;  // N m/rad, rad; play of mid-joint
  double loose = 0, loose_rate = 1;  // N m s/rad, rad/s; a damper of mid-joint beyond that rate
  double vane = 0, vane_speed = 1;   // N s/m, m/s; resists mid-cable beyond that speed
  double valve = 0;                  // N s/m; resists mid-cable on its way to larger sides
  double maxwell = 0, maxwell_lag = 0.3;  // N m/rad, s; spring before a dashpot in mid-joint
  double maxwell_limit = 0;               // N m, of what the spring holds before it slips; 0: none
  double tension_friction = 0;            // m; every joint's friction over its tension
  double eccentric_pull = 0;              // m; the tension pulls beside mid-joint by so much
  double leak = 0;                        // kg/s that the load loses
  double insect = 0;                      // kg at mid-cable
  double carried =
      0;  // share of the load's weight carried by a hand in the first second: a slack start
};

struct HiddenParameter {
  std::string_view name;  // as given on the command line and in the truth file
  double Hidden::*value;
};

/// All of them, in the order of Hidden.
const std::vector<HiddenParameter>& hidden_parameters();

/// Sets one parameter by name. Throws std::invalid_argument for a name not in the list.
void set_hidden(Hidden& hidden, std::string_view name, double value);

}  // namespace truth
