// SPDX-License-Identifier: GPL-3.0-or-later
//
// An emitted model against the closed forms of chapter 4 (reference), in numbers.
#pragma once

#include <string>
#include <vector>

#include "generated/catena_model.h"
#include "generator/certificate/accuracy.hpp"

namespace catena {

/// Compares M, F, G, K theta and C thetadot of the plain chain with the closed forms in long
/// double, at seeded random points. Units are those of accuracy.hpp. Only for models without
/// effects.
std::vector<FunctionAccuracy> compare_with_twin(const catena_model& table, int points,
                                                unsigned seed);

/// Parameters, in the order of the table, of the 3.39 m cable of chapter 6 (0.1424 kg/m, load 1.47
/// kg, k_i = 47.448 N m/rad) without damping and torque. Those of effects have their neutral
/// values, or their defaults where there is no neutral value.
std::vector<double> cable_parameters(const catena_model& table);

/// Undamped natural frequencies (rad/s, ascending) of the cable of cable_parameters about its
/// equilibrium.
struct Frequencies {
  bool applicable = false;
  std::string why_not;            ///< if not applicable
  std::vector<double> emitted;    ///< from the emitted M and d(r)/d(q)
  std::vector<double> closed;     ///< from (4.3), (4.11) as it should read, and (4.23)
  double largest_difference = 0;  ///< relative
};
/// Applicable to plain chains in the plane only.
Frequencies natural_frequencies(const catena_model& table);

}  // namespace catena
