// SPDX-License-Identifier: BSD-3-Clause
//
// Every way to be wrong that a user may find, one by one, through the program: a message that names
// file, line or key, value and rule; exit status 2; nothing written.
#include <doctest/doctest.h>

#include "tests/identify/program/catena_program.hpp"

using namespace catena;
using testing::replaced;
using testing::run_catena;

namespace {

const char* const kData =
    "time_s,side_1_m,down_1_m,side_2_m,down_2_m\n"
    "0.0,0.28,0.41,0.56,0.83\n"
    "0.1,0.27,0.42,0.55,0.84\n"
    "0.2,0.24,0.44,0.50,0.87\n";

void check_refused(const testing::TemporaryFolder& folder, const std::string& command,
                   const std::filesystem::path& the_case,
                   const std::vector<std::string>& expected) {
  const std::filesystem::path output = folder.path() / "out";
  const ProcessResult run = run_catena({command, the_case, "--output", output});
  CHECK_MESSAGE(run.exit_status == 2, run.output);
  for (const std::string& part : expected)
    CHECK_MESSAGE(run.output.find(part) != std::string::npos, run.output, " lacks ", part);
  CHECK_MESSAGE(!std::filesystem::exists(output), "something was written");
}

struct Row {
  const char* what;
  const char* from;
  const char* to;
  std::vector<std::string> expected;
};

}  // namespace

TEST_CASE("mistakes in a case to be simulated") {
  const Row rows[] = {
      {"unknown key", "load_mass", "load_mas", {"case.toml:10", "load_mas", "load_mass"}},
      {"unknown table", "[simulation]", "[simulaton]", {"case.toml:28", "simulaton", "simulation"}},
      {"wrong kind", "kind = \"case\"", "kind = \"effect\"", {"case.toml:2", "kind", "case"}},
      {"wrong format", "format = 1", "format = 7", {"case.toml:1", "format", "7"}},
      {"wrong type", "length = 1.0", "length = \"one\"", {"case.toml:8", "cable.length", "one"}},
      {"no TOML", "[cable]", "[cable", {"case.toml:7"}},
      {"a decimal comma", "length = 1.0", "length = 1,0", {"case.toml:8", "wanted: 1.0"}},
      {"no quotes", "\"straight\"", "straight", {"case.toml:25", "in quotes: \"straight\""}},
      {"one bracket", "[cable]", "[model]", {"case.toml:7", "begins with [[model]]"}},
      {"misspelt density",
       "density",
       "densty",
       {"case.toml:7", "density or link_masses", "\"densty\" on line 9"}},
      {"a coordinate of the load that is not there",
       "[simulation]",
       "[[initial.load]]\ncoordinate = \"swing\"\nvalue = 0.1\n[simulation]",
       {"initial: load: the model has no coordinate", "swing"}},
      {"two densities",
       "density = 0.3",
       "density = 0.3\nlink_masses = [0.1, 0.1]",
       {"case.toml:7", "not density and link_masses"}},
      {"units without a space",
       "unit = \"N m/rad\"",
       "unit = \"Nm/rad\"",
       {"case.toml:12", "did you mean \"N m\"?"}},
      {"wrong unit", "unit = \"N m/rad\"", "unit = \"N/m\"", {"case.toml:12", "N/m", "N m/rad"}},
      {"no unit", "unit = \"N m/rad\"", "unit = \"parsec\"", {"case.toml:12", "parsec"}},
      {"length not positive", "length = 1.0", "length = 0.0", {"case.toml:8", "0", "positive"}},
      {"negative density", "density = 0.3", "density = -0.3", {"case.toml:9", "-0.3", "positive"}},
      {"negative mass", "density = 0.3", "link_masses = [0.1, -0.1]", {"case.toml:9", "-0.1"}},
      {"negative load", "load_mass = 0.2", "load_mass = -0.2", {"case.toml:10", "-0.2"}},
      {"no mass at all",
       "density = 0.3\nload_mass = 0.2",
       "link_masses = [0.0, 0.0]\nload_mass = 0.0",
       {"case.toml", "mass matrix", "not positive definite"}},
      {"no value", "value = 0.1", "", {"case.toml:12", "value"}},
      {"NaN", "value = 0.1", "value = nan", {"case.toml:15", "nan"}},
      {"negative stiffness", "value = 0.1", "value = -0.1", {"stiffness_1", "-0.1"}},
      {"unknown parameter",
       "sets = \"stiffness\"",
       "sets = \"stifness\"",
       {"stifness", "stiffness"}},
      {"a number without its underline",
       "sets = \"stiffness\"",
       "sets = \"stiffness2\"",
       {"stiffness2", "did you mean \"stiffness_2\"?"}},
      {"a joint that there is not",
       "sets = \"stiffness\"",
       "sets = \"stiffness_3\"",
       {"stiffness_3", "there are stiffness_1 to stiffness_2"}},
      {"parameter not set",
       "sets = \"damping\"",
       "sets = \"damping_2\"",
       {"damping_1", "no value"}},
      {"bounds crossed",
       "value = 0.1",
       "value = 0.1\nlower = 1.0\nupper = 0.01",
       {"case.toml:16", "lower", "upper"}},
      {"links not a number", "links = 2", "links = \"two\"", {"case.toml:5", "links"}},
      {"no links", "links = 2", "links = 0", {"case.toml:5", "0"}},
      {"too many links",
       "links = 2",
       "links = 50000000",
       {"case.toml:5", "50000000", "1 to 10000"}},
      {"held too far away",
       "shape = \"straight\"\nangle = 0.6",
       "shape = \"catenary\"\nheld = {side = 1.0, down = 1.0}",
       {"case.toml", "held"}},
      {"missing description",
       "links = 2",
       "links = 2\ndescription = \"no.toml\"",
       {"case.toml:6", "no.toml", "no such file"}},
      {"no duration", "duration = 1.0", "", {"duration"}},
      {"more outputs than memory holds",
       "duration = 1.0\nstep = 0.02",
       "duration = 1e5\nstep = 0.02",
       {"keeping the outputs of every simulation.step needs about 16 GB", "--yes"}},
      {"step not positive", "step = 0.02", "step = 0.0", {"case.toml:30", "step"}},
  };
  const testing::TemporaryFolder folder;
  for (const Row& row : rows) {
    CAPTURE(std::string(row.what));
    check_refused(folder, "simulate",
                  folder.write("case.toml", replaced(testing::kSwing, row.from, row.to)),
                  row.expected);
  }
  check_refused(folder, "simulate", folder.path() / "absent.toml", {"absent.toml"});
}

