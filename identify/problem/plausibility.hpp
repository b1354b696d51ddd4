// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"
#include "identify/recordings/recording.hpp"
#include "runtime/model.hpp"

namespace catena {

/// What a hanging cable cannot do, or hardly ever does. Lengths are shares of what the case says,
/// times are in periods of a pendulum as long as the cable. Beyond "hardly" there is a warning, and
/// beyond "not" an error. The errors leave room for what a camera or a clamp does to a recording.
struct PlausibilityLimits {
  /// Chord over arc between neighbouring markers. A chord is never longer; cameras are calibrated to
  /// some per cent, and clamps give. It is shorter where the cable is bent or leaves its plane.
  double hardly_longer = 1.1, not_longer = 1.3;
  double hardly_shorter = 0.7, not_shorter = 0.1;
  /// A marker beyond its arc length from the support, in lengths of the cable: so much more for an
  /// origin that is marked by hand.
  double hardly_beyond = 0.03, not_beyond = 0.1;
  /// The last marker, in lengths of the cable: below it most of the cable is not seen.
  double least_marked = 0.5;
  /// rad: the mean direction from the first to the last marker, from the downward vertical. A cable
  /// that swings freely hangs down on average.
  double hardly_sideways = 1.2, hardly_upwards = 2.0;
  /// How far a marker moves, in lengths of the cable, while one that is at most twice as far from the support
  /// cannot rest, to the last digit. At a clamp it moves a fourth of that at least.
  double moves_others = 0.1;
  /// Period of the lowest mode: 0.82 (a rod) to 1 (a bob), to 1.2 at an amplitude of 90 degrees. A
  /// stiff cable is faster.
  double hardly_slower = 1.5, hardly_faster = 0.25;
  /// Frames in a period: fewer show no motion, and no camera takes more.
  double fewest_frames = 4, most_frames = 20000;
  /// A recording shorter than this shows no motion.
  double shortest = 0.05;
  /// Speed of the first frames of a cable at rest, in units of that of a fall, sqrt(g L).
  double hardly_at_rest = 0.2;
  /// Held after the first frame: later than this, the start of the model is far from the recording's.
  double held_time = 0.05;
  /// Rates of angles, in units of sqrt(g / the shortest link). A swing of 90 degrees has 1.4;
  /// degrees taken as radians give 57 times as much.
  double hardly_turning = 10;
  /// Noise, in lengths of the cable; rad for angles. More hides the motion.
  double most_noise = 0.1;
  /// kg/m: a steel rod of 11 cm. Load over mass of the cable.
  double heaviest = 80, heaviest_load = 1000;
  /// rad: an angle at the start. A cable that is not wound up has at most half a turn.
  double most_angle = 6.3;
};

/// Of the numbers of a case, without any recording: densities and masses in g, angles in degrees.
/// `length`: of the cable, m. Returns warnings as check_plausible, which repeats them.
std::vector<std::string> check_numbers(const CableGeometry& cable, const InitialSpec& initial,
                                       double length, const PlausibilityLimits& limits = {});

/// Compares the recording of an experiment, in SI units and the model's axes, with what a cable can
/// do. Returns warnings "key: what is seen; what to change", each of which names the key of the case
/// that is most likely wrong.
///
/// `initial`: how the experiment starts. `lengths`: of the links, m. Throws InputError, which names
/// the same, where no cable can move like that: unless the model has effects that move its support
/// or its origin, or scale what is seen; then that is a warning, too.
std::vector<std::string> check_plausible(const Recording& recording, const ExperimentSpec& spec,
                                         const InitialSpec& initial, const CableGeometry& cable,
                                         const Eigen::VectorXd& lengths, const Model& model,
                                         const PlausibilityLimits& limits = {});

}  // namespace catena
