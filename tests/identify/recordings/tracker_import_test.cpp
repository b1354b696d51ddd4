// SPDX-License-Identifier: BSD-3-Clause
#include "identify/recordings/tracker_import.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "common/input_error.hpp"
#include "identify/recordings/table.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;

TEST_CASE("exports of tracker programs are read as they are") {
  const testing::TemporaryFolder folder;
  struct Row {
    const char* what;
    DataSource source;
    const char* text;
    std::vector<std::string> names;
    std::vector<double> times, x, y;  // of the first point
  };
  const double nan = NAN;
  const Row rows[] = {
      {"Tracker, two tracks with speeds",
       DataSource::kTracker,
       ",mass_A,,,,mass_B,\nt,x,y,vx,vy,x,y\n0.0,1.5,-2.5,,,3,4\n0.033,1.6,-2.4,0.1,0.2,,\n",
       {"time", "mass_A x", "mass_A y", "mass_B x", "mass_B y"},
       {0, 0.033},
       {1.5, 1.6},
       {-2.5, -2.4}},
      {"Tracker, one track, decimal commas",
       DataSource::kTracker,
       "mass_A\nt;x;y\n0,0;1,5;-2,5\n0,5;1,6;-2,4\n",
       {"time", "mass_A x", "mass_A y"},
       {0, 0.5},
       {1.5, 1.6},
       {-2.5, -2.4}},
      {"Kinovea, named tracks that begin apart",
       DataSource::kKinovea,
       "#Kinovea Trajectory data export\n#T X Y\n\n# red\n0.5 10 20\n1 11 21\n\n# blue\n0 1 2\n0.5 "
       "3 4\n",
       {"time", "red x", "red y", "blue x", "blue y"},
       {0, 0.5, 1},
       {nan, 10, 11},
       {nan, 20, 21}},
      {"Kinovea, older: no names, clock times",
       DataSource::kKinovea,
       "#Kinovea Trajectory data export\n#T X Y\n0:00:00:00 866.00 320,00 \n0:01:02:03 847.00 "
       "321.00 \n",
       {"time", "track 1 x", "track 1 y"},
       {0, 62.03},
       {866, 847},
       {320, 321}},
      {"DeepLabCut",
       DataSource::kDeepLabCut,
       "scorer,net,net,net,net,net,net\nbodyparts,tip,tip,tip,mid,mid,mid\n"
       "coords,x,y,likelihood,x,y,likelihood\n0,1,2,0.99,3,4,0.9\n1,5,6,0.2,7,8,0.95\n",
       {"time", "tip x", "tip y", "mid x", "mid y"},
       {0, 1},
       {1, nan},
       {2, nan}},
  };
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double u, double v) {
      return (std::isnan(u) && std::isnan(v)) || std::abs(u - v) < 1e-12;
    });
  };
  for (const Row& row : rows) {
    CAPTURE(row.what);
    const Table table = import_tracker_table(row.source, folder.write("t.csv", row.text), 0.6);
    CHECK(table.names == row.names);
    CHECK(same(table.columns[0], row.times));
    CHECK(same(table.columns[1], row.x));
    CHECK(same(table.columns[2], row.y));
  }
}

TEST_CASE("what is no export of that program is refused with its line") {
  const testing::TemporaryFolder folder;
  struct Row {
    DataSource source;
    const char* text;
    const char* expected;
  };
  const Row rows[] = {
      {DataSource::kTracker, "a,b\nx,y\n1,2\n", "t.csv:2: the second line"},
      {DataSource::kTracker, ",m,\nt,x,y\n0,a,1\n", "t.csv:3: \"a\" is not a number"},
      {DataSource::kKinovea, "time x y\n", "t.csv:1: a text export of Kinovea"},
      {DataSource::kKinovea, "#Kinovea\n#T X Y\n0 1\n", "t.csv:3: time, x and y"},
      {DataSource::kKinovea, "#Kinovea\n0:00:00 1 2\n", "no time h:mm:ss:cc"},
      {DataSource::kDeepLabCut, "a,b\n1,2\n", "scorer, bodyparts and coords"},
      {DataSource::kDeepLabCut, "scorer,n,n,n\nbodyparts,t,t,t\ncoords,x,y,likelihood\n0,1,2\n",
       "t.csv:4: 3 fields; 4 are wanted"},
  };
  for (const Row& row : rows) {
    CAPTURE(row.text);
    std::string message;
    try {
      import_tracker_table(row.source, folder.write("t.csv", row.text), 0.6);
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK_MESSAGE(message.find(row.expected) != std::string::npos, message);
  }
}
