// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/recordings/outliers.hpp"
#include "identify/recordings/recording.hpp"

namespace catena {

/// A recording of markers as an SVG in the model's axes: the support, the first frame, the track of
/// every marker, rings around outliers, axes in m.
std::string recording_picture(const Recording& recording, const std::vector<Outlier>& outliers,
                              const std::string& title);

}  // namespace catena
