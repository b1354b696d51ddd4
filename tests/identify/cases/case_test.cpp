// SPDX-License-Identifier: BSD-3-Clause
#include "identify/cases/case.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <tuple>

#include "common/input_error.hpp"
#include "identify/cases/case_reader.hpp"
#include "identify/cases/case_writer.hpp"
#include "tests/support/data.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/text.hpp"

using namespace catena;
using testing::replaced;

namespace {

const char* const kWhole = R"(format = 1
kind = "case"
title = "a \"whole\" case"

[model]
links = 4

[cable]
length = 2.0
density = 0.1
load_mass = 0.5

[[parameter]]
name = "k"
sets = "stiffness"
value = 0.1
unit = "N m/rad"
free = true
lower = 0.01
upper = 1.0

[[parameter]]
name = "tilt"
sets = "camera_tilt.angle"
value = 0.0
free = true
lower = -0.1
upper = 0.1
per_experiment = true
factor = 2.0

[initial]
shape = "smooth"
terms = 3
free = true

[initial.velocity]
shape = "straight"
rates = [0.25]

[[experiment]]
name = "first"
data = "data.csv"
kind = "markers"
from = 0.5
to = 3.5
fit_until = 2.25
start = 0.25
every = 2
noise = 0.001
length_unit = "px"
metres_per_pixel = 0.002
vertical = "up"
mirrored = true
origin = [320.0, 20.0]
time_unit = "frames"
frame_rate = 30.0
markers = [
  {name = "middle", side = "x", down = "y", arc_length = 0.75},
  {name = "knot", side = "x", down = "y", joint = 2},
  {name = "load", side = "x", down = "y", load = true},
]

[experiment.initial]
shape = "catenary"
held = {side = 0.5, down = 1.25}
ends_at_held = true

[[experiment]]
name = "second"
data = "data.csv"
kind = "angles"
use = "validate"
window = 1.5
angle_unit = "deg"
wrapped = true
angles = [{name = "arm", column = "phi", link = 2}]

[[experiment.signal]]
name = "push"
data = "data.csv"
time = "x"
column = "y"

[error]
measure = "least_squares"
loss = "huber"
loss_scale = 2.5

[optimiser]
method = "least_squares"
max_evaluations = 77
tolerance = 1e-06
starts = 3
seed = 5
growing_windows = [0.5, 1.0]

[simulation]
duration = 4.0
step = 0.002
relative_tolerance = 1e-07
max_steps = 5000

[diagnosis]
good_enough = "0.002 m"
possible = ["steady_wind"]
impossible = ["scale", "camera_tilt"]
doubtful = ["load_drag.coefficient"]
)";

}  // namespace

TEST_CASE("a case is read as it stands") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const Case the_case = parse_case(kWhole, "case.toml", folder.path());
  CHECK(the_case.title == "a \"whole\" case");
  CHECK(the_case.links == 4);
  CHECK(the_case.cable.gravity == 9.81);
  REQUIRE(the_case.parameters.size() == 2);
  CHECK(the_case.parameters[0].scale == Scale::kLogarithmic);
  CHECK(the_case.parameters[1].scale == Scale::kLinear);
  CHECK(the_case.parameters[1].per_experiment);
  CHECK(the_case.parameters[1].factor == 2);
  CHECK(the_case.initial.shape == Shape::kSmooth);
  CHECK(the_case.initial.velocity_coefficients == std::vector<double>{0.25});
  REQUIRE(the_case.experiments.size() == 2);
  const ExperimentSpec& first = the_case.experiments[0];
  CHECK(first.upward);
  CHECK(first.origin[0] == 320);
  CHECK(first.points[1].joint == 2);
  CHECK(first.points[2].load);
  REQUIRE(first.initial);
  CHECK(first.initial->held[1] == 1.25);
  CHECK(the_case.experiments[1].use == Use::kValidate);
  CHECK(the_case.experiments[1].points[0].link == 2);
  CHECK(the_case.experiments[1].signals[0].column == "y");
  CHECK(the_case.error.loss == Loss::kHuber);
  CHECK_FALSE(the_case.error.noise_estimated);
  CHECK(the_case.optimiser.growing_windows.size() == 2);
  CHECK(the_case.simulation.max_steps == 5000);
}

