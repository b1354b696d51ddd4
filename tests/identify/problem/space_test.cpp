// SPDX-License-Identifier: BSD-3-Clause
//
// Cases in space: starts, what sensors see, fits.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"
#include "identify/fit/links_study.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/problem/initial_state.hpp"
#include "identify/problem/plausibility.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/problem/prediction_difference.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"
#include "tests/support/temporary_folder.hpp"

using namespace catena;
using Eigen::VectorXd;

namespace {

constexpr int kLinks = 3;

Model model() { return Model::load(SPATIAL_3); }

/// Three links, stiffness and damping unknown.
Case three_links() {
  Case the_case = testing::sections(testing::kTwoLinks);
  the_case.links = kLinks;
  testing::add_experiment(the_case, "run");
  return the_case;
}

/// A start that lies in no plane and turns about the vertical.
InitialSpec askew() {
  InitialSpec initial;
  initial.shape = Shape::kAngles;
  initial.coefficients = {0.3, -0.2, 0.7};
  initial.out_of_plane = {0.2, 0.4, -0.3};
  initial.azimuths = {0.5, 0.5, 2.0};
  initial.at_rest = false;
  initial.velocity_shape = Shape::kAngles;
  initial.velocity_coefficients = {0.5, -0.8, 1.0};
  initial.out_of_plane_rates = {-0.4, 0.9, 0.6};
  initial.azimuth_rates = {0.8, 0.8, 0.8};
  return initial;
}

Recording seven_markers(int frames, double step) {
  return testing::empty_markers({0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0}, frames, step, true);
}

/// The film of a start, and the state it began with.
Recording film_of(Case truth, const InitialSpec& initial, State& state, int frames = 8) {
  truth.initial = initial;
  Recording recording = testing::with_truth(truth, model(), seven_markers(frames, 0.002));
  const Problem problem(truth, model(), {recording});
  state = problem.initial_state(problem.start(), 0);
  return recording;
}

}  // namespace

TEST_CASE("derivatives by the unknowns of a start and by parameters are differences") {
  Case free = three_links();
  free.initial = askew();
  free.initial.free = free.initial.velocity_free = true;
  Case held = three_links();  // its start follows from the length
  held.initial.shape = Shape::kCatenary;
  held.initial.coefficients.clear();
  held.initial.held = {0.4, 0.5};
  held.initial.azimuths = {0.5, 0.5, 0.5};
  held.initial.at_rest = false;
  held.initial.velocity_coefficients = {0, 0, 0};
  held.initial.azimuth_rates = {2, 2, 2};
  held.parameters[0].free = held.parameters[1].free = false;
  ParameterSpec length;
  length.name = "length";
  length.sets = "cable.length";
  length.value = 1;
  length.free = true;
  held.parameters.push_back(length);
  for (Case& the_case : std::array<Case, 2>{free, held}) {
    the_case.simulation.relative_tolerance = 1e-11;
    the_case.simulation.absolute_tolerance_position = 1e-12;
    the_case.simulation.absolute_tolerance_velocity = 1e-11;
    const Problem problem(the_case, model(),
                          {testing::empty_markers({0.2, 0.5, 0.9}, 4, 0.1, true)});
    const VectorXd x = problem.start();
    REQUIRE(x.size() == (the_case.initial.free ? 2 + 4 * kLinks : 1));
    const Prediction here = problem.predict(x, 0, true, problem.directions(x, 0));
    REQUIRE_MESSAGE(here.ok(), here.message);
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
      const Eigen::MatrixXd difference = testing::difference_along(problem, x, j);
      const Eigen::MatrixXd& found = here.sensitivity[static_cast<std::size_t>(j)];
      CHECK(difference.norm() > 1e-3);
      CHECK((found - difference).norm() < 1e-5 * (1 + difference.norm()));
    }
  }
}

