// SPDX-License-Identifier: BSD-3-Clause
#include "runtime/adjoint.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "runtime/rest_states.hpp"
#include "tests/runtime/cable_case.hpp"
#include "tests/runtime/driven_model.hpp"
#include "tests/runtime/simulation_input.hpp"

namespace {

using catena::Model;
using catena::SensitivityDirection;
using catena::State;
using catena::Trajectory;
using catena::testing::cable_parameters;
using catena::testing::even_times;
using catena::testing::with_tolerance;
using Eigen::VectorXd;

// J = sum over the times of |q|^2 / 2 + 0.01 |v|^2 / 2 + sum z.
double value(const Trajectory& motion) {
  return 0.5 * motion.q.squaredNorm() + 0.005 * motion.v.squaredNorm() + motion.z.sum();
}
void slope_of(const Trajectory& motion, Trajectory& slope) {
  slope.q = motion.q;
  slope.v = 0.01 * motion.v;
  slope.z.setOnes();
}

double along(const SensitivityDirection& gradient, const SensitivityDirection& direction) {
  return gradient.parameters.dot(direction.parameters) + gradient.q.dot(direction.q) +
         gradient.v.dot(direction.v) + gradient.z.dot(direction.z);
}

// Compares the gradient with forward sensitivities and central differences along each direction.
void check_gradient(const Model& model, const VectorXd& p, const State& start,
                    const std::vector<SensitivityDirection>& directions,
                    const std::vector<double>& t, const catena::Signals& signals,
                    double tolerance) {
  const auto adjoint =
      catena::simulate_with_gradient(model, p, start, t, slope_of, with_tolerance(1e-9), signals);
  CAPTURE(adjoint.message);
  REQUIRE(adjoint.status == catena::Status::kSuccess);
  const auto forward = catena::simulate_with_sensitivities(model, p, start, directions, t,
                                                           with_tolerance(1e-9), signals);
  REQUIRE(forward.status == catena::Status::kSuccess);
  Trajectory slope = forward.trajectory;
  slope_of(forward.trajectory, slope);
  for (std::size_t k = 0; k < directions.size(); ++k) {
    CAPTURE(k);
    const SensitivityDirection& direction = directions[k];
    const Trajectory& s = forward.sensitivity[k];
    const double expected =
        slope.q.cwiseProduct(s.q).sum() + slope.v.cwiseProduct(s.v).sum() + s.z.sum();
    const double size = direction.parameters.cwiseProduct(p).cwiseAbs().maxCoeff();
    const double h = 1e-4 * (size > 0.0 ? size : 1.0);
    const auto at = [&](double e) {
      const State moved{start.q + e * direction.q, start.v + e * direction.v,
                        start.z + e * direction.z};
      return value(catena::simulate(model, p + e * direction.parameters, moved, t,
                                    with_tolerance(1e-12), signals)
                       .trajectory);
    };
    const double difference = (at(h) - at(-h)) / (2 * h);
    const double actual = along(adjoint.gradient, direction);
    CHECK(std::abs(actual - expected) < tolerance * std::abs(expected));
    CHECK(std::abs(actual - difference) < tolerance * std::abs(difference));
  }
}

// What residual_adjoint has to give, from the tangents along every unit vector.
struct ByTangents {
  static const catena_model*& table() {
    static const catena_model* given = nullptr;
    return given;
  }
  static void residual_adjoint(const void*, const catena_point* at, const double* weight,
                               const double* rate_weight, double* dq, double* dv, double* dz,
                               double* dp) {
    const catena_model& m = *table();
    VectorXd q = VectorXd::Zero(m.coordinates), v = q, a = q, r(m.coordinates);
    VectorXd z = VectorXd::Zero(m.states), f(m.states);
    VectorXd p = VectorXd::Zero(m.parameters), u = VectorXd::Zero(3 * m.signals);
    const auto each = [&](VectorXd& unit, double* out) {
      for (Eigen::Index i = 0; i < unit.size(); ++i) {
        unit[i] = 1.0;
        const catena_point direction{0.0,      q.data(), v.data(), a.data(),
                                     z.data(), u.data(), p.data()};
        m.residual_tangent(m.context, at, &direction, r.data());
        out[i] = r.dot(Eigen::Map<const VectorXd>(weight, m.coordinates));
        if (m.states > 0) {
          m.state_rate_tangent(m.context, at, &direction, f.data());
          out[i] += f.dot(Eigen::Map<const VectorXd>(rate_weight, m.states));
        }
        unit[i] = 0.0;
      }
    };
    each(q, dq);
    each(v, dv);
    each(z, dz);
    each(p, dp);
  }
};

TEST_CASE("the emitted gradient is the transpose of the emitted tangent") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (const int n : Model::built_in_links()) {
    CAPTURE(n);
    const Model model = Model::built_in(n);
    const auto values = [&](int count) {
      VectorXd x(count);
      for (double& entry : x) entry = number(random);
      return x;
    };
    const VectorXd q = 3.0 * values(n), v = 5.0 * values(n), a = 20.0 * values(n);
    const VectorXd p = values(model.parameters()), weight = values(n);
    const catena_point at{0.0, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
    VectorXd dq(n), dv(n), dp(model.parameters()), tq(n), tv(n), tp(model.parameters());
    model.residual_adjoint(at, weight.data(), nullptr, dq.data(), dv.data(), nullptr, dp.data());
    ByTangents::table() = &model.table();
    ByTangents::residual_adjoint(nullptr, &at, weight.data(), nullptr, tq.data(), tv.data(),
                                 nullptr, tp.data());
    // Sums of some n^2 terms of the size of the largest, in another order.
    const double rounding = 1e-15 * (10 + n * n);
    CHECK((dq - tq).cwiseAbs().maxCoeff() < rounding * tq.cwiseAbs().maxCoeff());
    CHECK((dv - tv).cwiseAbs().maxCoeff() < rounding * tv.cwiseAbs().maxCoeff());
    CHECK((dp - tp).cwiseAbs().maxCoeff() < rounding * tp.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("the transposed Newton matrix is solved with the same factors") {
  for (const int n : {3, 4, 12, 60}) {
    CAPTURE(n);
    const Model model = Model::built_in(n);
    const auto& table = model.table();
    const VectorXd p = cable_parameters(model, 5.0, 0.5);
    const VectorXd q = VectorXd::LinSpaced(n, 0.3, 1.4), v = VectorXd::LinSpaced(n, 3.0, -2.0);
    const VectorXd a = VectorXd::LinSpaced(n, -30.0, 60.0);
    const catena_point at{0.0, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
    std::vector<double> work(static_cast<std::size_t>(table.newton_work));
    REQUIRE(table.newton_factor(table.context, &at, 1.0, 0.02, 0.0004, work.data()) == 0);
    // x' (N^-1 y) = (N^-T x)' y for every pair of unit vectors
    Eigen::MatrixXd inverse(n, n), transposed(n, n);
    inverse.setIdentity();
    transposed.setIdentity();
    for (int j = 0; j < n; ++j) {
      table.newton_solve(table.context, work.data(), inverse.col(j).data());
      table.newton_solve_transposed(table.context, work.data(), transposed.col(j).data());
    }
    CHECK((inverse - inverse.transpose()).cwiseAbs().maxCoeff() >
          1e-6 * inverse.cwiseAbs().maxCoeff());
    CHECK((inverse.transpose() - transposed).cwiseAbs().maxCoeff() <
          1e-10 * inverse.cwiseAbs().maxCoeff());
  }
}

TEST_CASE("gradient of 4 links: every parameter and the initial state") {
  const Model model = Model::built_in(4);
  const VectorXd p = cable_parameters(model, 5.0, 0.05);
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
  check_gradient(model, p, start, directions, even_times(1.0, 10), {}, 1e-4);
}

TEST_CASE("gradient with an extra state and a signal, by the dense solver") {
  static const catena_model& base = *catena::testing::DrivenModel::table();
  static catena_model table = base;
  ByTangents::table() = &base;
  table.residual_adjoint = &ByTangents::residual_adjoint;
  const Model model(&table);
  const VectorXd p = cable_parameters(model, 2.0, 0.05);
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
  check_gradient(model, p, start, directions, even_times(1.0, 10), signals, 1e-4);
}

TEST_CASE("gradient of 60 links over more than one check point") {
  const Model model = Model::built_in(60);
  const VectorXd p = cable_parameters(model, 237.2412, 0.0336);
  const State start = catena::straight(model, 0.5);
  std::vector<SensitivityDirection> directions;
  SensitivityDirection common = SensitivityDirection::zero(model);
  common.parameters.segment(3 * 60, 60).setOnes();
  directions.push_back(common);
  directions.push_back(SensitivityDirection::parameter(model, model.parameter_index("load_mass")));
  const auto run = catena::simulate(model, p, start, even_times(0.5, 5), with_tolerance(1e-9));
  CHECK(run.statistics.steps > 500);
  check_gradient(model, p, start, directions, even_times(0.5, 5), {}, 1e-4);
}

TEST_CASE("a slope of the wrong size is refused") {
  const Model model = Model::built_in(2);
  const auto wrong = [](const Trajectory&, Trajectory& slope) { slope.q.resize(1, 1); };
  CHECK_THROWS_AS(
      catena::simulate_with_gradient(model, cable_parameters(model, 5.0, 0.05),
                                     catena::straight(model, 0.1), even_times(0.1, 2), wrong),
      std::invalid_argument);
}

}  // namespace
