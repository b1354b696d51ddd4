// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/figure.hpp"

namespace catena::plot {

/// Ends of a linear axis that shows low..high, and steps of 1, 2 or 5 times a power of ten inside
/// it. Needs low <= high, finite. Equal ends are widened.
std::vector<Tick> linear_ticks(double low, double high, int about);

/// Powers of ten in low..high (0 < low < high), thinned to about so many; where there are fewer
/// than two, 1, 2, 5 times powers of ten.
std::vector<Tick> logarithmic_ticks(double low, double high, int about);

/// A number for people: about `digits` significant digits, no trailing zeros, 1.2×10⁻⁷ where plain
/// decimals would be long; an en dash where it is not a number.
std::string for_people(double value, int digits = 4);

/// "kg/m²" of "kg/m^2".
std::string readable_unit(std::string unit);

/// A number to be read again: the shortest text that gives the same double; empty for NaN.
std::string exact(double value);

}  // namespace catena::plot
