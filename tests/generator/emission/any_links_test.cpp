// SPDX-License-Identifier: BSD-3-Clause
//
// The model with effects for any number of links against the one derived for 12: the same table and
// the same bits.
#include <doctest/doctest.h>

#include <random>
#include <string>
#include <vector>

#include "any_links_table.hpp"
#include "catena_model.h"
#include "chain_joint_hysteresis_support_series_scale_sea_floor_12.hpp"
#include "chain_joint_hysteresis_support_series_scale_sea_floor_any.hpp"

namespace any = catena::chain_joint_hysteresis_support_series_scale_sea_floor_any;
namespace twelve = catena::chain_joint_hysteresis_support_series_scale_sea_floor_12;

namespace {

using Values = std::vector<double>;

struct State {
  State(const catena_model& model, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.1, 1.0);
    const auto fill = [&](Values& values, int count) {
      for (int i = 0; i < count; ++i) values.push_back(unit(random));
    };
    for (Values* values : {&q, &v, &a}) fill(*values, model.coordinates);
    fill(z, model.states);
    fill(u, 3 * model.signals);
    fill(p, model.parameters);
  }
  catena_point point() const {
    return {0.3, q.data(), v.data(), a.data(), z.data(), u.data(), p.data()};
  }
  Values q, v, a, z, u, p;
};

// What the functions of a model write, one after the other.
Values results(const catena_model& model) {
  const State here(model, 1), there(model, 2);
  const catena_point at = here.point(), along = there.point();
  const auto n = static_cast<std::size_t>(model.coordinates);
  Values all;
  const auto call = [&](std::size_t count, const auto& function) {
    Values values(count);
    function(values.data());
    all.insert(all.end(), values.begin(), values.end());
  };
  const void* c = model.context;
  call(n, [&](double* r) { model.residual(c, &at, r); });
  call(n, [&](double* r) { model.residual_tangent(c, &at, &along, r); });
  call(n * n, [&](double* M) { model.mass_matrix(c, &at, M); });
  call(n, [&](double* a) { REQUIRE(model.acceleration(c, &at, a) == 0); });
  const auto states = static_cast<std::size_t>(model.states);
  call(states, [&](double* f) { model.state_rate(c, &at, f); });
  call(states, [&](double* f) { model.state_rate_tangent(c, &at, &along, f); });
  const auto parameters = static_cast<std::size_t>(model.parameters);
  call(2 * n + states + parameters, [&](double* d) {
    model.residual_adjoint(c, &at, along.a, along.z, d, d + n, d + 2 * n, d + 2 * n + states);
  });
  call(static_cast<std::size_t>(model.energies), [&](double* e) { model.energy(c, &at, e); });
  call(2 * n + 4, [&](double* x) { model.positions(c, &at, x, x + n + 2); });
  call(3 * n, [&](double* x) { model.internal_forces(c, &at, x, x + n, x + 2 * n); });
  call(static_cast<std::size_t>(model.events), [&](double* e) { model.event_values(c, &at, e); });
  const double in[3] = {0.3, 0.7, 0.4};
  call(3, [&](double* out) { model.observe(c, 0.3, at.p, in, out); });
  Values work(static_cast<std::size_t>(model.newton_work));
  REQUIRE(model.newton_factor(c, &at, 1.0, 0.01, 1e-4, work.data()) == 0);
  all.insert(all.end(), along.q, along.q + n);
  model.newton_solve(c, work.data(), all.data() + all.size() - n);
  return all;
}

}  // namespace

TEST_CASE("a model with effects for any number of links is the one derived for 12") {
  const catena::AnyLinksModel<any::Chain> made(12);
  const catena_model &model = made.model(), &fixed = twelve::table();
  REQUIRE(model.states == 12);
  REQUIRE(model.signals > 0);
  REQUIRE(model.observes == 1);
  REQUIRE(model.coordinates == fixed.coordinates);
  REQUIRE(model.states == fixed.states);
  REQUIRE(model.signals == fixed.signals);
  REQUIRE(model.parameters == fixed.parameters);
  REQUIRE(model.events == 13);  // of every link and of the load
  REQUIRE(model.events == fixed.events);
  CHECK(std::string(model.id) == fixed.id);
  CHECK(std::string(model.description_hash) == fixed.description_hash);
  for (int k = 0; k < fixed.parameters; ++k) {
    CHECK(std::string(model.parameter[k].name) == fixed.parameter[k].name);
    CHECK(std::string(model.parameter[k].description) == fixed.parameter[k].description);
  }
  for (int k = 0; k < fixed.states; ++k)
    CHECK(std::string(model.state[k].name) == fixed.state[k].name);
  for (int k = 0; k < fixed.signals; ++k)
    CHECK(std::string(model.signal[k].name) == fixed.signal[k].name);
  for (int k = 0; k < fixed.events; ++k)
    CHECK(std::string(model.event[k].name) == fixed.event[k].name);
  CHECK(results(model) == results(fixed));
}
