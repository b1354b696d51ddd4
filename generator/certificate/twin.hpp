// SPDX-License-Identifier: GPL-3.0-or-later
//
// An emitted model against the closed forms of chapter 4 (reference), in numbers.
#pragma once

#include <string>
#include <vector>

#include "generated/catena_model.h"
#include "generator/certificate/accuracy.hpp"

namespace catena {

/// M, F, G, K theta, C thetadot of the plain chain, each against its closed form in long double, at
/// seeded random points; units as in accuracy.hpp. Only for models without effects.
std::vector<FunctionAccuracy> compare_with_twin(const catena_model& table, int points,
                                                unsigned seed);

/// The parameters, in the order of the table, of the 3.39 m cable of chapter 6 (0.1424 kg/m, load
/// 1.47 kg, k_i = 47.448 N m/rad) without damping or torque; every effect's at its neutral value,
/// or its default where it has none.
std::vector<double> cable_parameters(const catena_model& table);

/// Undamped natural frequencies, rad/s, ascending, of cable_parameters' cable hanging at
/// rest.
struct Frequencies {
  bool applicable = false;
  std::string why_not;            ///< if not applicable
  std::vector<double> emitted;    ///< from the emitted M and d(r)/d(q)
  std::vector<double> closed;     ///< from (4.3), (4.11) as it should read, and (4.23)
  double largest_difference = 0;  ///< relative
};
Frequencies natural_frequencies(const catena_model& table);

}  // namespace catena
