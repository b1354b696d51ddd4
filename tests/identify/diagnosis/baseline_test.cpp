// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/baseline.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <cmath>

#include "identify/cases/case_reader.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/near.hpp"
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

/// One marker at the tip, as the file markers.csv beside the case.
std::string case_of(const std::string& sections, const std::string& more = "") {
  return "format = 1\nkind = \"case\"\n" + sections + R"(
[[experiment]]
name = "run"
data = "markers.csv"
kind = "markers"
)" + more;
}

int frames_held_out(const std::string& more) {
  const testing::TemporaryFolder folder;
  folder.write("markers.csv", markers());
  Case the_case = read_case(folder.write("case.toml", case_of(testing::kTwoLinks, more)));
  DiagnosisContext context({}, {}, folder.path(), fit_least_squares, {});
  std::vector<std::string> notes;
  hold_out(the_case, context, notes);
  REQUIRE(notes.size() == 1);
  CHECK(notes[0] == std::string("the case holds nothing out: the last 30 % of each recording") +
                        (more.empty() ? "" : ", and the windows that reach into it,") +
                        " were not fitted");
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

TEST_CASE("a baseline that loses the phase of a long motion is fitted over growing windows") {
  // With the damping known, no start is easier than another.
  std::string cable = testing::kTwoLinks;
  const std::string free_damping = "value = 0.002\nfree = true";
  cable.replace(cable.find(free_damping), free_damping.size(), "value = 0.0005\nfree = false");
  Case truth = testing::sections(cable);
  truth.parameters[0].value = 0.4;  // eight times where the fit starts
  testing::add_experiment(truth, "run");
  const double noise = 1e-3;
  const Recording recording = testing::with_truth(truth, Model::built_in(2),
                                                  testing::empty_markers({1.0}, 1200, 0.05), noise);
  std::string text = "time_s,side_1_m,down_1_m\n";
  for (Eigen::Index k = 0; k < recording.measured.cols(); ++k)
    text += fmt::format("{},{},{}\n", recording.time[static_cast<std::size_t>(k)],
                        recording.measured(0, k), recording.measured(1, k));
  const testing::TemporaryFolder folder;
  folder.write("markers.csv", text);
  const Case the_case = read_case(folder.write("case.toml", case_of(cable)));
  DiagnosisContext context({}, {}, folder.path(), fit_least_squares, {});
  const FittedModel model = fit_baseline(the_case, context);
  REQUIRE(model.ok);
  CHECK(model.x[0] == catena::near(0.4, 0.01));
  CHECK(fit_gap(model, {{.level = noise}}).ratio() < 1.1);
}
