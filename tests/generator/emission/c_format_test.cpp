// SPDX-License-Identifier: BSD-3-Clause
//
// Plain C99 against the C++ of the same model, at seeded states.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "chain_1.h"
#include "chain_12.h"
#include "chain_60.h"
#include "generated/models.hpp"
#include "tests/support/near.hpp"

namespace {

struct State {
  std::vector<double> q, v, a, p;
  catena_point point() const {
    return {0.0, q.data(), v.data(), a.data(), nullptr, nullptr, p.data()};
  }
};

State random_state(const catena_model& model, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.1, 1.0);
  const auto fill = [&](int count) {
    std::vector<double> values(static_cast<size_t>(count));
    for (double& value : values) value = unit(random);
    return values;
  };
  return {fill(model.coordinates), fill(model.coordinates), fill(model.coordinates),
          fill(model.parameters)};
}

// Both do the same sums in the same order but for sines, cosines and the order of elimination:
// a few roundings for each link, magnified by the condition of M for accelerations.
void compare(const std::vector<double>& actual, const std::vector<double>& expected,
             double tolerance) {
  double scale = 0;
  for (const double x : expected) scale = std::max(scale, std::abs(x));
  for (size_t i = 0; i < actual.size(); ++i) {
    CAPTURE(i);
    CHECK(std::abs(actual[i] - expected[i]) <= tolerance * scale);
  }
}

}  // namespace

TEST_CASE("the C of a model computes what its C++ does") {
  int count = 0;
  const catena_model* const* built_in = catena::built_in_models(&count);
  for (const catena_model* c : {chain_12(), chain_60()}) {
    const catena_model* cpp = nullptr;
    for (int k = 0; k < count; ++k) {
      if (built_in[k]->links == c->links) cpp = built_in[k];
    }
    REQUIRE(cpp != nullptr);
    CHECK(std::string(c->description_hash) == cpp->description_hash);
    REQUIRE(c->parameters == cpp->parameters);
    const State state = random_state(*c, 7), along_state = random_state(*c, 8);
    const catena_point at = state.point(), along = along_state.point();
    const size_t n = static_cast<size_t>(c->links);
    const double roundings = 1e-15 * c->links;
    std::vector<double> x(n), y(n), M(n * n), N(n * n);
    c->residual(c->context, &at, x.data());
    cpp->residual(cpp->context, &at, y.data());
    compare(x, y, roundings);
    c->residual_tangent(c->context, &at, &along, x.data());
    cpp->residual_tangent(cpp->context, &at, &along, y.data());
    compare(x, y, roundings);
    std::vector<double> e(static_cast<size_t>(c->energies)), f(e);
    c->energy(c->context, &at, e.data());
    cpp->energy(cpp->context, &at, f.data());
    compare(e, f, roundings);
    c->mass_matrix(c->context, &at, M.data());
    cpp->mass_matrix(cpp->context, &at, N.data());
    compare(M, N, roundings);
    CHECK(c->acceleration(c->context, &at, x.data()) == 0);
    CHECK(cpp->acceleration(cpp->context, &at, y.data()) == 0);
    compare(x, y, 1e4 * roundings);

    const auto gradient = [&](const catena_model& model) {
      const size_t p = static_cast<size_t>(model.parameters);
      std::vector<double> dq(n), dv(n), dp(p);
      model.residual_adjoint(model.context, &at, along.a, nullptr, dq.data(), dv.data(), nullptr,
                             dp.data());
      dq.insert(dq.end(), dv.begin(), dv.end());
      dq.insert(dq.end(), dp.begin(), dp.end());
      return dq;
    };
    compare(gradient(*c), gradient(*cpp), 10 * roundings);

    // An implicit step of 10 ms: N is near M, and as well conditioned.
    REQUIRE(c->structured == 1);
    REQUIRE(c->newton_work == cpp->newton_work);
    const double cv = 0.01, cq = cv * cv;
    std::vector<double> work(static_cast<size_t>(c->newton_work)), other_work(work);
    REQUIRE(c->newton_factor(c->context, &at, 1.0, cv, cq, work.data()) == 0);
    REQUIRE(cpp->newton_factor(cpp->context, &at, 1.0, cv, cq, other_work.data()) == 0);
    x = y = along_state.q;
    c->newton_solve(c->context, work.data(), x.data());
    cpp->newton_solve(cpp->context, other_work.data(), y.data());
    compare(x, y, 1e4 * roundings);
    std::vector<double> several(n * CATENA_DIRECTIONS);
    for (size_t i = 0; i < several.size(); ++i)
      several[i] =
          along_state.q[i / CATENA_DIRECTIONS] * static_cast<double>(i % CATENA_DIRECTIONS + 1);
    c->newton_solves(c->context, work.data(), several.data());
    for (size_t i = 0; i < several.size(); ++i) {
      CHECK(several[i] ==
            catena::near(x[i / CATENA_DIRECTIONS] * static_cast<double>(i % CATENA_DIRECTIONS + 1),
                         1e-9));
    }
    x = y = along_state.v;
    c->newton_solve_transposed(c->context, work.data(), x.data());
    cpp->newton_solve_transposed(cpp->context, other_work.data(), y.data());
    compare(x, y, 1e4 * roundings);
  }
}

TEST_CASE("one link: the physical pendulum") {
  const catena_model* model = chain_1();
  const State state = random_state(*model, 3);
  const catena_point at = state.point();
  double a = 0;
  REQUIRE(model->acceleration(model->context, &at, &a) == 0);
  const double l = state.p[0], m = state.p[1], I = state.p[2], k = state.p[3], c = state.p[4],
               T = state.p[5], mc = state.p[6], g = state.p[7];
  const double torque =
      T - k * state.q[0] - c * state.v[0] - (m / 2 + mc) * g * l * std::sin(state.q[0]);
  CHECK(a == catena::near(torque / (I + l * l * (m / 4 + mc)), 1e-14));
}
