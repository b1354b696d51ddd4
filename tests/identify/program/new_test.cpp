// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <cmath>

#include "identify/cases/case_reader.hpp"
#include "tests/identify/program/catena_program.hpp"

using namespace catena;
using testing::run_catena;

namespace {

/// The swing of two links, simulated, as a film: milliseconds, pixels, the origin above the picture,
/// semicolons and decimal commas, one wild point.
std::string film(const testing::TemporaryFolder& folder) {
  const auto swing = folder.write(
      "swing.toml", testing::replaced(testing::kSwing, "duration = 1.0", "duration = 3.0"));
  REQUIRE(run_catena({"simulate", swing, "--output", folder.path() / "swing", "-q"}).exit_status ==
          0);
  std::istringstream in(testing::text_of(folder.path() / "swing" / "positions.csv"));
  std::string line, out = "time_ms;x1;y1;x2;y2\n";
  std::getline(in, line);
  for (int row = 0; std::getline(in, line); ++row) {
    std::istringstream fields(line);
    std::string field, text;
    for (int i = 0; std::getline(fields, field, ',') && i < 5; ++i) {
      const double value = std::stod(field);
      text += i ? ";" : "";
      text += std::to_string(i == 0 ? 1000 * value
                                    : 400 * value + (i % 2 ? 320 : 40) +
                                          (i == 3 && row == 71 ? 60 : 0));
    }
    for (char& c : text)
      if (c == '.') c = ',';
    out += text + "\n";
  }
  return folder.write("film.csv", out);
}

}  // namespace

TEST_CASE("new makes a commented case and a picture of a film; the case finds the truth") {
  const testing::TemporaryFolder folder;
  const ProcessResult made =
      run_catena({"new", film(folder), "--length", "1.0", "--density", "0.3", "--load-mass", "0.2",
                  "--origin", "320,40", "--metres-per-pixel", "0.0025"});
  CHECK_MESSAGE(made.exit_status == 0, made.output);
  for (const char* word : {"in ms, 50 frames per second, 151 frames", "grows downwards",
                           "1 outlier is left out", "marker 2 at 1.42 s", "film.svg"})
    CHECK_MESSAGE(made.output.find(word) != std::string::npos, made.output, " lacks ",
                  std::string(word));
  const std::string text = testing::text_of(folder.path() / "film.toml");
  for (const char* line : {"# Made by catena new", "kg, at the end", "origin = [320, 40]"})
    CHECK_MESSAGE(text.find(line) != std::string::npos, text);
  const std::string picture = testing::text_of(folder.path() / "film.svg");
  CHECK(picture.find("Rings: 1 outliers") != std::string::npos);
  const ProcessResult check = run_catena({"identify", folder.path() / "film.toml", "--check"});
  CHECK_MESSAGE(check.exit_status == 0, check.output);
  CHECK(check.output.find("1 outlier is left out") != std::string::npos);
  // Nothing is overwritten.
  CHECK(run_catena({"new", folder.path() / "film.csv", "--length", "1", "--density", "0.3",
                    "--load-mass", "0"})
            .output.find("film.toml exists already") != std::string::npos);
}

TEST_CASE("new names the measures that no recording tells") {
  const testing::TemporaryFolder folder;
  const auto data = folder.write("m.csv", "time_s,x1,y1\n0,0.1,1\n0.1,0.2,1\n");
  const ProcessResult run = run_catena({"new", data, "--length", "1"});
  CHECK(run.exit_status == 2);
  CHECK(run.output.find("--length  ") == std::string::npos);
  for (const char* word : {"--density", "--load-mass", "kg/m"})
    CHECK_MESSAGE(run.output.find(word) != std::string::npos, run.output);
  CHECK(run_catena({"new", data, "--length", "-1", "--density", "1", "--load-mass", "0"})
            .output.find("--length: -1; must be positive") != std::string::npos);
}

TEST_CASE("new draws markers that hardly differ, and refuses measures that cannot be meant") {
  const testing::TemporaryFolder folder;
  const auto made = [&](const char* name, const std::string& value, const char* length) {
    const auto data = folder.write(
        name, "time_s,side_1_m,down_1_m\n0,0," + value + "\n0.1," + value + "," + value + "\n");
    return run_catena({"new", data, "--length", length, "--density", "0.1", "--load-mass", "0"});
  };
  // The ticks of so small a picture were counted with a margin of 1e-9 m.
  CHECK(made("small.csv", "1e-18", "1").exit_status == 0);
  CHECK(std::filesystem::file_size(folder.path() / "small.svg") < 10'000);
  const auto moment = folder.write("moment.csv", "time_s,x1,y1\n0,0,1\n1e-320,0,1\n2e-320,0,1\n");
  const ProcessResult short_one =
      run_catena({"new", moment, "--length", "1", "--density", "0.1", "--load-mass", "0"});
  CHECK_MESSAGE(short_one.output.find("stod") == std::string::npos, short_one.output);
  for (const char* rows :
       {"0,1,,,\n1,2,,,\n", "0,1,1,,\n1,,,2,2\n"}) {  // never seen, never together
    const auto data = folder.write("unseen.csv", std::string("time_s,x1,y1,x2,y2\n") + rows);
    const ProcessResult run =
        run_catena({"new", data, "--length", "1", "--density", "0.1", "--load-mass", "0"});
    CHECK(run.exit_status == 2);
    CHECK_MESSAGE(run.output.find("no frame shows") != std::string::npos, run.output);
  }
  for (const char* length : {"1e-160", "1e160", "1e308"}) {
    const ProcessResult run = made("m.csv", "0.5", length);
    CHECK(run.exit_status == 2);
    CHECK_MESSAGE(run.output.find("which cannot be meant") != std::string::npos, run.output);
  }
}

TEST_CASE("the name of a recording begins no line of the case") {
  const testing::TemporaryFolder folder;
  const auto data = folder.write("a\n[model]\nlinks = 7\n.csv",
                                 "time_s,side_1_m,down_1_m\n0,0.5,0.5\n0.1,0.5,0.6\n");
  const ProcessResult run = run_catena({"new", data, "--length", "1", "--density", "0.1",
                                        "--load-mass", "0", "-o", folder.path() / "a.toml"});
  CHECK_MESSAGE(run.exit_status == 0, run.output);
  CHECK(testing::text_of(folder.path() / "a.toml")
            .starts_with("# Made by catena new from a [model] links = 7 .csv.\n"));
  CHECK(read_case(folder.path() / "a.toml").links != 7);
}

TEST_CASE("new makes no case that could not be read") {
  const testing::TemporaryFolder folder;
  const std::filesystem::path latin = folder.path() / "m\xE4rz.csv";
  std::filesystem::rename(film(folder), latin);
  const ProcessResult run =
      run_catena({"new", latin, "--length", "1", "--density", "0.3", "--load-mass", "0.2",
                  "--output", folder.path() / "c.toml"});
  CHECK(run.exit_status == 2);
  CHECK_MESSAGE(run.output.find("have to be UTF-8") != std::string::npos, run.output);
  CHECK_FALSE(std::filesystem::exists(folder.path() / "c.toml"));
}
