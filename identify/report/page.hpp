// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/report_figures.hpp"
#include "identify/results/result_file.hpp"

namespace catena::report {

using namespace results;

/// The report as one HTML file that needs nothing else: web/source/page.html with style, script,
/// data, and the words and tables filled in. Charts, player and formulas are drawn by the script.
std::string to_html(const Document& document, const std::vector<ReportFigure>& figures);

}  // namespace catena::report
