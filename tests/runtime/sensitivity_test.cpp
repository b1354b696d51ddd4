// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/sensitivity.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "runtime/rest_states.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/driven_model.hpp"
#include "tests/runtime/simulation_input.hpp"

namespace {

using catena::Model;
using catena::SensitivityDirection;
using catena::SimulationOptions;
using catena::State;
using catena::testing::cable_parameters;
using catena::testing::even_times;
using catena::testing::with_tolerance;

/// Sensitivities against central differences of tighter simulations, relative to the largest value
/// of each: q, v, z.
void check_differences(const Model& model, const Eigen::VectorXd& p, const State& start,
                       const std::vector<SensitivityDirection>& directions,
                       const std::vector<double>& t, const catena::Signals& signals,
                       double tolerance) {
  const auto run = catena::simulate_with_sensitivities(model, p, start, directions, t,
                                                       with_tolerance(1e-9), signals);
  REQUIRE(run.status == catena::Status::kSuccess);
  REQUIRE(run.sensitivity.size() == directions.size());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    CAPTURE(k);
    const SensitivityDirection& direction = directions[k];
    // A step of 1e-4 of the parameter leaves 1e-8 of curvature; 1e-12 / 1e-4 of noise.
    const double size = direction.parameters.cwiseAbs().dot(p.cwiseAbs());
    const double h = 1e-4 * (size > 0.0 ? size : 1.0);
    const auto at = [&](double e) {
      const State moved{start.q + e * direction.q, start.v + e * direction.v,
                        start.z + e * direction.z};
      const auto result = catena::simulate(model, p + e * direction.parameters, moved, t,
                                           with_tolerance(1e-12), signals);
      REQUIRE(result.status == catena::Status::kSuccess);
      return result.trajectory;
    };
    const auto ahead = at(h), behind = at(-h);
    const auto check = [&](const Eigen::MatrixXd& plus, const Eigen::MatrixXd& minus,
                           const Eigen::MatrixXd& actual) {
      if (actual.size() == 0) return;
      const Eigen::MatrixXd expected = (plus - minus) / (2 * h);
      REQUIRE(expected.cwiseAbs().maxCoeff() > 0.0);
      CHECK((actual - expected).cwiseAbs().maxCoeff() < tolerance * expected.cwiseAbs().maxCoeff());
    };
    check(ahead.q, behind.q, run.sensitivity[k].q);
    check(ahead.v, behind.v, run.sensitivity[k].v);
    check(ahead.z, behind.z, run.sensitivity[k].z);
  }
}

TEST_CASE("sensitivities to every kind of parameter and to the initial state: 4 links") {
  const Model model = Model::built_in(4);
  const auto p = cable_parameters(model, 5.0, 0.05);
  const State start = catena::straight(model, 0.8);
  std::vector<SensitivityDirection> directions;
  for (const char* name : {"length_2", "mass_3", "inertia_1", "stiffness_1", "stiffness_4",
                           "damping_2", "torque_3", "load_mass", "gravity"})
    directions.push_back(SensitivityDirection::parameter(model, model.parameter_index(name)));
  SensitivityDirection initial = SensitivityDirection::zero(model);
  initial.q << 1.0, -0.5, 0.25, 0.7;
  directions.push_back(initial);
  initial.q.setZero();
  initial.v[3] = 1.0;
  directions.push_back(initial);
  // Steps are chosen for the state's error of 1e-9 a step; the sensitivities ride on them.
  check_differences(model, p, start, directions, even_times(1.0, 10), {}, 1e-5);
}

TEST_CASE("sensitivities with extra states and signals, by the dense solver") {
  const Model model(catena::testing::DrivenModel::table());
  const auto p = cable_parameters(model, 2.0, 0.05);
  State start = catena::straight(model, 0.4);
  start.z[0] = 0.7;
  catena::Signals signals;
  std::vector<double> t, torque;
  for (int i = 0; i <= 20; ++i) {
    t.push_back(0.05 * i);
    torque.push_back(3.0 * std::sin(8.0 * t.back()));
  }
  signals.add("drive.torque", t, torque);
  std::vector<SensitivityDirection> directions;
  for (const char* name : {"length_1", "stiffness_2", "load_mass"})
    directions.push_back(SensitivityDirection::parameter(model, model.parameter_index(name)));
  SensitivityDirection initial = SensitivityDirection::zero(model);
  initial.z[0] = 1.0;
  directions.push_back(initial);
  check_differences(model, p, start, directions, even_times(1.0, 10), signals, 1e-5);
}

TEST_CASE("sensitivities of 12 links through a release from a catenary") {
  const Model model = Model::built_in(12);
  const auto p = cable_parameters(model, 47.448, 0.5);
  const State start = catena::catenary(model, p, {1.5, 2.5});
  std::vector<SensitivityDirection> directions;
  directions.push_back(
      SensitivityDirection::parameter(model, model.parameter_index("stiffness_1")));
  SensitivityDirection common = SensitivityDirection::zero(model);  // damping_2..12 together
  common.parameters.segment(4 * 12 + 1, 11).setOnes();
  directions.push_back(common);
  check_differences(model, p, start, directions, even_times(1.0, 10), {}, 1e-4);
}

