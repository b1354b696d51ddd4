// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace catena {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kInfinite = std::numeric_limits<double>::infinity();

}  // namespace catena
