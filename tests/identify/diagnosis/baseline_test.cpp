// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/baseline.hpp"

#include <doctest/doctest.h>

#include <fstream>

#include "identify/cases/case_reader.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

/// 100 frames of one marker, 0 to 9.9 s.
std::string markers() {
  std::string text = "time_s,side_1_m,down_1_m\n";
  for (int k = 0; k < 100; ++k)
    text += std::to_string(0.1 * k) + "," + std::to_string(0.001 * k) + ",1.0\n";
  return text;
}

const char* const kCase = R"(format = 1
kind = "case"
[model]
links = 2
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "k"
sets = "stiffness"
value = 0.05
[[parameter]]
name = "c"
sets = "damping"
value = 0.002
[initial]
shape = "angles"
free = true
velocity = { shape = "angles", free = true }
[[experiment]]
name = "run"
data = "markers.csv"
kind = "markers"
)";

int frames_held_out(const std::string& more) {
  const testing::TemporaryFolder folder;
  folder.write("markers.csv", markers());
  Case the_case = read_case(folder.write("case.toml", kCase + more));
  DiagnosisContext context({}, {}, folder.path(), fit_least_squares, {});
  std::vector<std::string> notes;
  hold_out(the_case, context, notes);
  CHECK(notes.size() == 1);
  const Problem problem(the_case, Model::built_in(2));
  int frames = 0;
  for (const Experiment& experiment : problem.experiments())
    frames += static_cast<int>(experiment.recording.time.size()) -
              static_cast<int>(experiment.fitted() ? experiment.recording.fit_frames : 0);
  return frames;
}

}  // namespace

TEST_CASE("the end of a recording is held out, where the case holds nothing out") {
  CHECK(frames_held_out("") == 30);
}

TEST_CASE("with windows, those that reach into the end are held out whole") {
  CHECK(frames_held_out("window = 1.0\n") == 30);
  CHECK(frames_held_out("window = 2.5\n") == 50);
}