TEST_CASE("mistakes in a case to be identified, and in its data") {
  const Row cases[] = {
      {"missing data", "data = \"data.csv\"", "data = \"no.csv\"", {"case.toml:36", "no.csv"}},
      {"bounds crossed", "upper = 1.0", "upper = 0.0001", {"case.toml:18", "lower", "upper"}},
      {"start outside the bounds", "value = 0.05", "value = 5.0", {"case.toml:15", "5"}},
      {"unknown method",
       "measure = \"mean_distance\"",
       "measure = \"mean_distance\"\n[optimiser]\nmethod = \"annealing\"",
       {"annealing"}},
      {"free parameters without data",
       "kind = \"markers\"",
       "kind = \"markers\"\nuse = \"validate\"",
       {"case.toml", "without data"}},
      {"too many starts",
       "measure = \"mean_distance\"",
       "measure = \"mean_distance\"\n[optimiser]\nstarts = 2000000000",
       {"optimiser.starts: 2000000000; must be a whole number from 1 to 100000"}},
      {"nothing free", "free = true\nlower = 0.001\nupper = 1.0", "", {"case.toml"}},
      {"window without frames",
       "kind = \"markers\"",
       "kind = \"markers\"\nfrom = 7.0",
       {"0 frames from 7 s on", "its times are 0 s to 0.2 s"}},
      {"no frame to fit",
       "kind = \"markers\"",
       "kind = \"markers\"\nfit_until = -1.0",
       {"case.toml:34", "fit_until", "-1 s is before the first frame"}},
      {"a start after all frames",
       "kind = \"markers\"",
       "kind = \"markers\"\nstart = 0.2",
       {"case.toml:34", "start: 0.2 s is not before the last frame, at 0.2 s"}},
      {"frames too near each other",
       "kind = \"markers\"",
       "kind = \"markers\"\ntime_unit = \"frames\"\nframe_rate = 1e20",
       {"data.csv:3", "1e-21 s after 0 s; frames must be 1e-9 s apart", "frame_rate"}},
      {"times of ages",
       "kind = \"markers\"",
       "kind = \"markers\"\ntime_unit = \"frames\"\nframe_rate = 1e-20",
       {"data.csv:3", "times must lie within -1e9 and 1e9 s", "frame_rate"}},
      {"angles asked of markers", "kind = \"markers\"", "kind = \"angles\"", {"theta_1_rad"}},
  };
  const Row data[] = {
      {"not a number", "0.27", "abc", {"data.csv:3", "side_1_m", "abc"}},
      {"a short row", "0.1,0.27,0.42,0.55,0.84", "0.1,0.27,0.42", {"data.csv:3", "3 fields", "5"}},
      {"a long row", "0.84", "0.84,1,2", {"data.csv:3", "7 fields"}},
      {"infinity", "0.27", "inf", {"data.csv:3", "inf"}},
      {"times not increasing", "0.2,0.24", "0.1,0.24", {"data.csv:4", "time_s", "increase"}},
      {"no time", "0.2,0.24", ",0.24", {"data.csv:4", "time_s"}},
      {"no such columns",
       "side_1_m",
       "sideways",
       {"data.csv", "side_1_m", "it has time_s, sideways, down_1_m, ", "catena new"}},
      {"no names",
       "time_s,side_1_m,down_1_m,side_2_m,down_2_m\n",
       "",
       {"data.csv:1", "names of the columns"}},
      {"two columns of a name", "side_2_m", "side_1_m", {"data.csv", "two columns", "side_1_m"}},
      {"one frame", "0.1,0.27,0.42,0.55,0.84\n0.2,0.24,0.44,0.50,0.87\n", "", {"1 frame;", "two"}},
  };
  const testing::TemporaryFolder folder;
  const std::string whole =
      replaced(replaced(testing::kFit, "swing/positions.csv", "data.csv"), "fit_until = 0.6\n", "");
  folder.write("data.csv", kData);
  for (const Row& row : cases) {
    CAPTURE(std::string(row.what));
    std::string text = replaced(whole, row.from, row.to);
    if (std::string(row.what) == "nothing free")
      text = replaced(text, "free = true\nlower = 0.0001\nupper = 1.0", "");
    check_refused(folder, "identify", folder.write("case.toml", text), row.expected);
  }
  const auto the_case = folder.write("case.toml", whole);
  for (const Row& row : data) {
    CAPTURE(std::string(row.what));
    folder.write("data.csv", replaced(kData, row.from, row.to));
    check_refused(folder, "identify", the_case, row.expected);
  }
  folder.write("data.csv", "");
  check_refused(folder, "identify", the_case, {"data.csv", "empty"});
}

