// SPDX-License-Identifier: BSD-3-Clause
//
// Cameras that look at a cable in space: what they see, what follows from their pictures, fits.
#include "identify/problem/camera.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "identify/fit/error.hpp"
#include "identify/fit/fit.hpp"
#include "identify/least_squares/least_squares.hpp"
#include "identify/problem/motion.hpp"
#include "identify/problem/plausibility.hpp"
#include "identify/uncertainty/uncertainty.hpp"
#include "tests/identify/problem/prediction_difference.hpp"
#include "tests/identify/recordings.hpp"
#include "tests/support/failure.hpp"
#include "tests/support/near.hpp"

using namespace catena;
using Eigen::Index;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr int kLinks = 3;
constexpr double kMetresPerPixel = 0.003;  // about that of 1000 px at 3 m
constexpr std::array<const char*, 8> kOfCamera = {"side", "down", "across",       "pan",
                                                  "tilt", "roll", "focal_length", "lens"};
// The left camera stands before the cable, the right one beside it.
constexpr std::array<double, 8> kLeft = {-0.2, 0.4, -3, 0.05, 0.02, -0.03, 1000, -0.12};
constexpr std::array<double, 8> kRight = {-2.5, 0.1, -1.5, 1.0, 0.15, 0.04, 900, 0.05};

Model model() { return Model::load(SPATIAL_3); }

void add_camera(Case& the_case, const std::string& name, const std::array<double, 8>& values) {
  CameraSpec camera;
  camera.name = name;
  camera.where = "case.toml:7";
  the_case.cameras.push_back(camera);
  for (std::size_t i = 0; i < values.size(); ++i) {
    ParameterSpec parameter;
    parameter.name = name + "_" + kOfCamera[i];
    parameter.sets = name + "." + kOfCamera[i];
    parameter.value = values[i];
    parameter.where = "case.toml:9";
    the_case.parameters.push_back(parameter);
  }
}

ParameterSpec& parameter(Case& the_case, const std::string& name) {
  for (ParameterSpec& each : the_case.parameters)
    if (each.name == name) return each;
  throw std::logic_error(name);
}

/// Three links that swing out of every plane, seen by these cameras.
Case filmed_by(const std::vector<std::string>& cameras) {
  Case the_case = testing::sections(testing::kTwoLinks);
  the_case.links = kLinks;
  the_case.parameters[0].value = 0.1;
  the_case.parameters[1].value = 0.005;
  the_case.initial = {};
  the_case.initial.shape = the_case.initial.velocity_shape = Shape::kAngles;
  the_case.initial.coefficients = {0.3, -0.2, 0.7};
  the_case.initial.out_of_plane = {0.2, 0.4, -0.3};
  the_case.initial.azimuths = {0.5, 0.5, 0.5};
  the_case.initial.at_rest = false;
  the_case.initial.velocity_coefficients = {0.5, -0.8, 1.0};
  the_case.initial.out_of_plane_rates = {-0.4, 0.9, 0.6};
  testing::add_experiment(the_case, "run");
  the_case.experiments[0].length_unit = "px";
  the_case.experiments[0].metres_per_pixel = kMetresPerPixel;
  for (const std::string& camera : cameras)
    add_camera(the_case, camera, camera == "left" ? kLeft : kRight);
  the_case.optimiser.method = FitMethod::kLeastSquares;
  the_case.error.measure = Measure::kLeastSquares;
  return the_case;
}

/// Seven markers in the pictures of these cameras.
Recording film(const std::vector<std::string>& cameras, int frames, double step) {
  Recording recording;
  const Recording one =
      testing::empty_markers({0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0}, frames, step);
  recording.time = one.time;
  for (const std::string& camera : cameras)
    for (PointSpec point : one.points) {
      const int index = static_cast<int>(recording.points.size());
      point.camera = camera;
      recording.points.push_back(point);
      recording.channels.push_back({index, Component::kSide, camera + " side"});
      recording.channels.push_back({index, Component::kDown, camera + " down"});
    }
  recording.measured.setZero(static_cast<Index>(recording.channels.size()), frames);
  recording.fit_frames = frames;
  return recording;
}

