// SPDX-License-Identifier: BSD-3-Clause
#include "identify/diagnosis/telling_experiment.hpp"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <memory>
#include <string>

#include "identify/least_squares/least_squares.hpp"
#include "runtime/any_links.hpp"
#include "tests/identify/diagnosis/two_link_case.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

constexpr double kFilmNoise = 1e-3;  // m

/// A rod of 1 m, two links with a stiff joint, that swings by 0.05 rad, with a spring at the support or in a stronger
/// field instead: (mass / 2 + load) g l theta + stiffness theta is the moment of both.
FittedModel pendulum(double gravity, double stiffness, double mass, double load) {
  constexpr double angle = 0.05;
  Case the_case = testing::sections(fmt::format(
      "[model]\nlinks = 2\n[cable]\nlength = 1.0\nlink_masses = [{0}, {0}]\nload_mass = {1}\n"
      "gravity = {2}\n[[parameter]]\nname = \"k\"\nsets = \"stiffness_1\"\nvalue = {3}\n"
      "[[parameter]]\nname = \"stiff\"\nsets = \"stiffness_2\"\nvalue = 20.0\n"
      "[[parameter]]\nname = \"c\"\nsets = \"damping\"\nvalue = 0.001\nfree = true\n"
      "[initial]\nshape = \"straight\"\nangle = {4}\n",
      mass / 2, load, gravity, stiffness, angle));
  testing::add_experiment(the_case, "run");
  const Model model = any_links_model(2);
  const auto problem = std::make_shared<const Problem>(
      the_case, model,
      std::vector<Recording>{testing::with_truth(
          the_case, model, testing::empty_markers({1.0}, 101, 0.05), kFilmNoise)});
  return assess(problem, problem->start(), fit_least_squares, nullptr);
}

/// The two links whose support moves as a signal says that is as long as the recording.
FittedModel moved(const testing::TemporaryFolder& folder, double gravity) {
  constexpr int frames = 40;
  constexpr double step = 0.02;  // s
  const Model model = provide_model(folder.write("moved.toml",
                                                 "format = 1\nkind = \"model\"\nid = \"moved\"\n"
                                                 "effects = [\"support_series\"]\n"),
                                    2, testing::provider_of_build());
  Case the_case = testing::sections(testing::kTwoLinks);
  the_case.cable.gravity = gravity;
  std::string series = "time_s,side_m,down_m\n";
  for (int k = 0; k < frames; ++k) series += fmt::format("{},{},0.0\n", step * k, 0.001 * k);
  for (const std::string axis : {"side", "down"})
    the_case.signals.push_back({"support_series.support_" + axis,
                                folder.write("series.csv", series), "time_s", axis + "_m"});
  testing::add_experiment(the_case, "run");
  const Recording seen = testing::with_truth(
      the_case, model, testing::empty_markers({0.5, 1.0}, frames, step), kFilmNoise);
  const auto problem =
      std::make_shared<const Problem>(the_case, model, std::vector<Recording>{seen});
  return assess(problem, problem->start(), fit_least_squares, nullptr);
}

}  // namespace

TEST_CASE("a spring and a stronger field are told apart by another load, half of it the better") {
  // omega^2 = g/l + k/(m l^2): with half the load the spring does twice as much, with twice half as much.
  const double load = 0.2, stiffness = 0.2;
  const FittedModel spring = pendulum(9.81, stiffness, 0.01, load);
  const FittedModel field = pendulum(9.81 + stiffness / (load + 0.005), 0, 0.01, load);
  REQUIRE(spring.ok);
  REQUIRE(field.ok);
  const TellingExperiment telling = telling_experiment(spring, field, {kFilmNoise});
  CHECK(telling.words.starts_with("the same start with half the load, filmed for 10 s"));
  // The phases run apart by 0.15 rad each second: at most 0.05 m sin(0.75), in the mean over time and
  // components half of it.
  CHECK(telling.difference > 10);
  CHECK(telling.difference < 50);
}

TEST_CASE("where there is no load none is changed") {
  const double mass = 0.2, stiffness = 0.1;
  const FittedModel spring = pendulum(9.81, stiffness, mass, 0);
  const FittedModel field = pendulum(9.81 + 2 * stiffness / mass, 0, mass, 0);
  REQUIRE(spring.ok);
  REQUIRE(field.ok);
  const TellingExperiment telling = telling_experiment(spring, field, {kFilmNoise});
  CHECK(telling.words.find(" with ") == std::string::npos);
  CHECK(telling.difference < 5);  // sine and angle differ little
}

TEST_CASE("an experiment is no longer than the signals that are known") {
  const testing::TemporaryFolder folder;
  const FittedModel weaker = moved(folder, 9.0), stronger = moved(folder, 10.0);
  REQUIRE(weaker.ok);
  REQUIRE(stronger.ok);
  const TellingExperiment telling = telling_experiment(weaker, stronger, {kFilmNoise});
  CHECK(telling.difference > 1);
  CHECK(telling.words.find("filmed for 0.78 s") != std::string::npos);
}
