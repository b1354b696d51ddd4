// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "identify/report/figure.hpp"
#include "identify/results/result_file.hpp"

namespace catena::report {

using namespace results;

/// What channels say of a point or a link.
struct Coordinate {
  const char* name;
  const char* unit;
  Rows Channels::*rows;
};
inline constexpr Coordinate kCoordinates[] = {{"side", "m", &Channels::side},
                                              {"down", "m", &Channels::down},
                                              {"across", "m", &Channels::across},
                                              {"angle", "rad", &Channels::angle}};

/// A figure and its place in the report. Figures of one family are shown in one frame, a reader
/// choosing experiment and variant; the figures of a family follow one another.
struct ReportFigure {
  Figure figure;
  std::string section;       ///< "motion", "forces", "residuals", "fit", "energy" or "diagnosis"
  std::string family;        ///< "positions_side"
  std::string experiment;    ///< name, or empty: of the whole result
  std::string variant_kind;  ///< what a reader chooses: "Point", "View", "Parameter", "Effect",
                             ///< "Round"; may be empty
  std::string variant;       ///< "marker 3"
};

/// All figures that the document has data for. Ids are distinct.
std::vector<ReportFigure> report_figures(const Document& document);

/// Marks in a figure over time where what was held out begins, and what was sealed.
void mark_parts(const Experiment& experiment, Figure& figure);

/// The parts, each appending to `figures`; ids are given by report_figures.
void add_motion_figures(const Experiment& experiment, std::vector<ReportFigure>& figures);
void add_force_figures(const Experiment& experiment, std::vector<ReportFigure>& figures);
void add_residual_figures(const Experiment& experiment, std::vector<ReportFigure>& figures);
void add_noise_figures(const Experiment& experiment, std::vector<ReportFigure>& figures);
void add_energy_figures(const Experiment& experiment, std::vector<ReportFigure>& figures);
void add_fit_figures(const Result& result, std::vector<ReportFigure>& figures);
void add_diagnosis_figures(const Diagnosis& diagnosis, std::vector<ReportFigure>& figures);

}  // namespace catena::report
