// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/simulation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "runtime/rest_states.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/driven_model.hpp"
#include "tests/runtime/reference_model.hpp"
#include "tests/runtime/simulation_input.hpp"
#include "tests/support/near.hpp"

namespace {

using catena::LinearSolver;
using catena::Model;
using catena::SimulationOptions;
using catena::State;
using catena::Status;
using catena::testing::cable_parameters;
using catena::testing::even_times;
using catena::testing::reference_model;

double largest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  REQUIRE(a.rows() == b.rows());
  REQUIRE(a.cols() == b.cols());
  return (a - b).cwiseAbs().maxCoeff();
}

TEST_CASE("one rigid link swings with the period of the physical pendulum") {
  const Model model(reference_model<1>());
  Eigen::VectorXd p = model.default_parameters();
  const double length = 0.8, mass = 0.5, inertia = 0.02, load = 0.3, amplitude = 2.0;
  p << length, mass, inertia, 0.0, 0.0, 0.0, load, 9.81;
  // Period 4 K(sin(amplitude / 2)) / omega, omega^2 = (m / 2 + m_c) l g / (m l^2 / 4 + m_c l^2 + I)
  const double omega = std::sqrt((mass / 2 + load) * length * 9.81 /
                                 ((mass / 4 + load) * length * length + inertia));
  const double period = 4.0 * std::comp_ellint_1(std::sin(amplitude / 2)) / omega;
  const auto run = catena::simulate(model, p, catena::straight(model, amplitude),
                                    {0.0, period / 4, period / 2, period});
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.message.empty());
  // Some hundred steps, each wrong by about 1e-8 of the amplitude.
  CHECK(run.trajectory.q(0, 1) == doctest::Approx(0.0).epsilon(2e-6));
  CHECK(run.trajectory.q(0, 2) == catena::near(-amplitude, 2e-6));
  CHECK(run.trajectory.q(0, 3) == catena::near(amplitude, 2e-6));
}

TEST_CASE("many simulations on several threads have the bits of one at a time") {
  const Model model = Model::built_in(12);
  std::vector<Eigen::VectorXd> parameters;
  std::vector<State> initial;
  for (int i = 0; i < 7; ++i) {
    parameters.push_back(cable_parameters(model, 20.0 + 5 * i, 0.01 * (i + 1)));
    initial.push_back(catena::straight(model, 0.1 * (i + 1)));
  }
  const auto together = catena::simulate_batch(model, parameters, initial, even_times(0.2, 5), 3,
                                               SimulationOptions{});
  REQUIRE(together.size() == 7);
  for (std::size_t i = 0; i < 7; ++i) {
    const auto alone = catena::simulate(model, parameters[i], initial[i], even_times(0.2, 5));
    REQUIRE(alone.status == Status::kSuccess);
    REQUIRE(together[i].status == Status::kSuccess);
    CHECK(together[i].statistics.steps == alone.statistics.steps);
    CHECK(largest_difference(together[i].trajectory.q, alone.trajectory.q) == 0.0);
    CHECK(largest_difference(together[i].trajectory.v, alone.trajectory.v) == 0.0);
    CHECK(together[i].energy_imbalance == alone.energy_imbalance);
  }
  CHECK(catena::simulate_batch(model, {}, {}, even_times(0.2, 5), 3).empty());
  CHECK_THROWS_WITH_AS(catena::simulate_batch(model, parameters, {}, even_times(0.2, 5), 3),
                       "7 parameter sets, but 0 initial states; give as many of both",
                       std::invalid_argument);
  parameters[4][0] = std::nan("");
  std::string message;
  try {
    catena::simulate_batch(model, parameters, initial, even_times(0.2, 5), 3);
  } catch (const std::invalid_argument& error) {
    message = error.what();
  }
  CHECK(message.starts_with("set 5: "));
}

