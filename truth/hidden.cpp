// SPDX-License-Identifier: BSD-3-Clause
#include "truth/hidden.hpp"

#include <stdexcept>

namespace truth {

const std::vector<HiddenParameter>& hidden_parameters() {
  static const std::vector<HiddenParameter> list = {
      {"air_drag_isotropic.coefficient", &Hidden::drag_isotropic},
      {"air_drag_linear.normal", &Hidden::drag_linear_normal},
      {"air_drag_linear.tangential", &Hidden::drag_linear_tangential},
      {"air_drag_quadratic.normal", &Hidden::drag_quadratic_normal},
      {"air_drag_quadratic.tangential", &Hidden::drag_quadratic_tangential},
      {"steady_wind.wind", &Hidden::wind},
      {"steady_wind.normal", &Hidden::wind_normal},
      {"steady_wind.tangential", &Hidden::wind_tangential},
      {"added_mass.normal", &Hidden::added_normal},
      {"added_mass.tangential", &Hidden::added_tangential},
      {"added_mass.load", &Hidden::load_added_mass},
      {"buoyancy.displaced", &Hidden::buoyancy},
      {"buoyancy.load_displaced", &Hidden::load_buoyancy},
      {"link_damping.coefficient", &Hidden::link_damping},
      {"load_drag.coefficient", &Hidden::load_drag},
      {"load_mass.correction", &Hidden::load_mass_extra},
      {"load_inertia.offset", &Hidden::load_offset},
      {"load_inertia.about_centre", &Hidden::load_rotary_inertia},
      {"joint_dry_friction.moment", &Hidden::joint_friction},
      {"pivot_dry_friction.moment", &Hidden::pivot_friction},
      {"joint_damping_quadratic.coefficient", &Hidden::joint_quadratic_damping},
      {"joint_stiffness_cubic.cubic", &Hidden::cubic_stiffness},
      {"rest_curvature.curvature", &Hidden::rest_curvature},
      {"pivot_rest_angle.rest", &Hidden::pivot_rest_angle},
      {"pivot_stiffness.change", &Hidden::pivot_stiffness},
      {"pivot_damping.change", &Hidden::pivot_damping},
      {"joint_hysteresis.moment", &Hidden::hysteresis_moment},
      {"joint_hysteresis.reach", &Hidden::hysteresis_reach},
      {"centre_offset.fraction", &Hidden::centre_fraction},
      {"gravity_tilt.tilt", &Hidden::gravity_tilt},
      {"axial_stretch.axial_stiffness", &Hidden::axial_stiffness},
      {"axial_stretch.relaxation", &Hidden::axial_relaxation},
      {"support_motion.side_amplitude", &Hidden::support_side_amplitude},
      {"support_motion.down_amplitude", &Hidden::support_down_amplitude},
      {"support_motion.frequency", &Hidden::support_frequency},
      {"support_motion.side_phase", &Hidden::support_side_phase},
      {"support_motion.down_phase", &Hidden::support_down_phase},
      {"friction_law.stribeck", &Hidden::stribeck},
      {"drag_law.growth", &Hidden::drag_growth},
      {"clock_offset.offset", &Hidden::clock_offset},
      {"scale.factor", &Hidden::scale},
      {"camera_tilt.tilt", &Hidden::camera_tilt},
      {"marker_offset.across", &Hidden::marker_across},
      {"marker_offset.along", &Hidden::marker_along},
      {"origin_offset.side_shift", &Hidden::origin_side},
      {"origin_offset.down_shift", &Hidden::origin_down},
      {"wall_spring.stiffness", &Hidden::wall_spring},
      {"wall_spring.side", &Hidden::wall_side},
      {"place_drag.coefficient", &Hidden::place_drag},
      {"magnet.strength", &Hidden::magnet},
      {"magnet.depth", &Hidden::magnet_depth},
      {"kick.impulse", &Hidden::kick},
      {"kick.time", &Hidden::kick_time},
      {"push.force", &Hidden::push},
      {"push.time", &Hidden::push_time},
      {"shove.force", &Hidden::shove},
      {"shove.fade", &Hidden::shove_fade},
      {"shake.force", &Hidden::shake},
      {"shake.period", &Hidden::shake_period},
      {"gusts.size", &Hidden::gusts},
      {"gusts.turn", &Hidden::gusts_turn},
      {"stop.stiffness", &Hidden::stop},
      {"stop.side", &Hidden::stop_side},
      {"string.stiffness", &Hidden::string},
      {"string.slack", &Hidden::string_slack},
      {"string.side", &Hidden::string_side},
      {"string.down", &Hidden::string_down},
      {"tie.stiffness", &Hidden::tie},
      {"tie.slack", &Hidden::tie_slack},
      {"tie.limit", &Hidden::tie_limit},
      {"tie_damper.damping", &Hidden::tie_damping},
      {"tie_valve.damping", &Hidden::tie_valve},
      {"brake.damping", &Hidden::brake},
      {"brake.rate", &Hidden::brake_rate},
      {"joint_stop.stiffness", &Hidden::joint_stop},
      {"joint_stop.gap", &Hidden::joint_gap},
      {"loose_damper.damping", &Hidden::loose},
      {"loose_damper.rate", &Hidden::loose_rate},
      {"vane.damping", &Hidden::vane},
      {"vane.speed", &Hidden::vane_speed},
      {"valve.damping", &Hidden::valve},
      {"maxwell.stiffness", &Hidden::maxwell},
      {"maxwell.lag", &Hidden::maxwell_lag},
      {"maxwell.limit", &Hidden::maxwell_limit},
      {"tension_friction.reach", &Hidden::tension_friction},
      {"eccentric_pull.lever", &Hidden::eccentric_pull},
      {"leak.rate", &Hidden::leak},
      {"insect.mass", &Hidden::insect},
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