TEST_CASE("a tolerance is a number and a unit, and a diagnosis names effects") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const auto diagnosis = [&](const std::string& good_enough) {
    return parse_case(replaced(kWhole, "\"0.002 m\"", good_enough), "case.toml", folder.path())
        .diagnosis;
  };
  CHECK(diagnosis("\"2 mm\"").good_enough == doctest::Approx(0.002));
  CHECK(diagnosis("\"3 mrad\"").good_enough == doctest::Approx(0.003));
  CHECK(diagnosis("\"2 mm\"").impossible == std::vector<std::string>{"scale", "camera_tilt"});
  CHECK(diagnosis("\"2 mm\"").doubtful == std::vector<std::string>{"load_drag.coefficient"});
  for (const char* wrong : {"\"2\"", "\"2 miles\"", "\"-2 mm\"", "\"2 mm or so\"", "\"\""})
    CHECK(failure([&] { diagnosis(wrong); }).find("diagnosis.good_enough") != std::string::npos);
}

TEST_CASE("noise may be estimated: a loss and a prior need no stated one") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const auto read = [&](const std::string& text) {
    return parse_case(text, "case.toml", folder.path());
  };
  const std::string loss = "loss_scale = 2.5\n";
  const std::string estimated = replaced(kWhole, loss, loss + "noise = \"estimated\"\n");
  const Case unstated = read(replaced(replaced(estimated, "noise = 0.001\n", ""), "value = 0.1\n",
                                      "value = 0.1\nstandard_deviation = 0.02\n"));
  CHECK(unstated.error.noise_estimated);
  CHECK(read(case_text(unstated, folder.path())).error.noise_estimated);
  const auto refused = [&](const std::string& text, const std::string& why) {
    CHECK(failure([&] { read(text); }).find(why) != std::string::npos);
  };
  refused(replaced(estimated, "\"estimated\"", "\"unknown\""), "noise: \"unknown\"");
  refused(replaced(estimated, "measure = \"least_squares\"\nloss = \"huber\"",
                   "measure = \"likelihood\""),
          "only the measure least_squares takes it");
}

TEST_CASE("a parameter does not exceed another one that can be compared with it") {
  const std::string two = replaced(kWhole, "[initial]", R"([[parameter]]
name = "a"
sets = "air_drag_linear.tangential"
value = 0.1
free = true
lower = 0.0
at_most = "b"
[[parameter]]
name = "b"
sets = "air_drag_linear.normal"
value = 0.2
lower = 0.0
[initial])");
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const auto read = [&](const std::string& text) {
    return parse_case(text, "case.toml", folder.path());
  };
  const Case the_case = read(two);
  CHECK((the_case.parameters.end() - 2)->at_most == "b");
  CHECK((read(case_text(the_case, folder.path())).parameters.end() - 2)->at_most == "b");
  const auto refused = [&](const std::string& text, const std::string& why) {
    const std::string message = failure([&] { read(text); });
    CAPTURE(message);
    CHECK(message.find("at_most") != std::string::npos);
    CHECK(message.find(why) != std::string::npos);
  };
  refused(replaced(two, "at_most = \"b\"", "at_most = \"z\""), "\"z\" is no other parameter");
  refused(replaced(two, "at_most = \"b\"", "at_most = \"a\""), "\"a\" is no other parameter");
  refused(replaced(two, "value = 0.2", "value = 0.05"), "0.1 is more than that of \"b\", 0.05");
  refused(replaced(two, "value = 0.2\nlower = 0.0", "value = 0.2\nlower = 0.1"), "same lower");
  refused(replaced(two, "value = 0.2", "value = 0.2\nfactor = 2"), "factor");
  refused(replaced(two, "name = \"b\"", "name = \"b\"\nat_most = \"a\""), "in one order only");
}

