// SPDX-License-Identifier: GPL-3.0-or-later
//
// Tangents along several directions at once, and solves with several right-hand sides, against one
// at a time: the same operations in the same order, so the same bits.
#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "generated/directions.hpp"
#include "tests/generated/emitted_model.hpp"

using namespace catena::tests;

namespace {

constexpr std::size_t kWidth = CATENA_DIRECTIONS;

using DirectionBatch = std::vector<catena::Directions>;

double* numbers(DirectionBatch& several) { return reinterpret_cast<double*>(several.data()); }

DirectionBatch side_by_side(const std::vector<Input<double>>& inputs,
                            const std::vector<double> Input<double>::*member) {
  DirectionBatch result((inputs[0].*member).size());
  for (std::size_t k = 0; k < kWidth; ++k)
    for (std::size_t i = 0; i < result.size(); ++i)
      result[i].set(static_cast<int>(k), (inputs[k].*member)[i]);
  return result;
}

catena_point c_point(const Input<double>& input) {
  return {input.t,        input.q.data(), input.v.data(), input.a.data(),
          input.z.data(), input.u.data(), input.p.data()};
}

}  // namespace

TEST_CASE("several directions at once have the bits of one at a time") {
  for (const EmittedModel& model : emitted_models()) {
    const catena_model& table = *model.table;
    CAPTURE(table.id);
    REQUIRE(static_cast<bool>(table.residual_tangents));
    CHECK((table.state_rate_tangents != nullptr) == (table.states > 0));
    CHECK((table.newton_solves != nullptr) == (table.structured != 0));
    std::mt19937_64 random(27);
    const Input<double> input = random_input(table, random);
    std::vector<Input<double>> along;
    for (std::size_t k = 0; k < kWidth; ++k) {
      along.push_back(random_input(table, random));
      along.back().t = 0.25;  // of all directions
    }
    DirectionBatch q = side_by_side(along, &Input<double>::q),
                   v = side_by_side(along, &Input<double>::v),
                   a = side_by_side(along, &Input<double>::a),
                   z = side_by_side(along, &Input<double>::z),
                   u = side_by_side(along, &Input<double>::u),
                   p = side_by_side(along, &Input<double>::p);
    const catena_point at = c_point(input);
    const catena_point all{0.25,       numbers(q), numbers(v), numbers(a),
                           numbers(z), numbers(u), numbers(p)};

    const auto n = static_cast<std::size_t>(table.coordinates);
    const auto compare = [&](auto several, auto one, std::size_t entries) {
      DirectionBatch changes(entries);
      several(table.context, &at, &all, numbers(changes));
      for (std::size_t k = 0; k < kWidth; ++k) {
        std::vector<double> change(entries);
        const catena_point direction = c_point(along[k]);
        one(table.context, &at, &direction, change.data());
        for (std::size_t i = 0; i < entries; ++i)
          CHECK(changes[i][static_cast<int>(k)] == change[i]);
      }
    };
    compare(table.residual_tangents, table.residual_tangent, n);
    if (table.states > 0)
      compare(table.state_rate_tangents, table.state_rate_tangent,
              static_cast<std::size_t>(table.states));
    if (table.structured == 0) continue;
    std::vector<double> work(static_cast<std::size_t>(table.newton_work));
    REQUIRE(table.newton_factor(table.context, &at, 1, 1e-3, 1e-6, work.data()) == 0);
    DirectionBatch solutions = side_by_side(along, &Input<double>::q);
    table.newton_solves(table.context, work.data(), numbers(solutions));
    for (std::size_t k = 0; k < kWidth; ++k) {
      std::vector<double> solution = along[k].q;
      table.newton_solve(table.context, work.data(), solution.data());
      for (std::size_t i = 0; i < n; ++i) CHECK(solutions[i][static_cast<int>(k)] == solution[i]);
    }
  }
}
