// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// Numbers and units as people read them.
namespace catena::report {

/// About `digits` significant digits, no trailing zeros, 1.2×10⁻⁷ where plain decimals would be
/// long; an en dash for NaN.
std::string for_people(double value, int digits = 4);

/// "kg/m²" of "kg/m^2".
std::string readable_unit(std::string unit);

}  // namespace catena::report
