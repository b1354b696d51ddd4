// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// s, of durations, windows and between frames: a nanosecond is shorter than any swing of a cable.
inline constexpr double kShortestTime = 1e-9;

/// s, of any time: 30 years, beside which a double still tells a microsecond.
inline constexpr double kLongestTime = 1e9;

}  // namespace catena
