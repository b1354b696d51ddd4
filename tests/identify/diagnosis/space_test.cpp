// SPDX-License-Identifier: BSD-3-Clause
//
// Diagnosis of a chain in space.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>

#include "identify/diagnosis/diagnose.hpp"
#include "identify/diagnosis/errors_of_markers.hpp"
#include "identify/diagnosis/telling_experiment.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/models/model_provider.hpp"
#include "identify/problem/camera.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Vector3d;

namespace {

constexpr int kFrames = 240;
constexpr double kStep = 0.025;  // s
constexpr double kNoise = 1e-3;  // m
constexpr double kDrag = 0.12;   // kg/m, of the load

const char* const kChain = R"(format = 1
kind = "case"
[model]
description = "chain.toml"
links = 3
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "k"
sets = "stiffness"
value = 0.02
free = true
lower = 0.001
upper = 1.0
[[parameter]]
name = "c"
sets = "damping"
value = 0.001
free = true
lower = 0.0001
upper = 1.0
)";

/// Swings round the vertical, in no plane.
const char* const kStart = R"(
[initial]
shape = "angles"
angles = [0.6, 0.5, 0.8]
azimuths = [0.3, 0.3, 0.3]
velocity = { shape = "angles", rates = [0.2, -0.3, 0.1], azimuth_rates = [1.5, 1.5, 1.5] }
)";

std::string chain_with(const std::string& effects) {
  return "format = 1\nkind = \"model\"\nid = \"chain\"\nspace = \"3d\"\neffects = [" + effects +
         "]\n";
}

/// Two cameras, before the cable and beside it.
const char* const kCameras = R"([[camera]]
name = "left"
centre = [0, 0]
[[camera]]
name = "right"
centre = [0, 0]
[[parameter]]
name = "left.down"
sets = "left.down"
value = 0.5
[[parameter]]
name = "left.across"
sets = "left.across"
value = -3.0
[[parameter]]
name = "left.focal_length"
sets = "left.focal_length"
value = 1000
[[parameter]]
name = "right.side"
sets = "right.side"
value = -2.5
[[parameter]]
name = "right.across"
sets = "right.across"
value = -1.0
[[parameter]]
name = "right.pan"
sets = "right.pan"
value = 1.1
[[parameter]]
name = "right.focal_length"
sets = "right.focal_length"
value = 900
)";

/// What `truth` predicts, with noise, as a file.
std::string film(const Case& truth, const Model& model) {
  const Recording recording = testing::with_truth(
      truth, model, testing::empty_markers({1.0 / 3, 2.0 / 3, 1.0}, kFrames, kStep, true), kNoise);
  std::string text = "time_s";
  for (int marker = 1; marker <= 3; ++marker)
    text += fmt::format(",side_{0}_m,down_{0}_m,across_{0}_m", marker);
  for (Eigen::Index k = 0; k < kFrames; ++k) {
    text += fmt::format("\n{}", recording.time[static_cast<std::size_t>(k)]);
    for (const double value : recording.measured.col(k)) text += fmt::format(",{}", value);
  }
  return text + "\n";
}

/// The same in the pictures of both cameras, px, with noise of 0.3 px.
std::string pictures(const Case& truth, const Model& model) {
  Recording recording = testing::empty_markers({}, kFrames, kStep);
  std::string text = "time_s";
  for (const char* camera : {"left", "right"})
    for (int joint = 1; joint <= 3; ++joint) {
      const int index = static_cast<int>(recording.points.size());
      PointSpec& point = recording.points.emplace_back();
      point.joint = joint;
      point.camera = camera;
      recording.channels.push_back({index, Component::kSide, ""});
      recording.channels.push_back({index, Component::kDown, ""});
      text += fmt::format(",{0}_x_{1},{0}_y_{1}", camera, joint);
    }
  recording.measured.setZero(12, kFrames);
  Case seen = truth;
  seen.experiments[0].metres_per_pixel = 1;
  recording = testing::with_truth(seen, model, recording, 0.3);
  for (Eigen::Index k = 0; k < kFrames; ++k) {
    text += fmt::format("\n{}", recording.time[static_cast<std::size_t>(k)]);
    for (const double value : recording.measured.col(k)) text += fmt::format(",{}", value);
  }
  return text + "\n";
}

