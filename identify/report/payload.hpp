// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"

namespace catena::report {

/// The report's data as JSON, for the script of the HTML report and for other programs:
///
///     {"format": 1, "kind": "report", "title": ..., "command": ...,
///      "columns": [[...], ...],             lists of numbers, each once; null for NaN
///      "figures": [{"id", "title", "caption", "section", "family", "experiment", "variantKind",
///      "variant",
///                   "x": {"label", "unit", "logarithmic", "categories"}, "y": {...}, "yDownwards",
///                   "series": [{"name", "mark", "colour", "x": column, "y": column, "low",
///                   "high"}], "rules": [{"vertical", "at", "label"}], "map": {"x": column, "rows":
///                   [names], "value": [columns], "scale", "signed", "maximum"}}],
///      "motions": [{"experiment", "loadMass", "time": column, "side": [columns], "down":
///      [columns],
///                   "measured": {"time", "side", "down", "connected"}, "before": {"time", "side",
///                   "down"}}]}
///
/// Six significant digits. Longer series are thinned to every k-th value, so that at most
/// `most_points` stay; zero keeps all. Figures with equal aspect are not among them (they are drawn
/// as SVG).
std::string payload(const Document& document, const std::vector<ReportFigure>& figures,
                    std::size_t most_points);

}  // namespace catena::report
