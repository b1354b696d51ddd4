// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/recordings/recording.hpp"
#include "identify/recordings/table.hpp"

namespace catena {

/// Reads what tracker programs export, as it is, into a table: first the column "time", then
/// "NAME x", "NAME y" for every point, in the file's own units and axes:
///
///   Tracker     a line with the names of the tracks over their columns, then a line t, x, y, x, y,
///   ...;
///               further columns (speeds) are passed over. Comma, semicolon or tabulator between
///               cells; decimal commas where the separator is not a comma
///   Kinovea     its text export: "#Kinovea Trajectory data export", then for every track "# NAME"
///               and lines "time x y"; times as numbers or h:mm:ss:cc
///   DeepLabCut  lines scorer, bodyparts, coords; columns x, y, likelihood per body part; the first
///               column counts frames. Points less likely than the floor are not seen
///
/// Throws InputError naming file, line and rule.
Table import_tracker_table(DataSource source, const std::filesystem::path& path,
                           double likelihood_floor);

}  // namespace catena