TEST_CASE("a standard deviation needs a free parameter, least squares and the noise") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const auto read = [&](const std::string& text) {
    return parse_case(text, "case.toml", folder.path());
  };
  const std::string known =
      replaced(kWhole, "value = 0.1\n", "value = 0.1\nstandard_deviation = 0.02\n");
  CHECK(read(known).parameters[0].measured == 0.1);
  CHECK(read(replaced(known, "standard_deviation", "measured = 0.3\nstandard_deviation"))
            .parameters[0]
            .measured == 0.3);
  const auto refused = [&](const std::string& text, const std::string& why) {
    const std::string message = failure([&] { read(text); });
    CAPTURE(message);
    CHECK(message.find("standard_deviation") != std::string::npos);
    CHECK(message.find(why) != std::string::npos);
  };
  refused(replaced(known, "free = true\n", ""), "say free = true");
  const std::string loss = "\nloss = \"huber\"\nloss_scale = 2.5";
  refused(replaced(replaced(known, loss, ""), "noise = 0.001\n", ""), "states none");
  refused(replaced(known, "measure = \"least_squares\"" + loss, "measure = \"likelihood\""),
          "only the measure least_squares");
}

TEST_CASE("what is written is read back the same") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const Case the_case = parse_case(kWhole, "case.toml", folder.path());
  const std::string once = case_text(the_case, folder.path());
  const std::string twice = case_text(parse_case(once, "case.toml", folder.path()), folder.path());
  CHECK(once == twice);
  for (const char* line : {"arc_length = 0.75", "origin = [320, 20]", "start = 0.25",
                           "held = {side = 0.5, down = 1.25}", "data = \"data.csv\"",
                           "growing_windows = [0.5, 1]", "per_experiment = true"})
    CHECK_MESSAGE(once.find(line) != std::string::npos, std::string(line));
}

TEST_CASE("what a case says of cameras is written and read back, and checked") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y\n");
  const std::string text = R"(format = 1
kind = "case"
[model]
links = 4
[cable]
length = 1.0
density = 0.1
[[camera]]
name = "left"
centre = [960, 540.5]
[[camera]]
name = "right_2"
centre = [640, 360]
[[experiment]]
name = "first"
data = "data.csv"
kind = "markers"
length_unit = "px"
metres_per_pixel = 0.003
markers = [{name = "knot", side = "x", down = "y", camera = "right_2", load = true}]
)";
  const auto read = [&](const std::string& source) {
    return parse_case(source, "case.toml", folder.path());
  };
  const Case the_case = read(case_text(read(text), folder.path()));
  REQUIRE(the_case.cameras.size() == 2);
  CHECK(the_case.cameras[0].name == "left");
  CHECK(the_case.cameras[0].centre == std::array<double, 2>{960, 540.5});
  const PointSpec& knot = the_case.experiments[0].points[0];
  CHECK(knot.camera == "right_2");
  CHECK(knot.centre == std::array<double, 2>{640, 360});
  const std::tuple<const char*, const char*, const char*> all[] = {
      {"camera = \"right_2\"", "camera = \"right2\"",
       "camera: \"right2\" is no [[camera]] of this case; did you mean \"right_2\"?"},
      {"name = \"left\"", "name = \"left one\"",
       "case.toml:9: camera.name: \"left one\"; give one of letters, digits and _"},
      {"name = \"left\"", "name = \"right_2\"", "name: \"right_2\"; names must differ"},
      {"centre = [960, 540.5]", "centre = [960]", "centre: must be two numbers of at most 1e6, px"},
      {"centre = [960, 540.5]", "centre = [960, -1e300]", "centre: must be two numbers of at most"},
      {"centre = [960, 540.5]", "", "centre"},
      {"centre = [960, 540.5]", "centre = [960, 540.5]\nfocal_length = 1000", "focal_length"},
  };
  for (const auto& row : all) {
    const std::string right = std::get<0>(row), wrong = std::get<1>(row), rule = std::get<2>(row);
    CAPTURE(wrong);
    const std::string message = failure([&] { read(replaced(text, right, wrong)); });
    CHECK_MESSAGE(message.find(rule) != std::string::npos, message);
  }
}

