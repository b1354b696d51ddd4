// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/results/result_file.hpp"

/// The sections of the HTML report that are words and tables. Each is empty where there is nothing
/// to say.
namespace catena::report {

/// A table; the first row is the heading, the first column names its row. Cells are HTML.
std::string table(const std::string& caption, const std::vector<std::vector<std::string>>& rows);

std::string summary_html(const Document& document);
/// Mean sizes of the residuals of every point, over all frames.
std::string residuals_html(const Result& result);
std::string parameters_html(const Result& result);
std::string fit_html(const Result& result);
std::string diagnosis_html(const Diagnosis& diagnosis);
std::string equations_html(const Result& result);
std::string provenance_html(const Result& result);

}  // namespace catena::report
