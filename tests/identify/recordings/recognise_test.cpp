// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/recognise.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "identify/recordings/recording.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

namespace {

/// How a recording of a swing from rest is written.
struct Style {
  std::string names = "time_s,x1,y1,x2,y2";
  double time = 1, length = 1;  // one s, one m in units of the file
  double support[2] = {0, 0};
  int down = 1;
  double held = 0;    // s
  double start = 0;   // s after the release
  double jitter = 0;  // s: every second of three frames is late by it, every third by twice
};

RecognisedRecording recognised(const Style& style, KnownOfRecording known = {}) {
  const testing::TemporaryFolder folder;
  std::string text = style.names + "\n";
  const char separator = style.names.find(';') == std::string::npos ? ',' : ';';
  for (int k = 0; k < 150; ++k) {
    std::string row = std::to_string((k / 30.0 + k % 3 * style.jitter) * style.time);
    const double angle = 0.7 * std::cos(2.6 * std::max(0.0, k / 30.0 - style.held + style.start));
    for (const double arc : {0.6, 1.5}) {
      row += ";" + std::to_string(style.support[0] + style.length * arc * std::sin(angle));
      row += ";" +
             std::to_string(style.support[1] + style.length * style.down * arc * std::cos(angle));
    }
    for (char& c : row) c = c == ';' ? separator : c == '.' && separator == ';' ? ',' : c;
    text += row + "\n";
  }
  known.length = 1.5;
  known.arc_lengths = {0.6, 1.5};
  return recognise_recording(folder.write("film.csv", text), known);
}

}  // namespace

TEST_CASE("units come from the names, or from steps and distances") {
  ExperimentSpec spec = recognised({}).spec;
  CHECK(spec.time_unit == "s");
  CHECK(spec.length_unit == "m");
  CHECK(!spec.upward);
  CHECK(spec.origin.empty());
  REQUIRE(spec.points.size() == 2);
  CHECK(spec.points[1].side_column == "x2");
  CHECK(spec.points[1].arc_length == 1.5);

  Style style{.names = "Time [ms];Marker1_X (mm);Marker1_Y (mm);Marker2_X (mm);Marker2_Y (mm)",
              .time = 1000,
              .length = 1000};
  spec = recognised(style).spec;
  CHECK(spec.time_unit == "ms");
  CHECK(spec.length_unit == "mm");
  CHECK(spec.points[1].down_column == "Marker2_Y (mm)");
  style.names = "t;ax;ay;bx;by";  // no units: from the numbers
  style.length = 100;
  spec = recognised(style).spec;
  CHECK(spec.time_unit == "ms");
  CHECK(spec.length_unit == "cm");
  style.time = 30;
  style.length = 400;
  CHECK(failure([&] { recognised(style); }).find("--frame-rate") != std::string::npos);
  KnownOfRecording known;
  known.frame_rate = 30;
  const RecognisedRecording film = recognised(style, known);
  CHECK(film.spec.time_unit == "frames");
  CHECK(film.spec.length_unit == "px");
  CHECK(film.spec.metres_per_pixel == catena::near(1.0 / 400, 0.01));
  CHECK(film.estimated == std::vector<std::string>{"metres_per_pixel"});
}

TEST_CASE("where down is, where the support is, when the cable is let go") {
  Style style{.length = 400, .support = {320, 700}, .down = -1, .held = 0.5};
  RecognisedRecording found = recognised(style);
  CHECK(found.spec.upward);
  CHECK(found.spec.origin[0] == catena::near(320, 0.01));
  CHECK(found.spec.origin[1] == catena::near(700, 0.01));
  CHECK(found.spec.from == catena::near(0.5, 0.2));
  CHECK(found.at_rest);
  KnownOfRecording known;
  known.origin = {318, 702};
  known.metres_per_pixel = 0.0025;
  found = recognised(style, known);
  CHECK(found.spec.origin == std::vector<double>{318, 702});
  CHECK(found.estimated == std::vector<std::string>{"from"});
  style = {};
  CHECK(recognised(style).at_rest);
  style.start = 0.3;
  CHECK(!recognised(style).at_rest);
}

TEST_CASE("what is read with the recognised case is the motion") {
  const RecognisedRecording found = recognised({.names = "frame;p1x;p1y;p2x;p2y",
                                                .time = 30,
                                                .length = 400,
                                                .support = {320, 700},
                                                .down = -1},
                                               [] {
                                                 KnownOfRecording known;
                                                 known.frame_rate = 30;
                                                 known.metres_per_pixel = 1.0 / 400;
                                                 known.origin = {320, 700};
                                                 return known;
                                               }());
  CHECK(found.spec.points[0].side_column == "p1x");
  CHECK(found.spec.points[1].down_column == "p2y");
}

TEST_CASE("the frame rate is that of the whole film, whatever single steps are") {
  const RecognisedRecording found = recognised({.jitter = 0.004});
  CHECK_MESSAGE(found.understood[0].find("in s, 29.9") != std::string::npos, found.understood[0]);
  KnownOfRecording known;
  known.frame_rate = 25;
  const std::string refused = failure([&] { recognised({}, known); });
  CHECK_MESSAGE(refused.find("--frame-rate: 25; column \"time_s\"") != std::string::npos, refused);
}

TEST_CASE("a file without markers is refused with what is wanted") {
  const auto refused = [](const char* names) {
    return failure([&] { recognised({.names = names}); });
  };
  CHECK(refused("time_s,a,b,c,d").find("no markers; name their columns x1, y1") !=
        std::string::npos);
  CHECK(refused("time_s,x1,y1,x2,z2").find("\"x2\" has no partner") != std::string::npos);
  KnownOfRecording known;
  const testing::TemporaryFolder folder;
  known.length = 1;
  known.arc_lengths = {0.5};
  CHECK(failure([&] {
          recognise_recording(folder.write("m.csv", "t,x1,y1,x2,y2\n0,0,1,0,2\n0.1,0,1,0,2\n"),
                              known);
        }).find("--markers: 1 places; the recording has 2 markers") != std::string::npos);
}
