// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/recording.hpp"

namespace catena {

/// Reads what tracker programs export, as it is, into a table with the columns "time_s" (or
/// "frame") and "<point> side", "<point> down" in the file's own units and axes:
///
///   Tracker     a line with the names of the tracks, each followed by empty cells, then a line of
///               column names t, x, y, ... ; separated by comma, semicolon or tabulator; decimal commas
///   Kinovea     "Time" and "<name> X", "<name> Y" (the export for spreadsheets), or one block per
///               trajectory under "Label : name" with lines "time;x;y"; time h:mm:ss:cc or s
///   DeepLabCut  three lines scorer, bodyparts, coords; columns x, y, likelihood per body part; the
///               first column counts frames
///
/// Throws InputError naming file, line and rule.
Table import_tracker_table(const ExperimentSpec& experiment);

}  // namespace catena