/// A parameter that stays as it is.
std::string known(const std::string& sets, double value) {
  return fmt::format("[[parameter]]\nname = \"{0}\"\nsets = \"{0}\"\nvalue = {1}\n", sets, value);
}

/// The case of a film on which `effects` act, and whose model knows none of them: of positions, or by two
/// cameras.
Case filmed_with(const testing::TemporaryFolder& folder, const std::string& effects,
                 const std::string& parameters, bool in_pictures = false) {
  folder.write("truth.toml", chain_with(effects));
  folder.write("chain.toml", chain_with(""));
  const std::string chain = std::string(kChain) + (in_pictures ? kCameras : "");
  Case truth = read_case(folder.write("film.toml", chain + parameters + kStart));
  truth.description = folder.path() / "truth.toml";
  testing::add_experiment(truth, "run");
  const Model model = provide_model(truth.description, truth.links, {});
  std::string experiment =
      "[[experiment]]\nname = \"run\"\ndata = \"markers.csv\"\n"
      "kind = \"markers\"\nfit_until = 4.0\n";
  if (in_pictures) {
    experiment += "length_unit = \"px\"\nmetres_per_pixel = 0.003\nmarkers = [";
    for (const char* camera : {"left", "right"})
      for (int marker = 1; marker <= 3; ++marker)
        experiment += fmt::format(
            "{{ name = \"{0} {1}\", camera = \"{0}\", side = \"{0}_x_{1}\", down = \"{0}_y_{1}\", "
            "joint = {1} }}, ",
            camera, marker);
    experiment += "]\n";
  }
  folder.write("markers.csv", in_pictures ? pictures(truth, model) : film(truth, model));
  return read_case(folder.write("case.toml", chain + kStart + experiment));
}

}  // namespace

TEST_CASE("drag of the load is found in space") {
  const testing::TemporaryFolder folder;
  const Case the_case = filmed_with(folder, "\"load_drag\"", known("load_drag.coefficient", kDrag));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  const Diagnosis found = diagnose(the_case, context, {.max_links = the_case.links});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  REQUIRE(found.effects == std::vector<std::string>{"load_drag"});
  const auto drag = std::find_if(found.parameters.begin(), found.parameters.end(),
                                 [](const auto& each) { return each.effect == "load_drag"; });
  REQUIRE(drag != found.parameters.end());
  CHECK(std::abs(drag->value - kDrag) < 2 * drag->half_width());
  CHECK(drag->half_width() < 0.2 * kDrag);

  const auto& stages = found.stages;
  const TellingExperiment telling = telling_experiment(stages.front().model, found.final, {kNoise});
  CHECK(telling.difference > 10);
  CHECK(telling.words.find("the end of link 3") != std::string::npos);

  // Errors of markers: across the cable there is nothing along it.
  const FittedModel& model = found.final;
  const std::vector<Frames> errors = errors_of_markers(model);
  REQUIRE(errors.size() == 3 * 4);
  const Eigen::MatrixXd& seen = model.predicted[0];
  for (Eigen::Index k = 0; k < seen.cols(); k += 60) {
    const Vector3d along = (seen.col(k).segment<3>(6) - seen.col(k).segment<3>(0)).normalized();
    CHECK(errors[4][0].col(k).segment<3>(3).dot(along) == doctest::Approx(5e-3));
    for (const std::size_t across : {5u, 6u, 7u})
      CHECK(errors[across][0].col(k).segment<3>(3).dot(along) == doctest::Approx(0).scale(1e-3));
  }
}

