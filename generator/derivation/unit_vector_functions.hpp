// SPDX-License-Identifier: GPL-3.0-or-later
//
// Functions of unit vectors whose usual forms are singular where two of them are parallel.
#pragma once

#include <ginac/ginac.h>

namespace catena {

/// The square of the angle between two unit vectors, as a function of its cosine c, and minus half of
/// its derivative: the angle over its sine, and the first and second derivative of that. All are smooth at c = 1.
DECLARE_FUNCTION_1P(squared_angle)
DECLARE_FUNCTION_1P(angle_over_sine)
DECLARE_FUNCTION_1P(angle_over_sine_slope)
DECLARE_FUNCTION_1P(angle_over_sine_curvature)
/// x^(-1/2).
DECLARE_FUNCTION_1P(inverse_square_root)
/// -1 of what is negative, else 1.
DECLARE_FUNCTION_1P(sign_or_one)

}  // namespace catena
