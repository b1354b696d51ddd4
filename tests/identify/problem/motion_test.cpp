// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/motion.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "identify/models/model_provider.hpp"
#include "identify/problem/evaluation.hpp"
#include "identify/problem/prediction.hpp"
#include "runtime/positions.hpp"
#include "tests/identify/differences.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;

namespace {

constexpr int kLinks = 2;
constexpr Index kFrames = 40;

/// A case whose model has all sensor effects, those given with these values, the others neutral.
Problem seen_with(const Model& model, const std::vector<std::pair<std::string, double>>& effects,
                  DataKind kind) {
  Case the_case = testing::sections(testing::kTwoLinks);
  for (const auto& [name, value] : effects) {
    ParameterSpec parameter;
    parameter.name = parameter.sets = name;
    parameter.value = value;
    the_case.parameters.push_back(parameter);
  }
  testing::add_experiment(the_case, "run", kind);
  Recording recording = testing::empty_markers({0.3, 0.5, 0.8, 1.0}, kFrames, 0.02);
  if (kind == DataKind::kAngles) {
    recording.points.assign(kLinks, {});
    recording.channels.clear();
    for (int link = 0; link < kLinks; ++link) {
      recording.points[static_cast<std::size_t>(link)].link = link + 1;
      recording.channels.push_back({link, Component::kAngle, ""});
    }
    recording.measured.setZero(kLinks, kFrames);
  }
  return Problem(the_case, model, {recording});
}

}  // namespace

TEST_CASE("the chain that is laid over a measurement runs through what the sensors would report") {
  const testing::TemporaryFolder folder;
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  const Model model = provide_model(
      folder.write("seen.toml",
                   "format = 1\nkind = \"model\"\nid = \"seen\"\neffects = [\"clock_offset\", "
                   "\"camera_tilt\", \"scale\", \"origin_offset\", \"marker_offset\"]\n"),
      kLinks, options);
  using Values = std::vector<std::pair<std::string, double>>;
  for (const Values& effects :
       {Values{{"clock_offset.offset", 0.07}}, Values{{"clock_offset.offset", -0.07}},
        Values{{"camera_tilt.tilt", 0.1}}, Values{{"scale.factor", 1.1}},
        Values{{"origin_offset.side_shift", 0.05}, {"origin_offset.down_shift", -0.04}},
        Values{{"marker_offset.across", 0.03}, {"marker_offset.along", 0.02}},
        Values{{"clock_offset.offset", 0.07},
               {"camera_tilt.tilt", 0.1},
               {"scale.factor", 1.1},
               {"marker_offset.across", 0.03}}}) {
    CAPTURE(effects.front().first);
    const Problem problem = seen_with(model, effects, DataKind::kMarkers);
    const Eigen::VectorXd x = problem.start();
    const SeenChain seen = seen_chain(problem, x, 0);
    const Eigen::MatrixXd predicted = problem.predict(x, 0, true).simulated;
    REQUIRE(seen.side.rows() == 2 * kLinks + 1);
    const Recording& recording = problem.experiments()[0].recording;
    double apart = 0;  // of the cable itself, at the camera's times
    const Motion motion = motion_of(problem, x, 0);
    for (std::size_t p = 0; p < recording.points.size(); ++p) {
      const MaterialPoint at = point_at_arc_length(model, problem.model_parameters(x, 0),
                                                   recording.points[p].arc_length);
      const auto drawn = [&](const Eigen::MatrixXd& ends, Index k) {
        return (1 - at.fraction) * ends(2 * at.link, k) + at.fraction * ends(2 * at.link + 1, k);
      };
      const auto row = static_cast<Index>(2 * p);
      for (Index k = 0; k < kFrames; ++k) {
        CHECK(drawn(seen.side, k) == catena::near(predicted(row, k), 1e-9));
        CHECK(drawn(seen.down, k) == catena::near(predicted(row + 1, k), 1e-9));
        const double cable =
            (1 - at.fraction) * motion.side(at.link, k) + at.fraction * motion.side(at.link + 1, k);
        apart = std::max(apart, std::abs(cable - predicted(row, k)));
      }
    }
    CHECK(apart > 0.005);  // the effects do something
  }

  const Problem angles = seen_with(model, {{"camera_tilt.tilt", 0.1}}, DataKind::kAngles);
  const SeenChain seen = seen_chain(angles, angles.start(), 0);
  const Eigen::MatrixXd predicted = angles.predict(angles.start(), 0, true).simulated;
  for (Index k = 0; k < kFrames; ++k)
    for (Index link = 0; link < kLinks; ++link)
      CHECK(std::atan2(seen.side(link + 1, k) - seen.side(link, k),
                       seen.down(link + 1, k) - seen.down(link, k)) ==
            catena::near(predicted(link, k), 1e-9));
}

