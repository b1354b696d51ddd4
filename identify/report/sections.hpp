// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/report/html.hpp"
#include "identify/results/result_file.hpp"

/// The sections of the page that are words and tables. Each is empty where there is nothing to say.
namespace catena::report {

using namespace results;

Html summary_section(const Document& document);
/// Mean sizes of the residuals of every point, over all frames.
Html residuals_section(const Result& result);
Html parameters_section(const Result& result);
Html fit_section(const Result& result);
Html diagnosis_section(const Diagnosis& diagnosis);
Html equations_section(const Result& result);
Html provenance_section(const Result& result);

}  // namespace catena::report
