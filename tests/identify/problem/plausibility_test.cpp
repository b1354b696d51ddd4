// SPDX-License-Identifier: BSD-3-Clause
#include "identify/problem/plausibility.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "identify/problem/problem.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/data.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

constexpr double kLength = 1.6;  // m

/// A case of a cable that swings from rest, its two markers and load filmed at 30 frames/s for 6 s.
/// A test then makes one mistake in it.
struct Film {
  double rate = 30, duration = 6, held = 0;  // 1/s, s, s
  double metre = 1;                          // in units of the file
  double support[2] = {0, 0};                // in the file
  int down = 1;                              // which way the second column grows
  std::string time_unit = "s";
  double lost = 1e9;  // s: when the tracker loses the second marker
  std::function<void(Case&)> mistake = [](Case&) {};

  std::string csv() const {
    std::string text = "t,x1,y1,x2,y2,x3,y3\n";
    for (int k = 0; k <= duration * rate; ++k) {
      const double t = k / rate;
      const double unit = time_unit == "s" ? 1 : time_unit == "ms" ? 1e3 : rate;
      text += std::to_string(t * unit);
      const auto angle_at = [&](double time) {
        return 0.7 * std::cos(2.6 * std::max(0.0, time - held));
      };
      for (const double arc : {0.4, 0.9, kLength}) {
        const double angle = angle_at(arc == 0.9 ? std::min(t, lost) : t);
        text += "," + std::to_string(support[0] + metre * arc * std::sin(angle));
        text += "," + std::to_string(support[1] + metre * down * arc * std::cos(angle));
      }
      text += "\n";
    }
    return text;
  }

  /// The error, or the warnings, one a line.
  std::string said() const {
    const testing::TemporaryFolder folder;
    Case the_case = testing::sections(testing::kTwoLinks);
    the_case.cable.length = kLength;
    the_case.initial = {};
    the_case.initial.shape = Shape::kStraight;
    testing::add_experiment(the_case, "film");
    ExperimentSpec& spec = the_case.experiments[0];
    spec.data = folder.write("film.csv", csv());
    spec.time_unit = time_unit;
    const double arcs[] = {0.4, 0.9, kLength};
    for (int p = 0; p < 3; ++p) {
      const std::string number = std::to_string(p + 1);
      PointSpec point;
      point.name = "marker " + number;
      point.side_column = "x" + number;
      point.down_column = "y" + number;
      point.arc_length = arcs[p];
      spec.points.push_back(point);
    }
    mistake(the_case);
    std::string text;
    const std::string error = failure([&] {
      const Problem problem(the_case, Model::built_in(2));
      for (const std::string& warning : problem.experiments()[0].recording.warnings)
        text += warning + "\n";
    });
    return error.empty() ? text : "error: " + error;
  }
};

void expect(const std::string& said, std::initializer_list<const char*> words) {
  for (const char* word : words)
    CHECK_MESSAGE(said.find(word) != std::string::npos, said, " lacks ", std::string(word));
}

ExperimentSpec& spec_of(Case& the_case) { return the_case.experiments[0]; }

}  // namespace

TEST_CASE("a right case raises no alarm, in any units") {
  CHECK(Film().said() == "");
  Film film;
  film.metre = 400;
  film.support[0] = 320;
  film.support[1] = 700;
  film.down = -1;
  film.time_unit = "ms";
  film.mistake = [](Case& the_case) {
    spec_of(the_case).length_unit = "px";
    spec_of(the_case).metres_per_pixel = 1.0 / 400;
    spec_of(the_case).origin = {320, 700};
    spec_of(the_case).upward = true;
  };
  CHECK(film.said() == "");
  film.mistake = [inner =
                      film.mistake](Case& the_case) {  // calibrated 4 % wrongly, clicked 2 cm off
    inner(the_case);
    spec_of(the_case).metres_per_pixel *= 1.04;
    spec_of(the_case).origin = {328, 700};
  };
  CHECK(film.said() == "");
}

