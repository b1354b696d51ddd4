// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "truth/camera.hpp"

namespace truth {

/// time_s, side_i_m, down_i_m; an empty field where a marker was not seen.
void write_markers(const Recording& recording, const std::filesystem::path& path);

/// The cable as the case states it: density and load wrong by the share `off` up or down, the length by
/// a fifth of it. `seed` says which way.
Cable as_stated(Cable cable, double off, std::uint64_t seed);

/// The case file: geometry, masses and camera are known; stiffness, damping and the smooth shape at
/// the start, at rest, are unknown.
std::string case_text(const Cable& cable, const Camera& camera, int case_links);

/// The truth file: all values, for comparison with what was found.
std::string truth_text(const Cable& cable, const Hidden& hidden, const Camera& camera,
                       const std::vector<double>& held);

/// Throws std::runtime_error if it cannot be written.
void write_text(const std::string& text, const std::filesystem::path& path);

}  // namespace truth