TEST_CASE("derivatives of what is seen of a chain whose support moves") {
  const testing::TemporaryFolder folder;
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  const Model model = provide_model(
      folder.write(
          "moving.toml",
          "format = 1\nkind = \"model\"\nid = \"moving\"\neffects = [\"support_motion\"]\n"),
      kLinks, options);
  const Problem moving = seen_with(model,
                                   {{"support_motion.side_amplitude", 0.02},
                                    {"support_motion.down_amplitude", 0.01},
                                    {"support_motion.frequency", 1.3},
                                    {"support_motion.side_phase", 0.4},
                                    {"support_motion.down_phase", -0.2}},
                                   DataKind::kMarkers);
  Case the_case = moving.the_case();
  for (ParameterSpec& parameter : the_case.parameters) parameter.free = true;
  const Problem problem(the_case, model, moving.experiments());
  const Eigen::VectorXd x = problem.start();
  REQUIRE(x.size() == 7);
  const Evaluation at = evaluate(problem, x, true, true);
  REQUIRE(at.ok);
  const auto seen = [&](const Eigen::VectorXd& there) {
    return Eigen::VectorXd(problem.predict(there, 0, true).simulated.reshaped());
  };
  for (Index j = 0; j < x.size(); ++j) {
    CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
    const Eigen::MatrixXd& along = at.predictions[0].sensitivity[static_cast<std::size_t>(j)];
    const Eigen::VectorXd difference =
        testing::central_difference(seen, x, j, 1e-3 * std::abs(x[j]));
    CHECK((difference - along.reshaped()).norm() < 1e-3 * along.norm());
  }
}

TEST_CASE("a clock that runs beyond the signals is an impossible value, not the end of a search") {
  const testing::TemporaryFolder folder;
  ProviderOptions options;
  options.derive_program = tests::build_folder() / "bin" / "catena-derive";
  options.cache_directory = folder.path() / "cache";
  const Model model =
      provide_model(folder.write("clocked.toml",
                                 "format = 1\nkind = \"model\"\nid = \"clocked\"\neffects = "
                                 "[\"clock_offset\", \"support_series\"]\n"),
                    kLinks, options);
  std::string series = "time_s,side_m,down_m\n";
  for (Index k = 0; k < kFrames; ++k)  // as long as the recording
    series += std::to_string(0.02 * static_cast<double>(k)) + ",0.01,0.0\n";
  Case the_case = testing::sections(testing::kTwoLinks);
  ParameterSpec clock;
  clock.name = clock.sets = "clock_offset.offset";
  the_case.parameters.push_back(clock);
  the_case.parameters.back().free = true;
  for (const std::string axis : {"side", "down"})
    the_case.signals.push_back({"support_series.support_" + axis,
                                folder.write("series.csv", series), "time_s", axis + "_m"});
  testing::add_experiment(the_case, "run", DataKind::kMarkers);
  const Problem problem(the_case, model,
                        {testing::empty_markers({0.3, 0.5, 0.8, 1.0}, kFrames, 0.02)});
  Eigen::VectorXd x = problem.start();
  CHECK(problem.predict(x, 0, true).ok());
  REQUIRE(problem.unknowns().back().name == clock.name);
  x[x.size() - 1] = 0.001;
  const Prediction beyond = problem.predict(x, 0, true);
  CHECK_FALSE(beyond.ok());
  CHECK(beyond.message.find("which end at 0.78 s") != std::string::npos);
}