TEST_CASE("a wrong unit of length is an error that names the right one") {
  Film film;
  film.mistake = [](Case& the_case) { spec_of(the_case).length_unit = "mm"; };
  expect(film.said(), {"error: case.toml: length_unit: neighbouring markers are 0.001 times",
                       "length_unit = \"m\" would fit"});
  film = {};
  film.metre = 100;
  expect(film.said(), {"error: ", "length_unit: ", "length_unit = \"cm\" would fit"});
  film.metre = 409;
  expect(film.said(), {"error: ", "length_unit = \"px\" and metres_per_pixel = 0.00244"});
  film.mistake = [](Case& the_case) {  // pixels per metre for metres per pixel
    spec_of(the_case).length_unit = "px";
    spec_of(the_case).metres_per_pixel = 409;
  };
  expect(film.said(), {"error: ", "metres_per_pixel: ", "metres_per_pixel = 0.00244 would fit"});
  film.metre = 1;
  film.mistake = [](Case& the_case) { the_case.cable.length = 1.9; };
  CHECK(film.said() == "");  // a marker need not be at the end
  film.mistake = [](Case& the_case) {
    for (PointSpec& point : spec_of(the_case).points) point.arc_length *= 0.8;
    the_case.cable.length *= 0.8;
  };
  expect(film.said(), {"length_unit: ", "1.25 times", "`length`"});
}

TEST_CASE("a wrong origin, order or direction is named") {
  Film film;
  film.support[0] = 0.32;
  film.support[1] = 0.04;
  expect(film.said(), {"error: ", "origin: marker 1 is", "about [0.32, 0.04]"});
  film = {};
  film.mistake = [](Case& the_case) {
    std::vector<PointSpec>& points = spec_of(the_case).points;
    std::swap(points[0].side_column, points[2].side_column);
    std::swap(points[0].down_column, points[2].down_column);
    for (PointSpec& point : points)
      point.arc_length = kLength * static_cast<double>(&point - points.data() + 1) / 3;
  };
  expect(film.said(), {"error: ", "markers: ", "listed from the load upwards"});
  film.mistake = [](Case& the_case) { spec_of(the_case).upward = true; };
  expect(film.said(), {"vertical: on average the cable points upwards; vertical = \"down\""});
  film = {};
  film.down = -1;
  expect(film.said(), {"vertical: ", "vertical = \"up\""});
  film = {};
  film.mistake = [](Case& the_case) {
    for (PointSpec& point : spec_of(the_case).points)
      std::swap(point.side_column, point.down_column);
  };
  expect(film.said(), {"markers: ", "sideways"});
}

TEST_CASE("a length, and places along the cable, that do not fit the markers are named") {
  Film film;
  film.mistake = [](Case& the_case) { the_case.cable.length = 1600; };  // mm
  expect(film.said(), {"length: the last marker is at 1.6 m", "1600 m long"});
  film.mistake = [](Case& the_case) { the_case.cable.length = 3.1; };  // more than half is marked
  CHECK(film.said().find("length: ") == std::string::npos);
  film.mistake = [](Case& the_case) {  // uneven markers taken as even
    std::vector<PointSpec>& points = spec_of(the_case).points;
    for (PointSpec& point : points)
      point.arc_length = kLength * static_cast<double>(&point - points.data() + 1) / 3;
  };
  expect(film.said(), {"markers: marker 2 and marker 3 are 0.7 m apart, but only 0.533 m"});
  film.mistake = [](Case& the_case) {  // 0.1 m farther from the next than the cable is long
    spec_of(the_case).points[1].arc_length = 1.03;
  };
  expect(film.said(), {"markers: marker 2 and marker 3 are 0.7 m apart"});
  film.mistake = [](Case& the_case) {  // the columns of two markers exchanged
    std::vector<PointSpec>& points = spec_of(the_case).points;
    std::swap(points[1].side_column, points[2].side_column);
    std::swap(points[1].down_column, points[2].down_column);
  };
  expect(film.said(),
         {"error: ", "markers: marker 1 and marker 2 are 1.2 m apart", "in the order of the file"});
}

