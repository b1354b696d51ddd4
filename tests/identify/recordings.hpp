// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/format.h>

#include <random>
#include <string>
#include <vector>

#include "identify/cases/case_reader.hpp"
#include "identify/problem/problem.hpp"
#include "tests/support/temporary_folder.hpp"

namespace catena::testing {

/// A case from its [model], [cable], ... sections, without data.
inline Case sections(const std::string& text) {
  return parse_case("format = 1\nkind = \"case\"\n" + text, "case.toml", "");
}

/// Two links: stiffness and damping unknown, started at half and two fifths of what the tests hide.
inline const char* const kTwoLinks = R"(
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
free = true
lower = 0.001
upper = 1.0
[[parameter]]
name = "c"
sets = "damping"
value = 0.002
free = true
lower = 0.0001
upper = 1.0
[initial]
shape = "straight"
angle = 0.6
)";

/// Markers at the given arc lengths (m), `frames` of them `step` s apart from time 0; not measured
/// yet. In space they have three components.
inline Recording empty_markers(const std::vector<double>& arc_lengths, int frames, double step,
                               bool in_space = false) {
  Recording recording;
  for (int k = 0; k < frames; ++k) recording.time.push_back(step * k);
  for (std::size_t p = 0; p < arc_lengths.size(); ++p) {
    PointSpec point;
    point.name = "marker " + std::to_string(p + 1);
    point.arc_length = arc_lengths[p];
    recording.points.push_back(point);
    recording.channels.push_back({static_cast<int>(p), Component::kSide, point.name + " side"});
    recording.channels.push_back({static_cast<int>(p), Component::kDown, point.name + " down"});
    if (in_space)
      recording.channels.push_back(
          {static_cast<int>(p), Component::kAcross, point.name + " across"});
  }
  recording.measured.setZero(static_cast<Eigen::Index>(recording.channels.size()), frames);
  recording.fit_frames = frames;
  return recording;
}

/// Adds an experiment of that name for a recording that is handed in.
inline void add_experiment(Case& the_case, const std::string& name,
                           DataKind kind = DataKind::kMarkers) {
  ExperimentSpec spec;
  spec.name = name;
  spec.kind = kind;
  spec.where = "case.toml";
  the_case.experiments.push_back(spec);
}

/// The recording filled with what the case itself predicts, plus normal noise.
inline Recording with_truth(const Case& truth, const Model& model, Recording recording,
                            double noise = 0, unsigned seed = 1) {
  const Problem problem(truth, model, {recording});
  recording.measured = problem.predict(problem.start(), 0, true).simulated;
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0, noise);
  if (noise > 0)
    for (double& value : recording.measured.reshaped()) value += normal(generator);
  return recording;
}

/// The case with the markers of its only experiment in a file, equally far from one another from the support
/// to the end. The last three tenths are held out.
inline Case measured(Case the_case, const TemporaryFolder& folder, const Recording& recording) {
  std::string text = "time_s";
  for (std::size_t p = 1; p <= recording.points.size(); ++p)
    text += fmt::format(",side_{0}_m,down_{0}_m", p);
  for (std::size_t k = 0; k < recording.time.size(); ++k) {
    text += fmt::format("\n{}", recording.time[k]);
    for (const double value : recording.measured.col(static_cast<Eigen::Index>(k)))
      text += fmt::format(",{}", value);
  }
  ExperimentSpec& spec = the_case.experiments.front();
  spec.data = folder.write("markers.csv", text + "\n");
  spec.fit_until = recording.time[7 * recording.time.size() / 10];
  return the_case;
}

}  // namespace catena::testing