TEST_CASE("both linear solvers give the same motion, and statistics say which was used") {
  const Model model(reference_model<4>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  const State start = catena::catenary(model, p, {1.5, 2.5});
  SimulationOptions options;
  const auto automatic = catena::simulate(model, p, start, even_times(1.0, 20), options);
  options.linear_solver = LinearSolver::kDense;
  const auto dense = catena::simulate(model, p, start, even_times(1.0, 20), options);
  const auto unstructured =
      catena::simulate(Model(reference_model<4>(false)), p, start, even_times(1.0, 20));
  for (const auto* run : {&automatic, &dense, &unstructured})
    REQUIRE(run->status == Status::kSuccess);
  CHECK(automatic.statistics.used == LinearSolver::kStructured);
  CHECK(dense.statistics.used == LinearSolver::kDense);
  CHECK(unstructured.statistics.used == LinearSolver::kDense);
  CHECK(automatic.statistics.steps > 10);
  CHECK(automatic.statistics.residual_evaluations >= automatic.statistics.steps);
  CHECK(automatic.statistics.jacobian_evaluations > 0);
  CHECK(automatic.statistics.jacobian_evaluations < automatic.statistics.steps);
  CHECK(automatic.statistics.cpu_seconds > 0.0);
  // Both end Newton's iteration at a tenth of the step's error of about 1e-8.
  CHECK(largest_difference(automatic.trajectory.q, dense.trajectory.q) < 1e-5);
  CHECK(largest_difference(dense.trajectory.q, unstructured.trajectory.q) == 0.0);
}

TEST_CASE(
    "energy: what is stored, dissipated and supplied balances, better at tighter tolerances") {
  const Model model(reference_model<4>());
  auto p = cable_parameters(model, 5.0, 0.05);
  p[5 * 4 + 3] = 2.0;  // torque_4 supplies
  const State start = catena::catenary(model, p, {1.5, 2.5});
  double before = 0.0;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    CAPTURE(tolerance);
    SimulationOptions options;
    options.relative_tolerance = tolerance;
    options.absolute_tolerance_position = 1e-2 * tolerance;
    options.absolute_tolerance_velocity = 1e-1 * tolerance;
    const auto run = catena::simulate(model, p, start, even_times(2.0, 40), options);
    REQUIRE(run.status == Status::kSuccess);
    const auto& energy = run.trajectory.energy;
    REQUIRE(energy.rows() == 5);
    CHECK(energy.row(3).tail(1)[0] > 0.1);  // joint_damping has dissipated, J
    CHECK((energy.row(3).tail(40) - energy.row(3).head(40)).minCoeff() >= 0.0);
    // The torque's work is torque times turn, whatever the path.
    const double turn = run.trajectory.q(3, 40) - run.trajectory.q(3, 0);
    CHECK(energy(4, 40) == catena::near(2.0 * turn, 1e3 * tolerance));
    // Energies of some 30 J; the error per step adds up over some thousand steps.
    CHECK(run.energy_imbalance < 3e4 * tolerance);
    CHECK(run.energy_imbalance > 0.0);
    if (before > 0.0) CHECK(run.energy_imbalance < before);
    before = run.energy_imbalance;
  }
}

TEST_CASE("energies can be left out") {
  const Model model(reference_model<2>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  SimulationOptions options;
  options.energy = false;
  const auto run =
      catena::simulate(model, p, catena::straight(model, 0.3), even_times(0.5, 5), options);
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.trajectory.energy.size() == 0);
  CHECK(std::isnan(run.energy_imbalance));
}