TEST_CASE("a start that is not finite fails as a simulation does") {
  for (const bool in_space : {true, false}) {
    Case the_case = three_links();
    InitialSpec& initial = the_case.initial;
    initial = askew();
    initial.free = initial.velocity_free = true;
    if (!in_space)
      for (auto* list : {&initial.out_of_plane, &initial.azimuths, &initial.out_of_plane_rates,
                         &initial.azimuth_rates})
        list->clear();
    const Problem problem(the_case, in_space ? model() : Model::built_in(kLinks),
                          {testing::empty_markers({0.2, 0.5, 0.9}, 4, 0.1, in_space)});
    REQUIRE(problem.start().size() == 2 + (in_space ? 4 : 2) * kLinks);
    for (Eigen::Index j = 2; j < problem.start().size(); ++j) {
      CAPTURE(problem.unknowns()[static_cast<std::size_t>(j)].name);
      VectorXd x = problem.start();
      x[j] = std::numeric_limits<double>::infinity();
      for (const bool jacobian : {false, true}) {
        const Evaluation evaluation = evaluate(problem, x, true, jacobian);
        CHECK(!evaluation.ok);
        CHECK(evaluation.predictions[0].status == Status::kNotFinite);
      }
    }
  }
}

TEST_CASE("a start without a derivative by one of its unknowns fails as a simulation does") {
  Case the_case = three_links();
  the_case.initial = askew();
  the_case.initial.free = the_case.initial.velocity_free = true;
  const Problem problem(the_case, model(), {testing::empty_markers({0.2, 0.5, 0.9}, 4, 0.1, true)});
  const VectorXd x = problem.start();
  auto along = problem.directions(x, 0);
  along.back().v[0] = std::numeric_limits<double>::quiet_NaN();
  const Prediction prediction = problem.predict(x, 0, true, along);
  CHECK(prediction.status == Status::kNotFinite);
  CHECK(prediction.message.find("no derivative") != std::string::npos);
}

namespace {

/// Five links whose far end is held at 0.6 m aside and 0.3 m down, where it swings across.
Case held_at_both_ends() {
  Case the_case = three_links();
  the_case.links = 5;
  for (const auto& [name, value] :
       {std::pair("to_side", 0.6), {"to_down", 0.3}, {"amplitude", 0.1}}) {
    ParameterSpec spec;
    spec.name = name;
    spec.sets = std::string("holds_end.") + name;
    spec.value = value;
    spec.free = name == std::string("to_side");
    the_case.parameters.push_back(spec);
  }
  return the_case;
}

}  // namespace

TEST_CASE("derivatives of a motion between two ends are differences") {
  Case the_case = held_at_both_ends();
  the_case.initial = askew();
  the_case.initial.coefficients = {0.3, -0.2, 0.7, 1.1, 1.5};
  the_case.initial.out_of_plane = {0.2, 0.4, -0.3, 0, 0.1};
  the_case.initial.azimuths.assign(5, 0.5);
  the_case.initial.velocity_coefficients = {0.5, -0.8, 1.0, 0.3, 0};
  the_case.initial.out_of_plane_rates = {-0.4, 0.9, 0.6, 0, 0.2};
  the_case.initial.azimuth_rates.assign(5, 0.8);
  the_case.initial.free = the_case.initial.velocity_free = true;
  the_case.simulation.relative_tolerance = 1e-11;
  the_case.simulation.absolute_tolerance_position = 1e-12;
  the_case.simulation.absolute_tolerance_velocity = 1e-11;
  const Problem problem(the_case, Model::load(HELD_END_5),
                        {testing::empty_markers({0.2, 0.5, 0.8}, 4, 0.1, true)});
  const VectorXd x = problem.start();
  REQUIRE(x.size() == 3 + 4 * 5);
  const std::vector<SensitivityDirection> directions = problem.directions(x, 0);
  const Prediction here = problem.predict(x, 0, true, directions);
  REQUIRE_MESSAGE(here.ok(), here.message);
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    const auto k = static_cast<std::size_t>(j);
    CAPTURE(problem.unknowns()[k].name);
    const double step = 1e-5 * (1 + std::abs(x[j]));
    VectorXd more = x, less = x;
    more[j] += step;
    less[j] -= step;
    const Eigen::MatrixXd difference =
        (problem.predict(more, 0, true).simulated - problem.predict(less, 0, true).simulated) /
        (2 * step);
    CHECK(difference.norm() > 1e-3);
    CHECK((here.sensitivity[k] - difference).norm() < 1e-5 * (1 + difference.norm()));
    const State after = problem.initial_state(more, 0), before = problem.initial_state(less, 0);
    const VectorXd moved = (after.q - before.q) / (2 * step);
    const VectorXd faster = (after.v - before.v) / (2 * step);
    if (directions[k].q.size() == 0) {
      CHECK(moved.norm() + faster.norm() == 0);
      continue;
    }
    CHECK((directions[k].q - moved).norm() < 1e-6 * (1 + moved.norm()));
    CHECK((directions[k].v - faster).norm() < 1e-6 * (1 + faster.norm()));
  }
}