TEST_CASE("what a case says of space is written and read back, and checked") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,z\n");
  const std::string text = R"(format = 1
kind = "case"
[model]
links = 4
[cable]
length = 1.0
density = 0.1
[initial]
shape = "smooth"
terms = 2
coefficients = [0.5, 0.1]
azimuth = 0.4
out_of_plane = [0.2, -0.1]
free = true
[[initial.load]]
coordinate = "load_body.turn_roll"
value = 0.1
[[initial.load]]
coordinate = "load_body.turn_yaw"
value = 0.3
rate = -1.5
[initial.velocity]
shape = "straight"
rates = [0.25]
azimuth_rates = [1, 2, 3, 4]
out_of_plane_rates = [0.75]
[[experiment]]
name = "first"
data = "data.csv"
kind = "markers"
axes = ["x", "z", "y"]
vertical = "up"
origin = [1, 2, 3]
[[experiment]]
name = "second"
data = "data.csv"
kind = "markers"
markers = [{name = "knot", side = "x", down = "z", across = "y", joint = 2}]
)";
  const auto read = [&](const std::string& source) {
    return parse_case(source, "case.toml", folder.path());
  };
  const Case the_case = read(case_text(read(text), folder.path()));
  CHECK(the_case.initial.azimuths == std::vector<double>(4, 0.4));
  REQUIRE(the_case.initial.load.size() == 2);
  CHECK(the_case.initial.load[0].coordinate == "load_body.turn_roll");
  CHECK(the_case.initial.load[1].value == 0.3);
  CHECK(the_case.initial.load[1].rate == -1.5);
  CHECK(the_case.initial.out_of_plane == std::vector<double>{0.2, -0.1});
  CHECK(the_case.initial.azimuth_rates == std::vector<double>{1, 2, 3, 4});
  CHECK(the_case.initial.out_of_plane_rates == std::vector<double>{0.75});
  CHECK(the_case.experiments[0].axes == std::vector<std::string>{"x", "z", "y"});
  CHECK(the_case.experiments[0].origin == std::vector<double>{1, 2, 3});
  CHECK(the_case.experiments[1].points[0].across_column == "y");
  struct Wrong {
    std::string right, wrong, rule;
  };
  const Wrong all[] = {
      {"out_of_plane = [0.2, -0.1]", "out_of_plane = [0.2]",
       "out_of_plane: 1 numbers; must be as many as in `coefficients`, 2"},
      {"out_of_plane_rates = [0.75]", "out_of_plane_rates = [inf]",
       "out_of_plane_rates: inf; must lie within"},
      {"axes = [\"x\", \"z\", \"y\"]", "axes = [\"x\"]", "axes: must be two names"},
      {"value = 0.3", "value = inf", "initial.load: value and rate must be finite"},
      {"coordinate = \"load_body.turn_yaw\"", "coordinate = \"load_body.turn_roll\"",
       "coordinate: \"load_body.turn_roll\" stands there twice"},
      {"coordinate = \"load_body.turn_yaw\"\n", "", "\"coordinate\" is missing"},
      {"origin = [1, 2, 3]", "origin = [1, 2, 3, 4]", "origin: must be two numbers"},
      {"markers = [", "axes = [\"x\", \"z\", \"y\"]\nmarkers = [", "axes: names columns"},
  };
  for (const Wrong& each : all) {
    const std::string message = failure([&] { read(replaced(text, each.right, each.wrong)); });
    CHECK_MESSAGE(message.find(each.rule) != std::string::npos, message);
  }
}

