// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace catena {

/// The most links a model may have. The arrays of one call lie on the stack, the largest set of
/// them with 400 bytes a link: 4 MB of the 8 MB that a thread has.
inline constexpr int kMostLinks = 10'000;

}  // namespace catena
