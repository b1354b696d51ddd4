// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/recording.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "common/input_error.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

ExperimentSpec markers(const std::filesystem::path& data) {
  ExperimentSpec spec;
  spec.data = data;
  spec.where = "case.toml:9";
  return spec;
}

std::string message_of(const ExperimentSpec& spec, bool in_space = false) {
  try {
    read_recording(spec, 2, 2.0, in_space);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("default markers are spread evenly, gaps are not seen, windows are kept") {
  const testing::TemporaryFolder folder;
  ExperimentSpec spec = markers(folder.write("m.csv",
                                             "time_s,side_1_m,down_1_m,side_2_m,down_2_m\n"
                                             "0.0,0.1,0.9,0.2,1.8\n"
                                             "0.1,0.2,0.8,,\n"
                                             "0.3,0.3,0.7,0.4,1.6\n"
                                             "0.4,0.4,0.6,0.5,1.5\n"));
  spec.from = 0.1;
  spec.fit_until = 0.3;
  const Recording recording = read_recording(spec, 2, 2.0);
  CHECK(recording.time == std::vector<double>{0.1, 0.3, 0.4});
  CHECK(recording.fit_frames == 2);
  REQUIRE(recording.points.size() == 2);
  CHECK(recording.points[0].arc_length == 1.0);
  CHECK(recording.points[1].arc_length == 2.0);
  CHECK(recording.channels[3].name == "marker 2 down");
  CHECK(recording.measured(0, 1) == 0.3);
  CHECK(std::isnan(recording.measured(2, 0)));
  CHECK(recording.measured(3, 2) == 1.5);

  spec.every = 2;
  CHECK(read_recording(spec, 2, 2.0).time == std::vector<double>{0.1, 0.4});
  spec.use = Use::kValidate;
  CHECK(read_recording(spec, 2, 2.0).fit_frames == 0);
}

TEST_CASE("a column of times whose name speaks of another unit") {
  const testing::TemporaryFolder folder;
  ExperimentSpec spec =
      markers(folder.write("m.csv", "time_ms,side_1_m,down_1_m\n0,0.1,0.9\n100,0.2,0.8\n"));
  REQUIRE(read_recording(spec, 2, 2.0).warnings.size() == 1);
  CHECK(read_recording(spec, 2, 2.0).warnings[0] ==
        "time_unit: the column is called \"time_ms\", but its times are read as s; time_unit = "
        "\"ms\" would agree with it");
  spec.time_unit = "ms";
  CHECK(read_recording(spec, 2, 2.0).warnings.empty());
}

TEST_CASE("pixels, upward and mirrored axes, frame numbers, degrees that jump") {
  const testing::TemporaryFolder folder;
  ExperimentSpec spec = markers(folder.write("m.csv", "frame,x,y\n30,420,10\n60,220,-190\n"));
  spec.time_unit = "frames";
  spec.frame_rate = 60;
  spec.length_unit = "px";
  spec.metres_per_pixel = 0.01;
  spec.origin = {320, 110};
  spec.upward = true;
  spec.mirrored = true;
  PointSpec point;
  point.side_column = "x";
  point.down_column = "y";
  point.arc_length = 1;
  spec.points = {point};
  const Recording recording = read_recording(spec, 2, 2.0);
  CHECK(recording.time == std::vector<double>{0.5, 1.0});
  CHECK(recording.measured(0, 0) == doctest::Approx(-1.0));  // 100 px to the right, mirrored
  CHECK(recording.measured(1, 0) == doctest::Approx(1.0));   // 100 px below the origin
  CHECK(recording.measured(1, 1) == doctest::Approx(3.0));

  ExperimentSpec angles = markers(folder.write("a.csv", "t,phi\n0,170\n10,-170\n20,\n30,-10\n"));
  angles.kind = DataKind::kAngles;
  angles.time_unit = "ms";
  angles.angle_unit = "deg";
  angles.wrapped = true;
  point = {};
  point.angle_column = "phi";
  point.link = 1;
  angles.points = {point};
  const Recording turned = read_recording(angles, 2, 2.0);
  CHECK(turned.time[1] == doctest::Approx(0.01));
  CHECK(turned.measured(0, 1) == doctest::Approx(190 * std::numbers::pi / 180));
  CHECK(turned.measured(0, 3) == doctest::Approx(350 * std::numbers::pi / 180));
}

TEST_CASE("markers in space have three components, in the axes that the case names") {
  const testing::TemporaryFolder folder;
  ExperimentSpec spec = markers(folder.write("m.csv",
                                             "time_s,x_1_m,y_1_m,z_1_m,x_2_m,y_2_m,z_2_m\n"
                                             "0.0,0.3,0.1,0.2,0.4,0.2,-0.7\n"
                                             "0.1,0.4,0.2,0.1,,,\n"));
  spec.axes = {"x", "z", "y"};
  spec.upward = true;
  spec.origin = {0.1, 1.2, -0.1};
  const Recording recording = read_recording(spec, 2, 2.0, true);
  CHECK(recording.components() == 3);
  REQUIRE(recording.channels.size() == 6);
  CHECK(recording.channels[2].component == Component::kAcross);
  CHECK(recording.channels[5].name == "marker 2 across");
  CHECK(recording.points[0].arc_length == 1.0);
  CHECK(recording.measured(0, 0) == doctest::Approx(0.2));  // side: x - 0.1
  CHECK(recording.measured(1, 0) == doctest::Approx(1.0));  // down: 1.2 - z
  CHECK(recording.measured(2, 0) == doctest::Approx(0.2));  // across: y + 0.1
  CHECK(recording.measured(4, 0) == doctest::Approx(1.9));
  CHECK(std::isnan(recording.measured(5, 1)));

  const auto refused = [&](const ExperimentSpec& wrong, bool in_space, const std::string& said) {
    const std::string message = message_of(wrong, in_space);
    CHECK_MESSAGE(message.find("case.toml:9: " + said) != std::string::npos, message);
  };
  refused(spec, false, "axes: 3 names; the model moves in the plane: give 2");
  ExperimentSpec wrong = spec;
  wrong.axes.clear();
  refused(wrong, true,
          "data: " + spec.data.string() + " has no columns side_1_m, down_1_m, across_1_m");
  wrong = spec;
  wrong.origin = {0, 0};
  refused(wrong, true, "origin: 2 numbers; the model moves in space: give 3");
  wrong = spec;
  wrong.kind = DataKind::kAngles;
  refused(wrong, true, "kind: \"angles\"; the model moves in space");
  wrong = spec;
  wrong.source = DataSource::kTracker;
  refused(wrong, true, "source: a film of one camera");
  wrong = spec;
  wrong.axes.clear();
  wrong.origin.clear();
  PointSpec point;
  point.name = "knot";
  point.side_column = "x_1_m";
  point.down_column = "z_1_m";
  wrong.points = {point};
  refused(wrong, true, "markers: knot has no column `across`");
  wrong.points[0].across_column = "y_1_m";
  refused(wrong, false, "markers: knot has a column `across`");
}

TEST_CASE("markers in pictures of cameras are px from the centre of their camera") {
  const testing::TemporaryFolder folder;
  ExperimentSpec spec = markers(folder.write("m.csv", "time_s,x,y\n0,420,10\n0.1,220,\n"));
  spec.length_unit = "px";
  spec.metres_per_pixel = 0.01;
  PointSpec point;
  point.name = "knot";
  point.side_column = "x";
  point.down_column = "y";
  point.camera = "left";
  point.centre = {320, 110};
  point.arc_length = 1;
  spec.points = {point};
  const Recording recording = read_recording(spec, 2, 2.0, true);
  CHECK(recording.components() == 2);
  CHECK(recording.measured(0, 0) == doctest::Approx(1.0));   // 100 px to the right
  CHECK(recording.measured(1, 0) == doctest::Approx(-1.0));  // 100 px above
  CHECK(std::isnan(recording.measured(1, 1)));
  spec.mirrored = spec.upward = true;
  CHECK(read_recording(spec, 2, 2.0, true).measured(0, 0) == doctest::Approx(-1.0));
  CHECK(read_recording(spec, 2, 2.0, true).measured(1, 0) == doctest::Approx(1.0));

  const auto refused = [&](const ExperimentSpec& wrong, bool in_space, const std::string& said) {
    const std::string message = message_of(wrong, in_space);
    CHECK_MESSAGE(message.find("case.toml:9: " + said) != std::string::npos, message);
  };
  refused(spec, false, "markers: camera: the model moves in the plane");
  ExperimentSpec wrong = spec;
  wrong.length_unit = "m";
  refused(wrong, true, "length_unit: \"m\"; the pictures of cameras are in px");
  wrong = spec;
  wrong.origin = {320, 110};
  refused(wrong, true, "origin: pictures have the centre of their camera");
  wrong = spec;
  wrong.points[0].across_column = "y";
  refused(wrong, true, "markers: knot has a column `across`; a picture has side and down only");
  wrong = spec;
  wrong.points.push_back(point);
  wrong.points[1].camera = "";
  wrong.points[1].name = "bead";
  refused(wrong, true, "markers: bead has no camera, and others have one");
}

TEST_CASE(
    "semicolons with decimal commas, tabulators, a byte order mark, NaN for what was not seen") {
  const testing::TemporaryFolder folder;
  for (const char* text :
       {"\xEF\xBB\xBFtime_s;side_1_m;down_1_m\r\n0;0,5;1,75\r\n0,1;NaN;\r\n0,2;-1,5e-1;+2\r\n",
        "time_s\tside_1_m\tdown_1_m\n0\t0.5\t1.75\n0.1\tnan\t\n0.2\t-0.15\t2\n",
        "time_s,side_1_m,down_1_m\n0,0.5,1.75\n0.1,NaN,\n0.2,-0.15,2\n"}) {
    CAPTURE(std::string(text));
    const Recording recording = read_recording(markers(folder.write("m.csv", text)), 2, 2.0);
    CHECK(recording.time == std::vector<double>{0, 0.1, 0.2});
    CHECK(recording.measured(1, 0) == 1.75);
    CHECK(recording.measured(0, 2) == -0.15);
    CHECK(recording.measured.array().isNaN().count() == 2);
  }
}

TEST_CASE("bad data is named by file, line and column") {
  const testing::TemporaryFolder folder;
  struct Row {
    const char* text;
    const char* expected;
  };
  const Row rows[] = {
      {"", "empty"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0.1,1\n", "m.csv:3: 2 fields; the first line names 3"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0.1,1,2,3\n", "m.csv:3: 4 fields"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0.1,one,2\n",
       "column \"side_1_m\": \"one\" is not a number"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0.1,1;5,2\n", "\"1;5\" is not a number"},
      {"time_s;side_1_m;down_1_m\n0;1;2\n0,1;1,5,2;2\n", "\"1,5,2\" is not a number"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0.1,inf,2\n", "\"inf\" is not a number"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n0,1,2\n",
       "m.csv:3: column \"time_s\": 0 s after 0 s; times must increase"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n,1,2\n", "every row needs its time"},
      {"time_s,side_1_m,down_1_m\n0,1,2\n", "at least two are needed"},
      {"time_s,side_1_m,down_1_m\n0,,\n1,,\n", "no measurement"},
      {"time_s,x,y\n0,1,2\n1,1,2\n", "has no columns side_1_m, down_1_m"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    const std::string message = message_of(markers(folder.write("m.csv", row.text)));
    CHECK_MESSAGE(message.find(row.expected) != std::string::npos, message, " lacks ",
                  std::string(row.expected));
  }
  CHECK(message_of(markers(folder.path() / "absent.csv")).find("there is no such file") !=
        std::string::npos);
  ExperimentSpec spec = markers(folder.write("m.csv", "t,x,y\n0,1,2\n1,1,2\n"));
  PointSpec point;
  point.side_column = "xx";
  point.down_column = "y";
  point.arc_length = 1;
  spec.points = {point};
  CHECK(message_of(spec).find("there is no column \"xx\"") != std::string::npos);
  spec.points[0].side_column = "x";
  spec.points[0].arc_length = 2.1;
  CHECK(message_of(spec).find("the cable is 2 m long") != std::string::npos);
}

TEST_CASE("a chord that shrinks without bending is noticed, one that bends is not") {
  const testing::TemporaryFolder folder;
  const auto recording = [&](auto swing, auto bend, double noise) {
    std::mt19937 random(1);
    const auto with_noise = [&](double value) {
      return std::to_string(value + noise * (std::ldexp(static_cast<double>(random()), -31) - 1));
    };
    std::string text =
        "time_s,side_1_m,down_1_m,side_2_m,down_2_m,side_3_m,down_3_m,side_4_m,down_4_m\n";
    for (int k = 0; k < 200; ++k) {
      const double t = 0.02 * k;
      text += std::to_string(t);
      double side = 0, down = 0;
      for (int i = 0; i < 4; ++i) {  // fine pieces of an arc, seen under an angle out of the plane
        for (int j = 0; j < 50; ++j) {
          const double angle = bend(t) * (i + (j + 0.5) / 50);
          side += 0.01 * std::sin(angle) * std::cos(swing(t));
          down += 0.01 * std::cos(angle) * std::cos(swing(t));
        }
        text += "," + with_noise(side) + "," + with_noise(down);
      }
      text += "\n";
    }
    return read_recording(markers(folder.write("m.csv", text)), 4, 2.0);
  };
  const auto still = [](double) { return 0.0; };
  const auto oscillating = [](double t) { return 0.6 * std::sin(3 * t); };
  for (const double noise : {0.0, 0.02}) {  // m at most, beside distances of 0.5 m
    CAPTURE(noise);
    CHECK(recording(still, oscillating, noise).warnings.empty());
    CHECK(!recording(oscillating, still, noise).warnings.empty());
  }
}
