// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <string_view>

namespace catena::plot {

/// Series colours on white: ink, then the palette of Okabe and Ito (2008) darkened where it would
/// fall below a contrast of 3 : 1. Dark counterparts are in web/source/report.css.
inline constexpr std::array<std::string_view, 7> kSeriesColours = {
    "#1a1a1a", "#0072b2", "#c44e00", "#007a5a", "#a8508a", "#9a6a00", "#2f96d0"};

/// Dashes that tell the lines apart without colour (SVG stroke-dasharray); the first is solid.
inline constexpr std::array<std::string_view, 7> kSeriesDashes = {
    "", "", "7 3", "2 2.5", "9 3 2 3", "12 4", "5 2 1 2 1 2"};

/// Number of the colour of a series: see Series::colour.
constexpr int colour_index(int colour) { return colour <= 0 ? 0 : 1 + (colour - 1) % 6; }

/// Colour at `fraction` (0 .. 1, clamped) of a scale whose lightness falls steadily: of YlGnBu
/// (Brewer) for sizes, of cividis (Nuñez et al. 2018) for signed values.
std::string sequential_colour(double fraction);
std::string signed_colour(double fraction);

}  // namespace catena::plot
