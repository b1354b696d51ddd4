// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/recordings/recording.hpp"

namespace catena {

/// The time (s) of the frame in which a cable that was held is let go: that of the first frame if it
/// moves from there on. Until the release nothing moves; after it, distances grow as the square of
/// the time, which tells the release from the frames in which 1 % and 4 % of the whole motion are
/// reached. A cable that moves in the first frame gives that.
double release_time(const Recording& recording);

}  // namespace catena
