// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// Standard deviations to both sides of the mean, between which a normal variable lies with a probability of 95 %.
inline constexpr double kNormalQuantile95 = 1.959963984540054;

}  // namespace catena