/// The array of a model with one camera.
VectorXd array_of(const Model& model, const std::array<double, 8>& values) {
  VectorXd parameters = model.default_parameters();
  parameters.tail<8>() = Eigen::Map<const Eigen::Vector<double, 8>>(values.data());
  return parameters;
}

}  // namespace

TEST_CASE("what a camera sees is what closed forms say") {
  const Model with = with_cameras(filmed_by({"left"}), model());
  const Camera camera(with, "left");
  // Not turned: similar triangles.
  const VectorXd straight = array_of(with, {0.5, 0.25, -3, 0, 0, 0, 1000, 0});
  const Vector2d seen = camera.picture(straight, {0.8, 0.75, 1});
  CHECK(seen[0] == catena::near(1000 * 0.3 / 4, 1e-14));
  CHECK(seen[1] == catena::near(1000 * 0.5 / 4, 1e-14));
  // Behind it nothing is seen.
  CHECK(camera.picture(straight, {0.8, 0.75, -3.1}).hasNaN());
  // A barrel of k1 = -1/3 shows nothing farther from the axis than 1 at 1 ahead.
  const VectorXd barrel = array_of(with, {0, 0, 0, 0, 0, 0, 900, -1.0 / 3});
  CHECK(camera.picture(barrel, {0.99, 0, 1})[0] ==
        catena::near(900 * (0.99 - 0.99 * 0.99 * 0.99 / 3), 1e-14));
  CHECK(camera.picture(barrel, {1.01, 0, 1}).hasNaN());
  CHECK(camera.ray(barrel, {650, 0}).isApprox(Vector3d(1, 0, 1).normalized()));  // beyond: its edge

  // Turned: rotations of its three axes, one after the other.
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<double, 8> values;
    for (double& value : values) value = uniform(generator);
    values[6] = 800;
    values[7] *= 0.1;
    const VectorXd parameters = array_of(with, values);
    Vector3d right = Vector3d::UnitX(), below = Vector3d::UnitY(), axis = Vector3d::UnitZ();
    const auto turn = [](double angle, Vector3d& from, Vector3d& towards) {
      const Vector3d turned = std::cos(angle) * from + std::sin(angle) * towards;
      towards = std::cos(angle) * towards - std::sin(angle) * from;
      from = turned;
    };
    turn(values[3], axis, right);
    turn(values[4], axis, below);
    turn(values[5], right, below);
    const Vector3d place(values[0], values[1], values[2]);
    const double ahead = 2.5, to_right = uniform(generator), downwards = uniform(generator);
    const Vector3d point = place + ahead * (axis + to_right * right + downwards * below);
    const double bent = 1 + values[7] * (to_right * to_right + downwards * downwards);
    const Vector2d expected = 800 * bent * Vector2d(to_right, downwards);
    CHECK((camera.picture(parameters, point) - expected).norm() < 1e-9);
    CHECK((camera.ray(parameters, expected) - (point - place).normalized()).norm() < 1e-14);
    CHECK((camera.place(parameters) - place).norm() == 0);
    // It looks where pan and tilt say.
    const Vector3d looks(std::sin(values[3]) * std::cos(values[4]), std::sin(values[4]),
                         std::cos(values[3]) * std::cos(values[4]));
    CHECK(camera.picture(parameters, place + 2 * looks).norm() < 1e-9);
  }
}

