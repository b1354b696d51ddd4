// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"

namespace catena::report {

using namespace results;

/// The report's data as JSON, for the script of the HTML report and for other programs:
///
///     {"format": 1, "kind": "report", "title": ..., "command": ...,
///      "columns": [[...], ...],             lists of numbers, each once; null for NaN
///      "figures": [{"id", "title", "caption", "section", "family", "experiment", "variantKind",
///      "variant",
///                   "x": {"label", "unit", "logarithmic", "categories", "ticks"}, "y": {...},
///                   "yDownwards", "equalAspect", "wide",
///                   "series": [{"name", "mark", "colour", "x": column, "y": column}],
///                   "rules": [{"vertical", "at", "label"}],
///                   "map": {"x": column, "rows": [names], "value": [columns], "scale", "signed",
///                           "maximum"}}],
///      "motions": [{"experiment", "loadMass", "time": column, "side": [columns],
///                   "down": [columns], "measured": {"time", "side", "down", "connected"},
///                   "before": {"time", "side", "down"}}]}
///
/// `most_points`: longer series are thinned to every k-th value, so that at most so many stay, and
/// numbers have six significant digits; zero keeps all of both.
std::string payload(const Document& document, const std::vector<ReportFigure>& figures,
                    std::size_t most_points);

}  // namespace catena::report
