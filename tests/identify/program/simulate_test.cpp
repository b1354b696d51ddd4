// SPDX-License-Identifier: BSD-3-Clause
#include <doctest/doctest.h>

#include <sstream>

#include "identify/recordings/recording.hpp"
#include "identify/recordings/table.hpp"
#include "tests/identify/program/catena_program.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using testing::run_catena;

TEST_CASE("simulate writes what it says, the same every time") {
  const testing::TemporaryFolder folder;
  const auto the_case = folder.write("swing.toml", testing::kSwing);
  const std::string first = folder.path() / "first", second = folder.path() / "second";
  const ProcessResult run = run_catena({"simulate", the_case, "--output", first});
  CHECK_MESSAGE(run.exit_status == 0, run.output);
  CHECK(run.output.find("energy balance kept within") != std::string::npos);
  CHECK(run.output.find("\033") == std::string::npos);  // no terminal, no colours, no progress
  CHECK(run.output.find("\r") == std::string::npos);
  CHECK(run_catena({"simulate", the_case, "--output", second, "--quiet"}).output.empty());
  for (const char* name :
       {"result.json", "positions.csv", "angles.csv", "forces.csv", "energy.csv"}) {
    CAPTURE(std::string(name));
    const std::string text = testing::text_of(std::filesystem::path(first) / name);
    CHECK(text.size() > 500);
    CHECK(text == testing::text_of(std::filesystem::path(second) / name));
  }
  const Table positions = read_table(std::filesystem::path(first) / "positions.csv");
  CHECK(positions.rows() == 51);
  CHECK(positions.column("time_s").back() == 1.0);
  CHECK(positions.column("side_1_m").front() == catena::near(0.5 * std::sin(0.6), 1e-15));
  CHECK(positions.column("down_2_m").front() == catena::near(std::cos(0.6), 1e-15));
  CHECK(read_table(std::filesystem::path(first) / "angles.csv").column("theta_2_rad").front() ==
        0.6);
  // Two links askew, held still: joint 1 is bent by 0.6 over half a link of 0.5 m, joint 2 is not.
  const Table forces = read_table(std::filesystem::path(first) / "forces.csv");
  CHECK(forces.names.size() == 1 + 3 * 2 + 3);
  CHECK(forces.rows() == 51);
  CHECK(forces.column("moment_1_N_m").front() == catena::near(-0.1 * 0.6, 1e-15));
  CHECK(forces.column("moment_2_N_m").front() == 0.0);
  CHECK(forces.column("curvature_1_rad_m").front() == catena::near(0.6 / 0.25, 1e-15));
  CHECK(forces.column("curvature_2_rad_m").front() == 0.0);
  // All points begin to move across the links: along them each carries the weight below its end.
  const double along = 9.81 * std::cos(0.6);
  CHECK(forces.column("tension_1_N").front() == catena::near(0.5 * along, 1e-12));
  CHECK(forces.column("tension_2_N").front() == catena::near(0.35 * along, 1e-12));
  // The support pulls as the first link does, and bends it back.
  CHECK(std::sin(0.6) * forces.column("support_force_side_N").front() +
            std::cos(0.6) * forces.column("support_force_down_N").front() ==
        catena::near(-0.5 * along, 1e-12));
  CHECK(forces.column("support_moment_N_m").front() == catena::near(-0.1 * 0.6, 1e-12));
  const ProcessResult json = run_catena({"simulate", the_case, "--output", second, "--json"});
  CHECK(json.output == testing::text_of(std::filesystem::path(first) / "result.json"));
  CHECK(json.output.find("The Lagrangian is") != std::string::npos);
}