TEST_CASE("the model with cameras has their parameters and keeps its own") {
  const Case the_case = filmed_by({"left", "right"});
  const Model plain = model(), with = with_cameras(the_case, plain);
  REQUIRE(with.parameters() == plain.parameters() + 16);
  CHECK(with.parameter_index("right.lens") == with.parameters() - 1);
  CHECK(with.parameter_index("load_mass") == plain.parameter_index("load_mass"));
  CHECK(with_cameras(the_case, with).parameters() == with.parameters());
  CHECK(&with_cameras(testing::sections(testing::kTwoLinks), plain).table() == &plain.table());

  const auto refused = [](const Case& wrong, const Model& of, const std::string& said) {
    const std::string message = failure([&] { with_cameras(wrong, of); });
    CHECK_MESSAGE(message.find(said) == 0, message);
  };
  refused(
      the_case, Model::built_in(3),
      "case.toml:7: camera \"left\": the model moves in the plane, whose pictures need no camera");
  Case named = filmed_by({});
  add_camera(named, "holds_end", kLeft);
  refused(named, Model::load(HELD_END_5),
          "case.toml:7: camera \"holds_end\": an effect of the model has this name");
  // What is not known of a camera, and what cannot be, is said of the parameter.
  const auto of_problem = [](Case wrong) {
    return failure(
        [&] { const Problem problem(std::move(wrong), model(), {film({"left"}, 2, 0.1)}); });
  };
  Case unknown = filmed_by({"left"});
  std::erase_if(unknown.parameters,
                [](const ParameterSpec& each) { return each.sets == "left.focal_length"; });
  CHECK(of_problem(unknown).find("the model's left.focal_length (1) has no value; add a "
                                 "[[parameter]] that sets it") != std::string::npos);
  Case impossible = filmed_by({"left"});
  parameter(impossible, "left_focal_length").value = -1000;
  CHECK(
      of_problem(impossible) ==
      "case.toml:9: parameter \"left_focal_length\": sets left.focal_length to -1000; it must lie "
      "within 1 and 1e+06");
}

TEST_CASE("positions follow from pictures") {
  const Case the_case = filmed_by({"left", "right"});
  const Model with = with_cameras(the_case, model());
  const Problem problem(the_case, model(), {film({"left", "right"}, 3, 0.1)});
  const VectorXd parameters = problem.model_parameters(problem.start(), 0);
  Recording pictures = film({"left", "right"}, 3, 0.1);
  pictures.measured = problem.predict(problem.start(), 0, true).simulated;
  // What was seen, by the same motion seen in space.
  Case in_space = filmed_by({});
  in_space.experiments[0].length_unit = "m";
  const Problem truth(
      in_space, model(),
      {testing::empty_markers({0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0}, 3, 0.1, true)});
  const Eigen::MatrixXd expected = truth.predict(truth.start(), 0, true).simulated;
  const Recording found = positions_from_pictures(pictures, with, parameters, kMetresPerPixel);
  REQUIRE(found.components() == 3);
  CHECK(found.channels[5].component == Component::kAcross);
  REQUIRE(found.measured.rows() == expected.rows());
  CHECK((found.measured - expected).cwiseAbs().maxCoeff() < 1e-7);
  CHECK(expected.row(20).norm() > 0.1);  // it is out of the plane

  // One camera sees the direction; where none does, there is no position.
  pictures.measured.middleRows(14 + 2 * 6, 2).col(1).setConstant(NAN);
  pictures.measured.row(3).col(2).setConstant(NAN);
  pictures.measured.row(14 + 2).col(2).setConstant(NAN);
  const Recording fewer = positions_from_pictures(pictures, with, parameters, kMetresPerPixel);
  const Vector3d alone = fewer.measured.block<3, 1>(18, 1);
  CHECK(std::abs(alone[2]) < 1e-5);
  const Camera left(with, "left");
  CHECK((left.picture(parameters, alone) - left.picture(parameters, expected.block<3, 1>(18, 1)))
            .norm() < 1e-3);
  CHECK(fewer.measured.block<3, 1>(3, 2).array().isNaN().all());
  CHECK((fewer.measured.col(0) - expected.col(0)).cwiseAbs().maxCoeff() < 1e-7);

  // They are held against the cable; a pose may be wrong, so what no cable can do is a warning.
  const Recording longer =
      testing::with_truth(the_case, model(), film({"left", "right"}, 60, 0.03));
  const auto said_with = [&](const VectorXd& wrong) {
    const VectorXd lengths = VectorXd::Constant(kLinks, 1.0 / kLinks);
    std::string all;
    for (const std::string& warning :
         check_plausible(positions_from_pictures(longer, with, wrong, kMetresPerPixel),
                         the_case.experiments[0], the_case.initial, the_case.cable, lengths, with))
      all += warning + "\n";
    return all;
  };
  const auto said = [&](std::initializer_list<const char*> names, double more) {
    VectorXd wrong = parameters;
    for (const char* name : names) wrong[with.parameter_index(name)] += more;
    return said_with(wrong);
  };
  CHECK(said({}, 0) == "");
  CHECK(said({"left.focal_length"}, 4000).find("camera: ") == 0);
  // Both cameras stand elsewhere, and the support with them: a case with pictures has no `origin`.
  const std::string beside = said({"left.side", "right.side"}, 0.35);
  CHECK_MESSAGE(beside.find("camera: marker 1 is 0.") == 0, beside);
  CHECK_MESSAGE(beside.find("m from the support, but only 0.15 m along the cable; are the ") !=
                    std::string::npos,
                beside);
  const std::string above = said({"left.down", "right.down"}, -0.1);
  CHECK_MESSAGE(above.find("camera: marker 1 is only 0.") == 0, above);
  CHECK(beside.find("origin") == std::string::npos);
  CHECK(above.find("origin") == std::string::npos);
}