TEST_CASE("drag of the load is found in the pictures of two cameras") {
  const testing::TemporaryFolder folder;
  const Case the_case =
      filmed_with(folder, "\"load_drag\"", known("load_drag.coefficient", kDrag), true);
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  const Diagnosis found = diagnose(the_case, context, {.max_links = the_case.links});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  REQUIRE(found.effects == std::vector<std::string>{"load_drag"});
  CHECK(std::abs(found.parameters.back().value - kDrag) < 2 * found.parameters.back().half_width());

  // A mark off its place is off in both pictures, by about as many pixels as a place has there.
  const FittedModel& model = found.final;
  const std::vector<Frames> errors = errors_of_markers(model);
  REQUIRE(errors.size() == 3 * 4);
  const Eigen::MatrixXd& lowest_off = errors[9][0];
  CHECK(lowest_off.topRows(4).isZero());
  CHECK(lowest_off.middleRows(6, 4).isZero());
  const Recording& recording = model.problem->experiments()[0].recording;
  Recording moved = recording;
  moved.measured = model.predicted[0] + 1e-3 * lowest_off;
  Recording there = recording;
  there.measured = model.predicted[0];
  const Eigen::VectorXd parameters = model.problem->model_parameters(model.x, 0);
  const auto positions = [&](const Recording& pictures) {
    return positions_from_pictures(pictures, model.problem->model(), parameters, 0.003).measured;
  };
  const Eigen::MatrixXd off = 1e3 * (positions(moved) - positions(there));
  const Vector3d link =
      (positions(there).col(7).segment<3>(6) - positions(there).col(7).segment<3>(3)).normalized();
  const Vector3d side_of_cable = 5e-3 * (Vector3d::UnitX() - link[0] * link);
  CHECK((off.col(7).segment<3>(6) - side_of_cable).norm() < 1e-4);
}

TEST_CASE("axes of a recording that are not plumb are found, and by how much") {
  const testing::TemporaryFolder folder;
  const Case the_case =
      filmed_with(folder, "\"frame_tilt\"",
                  known("frame_tilt.side_tilt", 0.02) + known("frame_tilt.across_tilt", -0.03));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  CHECK(context.find("camera_tilt")->unavailable.find("says nothing of what is across") !=
        std::string::npos);
  const Diagnosis found = diagnose(the_case, context, {.max_links = the_case.links});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNamed);
  REQUIRE(found.effects == std::vector<std::string>{"frame_tilt"});
  for (const auto& each : found.parameters)
    if (each.effect == "frame_tilt")
      CHECK(std::abs(each.value - (each.name == "frame_tilt.side_tilt" ? 0.02 : -0.03)) <
            2 * each.half_width());
}

TEST_CASE("a spring across that no library has is discovered in space") {
  const testing::TemporaryFolder folder;
  folder.write("wall.toml", R"toml(format = 1
kind = "effect"
id = "wall"
title = "Spring to a wall"
description = "From the middle of the cable, across."
[parameters.spring]
unit = "N/m"
neutral = 0
description = "Stiffness"
[constants.place]
value = 0.5
unit = "m"
[constants.width]
value = 1e-5
unit = "m"
[[potential]]
at = "link_centre"
value = "(tanh((place - arc + length/2)/width) - tanh((place - arc - length/2)/width))/2*spring*across^2/2"
)toml");
  const double spring = 0.3;  // N/m
  const Case the_case = filmed_with(folder, "\"wall.toml\"", known("wall.spring", spring));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  const Diagnosis found = diagnose(
      the_case, context, {.max_effects = 0, .max_links = the_case.links, .discover = true});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kDiscovered);
  CHECK(found.sentence.find("across force = -linear x (across position - rest) at arc length 0.") !=
        std::string::npos);
  const auto stiffness =
      std::find_if(found.parameters.begin(), found.parameters.end(),
                   [](const auto& each) { return each.name == "discovered_law.linear"; });
  REQUIRE(stiffness != found.parameters.end());
  CHECK(std::abs(stiffness->value - spring) < 2 * stiffness->half_width());
  CHECK(stiffness->half_width() < 0.1 * spring);
}

TEST_CASE("nothing is found in space where nothing is missing") {
  const testing::TemporaryFolder folder;
  const Case the_case = filmed_with(folder, "", "");
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  const Diagnosis found = diagnose(the_case, context, {.max_links = the_case.links});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNone);
}