TEST_CASE("a parameter has a value for each experiment where the case gives one") {
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  const Case whole = parse_case(kWhole, "case.toml", folder.path());
  const std::string first = whole.experiments[0].name, flag = "per_experiment = true";
  const auto read = [&](const std::string& values, const std::string& with) {
    return parse_case(replaced(kWhole, flag, with + "\nvalues = " + values), "case.toml",
                      folder.path());
  };
  const Case given = read("{\"" + first + "\" = 0.05}", flag);
  CHECK(given.parameters[1].value_in(first) == 0.05);
  CHECK(given.parameters[1].value_in(whole.experiments[1].name) == whole.parameters[1].value);
  const std::string text = case_text(given, folder.path());
  CHECK(text.find("values = {\"" + first + "\" = 0.05}") != std::string::npos);
  CHECK(parse_case(text, "case.toml", folder.path()).parameters[1].values ==
        given.parameters[1].values);
  CHECK(failure([&] {
          read("{\"" + first + "x\" = 0.05}", flag);
        }).find("is no experiment of this case; did you mean \"" + first) != std::string::npos);
  CHECK(failure([&] {
          read("{\"" + first + "\" = 0.05}", "");
        }).find("values: needs per_experiment = true") != std::string::npos);
  CHECK(failure([&] { read("{\"" + first + "\" = inf}", flag); }).find("must be finite") !=
        std::string::npos);
}

TEST_CASE("no example names a file outside the examples, so that each runs from anywhere") {
  const std::filesystem::path examples = tests::source_folder() / "examples";
  const std::regex named("(?:data|description) = \"([^\"]*)\"");
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
    if (entry.path().extension() != ".toml") continue;
    std::ifstream in(entry.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    for (std::sregex_iterator match(text.begin(), text.end(), named), end; match != end; ++match) {
      const auto file = entry.path().parent_path() / (*match)[1].str();
      const auto place = file.lexically_normal().lexically_relative(examples).string();
      CHECK_MESSAGE(!place.starts_with(".."), entry.path().string(), ": ", place);
      ++files;
    }
  }
  CHECK(files >= 3);
}

