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

/// The case of a film on which `effects` act, and whose model knows none of them.
Case filmed_with(const testing::TemporaryFolder& folder, const std::string& effects,
                 const std::string& parameters) {
  folder.write("truth.toml", chain_with(effects));
  folder.write("chain.toml", chain_with(""));
  Case truth = read_case(folder.write("film.toml", std::string(kChain) + parameters + kStart));
  truth.description = folder.path() / "truth.toml";
  testing::add_experiment(truth, "run");
  folder.write("markers.csv", film(truth, provide_model(truth.description, truth.links, {})));
  return read_case(
      folder.write("case.toml", std::string(kChain) + kStart +
                                    "[[experiment]]\nname = \"run\"\ndata = \"markers.csv\"\n"
                                    "kind = \"markers\"\nfit_until = 4.0\n"));
}

}  // namespace

TEST_CASE("drag of the load is found in space, sensors are no candidates") {
  const testing::TemporaryFolder folder;
  const Case the_case = filmed_with(folder, "\"load_drag\"",
                                    fmt::format("[[parameter]]\nname = \"drag\"\n"
                                                "sets = \"load_drag.coefficient\"\nvalue = {}\n",
                                                kDrag));
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  CHECK(context.find("camera_tilt")->unavailable.find("sensors report of the plane") !=
        std::string::npos);
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

  // Errors of markers: across the cable there is nothing along it, and turned axes move no length.
  const FittedModel& model = found.final;
  const std::vector<Frames> errors = errors_of_markers(model);
  REQUIRE(errors.size() == 3 * 4 + 3 + 3 + 2);
  const Eigen::MatrixXd& seen = model.predicted[0];
  for (Eigen::Index k = 0; k < seen.cols(); k += 60) {
    const Vector3d along = (seen.col(k).segment<3>(6) - seen.col(k).segment<3>(0)).normalized();
    CHECK(errors[4][0].col(k).segment<3>(3).dot(along) == doctest::Approx(5e-3));
    for (const std::size_t across : {5u, 6u, 7u})
      CHECK(errors[across][0].col(k).segment<3>(3).dot(along) == doctest::Approx(0).scale(1e-3));
    CHECK(errors[13][0].col(k).segment<3>(6).dot(seen.col(k).segment<3>(6)) ==
          doctest::Approx(0).scale(1e-3));
  }
}

TEST_CASE("nothing is found in space where nothing is missing") {
  const testing::TemporaryFolder folder;
  const Case the_case = filmed_with(folder, "", "");
  DiagnosisContext context(the_case, {}, folder.path(), fit_least_squares, {});
  const Diagnosis found = diagnose(the_case, context, {.max_links = the_case.links});
  CAPTURE(found.sentence);
  CHECK(found.verdict == DiagnosisVerdict::kNone);
}