TEST_CASE("a cable behind a camera is a failure that says where to look") {
  Case the_case = filmed_by({"left"});
  parameter(the_case, "left_across").value = 3;
  const Problem problem(the_case, model(), {film({"left"}, 3, 0.1)});
  const Prediction prediction = problem.predict(problem.start(), 0, true);
  CHECK(prediction.status == Status::kNotFinite);
  CHECK_MESSAGE(prediction.message.find("look at the places and directions") != std::string::npos,
                prediction.message);
}

TEST_CASE("derivatives of what cameras see are differences") {
  Case the_case = filmed_by({"left", "right"});
  for (ParameterSpec& each : the_case.parameters) each.free = true;
  the_case.initial.free = the_case.initial.velocity_free = true;
  the_case.simulation.relative_tolerance = 1e-11;
  the_case.simulation.absolute_tolerance_position = 1e-12;
  the_case.simulation.absolute_tolerance_velocity = 1e-11;
  const Problem problem(the_case, model(), {film({"left", "right"}, 4, 0.1)});
  const VectorXd x = problem.start();
  REQUIRE(x.size() == 2 + 16 + 4 * kLinks);
  const Prediction here = problem.predict(x, 0, true, problem.directions(x, 0));
  REQUIRE_MESSAGE(here.ok(), here.message);
  for (Index j = 0; j < x.size(); ++j) {
    const Unknown& unknown = problem.unknowns()[static_cast<std::size_t>(j)];
    CAPTURE(unknown.name);
    const Eigen::MatrixXd difference = testing::difference_along(problem, x, j);
    const Eigen::MatrixXd& found = here.sensitivity[static_cast<std::size_t>(j)];
    CHECK(difference.norm() > 1e-4);
    CHECK((found - difference).norm() < 1e-5 * (1e-3 + difference.norm()));
  }
}

namespace {

/// What sensors get wrong, beside unknown stiffness, damping and start.
Case sensed(const std::vector<std::string>& cameras) {
  Case the_case = filmed_by(cameras);
  for (const auto& [sets, value] : {std::pair("clock_offset.offset", 0.03),
                                    {"frame_offset.side_shift", 0.02},
                                    {"frame_offset.across_shift", -0.03},
                                    {"frame_tilt.side_tilt", 0.05},
                                    {"frame_tilt.across_tilt", -0.04},
                                    {"frame_turn.turn", 0.2},
                                    {"scale.factor", 1.03}}) {
    ParameterSpec spec;
    spec.name = spec.sets = sets;
    spec.value = value;
    the_case.parameters.push_back(spec);
  }
  for (ParameterSpec& each : the_case.parameters) each.free = true;
  the_case.initial.free = the_case.initial.velocity_free = true;
  the_case.simulation.relative_tolerance = 1e-11;
  the_case.simulation.absolute_tolerance_position = 1e-12;
  the_case.simulation.absolute_tolerance_velocity = 1e-11;
  return the_case;
}

/// The rotation that the values of sensed() stand for: plumb axes to those of the recording.
Eigen::Matrix3d turn_of_sensed() {
  using Eigen::AngleAxisd;
  return (AngleAxisd(-0.2, Vector3d::UnitY()) * AngleAxisd(-0.04, Vector3d::UnitX()) *
          AngleAxisd(-0.05, Vector3d::UnitZ()))
      .toRotationMatrix();
}

}  // namespace