TEST_CASE("each mistake is named with its line, key, value and rule") {
  struct Row {
    const char* from;
    const char* to;
    const char* expected;
  };
  const Row rows[] = {
      {"format = 1", "format = 2", "format"},
      {"kind = \"case\"", "kind = \"model\"", "kind"},
      {"links = 4", "links = 0",
       "case.toml:6: model.links: 0; must be a whole number from 1 to 10000"},
      {"links = 4", "links = 4.5", "model.links"},
      {"links = 4", "links = 2000000", "2000000; must be a whole number from 1 to 10000"},
      {"links = 4", "linsk = 4", "links"},
      {"length = 2.0", "length = -2.0", "case.toml:9: cable.length: -2; must be positive"},
      {"length = 2.0", "length = \"2 m\"", "cable.length"},
      {"length = 2.0", "length = 2.0\nlink_lengths = [1.0, 1.0]", "one per link"},
      {"length = 2.0", "link_lengths = [1.0, 1.0, 0.0, 1.0]", "number 3 is 0"},
      {"density = 0.1", "link_masses = [1.0, 1.0, -0.1, 1.0]", "number 3 is -0.1"},
      {"density = 0.1", "densty = 0.1", "density"},
      {"load_mass = 0.5", "load_mass = -0.5", "must not be negative"},
      {"load_mass = 0.5", "load_mas = 0.5", "did you mean \"load_mass\"?"},
      {"value = 0.1", "value = nan", "value"},
      {"lower = 0.01", "lower = 2.0", "must not exceed upper"},
      {"lower = 0.01", "lower = 1.0", "free parameter needs room"},
      {"value = 0.1", "value = 7.0", "must lie within lower"},
      {"lower = 0.01", "lower = 0.0\nscale = \"log\"", "positive lower bound"},
      {"name = \"tilt\"", "name = \"k\"", "names must differ"},
      {"factor = 2.0", "factor = 0.0", "not zero"},
      {"shape = \"smooth\"", "shape = \"smoth\"", "smooth"},
      {"rates = [0.25]", "rates = [0.25, 1.0]", "this shape has 1"},
      {"rates = [0.25]", "rates = [1e200]", "must lie within -1e6 and 1e6"},
      {"rates = [0.25]", "rates = [inf]", "must lie within -1e6 and 1e6"},
      {"data = \"data.csv\"", "data = \"absent.csv\"", "there is no such file"},
      {"fit_until = 2.25", "fit_until = 0.25", "must be after from"},
      {"to = 3.5", "to = 0.5", "must be after from"},
      {"every = 2", "every = 0", "from 1 to 1000000000"},
      {"noise = 0.001", "noise = 0.0", "must be positive"},
      {"noise = 0.001", "noise = 1e-300", "1e-300; must lie between 1e-50 and 1e+50"},
      {"noise = 0.001", "noise = 1e300", "1e+300; must lie between 1e-50 and 1e+50"},
      {"noise = 0.001", "noise = inf", "inf; must lie between 1e-50 and 1e+50"},
      {"metres_per_pixel = 0.002", "metres_per_pixel = 1e-300", "must lie between"},
      {"window = 1.5", "window = 1e-10", "1e-10; must lie between 1e-09 and 1e+09"},
      {"duration = 4.0", "duration = 1e-300", "must lie between 1e-09 and 1e+09"},
      {"duration = 4.0", "duration = 1e300", "must lie between 1e-09 and 1e+09"},
      {"start = 0.25", "start = -1e300", "must lie within -1e9 and 1e9"},
      {"metres_per_pixel = 0.002", "", "lengths in px need it"},
      {"metres_per_pixel = 0.002", "meters_per_pixel = 0.002",
       "there is \"meters_per_pixel\" on line"},
      {"frame_rate = 30.0", "", "frames per second"},
      {"joint = 2", "joint = 5", "there are 4"},
      {"arc_length = 0.75", "arc_length = 0.75, joint = 1", "one of arc_length, joint and load"},
      {"link = 2", "link = 9", "there are 4"},
      {"origin = [320.0, 20.0]", "origin = [320.0]", "two numbers"},
      {"loss = \"huber\"", "loss = \"tukey\"", "loss"},
      {"noise = 0.001", "", "\"huber\" counts residuals in units of the noise"},
      {"measure = \"least_squares\"", "measure = \"mean_distance\"",
       "only the measure least_squares"},
      {"method = \"least_squares\"", "method = \"simplex\"", "method"},
      {"growing_windows = [0.5, 1.0]", "growing_windows = [1.0, 0.5]",
       "longer than the one before"},
      {"step = 0.002", "step = 0.0", "must be positive"},
      {"step = 0.002", "step = 1e-9", "ten million"},
      {"title = ", "titel = ", "did you mean \"title\"?"},
  };
  const testing::TemporaryFolder folder;
  folder.write("data.csv", "x,y,phi\n");
  for (const Row& row : rows) {
    CAPTURE(row.from);
    CAPTURE(row.to);
    std::string message;
    try {
      parse_case(replaced(kWhole, row.from, row.to), "case.toml", folder.path());
    } catch (const InputError& error) {
      message = error.what();
    }
    CHECK_MESSAGE(message.find(row.expected) != std::string::npos, message, " lacks ",
                  std::string(row.expected));
    CHECK_MESSAGE(message.starts_with("case.toml:"), message);
  }
}

TEST_CASE("a case keeps what was read, whatever becomes of its file") {
  const testing::TemporaryFolder folder;
  const std::string text =
      "format = 1\nkind = \"case\"\n[model]\nlinks = 2\n[cable]\nlength = 1.0\ndensity = 0.3\n"
      "load_mass = 0.2\n";
  const auto file = folder.write("cable.toml", text);
  const Case the_case = read_case(file);
  std::filesystem::remove(file);
  CHECK(the_case.text == text);
}