TEST_CASE("rounding across the plane does not change the sign of the rates of a hanging start") {
  const Model model = Model::load(HELD_END_5);
  InitialSpec initial;
  initial.shape = Shape::kHanging;
  initial.at_rest = false;
  initial.velocity_shape = Shape::kAngles;
  initial.velocity_coefficients = {0.5, -0.8, 1.0, 0.3, 0.2};
  VectorXd parameters = model.default_parameters();
  parameters.head(10).setConstant(0.2);
  parameters.segment(10, 5).setConstant(1e-4);
  parameters.segment(15, 10).setConstant(0.01);
  parameters[model.parameter_index("load_mass")] = 0.1;
  parameters[model.parameter_index("holds_end.to_side")] = -0.6;  // at an azimuth of pi
  std::vector<State> starts;
  for (const double across : {-1e-13, 0.0, 1e-13}) {
    parameters[model.parameter_index("holds_end.to_across")] = across;
    starts.push_back(state_at_start(model, parameters, initial, {}, 0));
  }
  CHECK(starts[1].v.head(5).norm() > 0.1);
  for (const State& start : starts) {
    CHECK((start.q - starts[1].q).norm() < 1e-9);
    CHECK((start.v - starts[1].v).norm() < 1e-9);
  }
  // It is the mirror image of the start on the other side with the rates reversed.
  for (double& rate : initial.velocity_coefficients) rate = -rate;
  parameters[model.parameter_index("holds_end.to_side")] = 0.6;
  parameters[model.parameter_index("holds_end.to_across")] = 0;
  const State mirrored = state_at_start(model, parameters, initial, {}, 0);
  CHECK((starts[1].v.head(5) + mirrored.v.head(5)).norm() < 1e-7);
  CHECK((starts[1].v.segment(5, 5) - mirrored.v.segment(5, 5)).norm() < 1e-7);
}

TEST_CASE("a start is seen from the support where signals move it") {
  const testing::TemporaryFolder folder;
  std::string table = "t,x,z,y,grip_x,grip_z,grip_y\n";
  for (int k = 0; k < 20; ++k) {
    const double t = 0.002 * k;
    table +=
        fmt::format("{},{},{},{},{},{},0\n", t, 3 + 0.7 * t, -2 + 0.5 * t, 1 - 2 * t, 0.2, 0.9);
  }
  folder.write("hand.csv", table);
  const Model model = Model::load(HELD_BY_HAND_5);
  Case truth = testing::sections(testing::kTwoLinks);
  truth.links = 5;
  testing::add_experiment(truth, "run");
  for (const auto& [name, column] : {std::pair("hand_side", "x"),
                                     {"hand_down", "z"},
                                     {"hand_across", "y"},
                                     {"grip_side", "grip_x"},
                                     {"grip_down", "grip_z"},
                                     {"grip_across", "grip_y"}})
    truth.experiments[0].signals.push_back(
        {std::string("hand.") + name, folder.path() / "hand.csv", "t", column});
  truth.initial = askew();
  truth.initial.coefficients = {0.3, -0.2, 0.7, 0.1, 0.5};
  truth.initial.out_of_plane = {0.2, 0.4, -0.3, 0, 0};
  truth.initial.azimuths = std::vector<double>(5, 0.5);
  truth.initial.velocity_coefficients = {0.5, -0.8, 1.0, 0.3, 0};
  truth.initial.out_of_plane_rates = {-0.4, 0.9, 0.6, 0, 0.2};
  truth.initial.azimuth_rates = {};
  const Recording recording = testing::with_truth(
      truth, model, testing::empty_markers({0.2, 0.4, 0.6, 0.8, 1.0}, 8, 0.002, true));
  const Problem made(truth, model, {recording});
  const State expected = made.initial_state(made.start(), 0);
  Case the_case = truth;
  the_case.initial = {};
  the_case.initial.shape = the_case.initial.velocity_shape = Shape::kAngles;
  the_case.initial.at_rest = false;
  const Problem problem(the_case, model, {recording});
  const State found = problem.initial_state(problem.start(), 0);
  CHECK((found.q - expected.q).cwiseAbs().maxCoeff() < 0.02);
  CHECK((found.v - expected.v).cwiseAbs().maxCoeff() < 1);
}