TEST_CASE("sensors report positions, cameras take pictures of what they report") {
  const Model sensing = Model::load(SENSING_3);
  Recording markers = testing::empty_markers({0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0}, 4, 0.1, true);
  const Problem positions(sensed({}), sensing, {markers});
  const Problem pictures(sensed({"left", "right"}), sensing, {film({"left", "right"}, 4, 0.1)});

  // The same by hand: the plain chain at the other clock, and the sensors in their order.
  Case plain = filmed_by({});
  plain.simulation = positions.the_case().simulation;
  for (double& t : markers.time) t += 0.03;
  plain.experiments[0].start = 0;
  const Problem truth(plain, model(), {markers});
  const Prediction moved = truth.predict(truth.start(), 0, true);
  REQUIRE_MESSAGE(moved.ok(), moved.message);
  const Prediction reported = positions.predict(positions.start(), 0, true);
  REQUIRE_MESSAGE(reported.ok(), reported.message);
  for (Index k = 1; k < 4; ++k)
    for (Index m = 0; m < 7; ++m) {
      const Vector3d at = moved.simulated.col(k).segment<3>(3 * m);
      const Vector3d expected = 1.03 * (turn_of_sensed() * (at + Vector3d(0.02, 0, -0.03)));
      CAPTURE(k);
      CAPTURE(m);
      CHECK((reported.simulated.col(k).segment<3>(3 * m) - expected).norm() < 1e-8);
    }

  const SeenChain chain =
      seen_chain(positions, positions.start(), 0);  // its load is the last marker
  const Eigen::MatrixXd load = reported.simulated.bottomRows(3);
  CHECK((chain.side.bottomRows(1) - load.row(0)).norm() < 1e-9);
  CHECK((chain.down.bottomRows(1) - load.row(1)).norm() < 1e-9);
  CHECK((chain.across.bottomRows(1) - load.row(2)).norm() < 1e-9);

  const Prediction seen = pictures.predict(pictures.start(), 0, true);
  REQUIRE_MESSAGE(seen.ok(), seen.message);
  const Camera left(pictures.model(), "left");
  const Vector2d picture =
      kMetresPerPixel * left.picture(pictures.model_parameters(pictures.start(), 0),
                                     reported.simulated.col(3).segment<3>(9));
  CHECK((seen.simulated.col(3).segment<2>(6) - picture).norm() < 1e-12);

  for (const Problem* problem : {&positions, &pictures}) {
    const VectorXd x = problem->start();
    const Prediction here = problem->predict(x, 0, true, problem->directions(x, 0));
    REQUIRE_MESSAGE(here.ok(), here.message);
    for (Index j = 0; j < x.size(); ++j) {
      CAPTURE(problem->unknowns()[static_cast<std::size_t>(j)].name);
      const Eigen::MatrixXd difference = testing::difference_along(*problem, x, j);
      const Eigen::MatrixXd& found = here.sensitivity[static_cast<std::size_t>(j)];
      CHECK(difference.norm() > 1e-4);
      CHECK((found - difference).norm() < 1e-5 * (1e-3 + difference.norm()));
    }
  }
}

