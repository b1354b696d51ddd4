// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "identify/cases/case.hpp"
#include "identify/cases/case_reader.hpp"
#include "tests/identify/program/catena_program.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using testing::run_catena;

namespace {

/// A folder with swing/positions.csv, made with k = 0.1 and c = 0.005.
struct Twin {
  testing::TemporaryFolder folder;
  Twin() {
    const auto swing = folder.write("swing.toml", testing::kSwing);
    REQUIRE(
        run_catena({"simulate", swing, "--output", folder.path() / "swing", "-q"}).exit_status ==
        0);
  }
};

/// Lines written so far; 0 of a file that is not there.
int lines_of(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return 0;
  const std::string text = testing::text_of(file);
  return static_cast<int>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("identify finds the truth, writes it, and the fitted case confirms it") {
  const Twin twin;
  for (const char* method : {"nelder_mead", "least_squares"}) {
    CAPTURE(std::string(method));
    const auto the_case =
        twin.folder.write("fit.toml", testing::kFit + "[optimiser]\nmethod = \"" + method + "\"\n");
    const std::filesystem::path out = twin.folder.path() / "out" / method;
    const ProcessResult run = run_catena({"identify", the_case, "--output", out});
    CHECK_MESSAGE(run.exit_status == 0, run.output);
    for (const char* word : {"identified", "fit", "validate", "RMS before", "RMS after", "mm"})
      CHECK(run.output.find(word) != std::string::npos);
    const Case fitted = read_case(out / "fitted.toml");
    CHECK(fitted.parameters[0].value == catena::near(0.1, 1e-3));
    CHECK(fitted.parameters[1].value == catena::near(0.005, 1e-3));
    const ProcessResult again =
        run_catena({"simulate", out / "fitted.toml", "--output", out / "again"});
    CHECK_MESSAGE(again.exit_status == 0, again.output);
    // the fitted case simulates to what the fit saw, digit by digit
    CHECK(testing::text_of(out / "again" / "residuals.csv") ==
          testing::text_of(out / "residuals.csv"));
    CHECK(testing::text_of(out / "residuals.csv").find(",validate,") != std::string::npos);
    const std::string before = testing::text_of(out / "result.json");
    CHECK(run_catena({"identify", the_case, "--output", out, "-q"}).output.empty());
    CHECK(testing::text_of(out / "result.json") == before);
  }
}

TEST_CASE("of many experiments, markers and angles have lines of their own") {
  const Twin twin;
  std::string text = testing::kFit;
  for (int i = 2; i <= 8; ++i)
    text.insert(text.find("[error]"),
                "[[experiment]]\nname = \"swing " + std::to_string(i) +
                    "\"\ndata = \"swing/positions.csv\"\nkind = \"markers\"\n\n");
  // One angle in two frames, 0.05 rad from where the chain starts.
  twin.folder.write("angle.csv", "time_s,angle_rad\n0,0.65\n1e-4,0.65\n");
  text.insert(text.find("[error]"),
              "[[experiment]]\nname = \"angle\"\ndata = \"angle.csv\"\nkind = \"angles\"\n"
              "angles = [{name = \"first\", column = \"angle_rad\", link = 1}]\n\n");
  const ProcessResult run = run_catena(
      {"simulate", twin.folder.write("many.toml", text), "--output", twin.folder.path() / "many"});
  CHECK_MESSAGE(run.exit_status == 0, run.output);
  INFO(run.output);
  CHECK(run.output.find("9 experiments\n") != std::string::npos);
  CHECK(run.output.find("2 values  RMS  50 mrad\n") != std::string::npos);
  CHECK(run.output.find(" mm\nvalidate") != std::string::npos);
}

TEST_CASE("an interrupted fit leaves the best so far and exits with 130") {
  const Twin twin;
  // a long fit: many links, many starts
  std::string slow = testing::replaced(testing::kFit, "links = 2", "links = 60");
  slow +=
      "[optimiser]\nmethod = \"nelder_mead\"\nstarts = 1000\nmax_evaluations = 1000000\n"
      "[simulation]\nrelative_tolerance = 1e-11\n";
  const auto the_case = twin.folder.write("fit.toml", slow);
  const std::filesystem::path out = twin.folder.path() / "out";
  const std::string program = tests::build_folder() / "bin" / "catena";
  for (const int signal : {SIGINT, SIGHUP}) {  // Ctrl-C; a terminal that closes
    const pid_t child = fork();
    if (child == 0) {
      execl(program.c_str(), "catena", "identify", the_case.c_str(), "--output", out.c_str(), "-q",
            "--yes", nullptr);
      _exit(127);
    }
    usleep(1'500'000);
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFEXITED(status));
    CHECK(WEXITSTATUS(status) == 130);
    CHECK(testing::text_of(out / "result.json").find("\"status\": \"interrupted\"") !=
          std::string::npos);
    CHECK(read_case(out / "fitted.toml").parameters.size() == 2);
    std::filesystem::remove_all(out);
  }

  const ProcessResult limited =
      run_catena({"identify", the_case, "--output", out / "limited", "--time-limit", "1.5", "-q"});
  CHECK(limited.exit_status == 0);
  CHECK(testing::text_of(out / "limited" / "result.json").find("\"status\": \"time_limit\"") !=
        std::string::npos);
}

TEST_CASE("a run killed at random times and resumed ends as an undisturbed one does") {
  const Twin twin;
  const std::string program = tests::build_folder() / "bin" / "catena";
  for (const char* method : {"nelder_mead", "least_squares"}) {
    CAPTURE(std::string(method));
    const bool simplex = method == std::string("nelder_mead");
    const auto the_case =
        twin.folder.write("fit.toml", testing::replaced(testing::kFit, "links = 2", "links = 12") +
                                          "[optimiser]\nmethod = \"" + method +
                                          "\"\nstarts = " + (simplex ? "8" : "60") +
                                          "\n[simulation]\nrelative_tolerance = 1e-9\n");
    const std::filesystem::path whole = twin.folder.path() / method / "whole";
    const std::filesystem::path killed = twin.folder.path() / method / "killed";
    REQUIRE(run_catena({"identify", the_case, "--output", whole, "-q"}).exit_status == 0);
    const int all_lines = lines_of(whole / "run.log");

    std::mt19937_64 random(simplex ? 1 : 2);
    std::uniform_real_distribution<double> shares(0, 1);
    int kills = 0, logged = 0, grew = 0;
    for (int attempt = 0; attempt < 6; ++attempt) {
      const pid_t child = fork();
      if (child == 0) {
        execl(program.c_str(), "catena", "identify", the_case.c_str(), "--output", killed.c_str(),
              "--resume", "-q", nullptr);
        _exit(127);
      }
      // In lines of the log, for seconds depend on the machine: six shares are less than the whole.
      const int until = logged + static_cast<int>(all_lines * 0.14 * shares(random));
      int status = 0;
      while (lines_of(killed / "run.log") < until && waitpid(child, &status, WNOHANG) == 0)
        usleep(200);
      if (status == 0) {
        usleep(static_cast<useconds_t>(5000 * shares(random)));
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
      }
      kills += WIFSIGNALED(status);
      const int lines = lines_of(killed / "run.log");
      grew += lines > logged;
      logged = lines;
    }
    CHECK(kills >= 4);  // else the run ended before it could be killed
    CHECK(grew >= 2);   // what came before a kill is kept
    REQUIRE(run_catena({"identify", the_case, "--output", killed, "--resume", "-q"}).exit_status ==
            0);
    for (const char* file : {"result.json", "fitted.toml", "residuals.csv", "positions.csv"}) {
      CAPTURE(std::string(file));
      CHECK(testing::text_of(killed / file) == testing::text_of(whole / file));
    }
  }
}

TEST_CASE("a study of the number of links refits, tells how the numbers converge and recommends") {
  testing::TemporaryFolder folder;
  // a cable with bending stiffness and damping of its own, the same for any number of links
  const auto as_cable = [](std::string text) {
    for (const auto& [from, to] :
         {std::pair{"\"stiffness\"", "\"bending_stiffness\""},
          std::pair{"\"damping\"", "\"damping_length\""}, std::pair{"\"N m/rad\"", "\"N m^2\""},
          std::pair{"\"N m s/rad\"", "\"N m^2 s/rad\""}})
      text = testing::replaced(text, from, to);
    return text;
  };
  const std::string fine = as_cable(testing::replaced(testing::kSwing, "links = 2", "links = 24"));
  const auto swing = folder.write("swing.toml", fine);
  REQUIRE(run_catena({"simulate", swing, "--output", folder.path() / "swing", "-q"}).exit_status ==
          0);
  std::string fit = as_cable(testing::kFit);
  fit = testing::replaced(
      fit, "kind = \"markers\"",
      "kind = \"markers\"\nmarkers = [{side = \"side_12_m\", down = \"down_12_m\", "
      "arc_length = 0.5}, {side = \"side_24_m\", down = \"down_24_m\", load = true}]");
  const auto the_case = folder.write("fit.toml", fit + "[optimiser]\nmethod = \"least_squares\"\n");
  const std::filesystem::path out = folder.path() / "out";
  const ProcessResult run = run_catena({"identify", the_case, "--links-study", "2,4,12,24",
                                        "--output", out, "--error-budget", "0.05"});
  CHECK_MESSAGE(run.exit_status == 0, run.output);
  // nothing but 24 links comes near the data of 24 links, which are without noise
  CHECK(run.output.find("fewest links within 5 % of the least error: 24") != std::string::npos);
  const auto json = nlohmann::json::parse(testing::text_of(out / "links_study.json"));
  REQUIRE(json["links_study"].size() == 4);
  double last = 1;
  for (const auto& row : json["links_study"]) {
    CHECK(row["error"].get<double>() < last);
    last = row["error"];
    if (row["links"] == 24) CHECK(row["parameters"]["k"].get<double>() == catena::near(0.1, 1e-3));
  }
  const ProcessResult wide = run_catena(
      {"identify", the_case, "--links-study", "2,4", "--output", out, "--error-budget", "1000"});
  CHECK(wide.output.find("least error: 2\n") != std::string::npos);
  const ProcessResult refused = run_catena(
      {"identify",
       folder.write("joint.toml", testing::replaced(fit, "arc_length = 0.5", "joint = 1")),
       "--links-study", "2,4", "--output", out});
  CHECK(refused.exit_status == 2);
  CHECK(refused.output.find("is at a joint") != std::string::npos);
}

TEST_CASE("a cable in space is identified, and its report is drawn") {
  const testing::TemporaryFolder folder;
  folder.write("space.toml", "format = 1\nkind = \"model\"\nid = \"space\"\nspace = \"3d\"\n");
  const auto in_space = [](const std::string& text) {
    return testing::replaced(text, "links = 2", "description = \"space.toml\"\nlinks = 2");
  };
  const std::string start =
      "shape = \"angles\"\nangles = [0.6, 0.3]\nazimuth = 0.4\nout_of_plane = [0.1, -0.2]\n"
      "velocity = {shape = \"straight\", rates = [0], azimuth_rate = 2}\n";
  const std::string straight = "shape = \"straight\"\nangle = 0.6\n";
  const auto swing =
      folder.write("swing.toml", testing::replaced(in_space(testing::kSwing), straight, start));
  REQUIRE(run_catena({"simulate", swing, "--output", folder.path() / "swing", "-q"}).exit_status ==
          0);
  const std::string found =
      "shape = \"angles\"\nfree = true\nvelocity = {shape = \"angles\", free = true}\n";
  const auto the_case = folder.write(
      "fit.toml",
      testing::replaced(testing::replaced(in_space(testing::kFit), straight, found),
                        "measure = \"mean_distance\"",
                        "measure = \"least_squares\"\n[optimiser]\nmethod = \"least_squares\""));
  const std::filesystem::path out = folder.path() / "out";
  const ProcessResult run = run_catena({"identify", the_case, "--output", out});
  REQUIRE_MESSAGE(run.exit_status == 0, run.output);
  CHECK(run.output.find("and 8 numbers of the initial state") != std::string::npos);
  const Case fitted = read_case(out / "fitted.toml");
  CHECK(fitted.parameters[0].value == catena::near(0.1, 1e-3));
  CHECK(fitted.parameters[1].value == catena::near(0.005, 1e-3));
  const ProcessResult again =
      run_catena({"simulate", out / "fitted.toml", "--output", out / "again"});
  CHECK_MESSAGE(again.exit_status == 0, again.output);
  const std::string residuals = testing::text_of(out / "residuals.csv");
  CHECK(testing::text_of(out / "again" / "residuals.csv") == residuals);
  CHECK(residuals.find(",across_m,") != std::string::npos);
  const auto result = nlohmann::json::parse(testing::text_of(out / "result.json"));
  const auto& experiment = result["experiments"][0];
  CHECK(experiment["measured"]["across"].size() == experiment["measured"]["side"].size());
  CHECK(experiment["predicted"]["across"].size() == experiment["measured"]["side"].size());

  const ProcessResult report =
      run_catena({"report", out, "--output", folder.path() / "report.html"});
  CHECK_MESSAGE(report.exit_status == 0, report.output);
  CHECK(testing::text_of(folder.path() / "report.html").find("\"across\":[") != std::string::npos);
}
