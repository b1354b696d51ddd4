// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/outliers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "identify/recordings/table.hpp"
#include "tests/support/data.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::Index;

namespace {

constexpr double kRate = 25;  // frames/s

/// Four markers on a cable of 1.6 m, `place(p, t)` from the support, with 1 mm of noise.
template <class Place>
Recording filmed(int frames, Place place, double noise = 1e-3) {
  std::mt19937_64 generator(1);
  std::normal_distribution<double> normal(0, noise);
  Recording recording;
  recording.points.resize(4);
  for (int p = 0; p < 4; ++p)
    for (const Component component : {Component::kSide, Component::kDown})
      recording.channels.push_back({p, component, ""});
  recording.measured.resize(8, frames);
  for (int k = 0; k < frames; ++k) {
    recording.time.push_back(k / kRate);
    for (int p = 0; p < 4; ++p) {
      const auto [side, down] = place(p, k / kRate);
      recording.measured(2 * p, k) = side + (noise > 0 ? normal(generator) : 0);
      recording.measured(2 * p + 1, k) = down + (noise > 0 ? normal(generator) : 0);
    }
  }
  return recording;
}

/// A swing with a fast second mode.
std::pair<double, double> swing(int p, double t) {
  const double s = 0.4 * (p + 1);
  const double angle = 0.6 * std::cos(2.5 * t) + 0.1 * std::cos(14 * t) * (p % 2 ? 1 : -1);
  return {s * std::sin(angle), s * std::cos(angle)};
}

std::vector<Outlier> outliers_of(const Recording& recording) {
  return find_outliers(recording, 1.6);
}

}  // namespace

TEST_CASE("points beside the motion are found, named and measured; nothing else is") {
  Recording recording = filmed(200, swing);
  CHECK(outliers_of(recording).empty());
  recording.measured(4, 60) += 0.060;   // marker 3 to the side
  recording.measured(7, 139) -= 0.085;  // marker 4 upwards
  recording.measured(0, 0) += 0.2;      // at the very start
  recording.measured.col(100).setConstant(std::nan(""));
  const std::vector<Outlier> found = outliers_of(recording);
  REQUIRE(found.size() == 3);
  CHECK(found[0].point == 0);
  CHECK(found[0].frame == 0);
  CHECK((found[1].point == 2 && found[1].frame == 60));
  CHECK((found[2].point == 3 && found[2].frame == 139));
  CHECK(found[1].size == catena::near(0.060, 0.1));
  CHECK(found[2].size == catena::near(0.085, 0.1));
}

TEST_CASE("two in a row, and two markers that were exchanged in one frame") {
  Recording recording = filmed(200, swing);
  recording.measured(4, 60) += 0.1;
  recording.measured(4, 61) -= 0.07;
  recording.measured.block<2, 1>(2, 120).swap(recording.measured.block<2, 1>(4, 120));
  const std::vector<Outlier> found = outliers_of(recording);
  REQUIRE(found.size() == 4);
  CHECK((found[0].point == 1 && found[0].frame == 120));
  CHECK((found[1].point == 2 && found[1].frame == 60));
  CHECK((found[2].point == 2 && found[2].frame == 61));
  CHECK((found[3].point == 2 && found[3].frame == 120));
}

TEST_CASE("fast motion, blows, jumps of the camera and noise are no outliers") {
  const auto moved_by = [](auto extra) {
    return [extra](int p, double t) {
      auto [side, down] = swing(p, t);
      return std::pair<double, double>{side + extra(p, t), down};
    };
  };
  const auto alone = [](int p, double value) { return p == 3 ? value : 0.0; };
  for (const double frequency : {3.0, 6.25, 9.0, 12.0}) {  // up to the limit of the camera
    CAPTURE(frequency);
    CHECK(outliers_of(filmed(200, moved_by([&](int p, double t) {
                               return alone(p, 0.1 * std::sin(6.2832 * frequency * t));
                             })))
              .empty());
  }
  for (double when = 2; when < 2 + 1 / kRate; when += 0.2 / kRate) {
    CAPTURE(when);
    const auto blow = [&](int p, double t) {  // the speed changes at once, then fades
      return alone(p, t > when ? 0.2 * std::sin(20 * (t - when)) * std::exp(-6 * (t - when)) : 0);
    };
    CHECK(outliers_of(filmed(200, moved_by(blow))).empty());
    const auto jump = [&](int p, double t) { return alone(p, t > when ? 0.1 : 0); };
    CHECK(outliers_of(filmed(200, moved_by(jump))).empty());
  }
  Recording bumped = filmed(200, swing);
  bumped.measured.col(80).array() += 0.05;
  CHECK(outliers_of(bumped).empty());
  CHECK(outliers_of(filmed(20000, swing, 3e-3)).empty());
}

TEST_CASE("published recordings: no outliers where a simulator or an encoder measured") {
  for (const char* name :
       {"engine_air", "engine_dry", "engine_quiet", "double_pendulum", "single_pendulum",
        "rod_pendulum_1", "string_bob_1003mm", "string_bob_1474mm"}) {
    CAPTURE(std::string(name));
    const bool angles = std::string(name).find("_pendulum") != std::string::npos;
    const auto data =
        tests::published_data(std::string(name) + (angles ? "/angles.csv" : "/markers.csv"));
    if (!data) return;
    ExperimentSpec spec;
    spec.data = *data;
    spec.kind = angles ? DataKind::kAngles : DataKind::kMarkers;
    const Recording recording = read_recording(spec, 12, 1.0);
    CHECK(recording.warnings.empty());
    CHECK(find_outliers(recording, 1.0).empty());
  }
}

TEST_CASE("outliers are left out of what is read, with a warning, unless the case keeps them") {
  const testing::TemporaryFolder folder;
  std::string text = "time_s,side_1_m,down_1_m\n";
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.5 * std::cos(0.1 * k);
    text += std::to_string(0.04 * k) + "," +
            std::to_string(std::sin(angle) + (k == 31 ? 0.072 : 0)) + "," +
            std::to_string(std::cos(angle)) + "\n";
  }
  ExperimentSpec spec;
  spec.data = folder.write("m.csv", text);
  const Recording recording = read_recording(spec, 2, 1.0);
  CHECK(std::isnan(recording.measured(0, 31)));
  CHECK(std::isnan(recording.measured(1, 31)));
  CHECK(recording.measured.array().isNaN().count() == 2);
  REQUIRE(recording.warnings.size() == 1);
  for (const char* word :
       {"1 outlier is left out", "marker 1 at 1.24 s", "line 33", "72 mm", "outliers = \"keep\""})
    CHECK_MESSAGE(recording.warnings[0].find(word) != std::string::npos, recording.warnings[0]);
  spec.keep_outliers = true;
  const Recording kept = read_recording(spec, 2, 1.0);
  CHECK(!kept.measured.array().isNaN().any());
  CHECK(kept.warnings.empty());
}
