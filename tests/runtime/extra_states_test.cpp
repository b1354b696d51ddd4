// SPDX-License-Identifier: BSD-3-Clause
//
// Extra states of joints: their elimination from the Newton matrix, O(n), against the dense matrix
// of all unknowns.
#include <doctest/doctest.h>

#include <limits>
#include <random>

#include "linear_algebra/decompositions.hpp"
#include "runtime/batch_dynamics.hpp"
#include "runtime/newton_matrix.hpp"
#include "runtime/simulation.hpp"

namespace {

using catena::LinearSolver;
using catena::Model;
using Eigen::VectorXd;

struct Random {
  VectorXd vector(int size, double low, double high) {
    VectorXd values(size);
    for (double& value : values) value = std::uniform_real_distribution<double>(low, high)(engine);
    return values;
  }
  std::mt19937 engine{11};
};

VectorXd parameters(const Model& model, double scale_of_load) {
  VectorXd p = model.default_parameters();
  const int n = model.links();
  const double length = 3.39 / n, mass = 0.1424 * length;
  p.segment(0, n).setConstant(length);
  p.segment(n, n).setConstant(mass);
  p.segment(2 * n, n).setConstant(mass * length * length / 12);
  p.segment(3 * n, n).setConstant(237.2412 * n / 60);
  p.segment(4 * n, n).setConstant(0.0336 * n / 60);
  p[model.parameter_index("load_mass")] = 1.47 * scale_of_load;
  p[model.parameter_index("gravity")] = 9.81;
  for (int i = 0; i < p.size(); ++i)
    if (!std::isfinite(p[i])) p[i] = 0.05;
  p[model.parameter_index("joint_hysteresis.moment")] = 0.4;
  return p;
}

// Both are backward stable: what their solutions may differ by is a few roundings times the
// condition of the matrix, which the step gamma sets between that of M and that of the stiffness.
TEST_CASE("states eliminated joint by joint or in the dense matrix of all unknowns: one solution") {
  const Model model = Model::load(WITH_STATES_12);
  REQUIRE(model.states() == 12);
  const int n = model.coordinates(), size = n + model.states();
  Random random;
  const catena::Signals none;
  double worst = 0.0;
  for (const double load : {1.0, 1e-3, 1e4}) {
    catena::Dynamics dynamics(model, parameters(model, load), none);
    LinearSolver used;
    const auto structured = make_newton_matrix(model, LinearSolver::kStructured, used);
    const auto dense = make_newton_matrix(model, LinearSolver::kDense, used);
    for (int trial = 0; trial < 30; ++trial) {
      const VectorXd q = random.vector(n, -3.0, 3.0), v = random.vector(n, -4.0, 4.0),
                     a = random.vector(n, -9.0, 9.0), z = random.vector(n, -0.02, 0.02);
      const double gamma = std::pow(10.0, -1.0 - trial % 5);
      const catena_point at = dynamics.at(0.0, q.data(), v.data(), a.data(), z.data());
      REQUIRE(structured->factor(dynamics, at, gamma) == 0);
      REQUIRE(dense->factor(dynamics, at, gamma) == 0);
      Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(size, size);
      for (int j = 0; j < size; ++j) dense->solve(inverse.col(j).data());
      const VectorXd singular = catena::singular_directions(inverse).values;
      const double roundings =
          singular[0] / singular[size - 1] * std::numeric_limits<double>::epsilon();
      const VectorXd b = random.vector(size, -1.0, 1.0);
      VectorXd x = b, y = b;
      structured->solve(x.data());
      dense->solve(y.data());
      worst = std::max(worst, (x - y).norm() / y.norm() / roundings);
      x = y = b;
      structured->solve_transposed(x.data());
      dense->solve_transposed(y.data());
      worst = std::max(worst, (x - y).norm() / y.norm() / roundings);
    }
  }
  CAPTURE(worst);
  CHECK(worst < 30);
}

TEST_CASE("a simulation with extra states takes the O(n) path and ends where the dense one does") {
  const Model model = Model::load(WITH_STATES_12);
  catena::State start = catena::State::zero(model);
  start.q = VectorXd::LinSpaced(12, 0.6, 0.9);
  catena::SimulationOptions options;
  options.relative_tolerance = 1e-10;
  VectorXd ends[2];
  const LinearSolver requested[] = {LinearSolver::kAutomatic, LinearSolver::kDense};
  for (int k = 0; k < 2; ++k) {
    options.linear_solver = requested[k];
    const auto run = catena::simulate(model, parameters(model, 1.0), start, {0.0, 0.2}, options);
    REQUIRE(run.status == catena::Status::kSuccess);
    CHECK(run.statistics.used == (k == 0 ? LinearSolver::kStructured : LinearSolver::kDense));
    ends[k] = run.trajectory.q.col(1);
  }
  CHECK((ends[0] - ends[1]).cwiseAbs().maxCoeff() < 1e-6);
}

TEST_CASE("a batch of eight points with extra states has the bits of eight calls") {
  const Model model = Model::load(WITH_STATES_12);
  const int n = model.coordinates();
  Random random;
  catena::BatchDynamics sets(model);
  std::vector<VectorXd> q, v, z, p;
  for (int k = 0; k < catena::BatchDynamics::kBatch; ++k) {
    q.push_back(random.vector(n, -3.0, 3.0));
    v.push_back(random.vector(n, -4.0, 4.0));
    z.push_back(random.vector(n, -0.02, 0.02));
    p.push_back(parameters(model, 1.0 + k));
    sets.set_parameters(k, p.back());
    for (int i = 0; i < n; ++i) {
      sets.q(k, i) = q.back()[i];
      sets.v(k, i) = v.back()[i];
      sets.z(k, i) = z.back()[i];
    }
  }
  REQUIRE(sets.evaluate(0.0) == 0);
  for (int k = 0; k < catena::BatchDynamics::kBatch; ++k) {
    const auto set = static_cast<std::size_t>(k);
    VectorXd a(n);
    const catena_point at{0.0,           q[set].data(), v[set].data(), nullptr,
                          z[set].data(), nullptr,       p[set].data()};
    REQUIRE(model.acceleration(at, a.data()) == 0);
    for (int i = 0; i < n; ++i) CHECK(sets.acceleration(k, i) == a[i]);
  }
}

}  // namespace
