// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "identify/cases/case.hpp"

namespace catena {

/// What a person knows of a recording that its file need not say.
struct KnownOfRecording {
  double length = kNotGiven;  ///< m, of the cable
  std::vector<double>
      arc_lengths;                ///< m, of the markers; empty: evenly spaced, the last at the end
  double frame_rate = kNotGiven;  ///< 1/s
  double metres_per_pixel = kNotGiven;
  std::vector<double> origin;  ///< of the support, in the axes of the file; empty: unknown
};

/// What a file of markers seems to say.
struct RecognisedRecording {
  ExperimentSpec spec;                  ///< with columns, places, units, axes and origin
  std::vector<std::string> understood;  ///< for people: "time: column t, in ms, 25 frames/s"
  /// What was estimated from the motion of the cable, by the key of the case it went into.
  std::vector<std::string> estimated;
  bool at_rest = true;  ///< at the first frame that is used
};

/// The unit in the name of a column: "m", "cm", "mm", "px", "s", "ms", "frames"; empty: none.
std::string unit_in_name(const std::string& name);

/// Reads the columns, units, axes and the start of a recording of markers off its file: an export of
/// Tracker, Kinovea or DeepLabCut, or a CSV file with a line of names in which every marker has one
/// column with x or side in its name and one with y or down.
///
/// Units are taken from the names ("x_mm", "t [ms]", "frame"); else from the motion: times from
/// their steps, lengths from the distances between markers. Down is where the cable hangs. The
/// support is where the cable ends if it goes on straight above the first marker. Throws InputError
/// for a file in which no markers are found, for numbers of places and markers that differ, and for a
/// count of frames without a rate.
RecognisedRecording recognise_recording(const std::filesystem::path& file,
                                        const KnownOfRecording& known);

}  // namespace catena
