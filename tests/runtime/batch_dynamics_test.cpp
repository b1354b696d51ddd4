// SPDX-License-Identifier: BSD-3-Clause
//
// Eight parameter sets and states at once, by the widest registers of this processor, give the bits
// of eight calls for one.
#include "runtime/batch_dynamics.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

#include "runtime/state.hpp"

namespace {

using catena::BatchDynamics;
using catena::Model;
using catena::State;

TEST_CASE("a batch of eight points has the bits of eight calls") {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (const int n : Model::built_in_links()) {
    CAPTURE(n);
    const Model model = Model::built_in(n);
    BatchDynamics sets(model);
    std::vector<Eigen::VectorXd> parameters;
    std::vector<State> states;
    for (int k = 0; k < BatchDynamics::kBatch; ++k) {
      Eigen::VectorXd p(model.parameters());
      for (int i = 0; i < p.size(); ++i) p[i] = uniform(0.1, 1.0);
      State state = State::zero(model);
      for (int i = 0; i < n; ++i) {
        state.q[i] = uniform(-7.0, 7.0);
        state.v[i] = uniform(-5.0, 5.0);
      }
      sets.set_parameters(k, p);
      for (int i = 0; i < n; ++i) {
        sets.q(k, i) = state.q[i];
        sets.v(k, i) = state.v[i];
      }
      parameters.push_back(p);
      states.push_back(state);
    }
    REQUIRE(sets.evaluate(0.0) == 0);
    for (int k = 0; k < BatchDynamics::kBatch; ++k) {
      const auto set = static_cast<std::size_t>(k);
      Eigen::VectorXd a(n);
      const catena_point at{0.0,     states[set].q.data(),  states[set].v.data(), nullptr, nullptr,
                            nullptr, parameters[set].data()};
      REQUIRE(model.acceleration(at, a.data()) == 0);
      for (int i = 0; i < n; ++i) {
        const double together = sets.acceleration(k, i);
        CHECK(std::memcmp(&together, &a[i], sizeof together) == 0);
      }
    }
  }
}

TEST_CASE("what does not fit the model is refused") {
  const Model model = Model::built_in(12);
  BatchDynamics sets(model);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(model.parameters());
  sets.set_parameters(7, ones);
  CHECK_THROWS_WITH_AS(sets.set_parameters(8, ones), "set 8: there are sets 0 to 7",
                       std::invalid_argument);
  CHECK_THROWS_AS(sets.set_parameters(0, Eigen::VectorXd::Ones(5)), std::invalid_argument);
  CHECK_THROWS_AS(sets.set_parameters(0, -ones), std::invalid_argument);
}

TEST_CASE("a mass matrix without a pivot is reported") {
  const Model model = Model::built_in(4);
  BatchDynamics sets(model);  // all masses zero
  CHECK(sets.evaluate(0.0) != 0);
}

/// In place of accelerations, sums in which every entry of every array shows; arrays lie as
/// catena_model.h has them for `sets` at once. Coordinate 2 fails where its velocity is negative.
template <int sets>
int32_t sums(const void*, const catena_point* at, double* a) {
  for (int k = 0; k < sets; ++k) {
    const auto of = [&](const double* array, int i) { return array[i * sets + k]; };
    if (of(at->v, 1) < 0) return 2;
    for (int i = 0; i < 2; ++i)
      a[i * sets + k] = at->t + of(at->q, i) + 10 * of(at->v, i) + 100 * of(at->z, 0) +
                        1e3 * of(at->u, 2) + 1e4 * of(at->p, 13);
  }
  return 0;
}

TEST_CASE("a batch of eight points is passed on in groups of as many as the processor takes") {
  using Sums = int32_t (*)(const void*, const catena_point*, double*);
  for (const auto& row :
       {std::pair<int, Sums>{1, sums<1>}, {2, sums<2>}, {4, sums<4>}, {8, sums<8>}}) {
    CAPTURE(row.first);
    catena_model table = Model::built_in(2).table();
    table.states = 1;
    table.state_rate = [](const void*, const catena_point*, double*) {};
    table.state_rate_tangent = [](const void*, const catena_point*, const catena_point*, double*) {
    };
    table.signals = 1;
    table.accelerations = row.second;
    table.batch = row.first;
    const Model model(&table);
    BatchDynamics sets(model);
    for (int k = 0; k < BatchDynamics::kBatch; ++k) {
      Eigen::VectorXd p = Eigen::VectorXd::Ones(model.parameters());
      p[13] = k;
      sets.set_parameters(k, p);
      for (int i = 0; i < 2; ++i) {
        sets.q(k, i) = 8 * i + k;
        sets.v(k, i) = 7 + 8 * i - k;
      }
      sets.z(k, 0) = k + 2;
      sets.u(k, 2) = k + 1;
    }
    REQUIRE(sets.evaluate(0.5) == 0);
    for (int k = 0; k < BatchDynamics::kBatch; ++k)
      for (int i = 0; i < 2; ++i)
        CHECK(sets.acceleration(k, i) ==
              0.5 + (8 * i + k) + 10 * (7 + 8 * i - k) + 100 * (k + 2) + 1e3 * (k + 1) + 1e4 * k);
    for (int k = 0; k < BatchDynamics::kBatch; ++k) {  // one that fails is enough
      const double velocity = std::exchange(sets.v(k, 1), -1);
      CHECK(sets.evaluate(0.5) == 2);
      sets.v(k, 1) = velocity;
    }
  }
}

}  // namespace
