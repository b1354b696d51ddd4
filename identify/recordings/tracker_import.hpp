// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "identify/recordings/recording.hpp"
#include "identify/recordings/table.hpp"

namespace catena {

/// Reads what tracker programs export, as it is, into a table: first the column "time", then
/// "NAME x", "NAME y" for every point, in the file's own units and axes:
///
/// - Tracker: a line with the names of the tracks over their columns, then a line t, x, y, x, y, ...
///   Further columns (speeds) are passed over. Cells are separated by commas, semicolons or
///   tabulators; where not by commas, numbers may have decimal commas.
/// - Kinovea: its text export, "#Kinovea Trajectory data export", then for every track "# NAME" and
///   lines "time x y". Times are numbers or h:mm:ss:cc.
/// - DeepLabCut: the lines scorer, bodyparts, coords, then x, y, likelihood per body part. The first
///   column counts frames.
///
/// `likelihood_floor`: DeepLabCut's points that are less likely count as not seen. Throws InputError
/// naming file, line and rule.
Table import_tracker_table(DataSource source, const std::filesystem::path& path,
                           double likelihood_floor);

}  // namespace catena
