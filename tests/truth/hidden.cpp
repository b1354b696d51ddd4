// SPDX-License-Identifier: BSD-3-Clause
#include "tests/truth/hidden.hpp"

#include <stdexcept>

namespace truth {

const std::vector<HiddenParameter>& hidden_parameters() {
  static const std::vector<HiddenParameter> list = {
      {"air_drag_linear.normal", &Hidden::drag_linear_normal},
      {"air_drag_linear.tangential", &Hidden::drag_linear_tangential},
      {"air_drag_quadratic.normal", &Hidden::drag_quadratic_normal},
      {"air_drag_quadratic.tangential", &Hidden::drag_quadratic_tangential},
      {"steady_wind.speed", &Hidden::wind_speed},
      {"steady_wind.drag", &Hidden::wind_drag},
      {"added_mass.normal", &Hidden::added_mass},
      {"buoyancy.displaced", &Hidden::buoyancy},
      {"load_drag.coefficient", &Hidden::load_drag},
      {"load_mass.correction", &Hidden::load_mass_extra},
      {"load_inertia.offset", &Hidden::load_offset},
      {"load_inertia.inertia", &Hidden::load_rotary_inertia},
      {"joint_dry_friction.moment", &Hidden::joint_friction},
      {"pivot_dry_friction.moment", &Hidden::pivot_friction},
      {"joint_stiffness_cubic.coefficient", &Hidden::cubic_stiffness},
      {"rest_curvature.curvature", &Hidden::rest_curvature},
      {"pivot_stiffness.extra", &Hidden::pivot_stiffness},
      {"pivot_damping.extra", &Hidden::pivot_damping},
      {"joint_hysteresis.moment", &Hidden::hysteresis_moment},
      {"joint_hysteresis.angle", &Hidden::hysteresis_angle},
      {"centre_offset.offset", &Hidden::centre_offset},
      {"gravity_tilt.angle", &Hidden::gravity_tilt},
      {"axial_stretch.compliance", &Hidden::axial_compliance},
      {"support_motion.side", &Hidden::support_side_amplitude},
      {"support_motion.down", &Hidden::support_down_amplitude},
      {"support_motion.frequency", &Hidden::support_frequency},
      {"support_motion.phase", &Hidden::support_phase},
      {"clock_offset.offset", &Hidden::clock_offset},
      {"scale.factor", &Hidden::scale},
      {"camera_tilt.angle", &Hidden::camera_tilt},
      {"marker_offset.side", &Hidden::camera_offset_side},
      {"marker_offset.down", &Hidden::camera_offset_down},
      {"wall_spring.stiffness", &Hidden::wall_spring},
      {"wall_spring.side", &Hidden::wall_side},
      {"magnet.strength", &Hidden::magnet},
      {"magnet.depth", &Hidden::magnet_depth},
      {"kick.impulse", &Hidden::kick},
      {"kick.time", &Hidden::kick_time},
      {"carried.share", &Hidden::carried},
  };
  return list;
}

void set_hidden(Hidden& hidden, std::string_view name, double value) {
  for (const HiddenParameter& parameter : hidden_parameters())
    if (parameter.name == name) {
      hidden.*parameter.value = value;
      return;
    }
  throw std::invalid_argument("no hidden parameter is called '" + std::string(name) + "'");
}

}  // namespace truth
