// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "truth/film_camera.hpp"

namespace truth {

/// time_s, side_i_m, down_i_m; an empty field where a marker was not seen.
void write_markers(const Recording& recording, const std::filesystem::path& path);

/// time_s; of mid-cable and of the load (middle_, load_): side, down, velocity_side, velocity_down, angle,
/// force_side, force_down; joint_angle, joint_rate, joint_moment. In m, m/s, rad, rad/s, N, N m.
void write_outside_forces(const std::vector<OutsideForces>& forces,
                          const std::filesystem::path& path);

/// By which share the case states a known of the cable too large.
struct Stated {
  double length = 0, density = 0, load = 0;

  /// Sets one by its name. Throws std::invalid_argument for another name.
  void set(std::string_view name, double share);
};

/// The cable as the case has it.
Cable as_stated(Cable cable, const Stated& stated);

/// What the case says beside the cable.
struct CaseOptions {
  int links = 24;
  std::vector<std::string> recordings = {"markers.csv"};  // one experiment each
};

/// The case file: geometry, masses and camera are known; stiffness, damping and the smooth shape at
/// the start, at rest, are unknown. With one link it is a bob on a straight string without mass, whose
/// damping and start are unknown, and only its last marker is used.
std::string case_text(const Cable& cable, const Camera& camera, const CaseOptions& options);

/// The truth file: all values, for comparison with what was found. `held`: side and down of the points
/// that the recordings begin from.
std::string truth_text(const Cable& cable, const Hidden& hidden, const Camera& camera,
                       const Stated& stated, const std::vector<std::vector<double>>& held);

/// Throws std::runtime_error if it cannot be written.
void write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace truth