TEST_CASE("any start is found from the first frames, without a singular shape") {
  const double right = std::numbers::pi / 2;
  struct Row {
    const char* name;
    std::vector<double> angles, azimuths;
  };
  // The last one: no one vertical plane is far from being crossed at a right angle by a link.
  const Row rows[] = {{"hanging", {0, 0, 0}, {0, 0, 0}},
                      {"upwards", {2.9, 3.0, 2.8}, {1, 1, 1}},
                      {"a corner", {0.4, 1.5, 1.5}, {0.3, 0.3, 0.3 + right}},
                      {"a helix", {1.2, 1.2, 1.2}, {0, 2, 4}}};
  for (const Row& row : rows) {
    CAPTURE(std::string(row.name));
    InitialSpec truth = askew();
    truth.coefficients = row.angles;
    truth.azimuths = row.azimuths;
    truth.out_of_plane.clear();
    State expected;
    const Recording recording = film_of(three_links(), truth, expected);
    Case the_case = three_links();
    the_case.initial = {};
    the_case.initial.shape = Shape::kAngles;
    the_case.initial.at_rest = false;
    the_case.initial.velocity_shape = Shape::kAngles;
    the_case.initial.free = the_case.initial.velocity_free = true;
    const Problem problem(the_case, model(), {recording});
    const State found = problem.initial_state(problem.start(), 0);
    CHECK((found.q - expected.q).cwiseAbs().maxCoeff() < 0.02);
    // a line through 12 ms of motion that is let go: half of that at 80 rad/s^2
    CHECK((found.v - expected.v).cwiseAbs().maxCoeff() < 0.5);
    // every coordinate moves its link
    for (const SensitivityDirection& along : problem.directions(problem.start(), 0))
      if (along.parameters.size() == 0) CHECK(std::max(along.q.norm(), along.v.norm()) > 0.6);
  }
}

TEST_CASE("stiffness, damping and the whole start are found, in their intervals") {
  Case truth = three_links();
  truth.parameters[0].value = 0.1;
  truth.parameters[1].value = 0.005;
  truth.initial = askew();
  Recording recording = testing::with_truth(truth, model(), seven_markers(60, 0.03), 1e-3);
  recording.measured.block(3, 10, 3, 5).setConstant(NAN);  // not seen
  recording.fit_frames = 45;
  Case the_case = three_links();
  the_case.initial.shape = Shape::kAngles;
  the_case.initial.coefficients.clear();
  the_case.initial.at_rest = false;
  the_case.initial.velocity_shape = Shape::kAngles;
  the_case.initial.free = the_case.initial.velocity_free = true;
  the_case.optimiser.method = FitMethod::kLeastSquares;
  the_case.error.measure = Measure::kLeastSquares;
  const Problem problem(the_case, model(), {recording});
  const FitResult result = fit(problem, {}, fit_least_squares);
  CHECK(result.status == FitStatus::kConverged);
  const Uncertainty uncertainty = uncertainty_of(problem, result.x);
  const double expected[] = {0.1, 0.005};
  for (std::size_t j = 0; j < 2; ++j) {
    const Estimate& estimate = uncertainty.estimates[j];
    CHECK(result.x[static_cast<Eigen::Index>(j)] == catena::near(expected[j], 0.05));
    CHECK(estimate.lower < expected[j]);
    CHECK(estimate.upper > expected[j]);
  }
  for (const Gap& gap : gaps_of(problem, evaluate(problem, result.x, true, false)))
    CHECK(gap.rms == catena::near(1e-3, 0.1));  // fitted and held out
  const Case fitted = problem.with(result.x);
  const Problem again(fitted, model(), {recording});
  CHECK((again.start() - result.x).cwiseAbs().maxCoeff() == 0);
}