TEST_CASE("a case of a model in space starts in azimuths and has a third component") {
  const testing::TemporaryFolder folder;
  folder.write("space.toml", "format = 1\nkind = \"model\"\nid = \"space\"\nspace = \"3d\"\n");
  const std::string model = "[model]\n", angle = "angle = 0.6\n";
  const std::string in_space =
      testing::replaced(testing::kSwing, model, model + "description = \"space.toml\"\n");
  const std::string turned =
      testing::replaced(in_space, angle,
                        angle +
                            "azimuth = 0.4\n[initial.velocity]\nshape = \"straight\"\nrates = [0]\n"
                            "azimuth_rates = [2, 3]\n");
  const auto the_case = folder.write("turned.toml", turned);
  const std::string output = folder.path() / "turned";
  const ProcessResult run = run_catena({"simulate", the_case, "--output", output});
  REQUIRE_MESSAGE(run.exit_status == 0, run.output);
  const Table positions = read_table(std::filesystem::path(output) / "positions.csv");
  const Table directions = read_table(std::filesystem::path(output) / "angles.csv");
  const double sine = std::sin(0.6);
  CHECK(positions.column("side_1_m").front() == catena::near(0.5 * sine * std::cos(0.4), 1e-14));
  CHECK(positions.column("across_2_m").front() == catena::near(sine * std::sin(0.4), 1e-14));
  CHECK(directions.column("direction_across_2_rate_1_s").front() ==
        catena::near(3 * sine * std::cos(0.4), 1e-14));
  CHECK(positions.column("across_load_m").back() != doctest::Approx(sine * std::sin(0.4)));
  const auto refused = [&](const std::string& text, const std::string& said) {
    const ProcessResult result =
        run_catena({"simulate", folder.write("refused.toml", text), "--output", output + "_not"});
    CHECK(result.exit_status == 2);
    CHECK_MESSAGE(result.output.find(said) != std::string::npos, result.output);
  };
  refused(testing::replaced(testing::kSwing, angle, angle + "azimuth = 0.4\n"),
          "initial: azimuth: the model moves in the plane");
  refused(testing::replaced(turned, "[2, 3]", "[2, 3, 4]"), "azimuth_rates: 3 numbers");
  refused(testing::replaced(testing::kSwing, angle, angle + "out_of_plane = [0.1]\n"),
          "initial: out_of_plane: the model moves in the plane");
  refused(in_space +
              "[[experiment]]\nname = \"a\"\ndata = \"turned/positions.csv\"\n"
              "kind = \"markers\"\nwindow = 0.3\njoined = true\n",
          "experiment: joined: \"a\"; windows of a model in space cannot be joined");
}

TEST_CASE("the times at which an event value changes its sign are written") {
  const testing::TemporaryFolder folder;
  folder.write("watch.toml",
               "format = 1\nkind = \"effect\"\nid = \"watch\"\ntitle = \"Watch\"\n"
               "description = \"Tells when the load is plumb\"\n[[event]]\nname = \"plumb\"\n"
               "unit = \"m\"\nat = \"load\"\nvalue = \"side\"\n");
  folder.write("watched.toml",
               "format = 1\nkind = \"model\"\nid = \"watched\"\neffects = [\"watch.toml\"]\n");
  const auto the_case = folder.write(
      "swing.toml",
      testing::replaced(testing::kSwing, "[model]\n", "[model]\ndescription = \"watched.toml\"\n"));
  const std::filesystem::path output = folder.path() / "swing";
  const ProcessResult run = run_catena({"simulate", the_case, "--output", output});
  REQUIRE_MESSAGE(run.exit_status == 0, run.output);
  const Table positions = read_table(output / "positions.csv");
  const std::vector<double>& side = positions.column("side_load_m");
  const std::vector<double>& time = positions.column("time_s");
  std::istringstream lines(testing::text_of(output / "events.csv"));
  std::string line;
  std::getline(lines, line);
  CHECK(line == "time_s,event,change");
  int crossings = 0;
  for (std::size_t k = 1; k < side.size(); ++k) {
    if ((side[k - 1] < 0) == (side[k] < 0)) continue;
    ++crossings;
    REQUIRE(std::getline(lines, line));
    const double at = std::stod(line);
    CHECK(at > time[k - 1]);
    CHECK(at < time[k]);
    CHECK(line.substr(line.find(',')) ==
          (side[k] > 0 ? ",watch.plumb,rises" : ",watch.plumb,falls"));
  }
  CHECK(crossings > 0);
  CHECK(!std::getline(lines, line));
}

