// SPDX-License-Identifier: GPL-3.0-or-later
#include "identify/cases/case_reader.hpp"
#include "identify/recordings/recognise.hpp"
#include "identify/recordings/recording.hpp"
#include "tests/fuzz/readers.hpp"

namespace catena::tests {
namespace {

void read_source(DataSource source, DataKind kind, const std::string& text) {
  ExperimentSpec experiment;
  experiment.data = written("recording.csv", text);
  experiment.source = source;
  experiment.kind = kind;
  (void)read_recording(experiment, 4, 1.0);
}

void read_a_case(const std::string& text) { (void)parse_case(text, "case.toml", "."); }

void read_markers(const std::string& text) {
  read_source(DataSource::kCatena, DataKind::kMarkers, text);
}
void read_angles(const std::string& text) {
  read_source(DataSource::kCatena, DataKind::kAngles, text);
}
void read_tracker(const std::string& text) {
  read_source(DataSource::kTracker, DataKind::kMarkers, text);
}
void read_kinovea(const std::string& text) {
  read_source(DataSource::kKinovea, DataKind::kMarkers, text);
}
void read_deeplabcut(const std::string& text) {
  read_source(DataSource::kDeepLabCut, DataKind::kMarkers, text);
}

/// What `catena new` makes of it.
void recognise(const std::string& text) {
  KnownOfRecording known;
  known.length = 1.0;
  (void)recognise_recording(written("recording.csv", text), known);
}

constexpr Reader kRecordingReaders[] = {
    {"case", refused_or_read<read_a_case>},     {"markers", refused_or_read<read_markers>},
    {"angles", refused_or_read<read_angles>},   {"tracker", refused_or_read<read_tracker>},
    {"kinovea", refused_or_read<read_kinovea>}, {"deeplabcut", refused_or_read<read_deeplabcut>},
    {"new", refused_or_read<recognise>},
};

}  // namespace

std::span<const Reader> recording_readers() { return kRecordingReaders; }

}  // namespace catena::tests