TEST_CASE("a recording in space is held against the cable as one in the plane") {
  Case truth = three_links();
  truth.initial.coefficients = {0.5};
  truth.initial.azimuths.assign(kLinks, std::numbers::pi / 2);  // it swings across only
  Recording film = testing::with_truth(truth, model(), seven_markers(200, 0.03), 1e-3);
  ExperimentSpec spec = truth.experiments[0];
  const VectorXd lengths = VectorXd::Constant(kLinks, 1.0 / kLinks);
  const auto said = [&](const Recording& recording, const InitialSpec& initial) {
    std::string all;
    for (const std::string& warning :
         check_plausible(recording, spec, initial, truth.cable, lengths, model()))
      all += warning + "\n";
    return all;
  };
  CHECK(said(film, truth.initial) == "");
  Recording fast = film;
  for (double& time : fast.time) time /= 30;
  CHECK(said(fast, truth.initial).find("time_unit: the cable swings once in") == 0);
  Recording over = film;
  for (Eigen::Index p = 0; p < 7; ++p) over.measured.row(3 * p + 1) *= -1;
  CHECK(said(over, truth.initial).find("vertical: on average the cable points upwards") == 0);
  Recording moved = film;
  for (Eigen::Index p = 0; p < 7; ++p) moved.measured.row(3 * p + 2).array() += 2.0;
  const std::string message = failure([&] { said(moved, truth.initial); });
  CHECK_MESSAGE(message.find("origin: marker 1 is") != std::string::npos, message);
  CHECK_MESSAGE(message.find(", 2.") != std::string::npos, message);  // across, of the remedy
}

TEST_CASE("a cable that is held may sag and need not point down") {
  Case truth = held_at_both_ends();
  for (ParameterSpec& spec : truth.parameters)
    if (spec.name.starts_with("to_")) spec.value = spec.name == "to_side" ? 0.15 : -0.05;
  truth.initial.shape = Shape::kHanging;
  truth.initial.coefficients.clear();
  const Model held = Model::load(HELD_END_5);
  const Recording film = testing::with_truth(
      truth, held, testing::empty_markers({0.2, 0.8, 1.0}, 100, 0.03, true), 1e-3);
  const VectorXd lengths = VectorXd::Constant(5, 0.2);
  const auto warnings = [&](const Model& of) {
    return check_plausible(film, truth.experiments[0], truth.initial, truth.cable, lengths, of);
  };
  CHECK(warnings(held).empty());
  CHECK(warnings(model()).size() == 2);  // one that hangs freely can hardly look so
}

TEST_CASE("another number of links takes the azimuth of all links, not those of each") {
  Case the_case = three_links();
  the_case.initial.azimuths.assign(kLinks, 0.4);
  CHECK(case_for_links(the_case, 5).initial.azimuths == std::vector<double>(5, 0.4));
  the_case.initial.azimuths[1] = 0.5;
  const std::string message = failure([&] { case_for_links(the_case, 5); });
  CHECK_MESSAGE(message.find("initial: gives azimuths per link") != std::string::npos, message);
}
