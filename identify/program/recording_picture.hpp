// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/recordings/outliers.hpp"
#include "identify/recordings/recording.hpp"

namespace catena {

/// A recording of markers as an SVG in the model's axes: the support, every marker where it is first
/// seen, with its place along the cable of `length` (m), its track, rings around outliers, axes in m.
std::string recording_picture(const Recording& recording, const std::vector<Outlier>& outliers,
                              const std::string& title, double length);

}  // namespace catena