namespace {

/// Fits the case to the truth's pictures with noise of 0.3 px, where some are not seen.
struct Fitted {
  FitResult result;
  Uncertainty uncertainty;
  std::vector<Gap> gaps;
  const Problem problem;
};

Fitted fitted(const Case& truth, Case the_case, const std::vector<std::string>& cameras) {
  Recording recording =
      testing::with_truth(truth, model(), film(cameras, 60, 0.03), 0.3 * kMetresPerPixel);
  recording.measured.block(2, 10, 2, 5).setConstant(NAN);
  recording.measured.row(recording.measured.rows() - 1).head(3).setConstant(NAN);
  recording.fit_frames = 45;
  the_case.initial.coefficients.clear();  // found from the first frames
  the_case.initial.out_of_plane.clear();
  the_case.initial.azimuths.clear();
  the_case.initial.velocity_coefficients.clear();
  the_case.initial.out_of_plane_rates.clear();
  the_case.initial.free = the_case.initial.velocity_free = true;
  const Problem problem(the_case, model(), {recording});
  const FitResult result = fit(problem, {}, fit_least_squares);
  return {result, uncertainty_of(problem, result.x),
          gaps_of(problem, evaluate(problem, result.x, true, false)), problem};
}

/// Every unknown with a true value: within the interval, to so many of its standard errors.
void check_found(const Fitted& found, Case truth) {
  CHECK(found.result.status == FitStatus::kConverged);
  for (const Gap& gap : found.gaps)  // fitted and held out
    CHECK(gap.rms == catena::near(0.3 * kMetresPerPixel, 0.1));
  for (std::size_t j = 0; j < found.problem.unknowns().size(); ++j) {
    const Unknown& unknown = found.problem.unknowns()[j];
    if (unknown.parameter < 0) continue;
    const double expected = parameter(truth, unknown.name).value;
    const Estimate& estimate = found.uncertainty.estimates[j];
    const double value = found.result.x[static_cast<Index>(j)];
    CAPTURE(unknown.name);
    CAPTURE(value);
    CAPTURE(expected);
    CAPTURE(estimate.standard_error);
    CHECK(estimate.verdict == Verdict::kIdentifiable);
    CHECK(std::abs(value - expected) < 3.5 * estimate.standard_error);
  }
}

}  // namespace

TEST_CASE("stiffness, damping and the pose of a camera are found from the pictures of two") {
  const Case truth = filmed_by({"left", "right"});
  Case the_case = truth;
  the_case.parameters[0].value = 0.05;
  the_case.parameters[1].value = 0.002;
  // About 0.2 m, 4 degrees and a tenth of the focal length off.
  const std::array<double, 8> off = {0.2, -0.2, 0.2, 0.07, -0.07, 0.07, 90, 0};
  for (std::size_t i = 0; i < kOfCamera.size(); ++i) {
    ParameterSpec& each = parameter(the_case, std::string("right_") + kOfCamera[i]);
    each.value += off[i];
    each.free = off[i] != 0;
  }
  parameter(the_case, "left_focal_length").free = true;
  parameter(the_case, "left_focal_length").value = 1040;
  check_found(fitted(truth, the_case, {"left", "right"}), truth);
}

TEST_CASE("what lenses bend is found, with a doubt about each that the case states") {
  const Case truth = filmed_by({"left", "right"});
  Case the_case = truth;
  the_case.parameters[0].value = 0.05;
  the_case.experiments[0].noise = 0.3 * kMetresPerPixel;
  for (const char* lens : {"left_lens", "right_lens"}) {
    ParameterSpec& each = parameter(the_case, lens);
    each.value = each.measured = 0;
    each.standard_deviation = 0.1;
    each.free = true;
  }
  const Fitted found = fitted(truth, the_case, {"left", "right"});
  check_found(found, truth);
  // The case gives the lenses no bounds. No step goes beyond the model's: there nothing is seen.
  CHECK(found.result.failures == 0);
}

TEST_CASE("one camera whose pose is known is enough for stiffness and damping") {
  const Case truth = filmed_by({"left"});
  Case the_case = truth;
  the_case.parameters[0].value = 0.05;
  the_case.parameters[1].value = 0.002;
  check_found(fitted(truth, the_case, {"left"}), truth);
}

TEST_CASE("no picture tells how cameras and cable are turned together about the vertical") {
  Case the_case = filmed_by({"left"});
  the_case.initial.free = the_case.initial.velocity_free = true;
  const auto undetermined = [&] {
    const Recording recording = testing::with_truth(the_case, model(), film({"left"}, 40, 0.03));
    const Problem problem(the_case, model(), {recording});
    std::vector<std::string> names;
    const Uncertainty uncertainty = uncertainty_of(problem, problem.start());
    for (std::size_t j = 0; j < uncertainty.estimates.size(); ++j)
      if (uncertainty.estimates[j].verdict == Verdict::kStructurallyNot)
        names.push_back(problem.unknowns()[j].name);
    return names;
  };
  CHECK(undetermined().empty());
  for (const char* name : {"left_side", "left_across", "left_pan"})
    parameter(the_case, name).free = true;
  const std::vector<std::string> names = undetermined();
  CHECK(std::find(names.begin(), names.end(), "left_pan") != names.end());
}
