// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "identify/report/figure.hpp"

namespace catena::plot {

struct SvgOptions {
  double width = 720, height = 400;  ///< user units (px); equal_aspect may use less of either
};

/// The figure as one self-contained SVG 1.1 document, readable in colour and in grey, on white.
/// Elements also carry the classes ink, grid, paper, c0 .. c6, with which a page that embeds the
/// drawing can recolour it. Same figure, same text. Throws as check.
std::string to_svg(const Figure& figure, const SvgOptions& options = {});

}  // namespace catena::plot