TEST_CASE("without --output no command replaces what another one wrote") {
  const testing::TemporaryFolder folder;
  folder.write("swing.toml", testing::kSwing);
  const std::string program = tests::build_folder() / "bin" / "catena";
  const ProcessResult run =
      run_process({"env", "-C", folder.path(), program, "simulate", "swing.toml"});
  CHECK_MESSAGE(run.exit_status == 0, run.errors);
  CHECK(std::filesystem::exists(folder.path() / "swing_simulation" / "result.json"));
  for (const char* command : {"diagnose", "identify"}) {
    const std::string help = run_catena({command, "--help"}).output;
    CHECK(help.find("CASE_simulation") == std::string::npos);
    CHECK((help.find("CASE_diagnosis") == std::string::npos) == (command[0] == 'i'));
  }
}

TEST_CASE("a simulation that fails says which state and when, exits with 1 and writes nothing") {
  const testing::TemporaryFolder folder;
  const auto the_case = folder.write(
      "swing.toml",
      testing::replaced(testing::kSwing, "step = 0.02", "step = 0.02\nmax_steps = 10"));
  const std::string output = folder.path() / "out";
  const ProcessResult run = run_catena({"simulate", the_case, "--output", output});
  CHECK(run.exit_status == 1);
  CHECK(run.output.find("t = ") != std::string::npos);
  CHECK(!std::filesystem::exists(output));
}

TEST_CASE("an energy balance that is lost gives a warning") {
  const testing::TemporaryFolder folder;
  const auto loose = folder.write(
      "loose.toml",
      testing::replaced(testing::kSwing, "step = 0.02", "step = 0.02\nrelative_tolerance = 1"));
  const ProcessResult run =
      run_catena({"simulate", loose, "--output", folder.path() / "out", "--quiet"});
  CHECK(run.exit_status == 0);
  CHECK(run.output.find("warning: the energy balance is off by") != std::string::npos);
  const std::string result = testing::text_of(folder.path() / "out/result.json");
  CHECK(result.find("the energy balance is off by") != std::string::npos);
}

TEST_CASE("help fits a screen and shows an example") {
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"--help"}, {"simulate", "--help"}, {"identify", "--help"}}) {
    const ProcessResult help = run_catena(command);
    CHECK(help.exit_status == 0);
    CHECK(std::count(help.output.begin(), help.output.end(), '\n') <= 40);
    CHECK(help.output.find("xample") != std::string::npos);
  }
  CHECK(run_catena({}).exit_status == 2);
  CHECK(run_catena({"simulat"}).exit_status == 2);
  CHECK(run_catena({"simulate"}).exit_status == 2);
  CHECK(run_catena({"simulate", "a.toml", "--no-such-option"}).exit_status == 2);
}

TEST_CASE("every command of catena-derive can be called as a command of catena") {
  const ProcessResult help = run_catena({"--help"});
  for (const std::string command : {"derive", "check", "verify", "certify"}) {
    CHECK(help.output.find("\n  " + command + " ") != std::string::npos);
    const ProcessResult handed_over = run_catena({command, "--help"});
    CHECK_MESSAGE(handed_over.exit_status == 0, handed_over.output);
    CHECK_MESSAGE(handed_over.output.find("--links") != std::string::npos, handed_over.output);
  }
  const ProcessResult verified = run_catena({"verify", "--links", "2"});
  CHECK_MESSAGE(verified.exit_status == 0, verified.output);
  CHECK_MESSAGE(verified.output.find("M equal, F equal") != std::string::npos, verified.output);
}
