// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

/// The pieces svg_plot.cpp puts together. Places are in user units (px).
namespace catena::plot {

inline constexpr double kFontSize = 12;

/// A place, to a hundredth.
std::string place(double value);

/// Text with & < > " escaped, for XML and HTML.
std::string escaped(const std::string& text);

/// Estimated width at kFontSize, on the wide side (there is no font to ask).
double text_width(const std::string& text);

std::string text_at(double x, double y, const std::string& anchor, const std::string& text,
                    const std::string& more_attributes = {});

/// Text that runs upwards, centred; nothing if the text is empty.
std::string upright_text(double x, double y, const std::string& text);

/// Nothing if the outline is empty.
std::string path(const std::string& outline, const std::string& attributes);

std::string line(double x1, double y1, double x2, double y2, const std::string& attributes);

/// Attributes of a line in a series' colour.
std::string stroke(int colour, double width, std::string_view dash);

/// Path of a marker of radius r, a shape for each colour so that grey prints can tell them apart.
std::string marker(int colour, double x, double y, double r);

}  // namespace catena::plot