/// Classical Runge-Kutta with fixed steps on the table's own accelerations: no line shared with the
/// integrator under test.
State runge_kutta(const catena_model& table, const Eigen::VectorXd& p, const State& start,
                  const catena::Signals& signals, double last, int steps) {
  const int n = table.coordinates, size = 2 * n + table.states;
  Eigen::VectorXd y(size);
  y << start.q, start.v, start.z;
  std::vector<double> u(static_cast<std::size_t>(3 * table.signals));
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(n);
  const auto rate = [&](double t, const Eigen::VectorXd& at_y) {
    signals.evaluate(t, u.data());
    const catena_point at{t,        at_y.data(), at_y.data() + n, zero.data(), at_y.data() + 2 * n,
                          u.data(), p.data()};
    Eigen::VectorXd result(size);
    result.head(n) = at_y.segment(n, n);
    REQUIRE(table.acceleration(table.context, &at, result.data() + n) == 0);
    if (table.states > 0) table.state_rate(table.context, &at, result.data() + 2 * n);
    return result;
  };
  const double h = last / steps;
  for (int i = 0; i < steps; ++i) {
    const double t = i * h;
    const Eigen::VectorXd k1 = rate(t, y), k2 = rate(t + h / 2, y + h / 2 * k1),
                          k3 = rate(t + h / 2, y + h / 2 * k2), k4 = rate(t + h, y + h * k3);
    y += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return {y.head(n), y.segment(n, n), y.tail(table.states)};
}

TEST_CASE("extra states and signals: the same as Runge-Kutta with small steps") {
  const Model model(catena::testing::DrivenModel::table());
  const auto p = cable_parameters(model, 2.0, 0.05);
  catena::Signals signals;
  std::vector<double> t, torque;
  for (int i = 0; i <= 20; ++i) {
    t.push_back(0.05 * i);
    torque.push_back(3.0 * std::sin(8.0 * t.back()));
  }
  signals.add("drive.torque", t, torque);
  State start = catena::straight(model, 0.4);
  start.z[0] = 0.7;
  const auto run = catena::simulate(model, p, start, {0.0, 0.35, 1.0}, {}, signals);
  REQUIRE(run.status == Status::kSuccess);
  CHECK(run.statistics.used == LinearSolver::kDense);
  const State expected = runge_kutta(model.table(), p, start, signals, 1.0, 20000);
  // Some hundred steps of relative error 1e-8 in values of order one to ten.
  CHECK(largest_difference(run.trajectory.q.col(2), expected.q) < 1e-5);
  CHECK(largest_difference(run.trajectory.v.col(2), expected.v) < 1e-4);
  CHECK(largest_difference(run.trajectory.z.col(2), expected.z) < 1e-5);
}

TEST_CASE("the same arguments give the same bits") {
  const Model model(reference_model<4>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  const State start = catena::catenary(model, p, {1.5, 2.5});
  const auto first = catena::simulate(model, p, start, even_times(0.5, 10));
  const auto second = catena::simulate(model, p, start, even_times(0.5, 10));
  CHECK(first.trajectory.q == second.trajectory.q);
  CHECK(first.energy_imbalance == second.energy_imbalance);
}

TEST_CASE("output times do not change the steps") {
  const Model model(reference_model<2>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  const auto few = catena::simulate(model, p, catena::straight(model, 1.0), even_times(1.0, 1));
  const auto many = catena::simulate(model, p, catena::straight(model, 1.0), even_times(1.0, 1000));
  CHECK(few.statistics.steps == many.statistics.steps);
  CHECK(few.trajectory.q.col(1) == many.trajectory.q.col(1000));
}

// What follows breaks the reference model in one way each.

catena_model broken;

const catena_model* two_links() { return reference_model<2>(); }

struct Failure {
  const char* what;
  void (*prepare)();
  Status status;
  const char* in_message;
};

void prepare_not_finite() {
  broken.residual = [](const void*, const catena_point* at, double* r) {
    two_links()->residual(two_links()->context, at, r);
    if (at->t > 0.5) r[1] = std::nan("");
  };
}

void prepare_overflow() {
  broken.residual = [](const void*, const catena_point* at, double* r) {
    two_links()->residual(two_links()->context, at, r);
    if (at->t > 0.5) r[1] += 1e305;  // finite, but the square of the change is not
  };
}

void prepare_no_solution() {
  broken.residual = [](const void*, const catena_point* at, double* r) {
    two_links()->residual(two_links()->context, at, r);
    // no acceleration whatever makes this vanish
    r[0] += 1e9 * (1.0 + (at->a[0] / 1e9) * (at->a[0] / 1e9));
  };
}

void prepare_rough_force() {
  broken.residual = [](const void*, const catena_point* at, double* r) {
    two_links()->residual(two_links()->context, at, r);
    // no two times see the same torque, and no step is short enough not to feel it
    if (at->t > 0.5) r[0] += 1e20 * std::sin(1e15 * at->t);
  };
}

TEST_CASE("failures are statuses that name the state and the time") {
  const Failure failures[] = {
      {"equations not finite", prepare_not_finite, Status::kNotFinite, "theta_2 at t = 0.5"},
      {"a correction too large for a number", prepare_overflow, Status::kNotFinite,
       "theta_2 at t = 0.5"},
      {"Newton's method diverges", prepare_no_solution, Status::kNoConvergence, "theta_"},
      {"a force without any smoothness", prepare_rough_force, Status::kStepFailure,
       "_rate at t = 0.5"},
  };
  for (const Failure& failure : failures) {
    CAPTURE(failure.what);
    broken = *two_links();
    failure.prepare();
    const Model model(&broken);
    const auto p = cable_parameters(model, 5.0, 0.05);
    const auto run = catena::simulate(model, p, catena::straight(model, 0.5), even_times(1.0, 10));
    CAPTURE(run.message);
    CHECK(catena::status_name(run.status) == std::string(catena::status_name(failure.status)));
    CHECK(run.message.find(failure.in_message) != std::string::npos);
    // what was reached before is there, and no more
    CHECK(run.trajectory.q.cols() == static_cast<Eigen::Index>(run.trajectory.time.size()));
    CHECK(run.trajectory.energy.cols() == run.trajectory.q.cols());
    CHECK(run.trajectory.time.back() < 0.6);
    CHECK(run.trajectory.q.allFinite());
  }
}

TEST_CASE("a mass matrix without a pivot is a status") {
  const Model model(reference_model<2>());
  auto p = cable_parameters(model, 5.0, 0.05);
  p[2 + 1] = p[4 + 1] = p[12] = 0.0;  // mass_2, inertia_2, load_mass
  const auto run = catena::simulate(model, p, catena::straight(model, 0.5), even_times(1.0, 10));
  CHECK(run.status == Status::kSingular);
  CHECK(run.message.find("theta_2 at t = 0 s") != std::string::npos);
  CHECK(run.trajectory.time.size() == 1);
}

TEST_CASE("too many steps and interruption are statuses") {
  const Model model(reference_model<2>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  SimulationOptions options;
  options.max_steps = 20;
  auto run = catena::simulate(model, p, catena::straight(model, 0.5), even_times(1.0, 10), options);
  CHECK(run.status == Status::kTooManySteps);
  CHECK(run.message.find("20 steps") != std::string::npos);
  CHECK(run.statistics.steps == 20);

  options.max_steps = 1'000'000;
  options.keep_going = [](double t) { return t < 0.45; };
  run = catena::simulate(model, p, catena::straight(model, 0.5), even_times(1.0, 10), options);
  CHECK(run.status == Status::kInterrupted);
  CHECK(run.message.find("t = 0.4") != std::string::npos);
  CHECK(run.trajectory.time.back() == doctest::Approx(0.4));
}

TEST_CASE("the first step at rest does not grow with the time to be simulated") {
  const Model model(reference_model<2>());
  const auto p = cable_parameters(model, 5.0, 0.05);
  const auto first_step = [&](double end) {
    SimulationOptions options;
    double reached = 0;
    options.keep_going = [&](double t) {
      reached = t;
      return false;
    };
    catena::simulate(model, p, catena::straight(model, 0.0), {0.0, end}, options);
    return reached;
  };
  CHECK(first_step(1e6) == first_step(1e3));
  CHECK(first_step(1e6) < 0.1);
}

TEST_CASE("a simulation that was not run says so") {
  CHECK(catena::Simulation{}.status == Status::kNotRun);
}

TEST_CASE("bad arguments name the value and the rule") {
  const Model model(reference_model<2>());
  const auto good = cable_parameters(model, 5.0, 0.05);
  const State start = catena::straight(model, 0.5);
  struct Row {
    const char* message;
    std::function<void(Eigen::VectorXd&, State&, std::vector<double>&, SimulationOptions&)> spoil;
  };
  const Row rows[] = {
      {"13 values given, the model has 14",
       [](auto& p, auto&, auto&, auto&) { p.conservativeResize(13); }},
      {"parameter length_1 has no value",
       [](auto& p, auto&, auto&, auto&) { p[0] = std::nan(""); }},
      {"parameter mass_2 = -0.1 kg is below its lower bound 0",
       [](auto& p, auto&, auto&, auto&) { p[3] = -0.1; }},
      {"initial q: 1 values given, the model has 2",
       [](auto&, auto& s, auto&, auto&) { s.q.conservativeResize(1); }},
      {"initial v, entry 2 = nan must be finite",
       [](auto&, auto& s, auto&, auto&) { s.v[1] = std::nan(""); }},
      {"times: none given", [](auto&, auto&, auto& t, auto&) { t.clear(); }},
      {"times, entry 3 = 0.1 s does not come after 0.1 s",
       [](auto&, auto&, auto& t, auto&) {
         t = {0.0, 0.1, 0.1};
       }},
      {"relative_tolerance = 0 must be positive",
       [](auto&, auto&, auto&, auto& o) { o.relative_tolerance = 0.0; }},
      {"absolute_tolerance_velocity = -1 must be positive",
       [](auto&, auto&, auto&, auto& o) { o.absolute_tolerance_velocity = -1.0; }},
      {"max_steps = 0 must be at least 1", [](auto&, auto&, auto&, auto& o) { o.max_steps = 0; }},
  };
  for (const Row& row : rows) {
    CAPTURE(row.message);
    auto p = good;
    State s = start;
    auto t = even_times(1.0, 10);
    SimulationOptions options;
    row.spoil(p, s, t, options);
    std::string message = "nothing was thrown";
    try {
      catena::simulate(model, p, s, t, options);
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    CAPTURE(message);
    CHECK(message.find(row.message) != std::string::npos);
  }
  SimulationOptions structured;
  structured.linear_solver = LinearSolver::kStructured;
  CHECK_THROWS_AS(catena::simulate(Model(reference_model<2>(false)), good, start,
                                   even_times(1.0, 1), structured),
                  std::invalid_argument);
}

TEST_CASE("signals must be the model's and cover the simulation") {
  const Model model(catena::testing::DrivenModel::table());
  const auto p = cable_parameters(model, 2.0, 0.05);
  const State start = State::zero(model);
  CHECK_THROWS_AS(catena::simulate(model, p, start, {0.0, 1.0}), std::invalid_argument);
  const std::vector<double> t{0.0, 0.5}, value{0.0, 1.0};
  catena::Signals other, short_one;
  other.add("wind", t, value);
  short_one.add("drive.torque", t, value);
  CHECK_THROWS_AS(catena::simulate(model, p, start, {0.0, 0.4}, {}, other), std::invalid_argument);
  CHECK_THROWS_AS(catena::simulate(model, p, start, {0.0, 1.0}, {}, short_one),
                  std::invalid_argument);
}

}  // namespace
