// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "truth/cable.hpp"

namespace truth {

/// The cable as a geometrically exact rod in the plane (Reissner 1972): an elastic curve that bends,
/// stretches and shears, no links. Finite elements of two nodes with one point of integration;
/// generalised-alpha method (Chung and Hulbert 1993), whose errors damp what the elements cannot resolve. The
/// clamp holds the direction of the curve itself. Friction follows Bouc and Wen, or the LuGre model where it
/// is larger at rest: it sticks. So nothing but mechanics is shared with the chains of links that are fitted
/// to it.
///
/// `Cable::links` is the number of elements. These hidden effects exist for it; others are refused:
/// drag of cable and load, wind, friction and hysteresis in the sections, rest curvature, a heavier
/// load, axial stiffness, gravity's tilt, a moving support, the laws of friction and drag, and all of
/// the camera.
///
/// The end is held at a point until everything rests, then released. Throws std::invalid_argument
/// for a hidden effect that does not exist here, std::runtime_error if the integration fails.
Motion move_rod(const Cable& cable, const Hidden& hidden, const std::vector<double>& held,
                const std::vector<double>& arc, const std::vector<double>& time,
                const Integration& integration = {});

}  // namespace truth