TEST_CASE("clamps in space without a direction") {
  const testing::TemporaryFolder folder;
  const std::string parameter = "unit = \"1\"\ndefault = 1.0\ndescription = \"d\"\n";
  const std::string grips =
      "format = 1\nkind = \"effect\"\nid = \"grips\"\ntitle = \"t\"\ndescription = \"d\"\n"
      "[constants.place]\nvalue = 0.6\nunit = \"m\"\ndescription = \"d\"\n"
      "[parameters.above]\n" +
      parameter + "[parameters.below]\n" + parameter +
      "[support]\nclamp_down = \"above\"\n"
      "[held_end]\nside = \"place\"\nclamp_side = \"below\"\n";
  folder.write("grips.toml", grips);
  folder.write("space.toml",
               "format = 1\nkind = \"model\"\nid = \"gripped\"\nspace = \"3d\"\n"
               "effects = [\"grips.toml\"]\n");
  const std::string whole =
      replaced(testing::kSwing, "links = 2", "links = 2\ndescription = \"space.toml\"");
  const auto with = [&](const std::string& name, const std::string& value) {
    return folder.write("case.toml",
                        replaced(whole, "[[parameter]]",
                                 "[[parameter]]\nname = \"grip\"\nsets = \"grips." + name +
                                     "\"\nvalue = " + value + "\n[[parameter]]"));
  };
  check_refused(
      folder, "simulate", with("above", "0.0"),
      {"case.toml: clamp_side, clamp_down and clamp_across of [support] are zero at t = 0 s"});
  check_refused(
      folder, "simulate", with("below", "0.0"),
      {"case.toml: clamp_side, clamp_down and clamp_across of [held_end] are zero at t = 0 s"});
  const ProcessResult later =
      run_catena({"simulate", with("above", "2.0"), "--output", folder.path() / "later"});
  CHECK_MESSAGE(later.exit_status == 0, later.output);
  folder.write("grips.toml", replaced(grips, "\"above\"", "\"0*above\""));
  check_refused(folder, "simulate", with("below", "1.0"),
                {"grips.toml:19: support.clamp_down: all components are zero"});
}