TEST_CASE("an origin near the first marker is named") {
  Film film;  // the support of the film is at 0, 0; the case puts it near marker 1
  film.mistake = [](Case& the_case) { spec_of(the_case).origin = {0, 0.35}; };
  expect(film.said(), {"origin: marker 1 is only", "about [0, "});
}

TEST_CASE("a wrong unit of time is named") {
  Film film;
  film.time_unit = "ms";
  film.mistake = [](Case& the_case) { spec_of(the_case).time_unit = "s"; };
  expect(film.said(), {"time_unit: the cable swings once in 2400 s", "takes 2.54 s"});
  film.duration = 1.2;  // no period of it
  expect(film.said(), {"time_unit: ", "0.03 frames per second"});
  film = {};
  film.mistake = [](Case& the_case) { spec_of(the_case).time_unit = "ms"; };
  expect(film.said(), {"time_unit: ", "0.0024 s"});
  film = {};
  film.time_unit = "frames";
  film.mistake = [](Case& the_case) { spec_of(the_case).time_unit = "s"; };
  expect(film.said(), {"time_unit: "});
  film.mistake = [](Case& the_case) { spec_of(the_case).frame_rate = 15; };
  expect(film.said(), {"frame_rate: ", "4.8 s"});
}

TEST_CASE("a start that is not the release is named") {
  Film film;
  film.mistake = [](Case& the_case) { spec_of(the_case).from = 0.3; };
  expect(film.said(), {"from: the cable moves at", "release"});
  film.mistake = [](Case& the_case) {  // a velocity is allowed for
    spec_of(the_case).from = 0.3;
    the_case.initial.at_rest = false;
  };
  CHECK(film.said() == "");
  film.mistake = [](Case& the_case) { spec_of(the_case).window = 1; };
  expect(film.said(), {"window: the cable moves at", "at 1 s", "every window start at rest"});
  film.mistake = [](Case& the_case) {
    spec_of(the_case).window = 1;
    the_case.initial.at_rest = false;
  };
  CHECK(film.said() == "");
  film = {};
  film.held = 0.8;
  expect(film.said(), {"from: the cable is held until 0.8", "from = 0.8"});
}

TEST_CASE("a marker that the tracker lost is named, and no length for it") {
  Film film;
  film.lost = 2.1;
  const std::string said = film.said();
  expect(said, {"markers: marker 2 stays where it is from 2.1 to 6 s, while marker 3 moves; "});
  CHECK(said.find("length_unit") == std::string::npos);
}

TEST_CASE("noise, fit_until and masses in another unit are named") {
  Film film;
  film.mistake = [](Case& the_case) { spec_of(the_case).noise = 1; };
  expect(film.said(), {"noise: 1 m hides the motion"});
  film.mistake = [](Case& the_case) { spec_of(the_case).fit_until = 4000; };
  expect(film.said(), {"fit_until: 4000 s is after the last frame (6 s)"});
  film.mistake = [](Case& the_case) { the_case.initial.coefficients = {40}; };
  expect(film.said(), {"initial: an angle of 40 rad is 6.37 turns", "40 degrees are 0.698"});
  film.mistake = [](Case& the_case) { the_case.cable.density = 142; };
  expect(film.said(), {"density: 142 kg/m"});
  film.mistake = [](Case& the_case) { the_case.cable.load_mass = 1381; };
  expect(film.said(), {"load_mass: 1380 kg"});
}