TEST_CASE("sensitivities leave the motion as it is, but for Newton's tolerance") {
  const Model model = Model::built_in(4);
  const auto p = cable_parameters(model, 5.0, 0.05);
  const State start = catena::straight(model, 0.8);
  const auto alone = catena::simulate(model, p, start, even_times(1.0, 10));
  const auto with = catena::simulate_with_sensitivities(
      model, p, start, {SensitivityDirection::parameter(model, 0)}, even_times(1.0, 10));
  CHECK(with.sensitivity[0].time == alone.trajectory.time);
  CHECK((with.trajectory.q - alone.trajectory.q).cwiseAbs().maxCoeff() < 1e-6);
  CHECK(with.statistics.steps < 1.2 * static_cast<double>(alone.statistics.steps));
}

TEST_CASE("in the error test, sensitivities are as good as smaller steps make them") {
  const Model model = Model::built_in(12);
  const auto p = cable_parameters(model, 47.448, 0.5);
  const State start = catena::catenary(model, p, {1.5, 2.5});
  // five, so that a batch is filled up with zeros
  std::vector<SensitivityDirection> directions;
  for (const char* name : {"stiffness_1", "stiffness_5", "damping_1", "mass_3"})
    directions.push_back(SensitivityDirection::parameter(model, model.parameter_index(name)));
  directions.push_back(SensitivityDirection::zero(model));
  directions.back().v[11] = 1.0;
  const auto run = [&](double tolerance, bool in_error_test) {
    SimulationOptions options = with_tolerance(tolerance);
    options.sensitivities_in_error_test = in_error_test;
    const auto result = catena::simulate_with_sensitivities(model, p, start, directions,
                                                            even_times(1.0, 20), options);
    REQUIRE(result.status == catena::Status::kSuccess);
    return result;
  };
  const auto reference = run(1e-11, true), without = run(1e-6, false), with = run(1e-6, true);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    CAPTURE(k);
    const Eigen::MatrixXd& expected = reference.sensitivity[k].q;
    const auto error = [&](const catena::SensitiveSimulation& result) {
      return (result.sensitivity[k].q - expected).norm() / expected.norm();
    };
    MESSAGE(error(without) << " without, " << error(with) << " with");
    CHECK(error(with) < 0.6 * error(without));
  }
  CHECK(with.statistics.steps > without.statistics.steps);
  CHECK(with.statistics.steps < 4 * without.statistics.steps);
}

TEST_CASE("sensitivities are linear in the direction") {
  const Model model = Model::built_in(3);
  const auto p = cable_parameters(model, 5.0, 0.05);
  const State start = catena::straight(model, 0.8);
  const SensitivityDirection first = SensitivityDirection::parameter(model, 1),
                             second = SensitivityDirection::parameter(model, 9);
  SensitivityDirection both = first;
  both.parameters = 2.0 * first.parameters - 3.0 * second.parameters;
  const auto run = catena::simulate_with_sensitivities(model, p, start, {first, second, both},
                                                       even_times(1.0, 10));
  const Eigen::MatrixXd expected = 2.0 * run.sensitivity[0].q - 3.0 * run.sensitivity[1].q;
  // The same linear recursion with the same factors: rounding, a thousand steps of it.
  CHECK((run.sensitivity[2].q - expected).cwiseAbs().maxCoeff() <
        1e-10 * expected.cwiseAbs().maxCoeff());
}

TEST_CASE("a run that fails keeps as much of the sensitivities as of the motion") {
  const Model model = Model::built_in(2);
  const auto p = cable_parameters(model, 5.0, 0.05);
  SimulationOptions options;
  options.keep_going = [](double t) { return t < 0.45; };
  const auto run = catena::simulate_with_sensitivities(model, p, catena::straight(model, 0.8),
                                                       {SensitivityDirection::parameter(model, 0)},
                                                       even_times(1.0, 10), options);
  CHECK(run.status == catena::Status::kInterrupted);
  CHECK(run.sensitivity[0].q.cols() == run.trajectory.q.cols());
  CHECK(run.sensitivity[0].time == run.trajectory.time);
}

TEST_CASE("directions of the wrong size are refused") {
  const Model model = Model::built_in(2);
  const auto p = cable_parameters(model, 5.0, 0.05);
  SensitivityDirection direction = SensitivityDirection::zero(model);
  direction.parameters.conservativeResize(3);
  CHECK_THROWS_AS(
      catena::simulate_with_sensitivities(model, p, State::zero(model), {direction}, {0.0, 1.0}),
      std::invalid_argument);
}

}  // namespace
