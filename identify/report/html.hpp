// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"

namespace catena::report {

/// The report as one HTML file that needs nothing else: style, script and data are inside. Words,
/// tables and equations are plain HTML; charts and player are drawn by the script.
std::string to_html(const Document& document, const std::vector<ReportFigure>& figures);

}  // namespace catena::report