TEST_CASE("mistakes on the command line") {
  struct CommandRow {
    std::vector<std::string> arguments;
    std::vector<std::string> expected;
  };
  const CommandRow rows[] = {
      {{"symulate"}, {"symulate is not a command; did you mean \"simulate\"?"}},
      {{"foo"}, {"foo is not a command; known are cache, certify, check,", "simulate"}},
      {{"--verson"}, {"--verson is not an option; did you mean \"--version\"?"}},
      {{}, {"catena: a command is wanted"}},
      {{"identify"}, {"catena identify: CASE is required"}},
      {{"simulate", "case.toml", "--outptu", "a"},
       {"catena simulate: --outptu is not an option; did you mean \"--output\"?"}},
      {{"simulate", "case.toml", "other.toml"}, {"other.toml is one argument too many"}},
      {{"check", "text.txt", "--link", "2"}, {"did you mean \"--links\"?"}},
      {{"identify", "case.toml", "--threads", "0"}, {"--threads: Value 0 not in range 1 to 1024"}},
      {{"identify", "case.toml", "--time-limit", "x"}, {"--time-limit: x is not a number above 0"}},
      {{"derive", "--links", "10000", "--effect", "added_mass", "air_drag_quadratic",
        "steady_wind"},
       {"deriving needs about 5.5 GB and 17 min", "--yes"}},
      {{"certify", "--links", "400"}, {"certifying needs about 13 min", "--yes"}},
      {{"identify", "case.toml", "--bootstrap", "-1"},
       {"--bootstrap: Value -1 not in range 0 to 100000"}},
  };
  for (const CommandRow& row : rows) {
    const ProcessResult run = run_catena(row.arguments);
    CHECK_MESSAGE(run.exit_status == 2, run.output);
    for (const std::string& part : row.expected)
      CHECK_MESSAGE(run.output.find(part) != std::string::npos, run.output, " lacks ", part);
    CHECK_MESSAGE(run.output.size() < 200, run.output);
  }
}

TEST_CASE("a recording that is given as a case") {
  const testing::TemporaryFolder folder;
  check_refused(folder, "identify", folder.write("data.csv", kData), {"data.csv:1", "catena new"});
}

TEST_CASE("angles in degrees, in a case without a recording") {
  const testing::TemporaryFolder folder;
  const auto run =
      run_catena({"simulate",
                  folder.write("case.toml", replaced(testing::kSwing, "angle = 0.6", "angle = 40")),
                  "--output", folder.path() / "out"});
  CHECK_MESSAGE(run.output.find("initial: an angle of 40 rad is 6.37 turns") != std::string::npos,
                run.output);
}