TEST_CASE(
    "a cable that snaps within milliseconds after it is let go began at rest; one that moved did "
    "not") {
  // 1000 frames/s: 0.5 (cos t - 1) of a swing, and a snap to 4 m/s with a time constant of 3 ms.
  const auto said = [](double snap, double before, double noise, unsigned seed = 3) {
    Film film;
    film.rate = 1000;
    film.duration = 2;
    film.mistake = [=](Case& the_case) {
      ExperimentSpec& spec = spec_of(the_case);
      std::mt19937_64 generator(seed);
      std::normal_distribution<double> normal(0, noise);
      std::string text = "t,x1,y1,x2,y2,x3,y3\n";
      for (int k = 0; k < 2000; ++k) {
        const double t = k / 1000.0;
        text += std::to_string(t);
        const double shift = snap * (t - 0.003 * (1 - std::exp(-t / 0.003))) * std::exp(-t / 0.05) +
                             before * t * std::exp(-t / 0.2);
        for (const double arc : {0.4, 0.9, kLength}) {
          const double swing = 0.7 * std::cos(2.6 * t);
          text += "," + std::to_string(arc * std::sin(swing) + shift + normal(generator));
          text += "," + std::to_string(arc * std::cos(swing) + normal(generator));
        }
        text += "\n";
      }
      std::ofstream(spec.data) << text;
    };
    return film.said();
  };
  CHECK(said(4, 0, 1e-9) == "");
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U, 6U}) CHECK(said(4, 0, 1e-4, seed) == "");
  CHECK(said(0, 0, 1e-3) == "");
  for (const double noise : {1e-9, 1e-4, 1e-3})
    expect(said(0, 2, noise), {"from: the cable moves at", "release"});
}

TEST_CASE("angles in degrees taken as radians are named, right ones are not") {
  const testing::TemporaryFolder folder;
  std::string degrees = "t,theta_1_rad\n";
  for (int k = 0; k < 300; ++k)
    degrees += std::to_string(k / 50.0) + "," + std::to_string(40 * std::cos(0.06 * k)) + "\n";
  Case the_case = testing::sections(testing::kTwoLinks);
  testing::add_experiment(the_case, "encoder", DataKind::kAngles);
  spec_of(the_case).data = folder.write("angles.csv", degrees);
  const auto warnings = [&] {
    return Problem(the_case, Model::built_in(2)).experiments()[0].recording.warnings;
  };
  REQUIRE(warnings().size() == 1);
  expect(warnings()[0], {"angle_unit: ", "angle_unit = \"deg\""});
  spec_of(the_case).angle_unit = "deg";
  CHECK(warnings().empty());
}

TEST_CASE("published recordings raise no alarm") {
  struct Row {
    const char* name;
    double length;  // m
    bool at_rest;
  };
  for (const Row& row : {Row{"engine_air/markers.csv", 2.585, true},
                         {"engine_dry/markers.csv", 2.585, true},
                         {"engine_quiet/markers.csv", 2.585, true},
                         {"cable_black_unweighted/markers.csv", 0.6, true},
                         {"cable_orange_weighted/markers.csv", 0.75, false},
                         {"string_bob_1003mm/markers.csv", 1.003, false},
                         {"string_bob_1474mm/markers.csv", 1.474, false},
                         {"double_pendulum/angles.csv", 0.4013, false},
                         {"single_pendulum/angles.csv", 0.1727, false},
                         {"rod_pendulum_1/angles.csv", 0.32, false}}) {
    CAPTURE(std::string(row.name));
    const auto data = tests::published_data(row.name);
    if (!data) return;
    ExperimentSpec spec;
    spec.data = *data;
    spec.keep_outliers = true;  // the orange cable has some
    if (std::string(row.name).find("angles") != std::string::npos) spec.kind = DataKind::kAngles;
    const int links = 2;
    const Recording recording = read_recording(spec, links, row.length);
    InitialSpec initial;
    initial.shape = Shape::kSmooth;
    initial.at_rest = row.at_rest;
    CableGeometry cable;
    cable.density = 0.1;
    const Eigen::VectorXd lengths = Eigen::VectorXd::Constant(links, row.length / links);
    for (const std::string& warning :
         check_plausible(recording, spec, initial, cable, lengths, Model::built_in(links)))
      CHECK_MESSAGE(false, warning);
  }
}
