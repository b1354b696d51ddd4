// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace truth {

/// What may be hidden in a recording: one number per parameter, coded here by hand. The names are
/// those of the library under test where it has such an effect; the last group is in no library.
struct Hidden {
  // forces per length of cable, at the link centres (t along the link, n across it)
  double drag_linear_normal = 0, drag_linear_tangential = 0;        // N s/m^2
  double drag_quadratic_normal = 0, drag_quadratic_tangential = 0;  // kg/m^2
  double wind_speed = 0, wind_drag = 0;                             // m/s, kg/m^2
  double added_mass = 0;                                            // kg/m, across the link
  double buoyancy = 0;                                              // kg/m of displaced fluid
  // at the load
  double load_drag = 0;                             // kg/m
  double load_mass_extra = 0;                       // kg
  double load_offset = 0, load_rotary_inertia = 0;  // m beyond the cable's end, kg m^2
  // at the joints
  double joint_friction = 0, pivot_friction = 0;          // N m
  double cubic_stiffness = 0;                             // N m/rad^3, every joint
  double rest_curvature = 0;                              // 1/m
  double pivot_stiffness = 0, pivot_damping = 0;          // N m/rad, N m s/rad, added at joint 1
  double hysteresis_moment = 0, hysteresis_angle = 0.02;  // N m, rad (Dahl)
  // the whole
  double centre_offset = 0;                                       // m, along each link
  double gravity_tilt = 0;                                        // rad
  double axial_compliance = 0;                                    // 1/N; strain per tension
  double support_side_amplitude = 0, support_down_amplitude = 0;  // m
  double support_frequency = 0, support_phase = 0;                // Hz, rad
  // what the camera does
  double clock_offset = 0;                                // s
  double scale = 1;                                       // 1
  double camera_tilt = 0;                                 // rad
  double camera_offset_side = 0, camera_offset_down = 0;  // m
  // outside every library
  double wall_spring = 0, wall_side = 0.3;  // N/m, m; at mid-cable
  double magnet = 0, magnet_depth = 0.1;    // N m^2, m below the rest point
  double kick = 0, kick_time = 1.5;         // N s sideways at mid-cable, s
  double carried = 0;  // share of the load's weight carried by a hand in the first second
};

struct HiddenParameter {
  std::string_view name;  // as given on the command line and in the truth file
  double Hidden::*value;
};

const std::vector<HiddenParameter>& hidden_parameters();

/// Sets one parameter by name. Throws std::invalid_argument for a name not in the list.
void set_hidden(Hidden& hidden, std::string_view name, double value);

}  // namespace truth
